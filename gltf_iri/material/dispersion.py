"""KHR_materials_dispersion: an index of refraction that grows from red to blue."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import number

__all__ = ["Dispersion"]


@dataclass(frozen=True, slots=True)
class Dispersion:
    """Strength of the dispersion."""

    EXTENSION: ClassVar[str] = "KHR_materials_dispersion"

    dispersion: float = number("dispersion", 0.0, "20 divided by the Abbe number; 0 is none.", low=0.0)
