"""KHR_materials_iridescence: a thin film over the base material."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import number, texture_info
from gltf_iri.material.texture import TextureInfo

__all__ = ["Iridescence"]


@dataclass(frozen=True, slots=True)
class Iridescence:
    """The film: how much of it, its index, and how thick it is where."""

    EXTENSION: ClassVar[str] = "KHR_materials_iridescence"

    factor: float = number("iridescenceFactor", 0.0, "Strength of the film.", low=0.0, high=1.0)
    texture: TextureInfo | None = texture_info(
        "iridescenceTexture", TextureInfo, "Multiplies the factor.", channels="r", colour_space="linear"
    )
    film_ior: float = number("iridescenceIor", 1.3, "Refractive index of the film.", low=1.0)
    thickness_min_nm: float = number(
        "iridescenceThicknessMinimum", 100.0, "Film thickness at a texture value of 0.", low=0.0, unit="nm"
    )
    thickness_max_nm: float = number(
        "iridescenceThicknessMaximum", 400.0, "Film thickness at 1, or without texture.", low=0.0, unit="nm"
    )
    thickness_texture: TextureInfo | None = texture_info(
        "iridescenceThicknessTexture",
        TextureInfo,
        "Thickness between the minimum (0) and the maximum (1).",
        channels="g",
        colour_space="linear",
    )
