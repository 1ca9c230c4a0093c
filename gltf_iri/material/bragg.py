"""EXT_materials_bragg, this project's proposal: rough layers of Bragg mirrors over the base material."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from gltf_iri.material.fields import nested_list, number, texture_info, whole_number
from gltf_iri.material.texture import TextureInfo

__all__ = ["Bragg", "MirrorLayer"]


@dataclass(frozen=True, slots=True)
class MirrorLayer:
    """One layer: facets that are mirrors of equal cells, each of two films, the first met first."""

    ior_1: float | None = number(
        "ior1", None, "Refractive index of each cell's first film; absent, that of the host.", low=1.0
    )
    ior_2: float = number("ior2", 1.5, "Refractive index of each cell's second film.", low=1.0)
    period_min_nm: float = number(
        "periodMinimum", 250.0, "Thickness of a cell at a texture value of 0.", low=0.0, unit="nm"
    )
    period_max_nm: float = number(
        "periodMaximum", 250.0, "Thickness of a cell at 1, or without texture.", low=0.0, unit="nm"
    )
    fill: float = number("fill", 0.5, "Share of the first film in a cell.", low=0.0, high=1.0)
    cells: int = whole_number("cells", 1, "How many cells.", low=1)
    roughness: float = number("roughness", 0.0, "Perceptual roughness of the facets.", low=0.0, high=1.0)

    def first_ior(self, host_ior: float) -> float:
        """Return the index of the first film of a layer that lies in a host of `host_ior`."""
        return host_ior if self.ior_1 is None else self.ior_1


@dataclass(frozen=True, slots=True)
class Bragg:
    """The stack: how much of it, what its layers lie in, and the layers."""

    EXTENSION: ClassVar[str] = "EXT_materials_bragg"

    factor: float = number("braggFactor", 0.0, "Strength of the layers.", low=0.0, high=1.0)
    texture: TextureInfo | None = texture_info(
        "braggTexture", TextureInfo, "Multiplies the factor.", channels="r", colour_space="linear"
    )
    host_ior: float = number("hostIor", 1.0, "Refractive index of what the layers lie in.", low=1.0)
    layers: tuple[MirrorLayer, ...] = nested_list("layers", MirrorLayer, "The layers, outermost first.")
    period_texture: TextureInfo | None = texture_info(
        "braggPeriodTexture",
        TextureInfo,
        "Periods of all layers between minimum (0) and maximum (1).",
        channels="g",
        colour_space="linear",
    )
