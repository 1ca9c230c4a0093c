"""KHR_materials_specular: weight and tint of a dielectric's reflection."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import number, texture_info, vector
from gltf_iri.material.texture import TextureInfo

__all__ = ["Specular"]


@dataclass(frozen=True, slots=True)
class Specular:
    """Weight and colour of the dielectric reflection; metals ignore both."""

    EXTENSION: ClassVar[str] = "KHR_materials_specular"

    factor: float = number("specularFactor", 1.0, "Weight of the reflection.", low=0.0, high=1.0)
    texture: TextureInfo | None = texture_info(
        "specularTexture", TextureInfo, "Multiplies the factor.", channels="a", colour_space="linear"
    )
    color_factor: tuple[float, float, float] = vector(
        "specularColorFactor", (1.0, 1.0, 1.0), "Tint at normal incidence.", low=0.0, colour_space="linear"
    )
    color_texture: TextureInfo | None = texture_info(
        "specularColorTexture", TextureInfo, "Multiplies the tint.", channels="rgb", colour_space="srgb"
    )
