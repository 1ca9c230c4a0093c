"""What a rough mirror's facets make of a reflectance: its mean over those that send light to the viewer.

A mirror whose facets reflect F(V·H) sends ∫ F·w of a white sky, where w = 4 V·D·(N·L)(V·H) is what a facet of
a perfect mirror sends (Walter et al. 2007, Eq. 20, and Karis 2013, "Real Shading in Unreal Engine 4"). Split
into the mean ∫F·w/∫w and ∫w = A + B of `optics/dfg.py`, image light keeps its two factors.
"""

from __future__ import annotations

from functools import cache
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.chebyshev import LogSeries
from gltf_iri.optics.microfacet import ALPHA_MIN, N_DOT_V_MIN, alpha_ggx, v_smith_ggx_correlated
from gltf_iri.optics.quadrature import gauss_unit

__all__ = ["facet_cosines", "facet_mean", "mean_cosine"]

Float64 = NDArray[np.float64]

# Gauss points over the slope of the facets, for each of two panels, and over half a turn: 4e-6 of the
# weights, 2e-5 of a film's mean at 1.5 µm, less for thinner ones.
_SLOPES: Final = 32
_TURNS: Final = 12

# Terms of the series of the mean cosine in N·V and in α, and the points that they are made from: 1e-6.
_SERIES_SLOPES: Final = 48
_SERIES_TURNS: Final = 16
_TERMS: Final = (40, 24)


def facet_cosines(
    n_dot_v: ArrayLike, alpha: ArrayLike, *, slopes: int = _SLOPES, turns: int = _TURNS
) -> tuple[Float64, Float64]:
    """Return cosines V·H and weights (..., 2·slopes·turns) of ∫ f(V·H)·w over facets; Σ weights is A + B.

    Facets whose mirror direction lies below the surface send nothing. At the angle θ of the facet the others
    reach from φ = 0 to where cos φ = −cot θ_v cot 2θ, so that the integrand is smooth on [0, φ_max], and so
    it is in θ on both sides of (π/2 − θ_v)/2, where φ_max leaves half a turn. tan θ = α tan x makes the
    facets' density D·cosθ·sinθ dθ = sin x cos x dx / π.

    Parameters
    ----------
    n_dot_v : cosine of the viewer's angle, in (0, 1].
    alpha : perceptual roughness squared, in (0, 1]; both broadcast.
    slopes, turns : Gauss points over θ, for each of two panels, and over φ.
    """
    cosine, a = np.broadcast_arrays(np.asarray(n_dot_v, np.float64), np.asarray(alpha, np.float64))
    # (..., panel, slope, turn)
    cos_v, a = cosine[..., None, None, None], a[..., None, None, None]
    sin_v = np.sqrt(1.0 - cos_v * cos_v)
    nodes, node_weights = gauss_unit(slopes)
    # x runs as sin², which takes the square root out of φ_max at the ends of the panels.
    inside = (np.sin(0.5 * np.pi * nodes) ** 2)[:, None]
    inside_weights = (0.5 * np.pi * np.sin(np.pi * nodes) * node_weights)[:, None]
    turn, turn_weights = gauss_unit(turns)
    # (π/2 ∓ θ_v)/2, between which φ_max leaves half a turn.
    signs = np.array([-1.0, 1.0])[:, None, None]
    ends = np.arctan(np.tan(0.25 * np.pi + signs * 0.5 * np.arccos(cos_v)) / a)
    low = np.concatenate([np.zeros_like(ends[..., :1, :, :]), ends[..., :1, :, :]], axis=-3)
    x = low + (ends - low) * inside
    share = 2.0 / np.pi * np.sin(x) * np.cos(x) * (ends - low) * inside_weights
    theta = np.arctan2(a * np.sin(x), np.cos(x))
    # The smallest divisor stands for 0/0 where V or the facet lies along N: there every φ counts.
    limit = -cos_v * np.cos(2.0 * theta) / np.maximum(sin_v * np.sin(2.0 * theta), 1e-300)
    phi_max = np.arccos(np.clip(limit, -1.0, 1.0))
    n_dot_h = np.cos(theta)
    v_dot_h = sin_v * np.sin(theta) * np.cos(phi_max * turn) + cos_v * n_dot_h
    # Rounding may put the last facets' mirror direction a hair below the surface.
    n_dot_l = np.maximum(2.0 * v_dot_h * n_dot_h - cos_v, 0.0)
    sent = 4.0 * v_smith_ggx_correlated(n_dot_l, cos_v, a) * n_dot_l * v_dot_h / n_dot_h
    weights = sent * share * phi_max * turn_weights
    return v_dot_h.reshape(*cosine.shape, -1), weights.reshape(*cosine.shape, -1)


def facet_mean(values: Float64, weights: Float64) -> Float64:
    """Return ∫F·w/∫w (..., 3) of reflectances (..., q, 3) at the cosines of `facet_cosines`."""
    return np.asarray(np.einsum("...q,...qc->...c", weights, values) / weights.sum(axis=-1)[..., None])


def mean_cosine(n_dot_v: ArrayLike, perceptual_roughness: ArrayLike) -> Float64:
    """Return ∫V·H·w/∫w to 1e-6, the cosine at which facets are seen on average, of broadcast arguments.

    A million points take about a second.

    Parameters
    ----------
    n_dot_v : cosine of the viewer's angle, in [0, 1]; below N_DOT_V_MIN as at N_DOT_V_MIN.
    perceptual_roughness : in [0, 1]; α = max(perceptual_roughness², ALPHA_MIN).
    """
    cosine, alpha = np.broadcast_arrays(np.asarray(n_dot_v, np.float64), alpha_ggx(perceptual_roughness))
    (mean,) = _series()(np.maximum(cosine, N_DOT_V_MIN).ravel(), alpha.ravel())
    return np.asarray(mean).reshape(cosine.shape)


@cache
def _series() -> LogSeries:
    return LogSeries.of(_mean_cosine, (N_DOT_V_MIN, 1.0), (ALPHA_MIN, 1.0), terms=_TERMS)


def _mean_cosine(n_dot_v: Float64, alpha: float) -> Float64:
    cosines, weights = facet_cosines(n_dot_v, alpha, slopes=_SERIES_SLOPES, turns=_SERIES_TURNS)
    return np.asarray(facet_mean(cosines[..., None], weights).T)
