"""KHR_materials_transmission: light that passes through a surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import number, texture_info
from gltf_iri.material.texture import TextureInfo

__all__ = ["Transmission"]


@dataclass(frozen=True, slots=True)
class Transmission:
    """Share of the light under the reflection that is transmitted instead of diffused."""

    EXTENSION: ClassVar[str] = "KHR_materials_transmission"

    factor: float = number("transmissionFactor", 0.0, "Share that is transmitted.", low=0.0, high=1.0)
    texture: TextureInfo | None = texture_info(
        "transmissionTexture", TextureInfo, "Multiplies the factor.", channels="r", colour_space="linear"
    )
