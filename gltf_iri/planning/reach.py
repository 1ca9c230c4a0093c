"""The values that a material's film meets anywhere: what a budget must hold for, and what needs no code."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

__all__ = ["Lobe", "Reach", "Span"]

# What lies under a film.
Lobe = Literal["dielectric", "metal"]


@dataclass(frozen=True, slots=True)
class Span:
    """All numbers from `low` to `high`, both included."""

    low: float
    high: float

    @classmethod
    def at(cls, value: float) -> Span:
        """Return the span of one number."""
        return cls(value, value)

    @property
    def is_point(self) -> bool:
        """True where there is one number only."""
        return self.low == self.high


@dataclass(frozen=True, slots=True)
class Reach:
    """What the film of one material meets, textures and vertex colours included; cosines always reach [0, 1].

    Channels of colours vary independently here, which is never less than what the textures hold.

    factor : of the film's strength, `iridescenceFactor` times its texture.
    thickness_nm : of the film.
    metallic, roughness : after their texture; roughness is perceptual.
    base_color : (R, G, B) in [0, 1]: the metal under the film.
    dielectric_f0 : (R, G, B) in [0, 1]: of the dielectric under the film, specular weight included where the
        plan's layering puts it there.
    is_dielectric_grey, is_metal_grey : True where the base's R, G and B are certainly equal at every point:
        one channel stands for all.
    spread_nm : the thickness' standard deviation within a pixel: what 95 % of pixels lie below, the greatest.
    """

    film_ior: float
    factor: Span
    thickness_nm: Span
    metallic: Span
    roughness: Span
    base_color: tuple[Span, Span, Span]
    dielectric_f0: tuple[Span, Span, Span]
    is_dielectric_grey: bool = False
    is_metal_grey: bool = False
    spread_nm: Span = Span(0.0, 0.0)

    @property
    def lobes(self) -> tuple[Lobe, ...]:
        """Those that the material has anywhere."""
        lobes: list[Lobe] = ["dielectric"] if self.metallic.low < 1.0 else []
        return (*lobes, "metal") if self.metallic.high > 0.0 else tuple(lobes)

    def base(self, lobe: Lobe) -> tuple[Span, Span, Span]:
        """Return what each channel's base reflectance meets."""
        return self.base_color if lobe == "metal" else self.dielectric_f0

    def is_grey(self, lobe: Lobe) -> bool:
        """Return whether the channels of the base are certainly equal at every point."""
        return self.is_metal_grey if lobe == "metal" else self.is_dielectric_grey
