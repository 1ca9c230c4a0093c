"""Share of the light from all around that a rough white mirror sends to the viewer: the two DFG terms.

Under a white environment a rough mirror of reflectance F0 sends F0·A + B: Karis 2013, "Real Shading in Unreal
Engine 4". Twin: the table of shaders/pass/dfg.frag.
"""

from __future__ import annotations

from functools import cache
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.chebyshev import LogSeries
from gltf_iri.optics.facet_mean import facet_cosines
from gltf_iri.optics.microfacet import ALPHA_MIN, N_DOT_V_MIN, alpha_ggx

__all__ = ["dfg_terms", "integrate_dfg"]

Float64 = NDArray[np.float64]

# Gauss points over the slope of the facets, for each of two panels, and over half a turn: 6e-8 at the worst
# place, N·V = 1e-4 and α = 1e-3, and ten digits where α > 0.1 and N·V > 0.1.
_SLOPES: Final = 96
_TURNS: Final = 32

# Terms of the series in N·V and in α: its own error is 2e-8.
_TERMS: Final = (56, 36)


def dfg_terms(n_dot_v: ArrayLike, perceptual_roughness: ArrayLike) -> tuple[Float64, Float64]:
    """Return A = ⟨(1 − Fc) G⟩ and B = ⟨Fc G⟩, Fc = (1 − V·H)⁵, to 1e-7, for each of the broadcast arguments.

    The first call takes about a second, a million points about three.

    Parameters
    ----------
    n_dot_v : cosine of the viewer's angle, in [0, 1]; below N_DOT_V_MIN as at N_DOT_V_MIN.
    perceptual_roughness : in [0, 1]; α = max(perceptual_roughness², ALPHA_MIN).
    """
    cosine, alpha = np.broadcast_arrays(np.asarray(n_dot_v, np.float64), alpha_ggx(perceptual_roughness))
    a, b = _series()(np.maximum(cosine, N_DOT_V_MIN).ravel(), alpha.ravel())
    return a.reshape(cosine.shape), b.reshape(cosine.shape)


def integrate_dfg(n_dot_v: Float64, alpha: float) -> Float64:
    """Return A and B, (2, n), of N·V (n,) by quadrature over the facets: ∫ {1 − Fc, Fc}·w."""
    cosines, weights = facet_cosines(n_dot_v, alpha, slopes=_SLOPES, turns=_TURNS)
    grazing = (1.0 - cosines) ** 5
    return np.stack([np.sum(weights * (1.0 - grazing), axis=-1), np.sum(weights * grazing, axis=-1)])


@cache
def _series() -> LogSeries:
    return LogSeries.of(integrate_dfg, (N_DOT_V_MIN, 1.0), (ALPHA_MIN, 1.0), terms=_TERMS)
