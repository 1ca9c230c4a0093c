"""The fibres of a cloth: Charlie's distribution, its fitted masking, and the light that a whole sky gives it.

α is the sheen's perceptual roughness squared. Source: Estevez & Kulla 2017, "Production Friendly Microfacet
Sheen BRDF", which KHR_materials_sheen takes over. Twin: shaders/optics/sheen.glsl.
"""

from __future__ import annotations

from functools import cache
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.chebyshev import LogSeries
from gltf_iri.optics.microfacet import N_DOT_V_MIN
from gltf_iri.optics.quadrature import gauss_unit

__all__ = [
    "SHEEN_ALPHA_MIN",
    "SHEEN_FIT_AT_0",
    "SHEEN_FIT_AT_1",
    "d_charlie",
    "integrate_sheen",
    "lambda_sheen",
    "sheen_albedo",
    "sheen_alpha",
    "sheen_weight",
    "v_sheen",
]

Float64 = NDArray[np.float64]

# Keeps the exponent of the sine at 200 or below, where float32 holds its power; smoother fibres would shine
# close to the horizon only, where their fitted masking lets through several times what arrives.
SHEEN_ALPHA_MIN: Final = 5e-3

# a, b, c, d, e of the masking's fit at α = 0 and at α = 1 (Estevez & Kulla 2017, table in section 3).
SHEEN_FIT_AT_0: Final = (25.3245, 3.32435, 0.16801, -1.27393, -4.85967)
SHEEN_FIT_AT_1: Final = (21.5473, 3.82987, 0.19823, -1.97760, -4.32054)

# Gauss points over N·L, for each of two panels, and over half a turn: 1e-6 at the worst place.
_COSINES: Final = 32
_TURNS: Final = 48
_CLUSTER: Final = 6  # N·L = t⁶/2: the fit holds (N·L)^c with c near 1/6


def sheen_alpha(sheen_roughness: ArrayLike) -> Float64:
    """α = max(sheen_roughness², SHEEN_ALPHA_MIN)."""
    return np.asarray(np.maximum(np.asarray(sheen_roughness, np.float64) ** 2, SHEEN_ALPHA_MIN))


def d_charlie(n_dot_h: ArrayLike, alpha: ArrayLike) -> Float64:
    """Density of fibres whose normal is H, per steradian.

    D = (2 + 1/α) sin^(1/α) θ_h / 2π, Estevez & Kulla 2017, Eq. 2; sin²θ_h = 1 − (N·H)², for the lobe lies
    where N·H is small.

    Parameters
    ----------
    n_dot_h : cosine of the angle to the half vector, in [0, 1].
    alpha : the sheen's perceptual roughness squared, in [SHEEN_ALPHA_MIN, 1].
    """
    cosine, exponent = np.asarray(n_dot_h, np.float64), 1.0 / np.asarray(alpha, np.float64)
    sine_squared = np.maximum(1.0 - cosine * cosine, 0.0)  # a cosine rounded past 1 has no negative sine
    return np.asarray((2.0 + exponent) / (2.0 * np.pi) * sine_squared ** (0.5 * exponent))


def lambda_sheen(cos_theta: ArrayLike, alpha: ArrayLike) -> Float64:
    """Λ = e^L(cosθ) below cosθ = ½, e^(2L(½) − L(1 − cosθ)) above; L(x) = a / (1 + b xᶜ) + d x + e.

    a … e run from their fit at α = 1 to that at α = 0 as (1 − α)². Estevez & Kulla 2017, section 3.
    """
    cosine, a = np.asarray(cos_theta, np.float64), np.asarray(alpha, np.float64)
    share = (1.0 - a) ** 2
    fit = [one + share * (zero - one) for zero, one in zip(SHEEN_FIT_AT_0, SHEEN_FIT_AT_1, strict=True)]

    def exponent(x: ArrayLike) -> Float64:
        return np.asarray(fit[0] / (1.0 + fit[1] * np.asarray(x) ** fit[2]) + fit[3] * np.asarray(x) + fit[4])

    near = np.minimum(cosine, 1.0 - cosine)
    return np.asarray(np.exp(np.where(cosine < 0.5, exponent(near), 2.0 * exponent(0.5) - exponent(near))))


