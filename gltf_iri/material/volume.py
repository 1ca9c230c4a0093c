"""KHR_materials_volume: what is inside a closed surface."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Final

from gltf_iri.material.fields import number, texture_info, vector
from gltf_iri.material.texture import TextureInfo

__all__ = ["Volume"]

# Keeps the logarithm of a black attenuation colour finite: black leaves 10⁻³⁰ after the distance.
_ATTENUATION_MIN: Final = 1e-30
# Keeps absorption · path a number where the distance is next to nothing and the path is 0.
_ABSORPTION_MAX_PER_M: Final = 1e30


@dataclass(frozen=True, slots=True)
class Volume:
    """Thickness under the surface and absorption inside it."""

    EXTENSION: ClassVar[str] = "KHR_materials_volume"

    thickness_factor_m: float = number(
        "thicknessFactor", 0.0, "Depth under the surface, in the mesh's own space.", low=0.0, unit="m"
    )
    thickness_texture: TextureInfo | None = texture_info(
        "thicknessTexture", TextureInfo, "Multiplies the depth.", channels="g", colour_space="linear"
    )
    attenuation_distance_m: float = number(
        "attenuationDistance",
        math.inf,
        "Mean distance before light meets a particle; absent means no absorption.",
        low=0.0,
        low_is_excluded=True,
        unit="m",
    )
    attenuation_color: tuple[float, float, float] = vector(
        "attenuationColor",
        (1.0, 1.0, 1.0),
        "Colour of white light after the attenuation distance.",
        low=0.0,
        high=1.0,
        colour_space="linear",
    )

    @property
    def absorption_per_m(self) -> tuple[float, float, float]:
        """Beer's coefficients: light keeps exp(−absorption · path), −ln(colour) / distance each.

        KHR_materials_volume, Attenuation.
        """
        red, green, blue = (
            min(
                -math.log(max(channel, _ATTENUATION_MIN)) / self.attenuation_distance_m, _ABSORPTION_MAX_PER_M
            )
            for channel in self.attenuation_color
        )
        return red, green, blue
