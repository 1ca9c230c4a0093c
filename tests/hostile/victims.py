"""What the fuzzers share: small real assets, a copy of one with one file broken, and the process's size."""

from __future__ import annotations

import random
import resource
from pathlib import Path
from typing import Final

from mutate import break_bytes, break_gltf

__all__ = ["HangError", "assets", "breakage", "resident", "ring"]

LARGEST_ASSET = 1 << 20  # bytes with all its files: larger ones would only slow the search down
BESIDE: Final = (".bin", ".png", ".jpg", ".jpeg", ".webp")
PAGE = resource.getpagesize()


class HangError(Exception):
    """A file took so long that the alarm rang."""


def ring(*_: object) -> None:
    raise HangError


def resident() -> int:
    """Return the bytes of memory that this process holds now."""
    return int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1]) * PAGE


def assets(folders: list[Path]) -> list[Path]:
    """Return the files to break: whole small assets only."""
    found = [p for folder in folders for p in sorted(folder.rglob("*.gl*")) if p.suffix in (".gltf", ".glb")]
    return [path for path in found if sum(f.stat().st_size for f in belonging(path)) <= LARGEST_ASSET]


def belonging(path: Path) -> list[Path]:
    """Return `path` and, for a .gltf, every file of its folder that may be part of it."""
    if path.suffix == ".glb":
        return [path]
    return [path, *(f for f in path.parent.rglob("*") if f.is_file() and f != path and f.suffix in BESIDE)]


def breakage(path: Path, place: Path, chance: random.Random) -> Path:
    """Copy the asset to `place` with one of its files broken; return the copy."""
    victims = [path] * 4 + [f for f in belonging(path) if f.suffix in BESIDE]
    victim = chance.choice(victims)
    for source in belonging(path):
        copy = place / source.relative_to(path.parent)
        copy.parent.mkdir(parents=True, exist_ok=True)
        data = source.read_bytes()
        if source == victim == path:
            data = break_gltf(data, chance, is_glb=path.suffix == ".glb")
        elif source == victim:
            data = break_bytes(data, chance)
        copy.write_bytes(data)
    return place / path.name
