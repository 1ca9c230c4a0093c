"""The truth of one material's Bragg layers, for a million directions: `layers-single` out of fine tables."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.spaces import White
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.reference.spectrum_table import (
    FineBands,
    SpectrumTable,
    blocks,
    filtered,
    fine_bands,
    reflectance_tables,
)

__all__ = ["TabulatedLayers"]

Float64 = NDArray[np.float64]


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


class TabulatedLayers:
    """Gives the colours of `plan`'s layers at points as `layers-single` does, nearly; see `LayersMethod`.

    Spectra are summed over 4096 wavelengths, and multiplied as the means of 256 bands. In air, mirrors of ten
    cells have resonances beside their gaps that are narrower: of the paper's stacks p95 of what a channel is
    off by is 3e-4, and its largest 1e-3 (a test says so); of low contrast, as in beetles, 1e-6. Near the
    critical angle of a last layer whose n1 is less than the host's, and for 50 cells in air, it is more.
    """

    def __init__(self, plan: LayersPlan, white: White) -> None:
        fine = _VARYING if plan.varies else _FIXED
        self._plan = plan
        self._bands = fine_bands(fine.bands, fine.samples, white)
        self._first: SpectrumTable | None = None
        self._reflected: list[SpectrumTable] = []
        self._passed: list[SpectrumTable] = []
        for number, layer in enumerate(plan.layers):
            colours, means = reflectance_tables(plan, layer, self._bands, fine.periods, fine.cosines)
            if number == 0:
                self._first = colours
            self._reflected.append(means)
            if plan.under == "base" or number + 1 < len(plan.layers):
                self._passed.append(filtered(means, layer.alpha, fine.filtered_cosines))

    def __call__(self, texel: Float64) -> _AtPoints:
        """Return the colours at points where the period texture reads `texel` (...)."""
        span = self._plan.texel
        width = span.high - span.low
        share = np.zeros(np.shape(texel))
        if width > 0.0:
            # Filtering may round past what the texels hold.
            share = np.clip((np.asarray(texel) - span.low) / width, 0.0, 1.0)
        return _AtPoints(self._first, self._reflected, self._passed, self._bands, share)


@dataclass(frozen=True, slots=True)
class _AtPoints:
    """`LayerColours` at points of one material; `share` (...) of the way along every layer's period."""

    first: SpectrumTable | None
    tables: list[SpectrumTable]
    passages: list[SpectrumTable]
    bands: FineBands
    share: Float64

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o)."""
        share, h, i, o = np.broadcast_arrays(self.share, cos_h, cos_i, cos_o)
        if layer == 0 and self.first is not None:
            return self.first.at(share.ravel(), h.ravel()).reshape(*h.shape, 3)
        return self._colour(share, self.tables[layer], h, self.passages[:layer], i, o)

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) T_k(o) over all layers."""
        share, i, o = np.broadcast_arrays(self.share, cos_i, cos_o)
        return self._colour(share, None, i, self.passages, i, o)

    def _colour(
        self,
        share: Float64,
        table: SpectrumTable | None,
        h: Float64,
        above: list[SpectrumTable],
        i: Float64,
        o: Float64,
    ) -> Float64:
        flat = [each.ravel() for each in (share, h, i, o)]
        rgb = np.zeros((h.size, 3))
        for rows in blocks(h.size):
            s, at_h, at_i, at_o = (each[rows] for each in flat)
            spectrum = np.ones((len(s), len(self.bands.weights))) if table is None else table.at(s, at_h)
            for passage in above:
                spectrum *= passage.at(s, at_i)
                spectrum *= passage.at(s, at_o)
            rgb[rows] = spectrum @ self.bands.weights
        return rgb.reshape(*h.shape, 3)
