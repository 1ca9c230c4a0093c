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

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.chebyshev_u import chebyshev_pair, chebyshev_u

__all__ = ["SCRATCH_ARRAYS", "HalfPhases", "half_phases", "transmittance"]

Float64 = NDArray[np.float64]

# Half turns of decay in n2 beyond which nothing passes: e^(−4π·20) is lost beside 1, and cosh² stays far from
# overflow.
_OPAQUE_HALF_TURNS: Final = 20.0

SCRATCH_ARRAYS: Final = 10


@dataclass(frozen=True, slots=True)
class HalfPhases:
    """The films' phases at some wavelengths, the same for both polarisations."""

    t_1: Float64  # tan ½φ₁
    t_2: Float64  # tan ½φ₂, or tanh ½|φ₂| where light fades in n2
    double_cos2: Float64  # 2 cos²½φ₁ cos²½φ₂
    sine_2: Float64  # sin φ₂ or sinh |φ₂|
    product: Float64  # t₁t₂
    is_frustrated: bool


def half_phases(
    path_1_nm: Any, path_2_nm: Any, wavelength_nm: Any, scratch: Sequence[Float64], *, is_frustrated: bool
) -> HalfPhases:
    """Return tangents and cosines of half the phases 2π·path/λ; `is_frustrated` where light fades in n2.

    scratch : SCRATCH_ARRAYS arrays, of which the first five hold the result.
    """
    t_1, t_2, double_cos2, sine_2, product, secant_2 = scratch[:6]
    np.divide(path_1_nm, wavelength_nm, out=t_1)
    np.divide(path_2_nm, wavelength_nm, out=t_2)
    _take_tangent(t_1, secant_2)
    if is_frustrated:
        decay = np.pi * np.minimum(t_2, _OPAQUE_HALF_TURNS)
        np.tanh(decay, out=t_2)
        np.divide(1.0, np.cosh(decay) ** 2, out=secant_2)
    else:
        _take_tangent(t_2, secant_2)
        np.multiply(t_2, t_2, out=secant_2)
        secant_2 += 1.0
    np.multiply(t_1, t_2, out=product)
    np.divide(t_2, secant_2, out=sine_2)
    sine_2 *= 2.0
    np.multiply(t_1, t_1, out=double_cos2)
    double_cos2 += 1.0
    double_cos2 *= secant_2
    np.divide(2.0, double_cos2, out=double_cos2)
    return HalfPhases(t_1, t_2, double_cos2, sine_2, product, is_frustrated)


def transmittance(
    phases: HalfPhases,
    contrast: Any,
    imbalance: Any,
    cells: int | NDArray[np.int64],
    host: tuple[Any, Any] | None,
    scratch: Sequence[Float64],
) -> Float64:
    """Return a new array of the share 1/(1 + F) that passes `cells` cells, of one polarisation.

    contrast, imbalance : of `Cell`; host : its r_h1 and 1 − r_h1², None where the host is n1. Deep in a gap F
    overflows: run under np.errstate(over="ignore"), nothing passes then.
    """
    one_minus, one_minus_x2 = scratch[5:7]
    _trace_distances(phases, contrast, one_minus, one_minus_x2, scratch[7:10])
    one_minus_x2 *= one_minus
    x = np.subtract(1.0, one_minus, out=one_minus)
    if host is None:
        ratio = chebyshev_u(x, one_minus_x2, cells, scratch[7:10])
        ratio *= phases.sine_2
        ratio *= imbalance
        ratio *= ratio
    else:
        t, u = chebyshev_pair(x, one_minus_x2, cells, scratch[7:10])
        ratio = _ratio_with_host(phases, contrast, imbalance, t, u, host)
    ratio += 1.0
    return np.asarray(np.divide(1.0, ratio))


def _take_tangent(half_turns: Float64, scratch: Float64) -> None:
    """Put tan(π·half_turns) in its place; whole half turns come off before π, and cost no digits."""
    np.rint(half_turns, out=scratch)
    half_turns -= scratch
    half_turns *= np.pi
    np.tan(half_turns, out=half_turns)


def _trace_distances(
    phases: HalfPhases, contrast: Any, one_minus: Float64, one_plus: Float64, scratch: Sequence[Float64]
) -> None:
    """Put 1 − x and 1 + x into `one_minus` and `one_plus`, x = cos KΛ."""
    other, spread_contrast, spread_inverse = scratch
    inverse = _spread(1.0 / contrast, spread_inverse)
    contrast = _spread(contrast, spread_contrast)
    np.multiply(phases.t_2, contrast, out=one_minus)
    if phases.is_frustrated:
        np.negative(one_minus, out=one_minus)
    one_minus += phases.t_1
    np.multiply(phases.t_2, inverse, out=other)
    other += phases.t_1
    one_minus *= other
    one_minus *= phases.double_cos2
    if phases.is_frustrated:
        np.add(inverse, phases.product, out=one_plus)
    else:
        np.subtract(inverse, phases.product, out=one_plus)
    np.subtract(contrast, phases.product, out=other)
    one_plus *= other
    one_plus *= phases.double_cos2


def _spread(values: Any, into: Float64) -> Any:
    """Return `values` written out: numpy's loops over broadcast arrays take twice as long."""
    if np.shape(values) == into.shape:
        return values
    np.copyto(into, values)
    return into


def _ratio_with_host(
    phases: HalfPhases, contrast: Any, imbalance: Any, t: Float64, u: Float64, host: tuple[Any, Any]
) -> Float64:
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
