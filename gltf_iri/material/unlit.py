"""KHR_materials_unlit: the base colour and nothing else."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

__all__ = ["Unlit"]


@dataclass(frozen=True, slots=True)
class Unlit:
    """A material without lighting; it has no properties."""

    EXTENSION: ClassVar[str] = "KHR_materials_unlit"
