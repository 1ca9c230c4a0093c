"""Writes the broken and hostile files of this folder: `python tests/hostile/write.py`.

Each is a sound triangle with a film over metal, made wrong in one place. What the reader must say about it
stands in cases.json.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Final

from wrong import addresses, bytes_of_files, extents, geometry, materials, nodes, references
from wrong.sound import text

FOLDER: Final = Path(__file__).resolve().parent / "files"
EDITED: Final = (addresses, extents, geometry, nodes, references, materials)


def files() -> Mapping[str, bytes]:
    """Every committed file by its name."""
    edited = {f"{name}.gltf": text(edits) for part in EDITED for name, edits in part.EDITED.items()}
    return {**edited, **bytes_of_files.RAW, **bytes_of_files.GLB}


def main() -> None:
    FOLDER.mkdir(exist_ok=True)
    for place in FOLDER.iterdir():
        place.unlink()
    for name, data in files().items():
        (FOLDER / name).write_bytes(data)


if __name__ == "__main__":
    main()
