"""The shape of a table that holds a film's colour: its axes, and how finely each is divided."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

from gltf_iri.planning.reach import Lobe, Span

__all__ = ["FilmTable", "Quantity", "TableAxis", "Texel", "texel_bytes"]

Texel = Literal["f2", "f4"]  # half or single precision

# In this order wherever a table has them; every table has the first.
Quantity = Literal["cos_theta", "thickness_nm", "base_f0", "roughness", "spread_nm"]


def texel_bytes(texel: Texel) -> int:
    """Return the memory of one texel, which OpenGL keeps as RGBA."""
    return 4 * (2 if texel == "f2" else 4)


@dataclass(frozen=True, slots=True)
class TableAxis:
    """One axis: `nodes` values from `low` to `high`, evenly spaced in the coordinate t ∈ [0, 1].

    t = (√x − √low)/(√high − √low) for base_f0, whose index is a function of the root; else
    t = (x − low)/(high − low). Between nodes tables are interpolated linearly in t, as OpenGL filters.
    """

    quantity: Quantity
    span: Span
    nodes: int

    def to_json(self) -> dict[str, Any]:
        """Return the axis as reports print it."""
        return {"quantity": self.quantity, "low": self.span.low, "high": self.span.high, "nodes": self.nodes}


@dataclass(frozen=True, slots=True)
class FilmTable:
    """A film over one lobe's base, at every value that the material can reach.

    Without axes `thickness_nm` and `base_f0` are the constants given here. An axis `base_f0` is read once a
    channel: entry [..., c] over a grey base of that reflectance is channel c. At roughness 0 a table holds
    the film in one direction, at others its mean over what a rough white mirror's facets send to the viewer
    from a white sky: ∫F·w/∫w, seen at N·V = cos_theta. Along `spread_nm`, a standard deviation, the thickness
    is averaged over a Gaussian.

    axes : cos_theta first, then those of the others that vary, in the order of `Quantity`; at most four.
    delta_e : measured; what interpolation and texels add to the truth, p95 of CIEDE2000.
    """

    lobe: Lobe
    film_ior: float
    thickness_nm: float
    base_f0: tuple[float, float, float]
    axes: tuple[TableAxis, ...]
    texel: Texel
    delta_e: float

    @property
    def shape(self) -> tuple[int, ...]:
        """Nodes along each axis; the array of texels has it, and 3 channels at the end."""
        return tuple(axis.nodes for axis in self.axes)

    @property
    def bytes(self) -> int:
        """Memory of the texels."""
        return math.prod(self.shape) * texel_bytes(self.texel)

    @property
    def format(self) -> str:
        """What OpenGL calls its texels."""
        return "RGBA16F" if self.texel == "f2" else "RGBA32F"

    def axis(self, quantity: Quantity) -> TableAxis | None:
        """Return the axis of `quantity`, None where it does not vary."""
        return next((axis for axis in self.axes if axis.quantity == quantity), None)

    def to_json(self) -> dict[str, Any]:
        """Return the row of `plan --json`."""
        return {
            "lobe": self.lobe,
            "axes": [axis.to_json() for axis in self.axes],
            "texel": self.format,
            "bytes": self.bytes,
            "delta_e": self.delta_e,
        }
