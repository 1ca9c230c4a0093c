"""Method `layers-single`, the truth of the single-reflection model: spectra multiplied as physics does.

C_l = ∫ R_l(λ, h) Π_{k<l} T_k(λ, i) T_k(λ, o) of Fourneau et al. 2024, Eq. 34, with T of Eq. 28,
integrated over the spectrum until no colour moves by COLOUR_CONVERGENCE. Lossless cells, both polarisations
averaged at each layer. Stack and cosines broadcast: materials × poses.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.integrate import integrate_colour
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.layer_spectra import LayerRows
from gltf_iri.evaluation.layers import LayeredSurface, LayerStack, evaluate_layered

__all__ = ["LayersSingle", "evaluate_layers_single"]

Float64 = NDArray[np.float64]


class LayersSingle:
    """`LayerColours` of a stack of any shape; the bound of T is told by `layer_spectra.FILTER_POINTS_MAX`."""

    def __init__(self, stack: LayerStack, white: White) -> None:
        self._stack, self._white = stack, white

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3), the colour of R_layer(h) Π_{k<layer} T_k(i) T_k(o)."""
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
        count = int(np.prod(shape, dtype=np.intp))
        if not used:
            return np.ones((*shape, 3))
        h, i, o = (np.broadcast_to(np.asarray(c, np.float64), shape).reshape(-1) for c in cosines)
        rows_of = [LayerRows.of(layer, stack.host_ior, shape) for layer in used]

        def spectrum(rows: NDArray[np.intp], wavelength_nm: Float64) -> Float64:
            product = (
                np.ones((len(rows), wavelength_nm.shape[-1]))
                if reflecting is None
                else rows_of[reflecting].reflectance(rows, h[rows], wavelength_nm)
            )
            for each in rows_of[:above]:
                for cosine in (i, o):
                    product = product * each.transmissivity(rows, cosine[rows], wavelength_nm)
            return product

        opd_nm = np.zeros(count)
        if reflecting is not None:
            opd_nm += rows_of[reflecting].opd_nm()
        return integrate_colour(spectrum, count, white=self._white, opd_nm=opd_nm).reshape(*shape, 3)


def evaluate_layers_single(surface: LayeredSurface, white: White) -> Evaluation:
    """Evaluate the truth of the model under `white`; UsageError where a spectrum cannot be integrated."""
    return evaluate_layered(surface, LayersSingle(surface.stack, white), "layers-single", white)
