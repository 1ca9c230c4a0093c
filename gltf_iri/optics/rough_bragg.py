"""A rough Bragg layer: facets that are tiny Bragg mirrors, and what of light passes between them unbent.

Behind a layer lies the medium that lies before it, so that every facet lets light through in the direction it
came in, whatever way it is turned (Fourneau et al. 2024, §4.2). What passes is the facets' transmissivity,
averaged by a filter F_α over the angle θ_d between light and facet. Facets are GGX, masked on either side by
themselves (Eq. 18 and 19). α is the perceptual roughness squared; 0 is a smooth mirror.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.quadrature import gauss_unit

__all__ = ["facet_weight", "filter_nodes", "g1_smith", "transmission_filter"]

Float64 = NDArray[np.float64]


def g1_smith(cos_theta: ArrayLike, alpha: ArrayLike) -> Float64:
    """G₁ = 2c / (c + √(α² + (1 − α²)c²)), the share of facets that are seen; Fourneau et al. 2024, Eq. 19.

    cos_theta : cosine of light and the layer's normal, in [0, 1]; at 0 nothing is seen, but for α = 0.
    """
    c, a = np.asarray(cos_theta, np.float64), np.asarray(alpha, np.float64)
    root = np.sqrt(a * a + (1.0 - a * a) * c * c)
    # 0/0 where light grazes a smooth layer: the limit of small α at a given angle.
    return np.asarray(
        np.divide(2.0 * c, c + root, out=np.ones(np.broadcast(c, a).shape), where=c + root > 0.0)
    )


def facet_weight(
    n_cross_h_squared: ArrayLike, cos_theta_i: ArrayLike, cos_theta_o: ArrayLike, alpha: ArrayLike
) -> Float64:
    """Return D(h) G₁(i) G₁(o) / (4 cosθ_i cosθ_o), 1/sr: the layer's BRDF over its facets' reflectance.

    Fourneau et al. 2024, Eq. 17 to 19, with |n×h|² for tan²θ_h, of which small angles keep all digits.

    n_cross_h_squared : sin²θ_h of the half vector; cos_theta_i, cos_theta_o : of light and viewer, in [0, 1];
    alpha : in (0, 1].
    """
    sine_squared, i, o, a = (
        np.asarray(x, np.float64) for x in (n_cross_h_squared, cos_theta_i, cos_theta_o, alpha)
    )
    a2 = a * a
    spread = sine_squared + a2 * (1.0 - sine_squared)
    # G₁/(2c) = 1/(c + √…) is finite at grazing angles, where G₁ and the cosine both vanish.
    seen = (i + np.sqrt(a2 + (1.0 - a2) * i * i)) * (o + np.sqrt(a2 + (1.0 - a2) * o * o))
    return np.asarray(a2 / (np.pi * spread * spread * seen))


def transmission_filter(cos_theta_i: ArrayLike, theta_d_rad: ArrayLike, alpha: ArrayLike) -> Float64:
    """Return F_α(θ_i, θ_d), 1/rad: how much of light at θ_i meets facets at θ_d and gets by their masking.

    F_α = 2 G₁² cosθ_d sinθ_d / cosθ_i ∫₀^ψmax D̃ dψ, Fourneau et al. 2024, Eq. 26 and 29; ∫ F_α dθ_d = G₁
    (Appendix C). The integral is closed here: D̃ = α²/(π (1 − κu²)²) with κ = 1 − α², u = cosθ_m = a + b cosψ,
    splits into ¼ Σ± [1/(1 ± √κ u) + 1/(1 ± √κ u)²], and with p = 1 ± √κ a, q = ± √κ b

        J₁ = ∫ dψ/(p + q cosψ) = 2/√(p² − q²) · arctan(√((p − q)/(p + q)) tan ½ψmax)
        J₂ = ∫ dψ/(p + q cosψ)² = (p J₁ − q sinψmax/(p + q cosψmax)) / (p² − q²).

    p ± q = 1 ± √κ cos(θ_i ∓ θ_d) come from sines and cosines of half angles, which keep their digits at the
    peak; where facets end at the horizon, u(ψmax) = 0.

    cos_theta_i : in (0, 1]; theta_d_rad : in [0, π/2]; alpha : in (0, 1].
    """
    cos_i, d, a = np.broadcast_arrays(*(np.asarray(x, np.float64) for x in (cos_theta_i, theta_d_rad, alpha)))
    i = np.arccos(cos_i)
    root = np.sqrt((1.0 - a) * (1.0 + a))
    least = a * a / (1.0 + root)  # 1 − √κ
    difference, total = np.cos(i - d), np.cos(i + d)
    reaches_horizon = total < 0.0
    # tan ½ψmax, and b·sin ψmax: facets end where cosθ_m = 0.
    with np.errstate(divide="ignore", invalid="ignore"):
        tangent = np.where(reaches_horizon, np.sqrt(difference / -total), np.inf)
    sine = np.sqrt(np.maximum(-difference * total, 0.0))
    integral = np.zeros(cos_i.shape)
    for sign, half in ((-1.0, np.sin), (1.0, np.cos)):
        plus = least + 2.0 * root * half(0.5 * (i - d)) ** 2  # p + q
        minus = least + 2.0 * root * half(0.5 * (i + d)) ** 2  # p − q
        squared = plus * minus
        j_1 = 2.0 / np.sqrt(squared) * np.arctan(np.sqrt(minus / plus) * tangent)
        j_2 = (0.5 * (plus + minus) * j_1 - sign * root * sine) / squared
        integral += 0.25 * (j_1 + j_2)
    g1 = g1_smith(cos_i, a)
    scale = 2.0 * g1 * g1 * np.cos(d) * np.sin(d) / cos_i
    return np.asarray(scale * (a * a / np.pi) * integral)


def filter_nodes(cos_theta_i: ArrayLike, alpha: ArrayLike, *, count: int = 24) -> tuple[Float64, Float64]:
    """Return cosines cosθ_d and weights (..., 3·count) of ∫ f(cosθ_d) F_α dθ_d, Fourneau et al. 2024, Eq. 28.

    Three panels end at θ_i, where F_α peaks, and at π/2 − θ_i, where facets begin to end at the horizon. On
    each, θ_d = θ_i + α tan x takes the peak's width out and x runs as sin², which takes the square roots out
    of the ends. A smooth layer has all its weight at θ_i.

    cos_theta_i : in [0, 1]; alpha : in [0, 1]; count : Gauss points a panel.
    """
    cos_i, a = np.broadcast_arrays(np.asarray(cos_theta_i, np.float64), np.asarray(alpha, np.float64))
    # Light along the surface meets facets as light just above it does; 0 would divide by it.
    cos_i, a = np.maximum(cos_i, 1e-9)[..., None, None], a[..., None, None]
    is_smooth = a <= 0.0
    width = np.where(is_smooth, 1.0, a)
    i = np.arccos(cos_i)
    low, high = np.minimum(i, 0.5 * np.pi - i), np.maximum(i, 0.5 * np.pi - i)
    ends = np.concatenate([np.zeros_like(i), low, high, np.full_like(i, 0.5 * np.pi)], axis=-2)
    x = np.arctan((ends - i) / width)
    nodes, node_weights = gauss_unit(count)
    inside = np.sin(0.5 * np.pi * nodes) ** 2
    inside_weights = 0.5 * np.pi * np.sin(np.pi * nodes) * node_weights
    first, length = x[..., :-1, :], np.diff(x, axis=-2)
    tangent = np.tan(first + length * inside)
    theta_d = np.clip(i + width * tangent, 0.0, 0.5 * np.pi)
    weights = (
        transmission_filter(cos_i, theta_d, width)
        * width
        * (1.0 + tangent * tangent)
        * length
        * inside_weights
    )
    shape = (*cos_i.shape[:-2], 3 * count)
    cosines, weights = np.cos(theta_d).reshape(shape), weights.reshape(shape)
    smooth = np.broadcast_to(is_smooth[..., 0], shape)
    cosines = np.where(smooth, cos_i[..., 0], cosines)
    # Equal shares of 1.
    return cosines, np.where(smooth, 1.0 / (3 * count), weights)
