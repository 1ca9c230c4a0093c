"""KHR_materials_ior: the refractive index of a dielectric base."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import number

__all__ = ["Ior"]


@dataclass(frozen=True, slots=True)
class Ior:
    """The index; 0 stands for a very large one (reflectance 1 at normal incidence)."""

    EXTENSION: ClassVar[str] = "KHR_materials_ior"

    ior: float = number("ior", 1.5, "Refractive index of the base.", low=1.0, also_allowed=0.0)

    @property
    def f0(self) -> float:
        """Reflectance at normal incidence under air, ((n − 1)/(n + 1))²."""
        if self.ior == 0.0:
            return 1.0
        return ((self.ior - 1.0) / (self.ior + 1.0)) ** 2
