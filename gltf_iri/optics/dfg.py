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
from gltf_iri.optics.microfacet import ALPHA_MIN, N_DOT_V_MIN, alpha_ggx, v_smith_ggx_correlated
from gltf_iri.optics.quadrature import gauss_unit

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
    """Return A and B, (2, n), of N·V (n,) by quadrature: 4 ∫ V·D·(N·L)(V·H) {1 − Fc, Fc} dω over facets.

    Facets whose mirror direction lies below the surface send nothing. At the angle θ of the facet the others
    reach from φ = 0 to where cos φ = −cot θ_v cot 2θ, so that the integrand is smooth on [0, φ_max], and so
    it is in θ on both sides of (π/2 − θ_v)/2, where φ_max leaves half a turn. tan θ = α tan x makes the
    facets' density D·cosθ·sinθ dθ = sin x cos x dx / π.
    """
    nodes, weights = gauss_unit(_SLOPES)
    # x runs as sin², which takes the square root out of φ_max at the ends of the panels.
    inside, inside_weights = (
        np.sin(0.5 * np.pi * nodes) ** 2,
        0.5 * np.pi * np.sin(np.pi * nodes) * weights,
    )
    turns, turn_weights = gauss_unit(_TURNS)
    cos_v = n_dot_v[:, None]
    sin_v = np.sqrt(1.0 - cos_v * cos_v)
    theta_v = np.arccos(cos_v)
    corners = [np.arctan(np.tan(0.25 * np.pi + sign * 0.5 * theta_v) / alpha) for sign in (-1.0, 1.0)]
    sums = np.zeros((2, len(n_dot_v)))
    for low, high in ((np.zeros_like(corners[0]), corners[0]), (corners[0], corners[1])):
        x = low + (high - low) * inside
        share = 2.0 / np.pi * np.sin(x) * np.cos(x) * (high - low) * inside_weights
        theta = np.arctan2(alpha * np.sin(x), np.cos(x))
        # The smallest divisor stands for 0/0 where V or the facet lies along N: there every φ counts.
        limit = -cos_v * np.cos(2.0 * theta) / np.maximum(sin_v * np.sin(2.0 * theta), 1e-300)
        phi_max = np.arccos(np.clip(limit, -1.0, 1.0))[..., None]
        n_dot_h = np.cos(theta)[..., None]
        v_dot_h = (sin_v * np.sin(theta))[..., None] * np.cos(phi_max * turns) + cos_v[..., None] * n_dot_h
        # Rounding may put the last facets' mirror direction a hair below the surface.
        n_dot_l = np.maximum(2.0 * v_dot_h * n_dot_h - cos_v[..., None], 0.0)
        sent = 4.0 * v_smith_ggx_correlated(n_dot_l, cos_v[..., None], alpha) * n_dot_l * v_dot_h / n_dot_h
        sent *= share[..., None] * phi_max * turn_weights
        grazing = (1.0 - v_dot_h) ** 5
        sums += np.sum(sent * (1.0 - grazing), axis=(1, 2)), np.sum(sent * grazing, axis=(1, 2))
    return sums


@cache
def _series() -> LogSeries:
    return LogSeries.of(integrate_dfg, (N_DOT_V_MIN, 1.0), (ALPHA_MIN, 1.0), terms=_TERMS)
