"""The films of real files as a set for the map of cost and error: what their materials meet."""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Final

from gltf_iri.bench.film_parts import FilmPart
from gltf_iri.planning.material_reach import material_reach
from gltf_iri.samples.collection import build_samples
from gltf_iri.scene.load import Model, load
from gltf_iri.whole_files import write_whole

__all__ = ["SAMPLES", "file_parts", "sample_parts", "set_names"]

# The set of this program's own sample assets.
SAMPLES: Final = "samples"

# Files may hold more materials than a benchmark has minutes.
_MOST_PARTS: Final = 60
_LONGEST_NAME: Final = 40


def sample_parts() -> list[FilmPart]:
    """Return the films of the shipped samples' materials, lobe by lobe."""
    parts: list[FilmPart] = []
    with tempfile.TemporaryDirectory() as folder:
        for sample in build_samples():
            place = Path(folder) / sample.name
            write_whole({place / name: content for name, content in sample.files.items()})
            parts += _parts(load(Path(folder) / sample.file))
    return _different(parts)


def file_parts(path: Path) -> list[FilmPart]:
    """Return the films of a file's materials, lobe by lobe; empty where it has none.

    At most sixty. Raises UsageError and AssetError as `load`.
    """
    return _different(_parts(load(path)))


def set_names(paths: Sequence[Path]) -> list[str]:
    """Return a name for the set of each file: plain letters, each once, none that another set has."""
    names: list[str] = []
    for path in paths:
        stem = re.sub(r"[^A-Za-z0-9_-]+", "-", path.stem)[:_LONGEST_NAME].strip("-") or "file"
        name, k = f"file-{stem}", 2
        while name in names:
            name, k = f"file-{stem}-{k}", k + 1
        names.append(name)
    return names


def _parts(model: Model) -> list[FilmPart]:
    parts: list[FilmPart] = []
    for material in model.materials:
        reach = material_reach(material, model.document)
        if reach is not None:
            parts += [
                FilmPart(lobe, reach.film_ior, reach.thickness_nm, reach.base(lobe)) for lobe in reach.lobes
            ]
        if len(parts) > _MOST_PARTS:
            break
    return parts


def _different(parts: Iterable[FilmPart]) -> list[FilmPart]:
    return list(dict.fromkeys(parts))[:_MOST_PARTS]
