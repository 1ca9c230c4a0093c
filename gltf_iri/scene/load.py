"""From a path to a model: the checked document, its materials, and its scenes on demand."""

from __future__ import annotations

from dataclasses import dataclass
from os import PathLike
from pathlib import Path

from gltf_iri.asset.document import Document, open_document
from gltf_iri.errors import naming_file
from gltf_iri.material.material import Material
from gltf_iri.material.parse import parse_materials
from gltf_iri.scene.assemble import assemble_scene
from gltf_iri.scene.extensions import check_extensions
from gltf_iri.scene.model import Scene

__all__ = ["Model", "load"]


@dataclass(frozen=True, slots=True)
class Model:
    """A glTF file that has been opened and whose materials have been read."""

    path: Path
    document: Document
    materials: tuple[Material, ...]
    notes: tuple[str, ...]  # what was left out or put right, in sentences for the report

    def scene(self, index: int | None = None) -> Scene:
        """Return scene `index`, or the file's default scene.

        Raises UsageError where there is no such scene, AssetError where it contradicts itself or holds no
        triangles.
        """
        with naming_file(self.path):
            return assemble_scene(self.document, self.materials, index)


def load(path: str | PathLike[str]) -> Model:
    """Open a .gltf or .glb file.

    Raises UsageError where `path` does not exist; AssetError where the file is broken or requires
    an extension that is not supported.
    """
    place = Path(path)
    with naming_file(place):
        document = open_document(place)
        notes = list(document.notes)
        check_extensions(document.json, notes)
        return Model(place, document, parse_materials(document), tuple(dict.fromkeys(notes)))
