"""Yeh's closed form for mirrors of lossless cells, in one expression for bands, gaps and band edges.

With t = tan ½φ of the films' phases φ = k_z d, X = Y₂/Y₁ and x = cos KΛ (Fourneau et al. 2024, Eq. 8),

    (1 − x)/2 = cos²½φ₁ cos²½φ₂ (t₁ + X t₂)(t₁ + t₂/X),   (1 + x)/2 = cos²½φ₁ cos²½φ₂ (1/X − t₁t₂)(X − t₁t₂):

each factor vanishes at the band edges of one kind of standing wave, so no digits cancel there, and 1 − x²
is a product too. With U = U_{N−1}(x) and T = T_N(x) (`chebyshev_u`), g = ½(X − 1/X) sin φ₂ and r = r_h1
from a host into n1, the reflected light is F times the transmitted (Eq. 2 and 9, and Appendix D),

    F = g²U² without a host,   (1 − r²)F = (rT − gU sin φ₁)² + U²(rσ − g cos φ₁)² with one,
    σ = sin φ₁ cos φ₂ + ½(X + 1/X) cos φ₁ sin φ₂,

so that R = F/(1 + F) and 1/(1 + F) passes. Where light fades in n2, φ₂ = i|φ₂| and X = i|X| leave every
product real.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.chebyshev_u import chebyshev_pair, chebyshev_u

__all__ = ["HalfPhases", "half_phases", "transmittance"]

Float64 = NDArray[np.float64]

# Half turns of decay in n2 beyond which nothing passes: e^(−4π·20) is lost beside 1, and cosh² stays far from
# overflow.
_OPAQUE_HALF_TURNS: Final = 20.0


@dataclass(frozen=True, slots=True)
class HalfPhases:
    """The films' phases at some wavelengths, the same for both polarisations."""

    t_1: Float64  # tan ½φ₁
    t_2: Float64  # tan ½φ₂, or tanh ½|φ₂| where light fades in n2
    double_cos2: Float64  # 2 cos²½φ₁ cos²½φ₂
    sine_2: Float64  # sin φ₂ or sinh |φ₂|
    is_frustrated: bool


def half_phases(path_1_nm: Any, path_2_nm: Any, wavelength_nm: Any, *, is_frustrated: bool) -> HalfPhases:
    """Return tangents and cosines of half the phases 2π·path/λ; `is_frustrated` where light fades in n2."""
    t_1 = _tangent(path_1_nm / wavelength_nm)
    secant_1 = t_1 * t_1
    secant_1 += 1.0
    if is_frustrated:
        decay = np.pi * np.minimum(path_2_nm / wavelength_nm, _OPAQUE_HALF_TURNS)
        t_2, cosine_2 = np.tanh(decay), np.cosh(decay)
        secant_2 = 1.0 / (cosine_2 * cosine_2)
    else:
        t_2 = _tangent(path_2_nm / wavelength_nm)
        secant_2 = t_2 * t_2
        secant_2 += 1.0
    sine_2 = t_2 / secant_2
    sine_2 *= 2.0
    secant_1 *= secant_2
    return HalfPhases(t_1, t_2, np.divide(2.0, secant_1, out=secant_1), sine_2, is_frustrated)


def transmittance(
    phases: HalfPhases,
    contrast: Any,
    imbalance: Any,
    cells: int | NDArray[np.int64],
    host: tuple[Any, Any] | None = None,
) -> Float64:
    """Return the share 1/(1 + F) that passes `cells` cells, of one polarisation.

    contrast, imbalance : of `Cell`; host : its r_h1 and 1 − r_h1², None where the host is n1. Deep in a gap F
    overflows: run under np.errstate(over="ignore"), nothing passes then.
    """
    one_minus, one_plus = _trace_distances(phases, contrast)
    one_minus_x2 = one_plus
    one_minus_x2 *= one_minus
    x = np.subtract(1.0, one_minus, out=one_minus)
    if host is None:
        ratio = chebyshev_u(x, one_minus_x2, cells)
        ratio *= phases.sine_2
        ratio *= imbalance
        ratio *= ratio
    else:
        ratio = _ratio_with_host(phases, contrast, imbalance, chebyshev_pair(x, one_minus_x2, cells), host)
    ratio += 1.0
    return np.asarray(np.divide(1.0, ratio, out=ratio))


def _tangent(half_turns: Float64) -> Float64:
    """Return tan(π·half_turns); whole half turns come off before π is multiplied in, and cost no digits."""
    half_turns -= np.rint(half_turns)
    half_turns *= np.pi
    return np.asarray(np.tan(half_turns, out=half_turns))


def _trace_distances(phases: HalfPhases, contrast: Any) -> tuple[Float64, Float64]:
    """Return 1 − x and 1 + x, x = cos KΛ."""
    inverse = 1.0 / contrast
    product = phases.t_1 * phases.t_2
    one_minus = phases.t_2 * (-contrast if phases.is_frustrated else contrast)
    one_minus += phases.t_1
    other = phases.t_2 * inverse
    other += phases.t_1
    one_minus *= other
    one_minus *= phases.double_cos2
    one_plus = inverse + product if phases.is_frustrated else inverse - product
    one_plus *= np.subtract(contrast, product, out=product)
    one_plus *= phases.double_cos2
    return one_minus, one_plus


def _ratio_with_host(
    phases: HalfPhases, contrast: Any, imbalance: Any, powers: tuple[Float64, Float64], host: tuple[Any, Any]
) -> Float64:
    t, u = powers
    r, one_minus_r2 = host
    cosine2 = 1.0 / (1.0 + phases.t_1 * phases.t_1)
    sine_1, cosine_1 = 2.0 * phases.t_1 * cosine2, 2.0 * cosine2 - 1.0
    sign = -1.0 if phases.is_frustrated else 1.0
    cosine_2 = 1.0 - sign * phases.t_2 * phases.sine_2
    mean_contrast = 0.5 * (sign * contrast + 1.0 / contrast)
    g = imbalance * phases.sine_2
    sigma = sine_1 * cosine_2 + mean_contrast * cosine_1 * phases.sine_2
    # Deep in a gap T and U both overflow, and the difference of the two says nothing.
    is_opaque = np.isinf(t) | np.isinf(u)
    if is_opaque.any():
        t, u = np.where(is_opaque, np.inf, t), np.where(is_opaque, 0.0, u)
        r = np.where(is_opaque & (r == 0.0), 1.0, r)
    return np.asarray(((r * t - g * sine_1 * u) ** 2 + (u * (r * sigma - g * cosine_1)) ** 2) / one_minus_r2)
