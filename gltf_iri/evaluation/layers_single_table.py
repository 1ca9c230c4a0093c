"""Method `layers-single-table`: the single-reflection model of one stack, its spectra read from tables.

Each layer's R_λ(cosθ) and T_λ(cosθ) at even cosines in the host and at the wavelengths of one rule, linear
between the cosines; multiplied and summed wavelength by wavelength (Fourneau et al. 2024, §5, Model-LUT,
with T itself in place of the filter). Fringes finer than the cosines' steps are lost.
"""

from __future__ import annotations

from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.layer_spectra import LayerSpectra
from gltf_iri.evaluation.layers import LayeredSurface, LayerStack, evaluate_layered

__all__ = ["LayersSingleTable", "evaluate_layers_single_table"]

Float64 = NDArray[np.float64]

_NODES: Final = 512
_WAVELENGTHS: Final = 128
_VALUES_AT_ONCE: Final = 1 << 18

_Factor = tuple[Float64, Float64]  # a table and the cosines that it is read at


class LayersSingleTable:
    """`LayerColours` of one stack; tables are made when they are first asked for.

    nodes : cosines of each table; wavelengths : steps of the colour rule, rounded up to an even number.
    Raises UsageError for stacks of arrays.
    """

    def __init__(
        self, stack: LayerStack, white: White, *, nodes: int = _NODES, wavelengths: int = _WAVELENGTHS
    ) -> None:
        if any(a.size != 1 for a in (stack.host_ior, *(np.zeros(each.shape) for each in stack.layers))):
            raise UsageError(
                "'layers-single-table' tabulates one stack: give numbers for its layers, not arrays."
            )
        self._rule = colour_rule(wavelengths + wavelengths % 2, white)
        self._cosines = np.linspace(0.0, 1.0, nodes)
        self._layers = [LayerSpectra(each, float(stack.host_ior.item())) for each in stack.layers]

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o)."""
        return self._colour([(self._reflecting[layer], cos_h), *self._through(layer, cos_i, cos_o)])

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) T_k(o) over all layers; 1 where there is none."""
        return self._colour(self._through(len(self._layers), cos_i, cos_o))

    def entering(self, cos_i: Float64) -> Float64:
        """Return (..., 3), the colour of Π_k T_k(i) over all layers: of light that crosses them once."""
        return self._colour(self._through(len(self._layers), cos_i))

    def _through(self, above: int, *cosines: Float64) -> list[_Factor]:
        """Return what the first `above` layers let through at each of `cosines`."""
        if above == 0:  # nothing is lost, in the cosines' shape
            unlost = np.ones((2, len(self._rule.weights)))
            return [(unlost, cosine) for cosine in cosines]
        return [(table, cosine) for table in self._passing[:above] for cosine in cosines]

    @cached_property
    def _reflecting(self) -> list[Float64]:
        wavelength_nm = self._rule.wavelength_nm
        return [each.reflectance(self._cosines, wavelength_nm) for each in self._layers]

    @cached_property
    def _passing(self) -> list[Float64]:
        wavelength_nm = self._rule.wavelength_nm
        return [each.transmissivity(self._cosines, wavelength_nm) for each in self._layers]

    def _colour(self, factors: list[_Factor]) -> Float64:
        shape = np.broadcast_shapes(*(np.shape(cosine) for _, cosine in factors))
        rows = [
            (table, np.broadcast_to(np.asarray(cosine, np.float64), shape).reshape(-1))
            for table, cosine in factors
        ]
        rgb = np.zeros((len(rows[0][1]), 3))
        step = max(1, _VALUES_AT_ONCE // len(self._rule.wavelength_nm))
        for start in range(0, len(rgb), step):
            part = slice(start, start + step)
            product = np.ones(())
            for table, column in rows:
                product = product * _between(table, column[part])
            rgb[part] = product @ self._rule.weights
        return rgb.reshape(*shape, 3)


def evaluate_layers_single_table(
    surface: LayeredSurface, white: White, *, nodes: int = _NODES, wavelengths: int = _WAVELENGTHS
) -> Evaluation:
    """Evaluate the model of one stack from tables under `white`; UsageError for stacks of arrays."""
    colours = LayersSingleTable(surface.stack, white, nodes=nodes, wavelengths=wavelengths)
    return evaluate_layered(surface, colours, "layers-single-table", white)


def _between(table: Float64, cosine: Float64) -> Float64:
    """Return rows of `table`, whose even cosines run from 0 to 1, at `cosine` (r,), linear between them."""
    place = cosine * (len(table) - 1)
    low = np.minimum(place.astype(np.intp), len(table) - 2)
    share = (place - low)[:, None]
    return np.asarray(table[low] * (1.0 - share) + table[low + 1] * share)
