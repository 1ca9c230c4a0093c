"""KHR_materials_clearcoat: a clear varnish over everything else."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import number, texture_info
from gltf_iri.material.texture import NormalTextureInfo, TextureInfo

__all__ = ["Clearcoat"]


@dataclass(frozen=True, slots=True)
class Clearcoat:
    """Strength, roughness and normals of the varnish."""

    EXTENSION: ClassVar[str] = "KHR_materials_clearcoat"

    factor: float = number("clearcoatFactor", 0.0, "Strength of the coat.", low=0.0, high=1.0)
    texture: TextureInfo | None = texture_info(
        "clearcoatTexture", TextureInfo, "Multiplies the factor.", channels="r", colour_space="linear"
    )
    roughness_factor: float = number(
        "clearcoatRoughnessFactor", 0.0, "Perceptual roughness of the coat.", low=0.0, high=1.0
    )
    roughness_texture: TextureInfo | None = texture_info(
        "clearcoatRoughnessTexture",
        TextureInfo,
        "Multiplies the roughness.",
        channels="g",
        colour_space="linear",
    )
    normal_texture: NormalTextureInfo | None = texture_info(
        "clearcoatNormalTexture",
        NormalTextureInfo,
        "Normals of the coat.",
        channels="rgb",
        colour_space="linear",
    )