def v_sheen(n_dot_l: ArrayLike, n_dot_v: ArrayLike, alpha: ArrayLike) -> Float64:
    """Visibility 1 / ((1 + Λ(N·V) + Λ(N·L)) · 4 N·L N·V), Estevez & Kulla 2017, section 3.

    Parameters
    ----------
    n_dot_l, n_dot_v : cosines of the light's and the viewer's angle, in (0, 1].
    alpha : the sheen's perceptual roughness squared, in [SHEEN_ALPHA_MIN, 1].
    """
    light, view = np.asarray(n_dot_l, np.float64), np.asarray(n_dot_v, np.float64)
    masking = 1.0 + lambda_sheen(view, alpha) + lambda_sheen(light, alpha)
    return np.asarray(1.0 / (masking * 4.0 * light * view))


def sheen_albedo(n_dot_v: ArrayLike, sheen_roughness: ArrayLike) -> Float64:
    """Share E of the light from all around that white fibres send to the viewer, to 1e-5.

    E = min(∫ D·V·(N·L) dω, 1): smooth fibres at grazing angles would send more than arrives, as their masking
    is only a fit. The first call takes about a second.

    Parameters
    ----------
    n_dot_v : cosine of the viewer's angle, in [0, 1]; below N_DOT_V_MIN as at N_DOT_V_MIN.
    sheen_roughness : perceptual, in [0, 1]; α = max(sheen_roughness², SHEEN_ALPHA_MIN).
    """
    cosine, alpha = np.broadcast_arrays(
        np.maximum(np.asarray(n_dot_v, np.float64), N_DOT_V_MIN), sheen_alpha(sheen_roughness)
    )
    albedo = np.zeros(cosine.size)
    for series in _series():
        inside = (cosine.ravel() >= series.x_range[0]) & (cosine.ravel() <= series.x_range[1])
        albedo[inside] = series(cosine.ravel()[inside], alpha.ravel()[inside])[0]
    return np.clip(albedo, 0.0, 1.0).reshape(cosine.shape)  # the series' own error may pass below 0


def sheen_weight(sheen_color: ArrayLike, albedo: ArrayLike) -> Float64:
    """Share (...) of the light that passes the fibres: 1 − max(R, G, B)·E.

    KHR_materials_sheen, Albedo Scaling. `sheen_color` is (..., 3), `albedo` E (...), at most 1.
    """
    return np.asarray(1.0 - np.max(np.asarray(sheen_color, np.float64), axis=-1) * albedo)


def integrate_sheen(n_dot_v: Float64, alpha: float) -> Float64:
    """Return ∫ D·V·(N·L) dω, (1, n), of N·V (n,) by quadrature; it may exceed 1 at grazing angles.

    The fit's Λ bends at cosθ = ½, where one panel of N·L ends and the other begins.
    """
    t, t_weights = gauss_unit(_COSINES)
    turns, turn_weights = gauss_unit(_TURNS)
    cos_phi = np.cos(np.pi * turns)
    grazing = 0.5 * t**_CLUSTER
    n_dot_l = np.concatenate([grazing, 1.0 - grazing])[:, None]
    share = np.tile(_CLUSTER * t ** (_CLUSTER - 1) * t_weights, 2)[:, None] * np.pi * turn_weights
    view = n_dot_v[:, None, None]
    v_dot_l = np.sqrt((1.0 - view**2) * (1.0 - n_dot_l**2)) * cos_phi + view * n_dot_l
    n_dot_h = (view + n_dot_l) / np.sqrt(2.0 + 2.0 * v_dot_l)
    sent = d_charlie(np.minimum(n_dot_h, 1.0), alpha) * v_sheen(n_dot_l, view, alpha) * n_dot_l
    return np.asarray(np.sum(sent * share, axis=(1, 2))[None])


@cache
def _series() -> tuple[LogSeries, LogSeries]:
    """Below and above N·V = ½, where Λ bends."""
    alphas = (SHEEN_ALPHA_MIN, 1.0)
    return (
        LogSeries.of(integrate_sheen, (N_DOT_V_MIN, 0.5), alphas, terms=(64, 32)),
        LogSeries.of(integrate_sheen, (0.5, 1.0), alphas, terms=(24, 32)),
    )
