"""KHR_materials_sheen: light that the fibres of a cloth scatter back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import number, texture_info, vector
from gltf_iri.material.texture import TextureInfo

__all__ = ["Sheen"]


@dataclass(frozen=True, slots=True)
class Sheen:
    """Colour and roughness of the fibres."""

    EXTENSION: ClassVar[str] = "KHR_materials_sheen"

    color_factor: tuple[float, float, float] = vector(
        "sheenColorFactor",
        (0.0, 0.0, 0.0),
        "Colour of the sheen; black is none.",
        low=0.0,
        high=1.0,
        colour_space="linear",
    )
    color_texture: TextureInfo | None = texture_info(
        "sheenColorTexture", TextureInfo, "Multiplies the colour.", channels="rgb", colour_space="srgb"
    )
    roughness_factor: float = number(
        "sheenRoughnessFactor", 0.0, "Perceptual roughness of the sheen.", low=0.0, high=1.0
    )
    roughness_texture: TextureInfo | None = texture_info(
        "sheenRoughnessTexture",
        TextureInfo,
        "Multiplies the roughness.",
        channels="a",
        colour_space="linear",
    )
