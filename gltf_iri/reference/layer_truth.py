"""The truth of one material's Bragg layers, for a million directions: `layers-single` out of fine tables."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.baking.layer_fill import filled_layers
from gltf_iri.baking.layer_lookup import ImageColours, LayerLookup
from gltf_iri.colour.spaces import White
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables
from gltf_iri.reference.spectrum_table import (
    SpectrumTable,
    blocks,
    filtered,
    fine_bands,
    reflectance_tables,
)

__all__ = ["TabulatedLayers"]

Float64 = NDArray[np.float64]

_Factor = tuple[SpectrumTable, Float64]


@dataclass(frozen=True, slots=True)
class _Fineness:
    """Bands, samples of each, nodes along the texture's value and along the cosines of R and of T."""

    bands: int
    samples: int
    periods: int
    cosines: int
    filtered_cosines: int


# Of one stack, and of one whose periods vary: what fits into memory and is filled within seconds.
_FIXED: Final = _Fineness(256, 16, 1, 4097, 1025)
_VARYING: Final = _Fineness(128, 8, 65, 769, 193)

# Nodes for image light, linear between them.
_SKY_COSINES: Final = 513
_SKY_PERIODS: Final = 33


class TabulatedLayers:
    """Gives the colours of `plan`'s layers at points as `layers-single` does, nearly; see `LayersMethod`.

    Spectra are summed over 4096 wavelengths, and multiplied as the means of 256 bands. In air, mirrors of ten
    cells have resonances beside their gaps that are narrower: of the paper's stacks p95 of what a channel is
    off by is 3e-4, and its largest 1e-3 (a test says so); of low contrast, as in beetles, 1e-6. Near the
    critical angle of a last layer whose n1 is less than the host's, and for 50 cells in air, it is more.
    Where periods vary there are 1024 wavelengths and 128 bands: 4e-4, and 1e-3.
    """

    def __init__(self, plan: LayersPlan, white: White) -> None:
        fine = _VARYING if plan.varies else _FIXED
        self.count = len(plan.layers)
        self._plan, self._white = plan, white
        self._bands = fine_bands(fine.bands, fine.samples, white)
        made = [
            reflectance_tables(plan, layer, self._bands, fine.periods, fine.cosines) for layer in plan.layers
        ]
        self._first, self._reflected = made[0][0], [means for _, means in made]
        # What passes the last layer comes back from a base only.
        passing = plan.layers if plan.under == "base" else plan.layers[:-1]
        self._passed = [
            filtered(means, layer.alpha, fine.filtered_cosines)
            for means, layer in zip(self._reflected, passing, strict=False)
        ]

    def __call__(self, texel: Float64) -> _AtPoints:
        """Return the colours at points where the period texture reads `texel` (...)."""
        span = self._plan.texel
        width = span.high - span.low
        share = np.zeros(np.shape(texel))
        if width > 0.0:
            # Filtering may round past what the texels hold.
            share = np.clip((np.asarray(texel) - span.low) / width, 0.0, 1.0)
        return _AtPoints(self, share)

    def first(self, share: Float64, cosine: Float64) -> Float64:
        """Return the first layer's reflectance as a colour (..., 3)."""
        return self._first.at(share.ravel(), cosine.ravel()).reshape(*share.shape, 3)

    def reflecting(self, layer: int, cosine: Float64) -> list[_Factor]:
        """Return the factor of what a layer reflects."""
        return [(self._reflected[layer], cosine)]

    def passing(self, count: int | None, *cosines: Float64) -> list[_Factor]:
        """Return the factors of what passes the first `count` layers, or all, at each of `cosines`."""
        return [(table, cosine) for table in self._passed[:count] for cosine in cosines]

    def colour(self, share: Float64, factors: list[_Factor]) -> Float64:
        """Return the colour (..., 3) of a product of spectra, each at its cosines (...)."""
        rgb, along = np.zeros((share.size, 3)), share.ravel()
        flat = [(table, cosine.ravel()) for table, cosine in factors]
        for rows in blocks(share.size):
            spectrum = np.ones((len(along[rows]), len(self._bands.weights)))
            for table, cosine in flat:
                spectrum *= table.at(along[rows], cosine[rows])
            rgb[rows] = spectrum @ self._bands.weights
        return rgb.reshape(*share.shape, 3)

    def image(self, share: Float64, n_dot_v: Float64, metal_roughness: Float64) -> ImageColours:
        """Return what becomes of image light, whose tables hold colours of whole spectra."""
        span = self._plan.texel
        lookup = LayerLookup(self._sky, span.low + share * (span.high - span.low))
        return lookup.image(n_dot_v, metal_roughness)

    @cached_property
    def _sky(self) -> BakedLayers:
        periods = _SKY_PERIODS if self._plan.varies else 1
        tables = LayerTables(3, True, _SKY_COSINES, periods, "f4", 0.0)
        return filled_layers(replace(self._plan, tables=tables), self._white)


@dataclass(frozen=True, slots=True)
class _AtPoints:
    """`ColoursAtPoints` of one material; `share` (...) of the way along every layer's period."""

    of: TabulatedLayers
    share: Float64

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o)."""
        share, h, i, o = np.broadcast_arrays(self.share, cos_h, cos_i, cos_o)
        if layer == 0:
            return self.of.first(share, h)
        return self.of.colour(share, self.of.reflecting(layer, h) + self.of.passing(layer, i, o))

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) T_k(o) over all layers."""
        share, i, o = np.broadcast_arrays(self.share, cos_i, cos_o)
        return self.of.colour(share, self.of.passing(None, i, o))

    def entering(self, cos_i: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) over all layers: of light that crosses them once."""
        share, i = np.broadcast_arrays(self.share, cos_i)
        return self.of.colour(share, self.of.passing(None, i))

    def image(self, n_dot_v: Float64, metal_roughness: Float64) -> ImageColours:
        """Return what image light becomes, as `LayerLookup.image` does of its tables."""
        return self.of.image(*np.broadcast_arrays(self.share, n_dot_v, metal_roughness))
