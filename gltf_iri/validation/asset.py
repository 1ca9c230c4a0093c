"""What every rule may ask about the file that is checked."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from gltf_iri.validation.collector import Collector
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.files.resources import Resources
from gltf_iri.validation.options import Options
from gltf_iri.validation.schema.trees import Trees
from gltf_iri.validation.schema.walk import Walk
from gltf_iri.validation.tables import EXTENSIONS

if TYPE_CHECKING:
    from gltf_iri.validation.files.image_info import ImageInfo

__all__ = ["Asset"]


class Asset:
    """A file whose schema was walked.

    root : the checked glTF object.
    entries : all objects, each after those that it holds; the root is last.
    declared : the names in extensionsUsed.
    folder : where files that the asset names lie; None where there is no such place.
    is_glb, binary : whether the file is a GLB, and the bytes of its BIN chunk.
    resources : the bytes of buffers and pictures.
    images : what the headers of those pictures say that could be read, by index.
    """

    def __init__(
        self,
        root: Entry,
        walk: Walk,
        collector: Collector,
        options: Options,
        declared: frozenset[str],
        *,
        folder: Path | None,
        is_glb: bool,
        binary: memoryview | None,
    ) -> None:
        self.root = root
        self._arrays: dict[str, list[Entry | None]] = {}
        self.entries = walk.entries
        self.references = walk.references
        self.collector = collector
        self.options = options
        self.declared = declared
        self.folder = folder
        self.is_glb = is_glb
        self.binary = binary
        self.resources = Resources(self)
        self.images: dict[int, ImageInfo] = {}

    @cached_property
    def trees(self) -> Trees:
        """The trees of all nodes; ask after the links were checked."""
        return Trees(self.array("nodes"))

    def array(self, name: str) -> list[Entry | None]:
        """Return the array that indices of `name` mean: "meshes", or "KHR_lights_punctual.lights"."""
        found = self._arrays.get(name)
        if found is None:
            extension, _, key = name.rpartition(".")
            holder = self.root.extensions.get(extension) if extension else self.root
            found = self._arrays[name] = holder.get(key, []) if holder is not None else []
        return found

    def get(self, name: str, index: int | None) -> Entry | None:
        """Return entry `index` of an array, or None where there is none or it is broken."""
        entries = self.array(name)
        return entries[index] if index is not None and 0 <= index < len(entries) else None

    def knows_extensions_of(self, entry: Entry) -> bool:
        """Return whether all extensions of `entry` are declared and known; others could mean anything."""
        stated = entry.raw.get("extensions")
        return not isinstance(stated, dict) or all(
            name in EXTENSIONS and name in self.declared for name in stated
        )
