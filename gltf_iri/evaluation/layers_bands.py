"""Method `layers-bands`: spectra as their means over a few bands, multiplied band by band.

What `layers-single` computes, with `colour/bands.py` in place of the spectra: B numbers a factor, which small
tables hold. What nothing attenuates, the first layer's reflection, is a colour and exact.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.bands import Bands, bands_of
from gltf_iri.colour.quadrature import HALF_BANDWIDTH_PER_NM, ColourRule, colour_rule
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.layer_rows import FacetRows, PassingRows
from gltf_iri.evaluation.layers import LayeredSurface, LayerStack, evaluate_layered
from gltf_iri.evaluation.layers_single import LayersSingle

__all__ = ["LAYER_BANDS", "LayersBands", "evaluate_layers_bands", "means_rule"]

Float64 = NDArray[np.float64]

LAYER_BANDS: Final = 16

# The rule under the means: its wavelengths lie closer than bands are wide, and twice as close as fringes.
# What finer fringes than the last degree's add to a mean is less than what bands leave out.
_FIRST_DEGREE: Final = 256
_LAST_DEGREE: Final = 1024
_OVERSAMPLED: Final = 2.0

_ROWS_AT_ONCE: Final = 1024  # bounds memory: a block holds 1024 × 1025 numbers


def means_rule(opd_nm: float, white: White) -> ColourRule:
    """Return the wavelengths that means of spectra with fringes of path difference `opd_nm` are taken at."""
    needed = _OVERSAMPLED * 2.0 * np.pi * HALF_BANDWIDTH_PER_NM * opd_nm
    degree = _FIRST_DEGREE
    while degree < min(needed, _LAST_DEGREE):
        degree *= 2
    return colour_rule(degree, white)


class LayersBands:
    """`LayerColours` of a stack of any shape; UsageError for numbers of bands that `bands_of` refuses."""

    def __init__(self, stack: LayerStack, white: White, *, bands: int = LAYER_BANDS) -> None:
        self._stack, self._white = stack, white
        self._exact = LayersSingle(stack, white)
        self._bands: Bands = bands_of(bands, white)

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o)."""
        if layer == 0:
            return self._exact.reflected(0, cos_h, cos_i, cos_o)
        return self._colour(layer, layer, (cos_h, cos_i, cos_o))

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) T_k(o) over all layers; 1 where there is none."""
        return self._colour(None, len(self._stack.layers), (cos_i, cos_i, cos_o))

    def _colour(
        self, reflecting: int | None, above: int, cosines: tuple[Float64, Float64, Float64]
    ) -> Float64:
        stack = self._stack
        used = stack.layers[: above if reflecting is None else above + 1]
        shape = np.broadcast_shapes(
            *(np.shape(c) for c in cosines), stack.host_ior.shape, *(layer.shape for layer in used)
        )
        h, i, o = (np.broadcast_to(np.asarray(c, np.float64), shape).reshape(-1) for c in cosines)
        facets = [FacetRows(layer, stack.host_ior, shape, h) for layer in used]
        passing = [PassingRows(layer, stack.host_ior, shape, (i, o)) for layer in used[:above]]
        rule = means_rule(max((float(a.opd_nm.max(initial=0.0)) for a in facets), default=0.0), self._white)
        shares = self._bands.shares(rule)
        rgb = np.zeros((len(h), 3))
        for start in range(0, len(h), _ROWS_AT_ONCE):
            rows = np.arange(start, min(start + _ROWS_AT_ONCE, len(h)))
            product = np.ones((len(rows), len(self._bands.weights)))
            if reflecting is not None:
                product *= facets[reflecting].reflectance(rows, rule.wavelength_nm) @ shares
            for each in passing:
                for way in each.ways(rows, rule.wavelength_nm):
                    product *= way @ shares
            rgb[rows] = product @ self._bands.weights
        return rgb.reshape(*shape, 3)


def evaluate_layers_bands(surface: LayeredSurface, white: White, *, bands: int = LAYER_BANDS) -> Evaluation:
    """Evaluate `layers-bands` under `white`; UsageError where the first layer's colour does not settle."""
    return evaluate_layered(surface, LayersBands(surface.stack, white, bands=bands), "layers-bands", white)
