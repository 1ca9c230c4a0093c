"""Which files a gallery shows."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from gltf_iri.errors import UsageError

__all__ = ["find_assets"]

_ENDINGS = (".gltf", ".glb")


def find_assets(paths: Iterable[Path]) -> tuple[Path, ...]:
    """Return the files named, and the .gltf and .glb files of the folders named and of all folders in them.

    A folder's files come sorted; no file comes twice. Folders behind links are not entered, so no walk is
    without end. Raises UsageError where `paths` hold no asset.
    """
    found: dict[Path, Path] = {}
    given = tuple(paths)
    for path in given:
        inside = sorted(path.rglob("*")) if path.is_dir() else (path,)
        for file in inside:
            if file == path or (file.suffix.lower() in _ENDINGS and file.is_file()):
                found.setdefault(file.resolve(), file)
    if not found:
        raise UsageError(f"There is no .gltf or .glb file in {', '.join(map(str, given))}.")
    return tuple(found.values())
