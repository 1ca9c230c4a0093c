"""KHR_materials_emissive_strength: light stronger than the factor's 1."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import number

__all__ = ["EmissiveStrength"]


@dataclass(frozen=True, slots=True)
class EmissiveStrength:
    """Multiplies the emissive colour."""

    EXTENSION: ClassVar[str] = "KHR_materials_emissive_strength"

    strength: float = number("emissiveStrength", 1.0, "Multiplies the emissive factor.", low=0.0)
