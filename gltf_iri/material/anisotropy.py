"""KHR_materials_anisotropy: highlights drawn out along one direction, as on brushed metal."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import number, texture_info
from gltf_iri.material.texture import TextureInfo

__all__ = ["Anisotropy"]


@dataclass(frozen=True, slots=True)
class Anisotropy:
    """How far the highlight is drawn out, and which way."""

    EXTENSION: ClassVar[str] = "KHR_materials_anisotropy"

    strength: float = number(
        "anisotropyStrength", 0.0, "How far the highlight is drawn out.", low=0.0, high=1.0
    )
    rotation_rad: float = number(
        "anisotropyRotation",
        0.0,
        "Counter-clockwise turn of the direction from the tangent.",
        unit="rad",
    )
    texture: TextureInfo | None = texture_info(
        "anisotropyTexture",
        TextureInfo,
        "Direction in tangent space (R, G), which the rotation turns further; multiplies the strength (B).",
        channels="rgb",
        colour_space="linear",
    )
