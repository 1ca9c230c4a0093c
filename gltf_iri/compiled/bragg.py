"""Yeh's closed form compiled: the twin of optics/yeh.py, a row of wavelengths at a time.

Sines and cosines of half the phases stand for the tangents there. The steps of the doubling run over a
stretch of wavelengths each, because a loop within a loop keeps the compiler from using vector instructions;
two steps at a time and one polarisation after the other, because the rest of the time goes into loads and
stores. Rows are padded to full vectors: what is left over would go one by one through every loop.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.compiled.bragg_cell import FADES_IN_1, FADES_IN_2, HOST
from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sincos import sincos_half_turns
from gltf_iri.compiled.two_floats import ratio

__all__ = ["bragg_rows", "bragg_rows_in_host"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]

_VECTOR = 8  # numbers that the widest vector instructions take at once
_STRETCH = 96  # wavelengths; what belongs to them stays in a core's first cache
_OPAQUE_HALF_TURNS = 20.0  # that of optics/yeh.py
_OPAQUE = 1e150  # of T, U or 1/(1 − R): beyond, squares and products overflow and nothing passes


@loop
def bragg_rows(constants: Float64, cells: Int64, wavelength_nm: Float64, out: Float64) -> None:
    """Fill `out` (rows, k), the mean of R_s and R_p, for lossless films that light runs in, in a host of n1.

    constants : (CONSTANTS, rows) of `bragg_cell`; cells : (rows,); wavelength_nm : (1 or rows, k).
    """
    width = out.shape[1]
    padded = -(-width // _VECTOR) * _VECTOR
    per_nm, per_nm_low, line = np.zeros(padded), np.zeros(padded), np.zeros(padded)
    x_s, w_s, t_s, u_s = np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH)
    x_p, w_p, t_p, u_p = np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH)
    sine_2 = np.zeros(_STRETCH)
    for row in range(len(cells)):
        if row < len(wavelength_nm):
            for j in range(width):
                per_nm[j], per_nm_low[j] = ratio(1.0, wavelength_nm[row, j])
        path_1, path_2 = constants[0, row], constants[1, row]
        s, p, g_s, g_p = constants[2, row], constants[3, row], constants[4, row], constants[5, row]
        inverse_s, inverse_p = 1.0 / s, 1.0 / p
        is_even = cells[row] % 2 == 0  # U of an even number is 2TU of its half
        number, factor = (cells[row] // 2, 2.0) if is_even else (cells[row], 1.0)
        factor_s, factor_p = factor * g_s, factor * g_p
        for start in range(0, padded, _STRETCH):
            stop = min(start + _STRETCH, padded)
            # As views: an index of two terms would be checked, and gathered, one by one.
            wave, rest, into = per_nm[start:stop], per_nm_low[start:stop], line[start:stop]
            count = stop - start
            for j in range(count):
                sin_1, cos_1 = sincos_half_turns(path_1 * wave[j] + path_1 * rest[j])
                sin_2, cos_2 = sincos_half_turns(path_2 * wave[j] + path_2 * rest[j])
                sc, cs, cc, ss = sin_1 * cos_2, cos_1 * sin_2, cos_1 * cos_2, sin_1 * sin_2
                x_s[j], w_s[j] = _trace(sc, cs, cc, ss, s, inverse_s)
                x_p[j], w_p[j] = _trace(sc, cs, cc, ss, p, inverse_p)
                sine_2[j] = 2.0 * sin_2 * cos_2
            _power(x_s, w_s, t_s, u_s, number, count)
            _power(x_p, w_p, t_p, u_p, number, count)
            if is_even:
                for j in range(count):
                    root_s, root_p = t_s[j] * u_s[j] * factor_s, t_p[j] * u_p[j] * factor_p
                    into[j] = _mean((root_s * sine_2[j]) ** 2, (root_p * sine_2[j]) ** 2)
            else:
                for j in range(count):
                    root_s, root_p = u_s[j] * factor_s, u_p[j] * factor_p
                    into[j] = _mean((root_s * sine_2[j]) ** 2, (root_p * sine_2[j]) ** 2)
        for j in range(width):
            out[row, j] = line[j]


@loop
def bragg_rows_in_host(constants: Float64, cells: Int64, wavelength_nm: Float64, out: Float64) -> None:
    """Fill `out` as `bragg_rows` does, under any host and where light may fade in the films."""
    width = out.shape[1]
    padded = -(-width // _VECTOR) * _VECTOR
    per_nm, per_nm_low, line = np.zeros(padded), np.zeros(padded), np.zeros(padded)
    x_s, w_s, t_s, u_s = np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH)
    x_p, w_p, t_p, u_p = np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH)
    sine_1, cosine_1 = np.zeros(_STRETCH), np.zeros(_STRETCH)
    sine_2, cosine_2 = np.zeros(_STRETCH), np.zeros(_STRETCH)
    for row in range(len(cells)):
        if row < len(wavelength_nm):
            for j in range(width):
                per_nm[j], per_nm_low[j] = ratio(1.0, wavelength_nm[row, j])
        path_1, path_2 = constants[0, row], constants[1, row]
        g_s, g_p = constants[4, row], constants[5, row]
        r_s, r_p = constants[HOST, row], constants[HOST + 1, row]
        through_s, through_p = constants[HOST + 2, row], constants[HOST + 3, row]
        fades_in_2 = constants[FADES_IN_2, row] > 0.0
        sign = -1.0 if fades_in_2 else 1.0  # φ₂ = i|φ₂| and X = i|X|: X t₂ changes sign, t₂/X does not
        s, p = sign * constants[2, row], sign * constants[3, row]
        inverse_s, inverse_p = sign / s, sign / p
        mean_s, mean_p = 0.5 * (s + inverse_s), 0.5 * (p + inverse_p)
        for start in range(0, padded, _STRETCH):
            stop = min(start + _STRETCH, padded)
            wave, rest, into = per_nm[start:stop], per_nm_low[start:stop], line[start:stop]
            count = stop - start
            if fades_in_2:
                for j in range(count):
                    decay = np.pi * min(path_2 * wave[j], _OPAQUE_HALF_TURNS)
                    sine_2[j], cosine_2[j] = np.sinh(decay), np.cosh(decay)
            else:
                for j in range(count):
                    sine_2[j], cosine_2[j] = sincos_half_turns(path_2 * wave[j] + path_2 * rest[j])
            for j in range(count):
                sin_1, cos_1 = sincos_half_turns(path_1 * wave[j] + path_1 * rest[j])
                sin_2, cos_2 = sine_2[j], cosine_2[j]
                sc, cs, cc, ss = sin_1 * cos_2, cos_1 * sin_2, cos_1 * cos_2, sin_1 * sin_2
                x_s[j], w_s[j] = _trace(sc, cs, cc, ss, s, inverse_s)
                x_p[j], w_p[j] = _trace(sc, cs, cc, ss, p, inverse_p)
                sine_1[j], cosine_1[j] = 2.0 * sin_1 * cos_1, 1.0 - 2.0 * sin_1 * sin_1
                sine_2[j], cosine_2[j] = 2.0 * sin_2 * cos_2, 1.0 - sign * 2.0 * sin_2 * sin_2
            _power(x_s, w_s, t_s, u_s, cells[row], count)
            _power(x_p, w_p, t_p, u_p, cells[row], count)
            for j in range(count):
                phases = sine_1[j], cosine_1[j], sine_2[j], cosine_2[j]
                into[j] = _mean(
                    _ratio(phases, mean_s, g_s, t_s[j], u_s[j], r_s, through_s),
                    _ratio(phases, mean_p, g_p, t_p[j], u_p[j], r_p, through_p),
                )
        reflects_all = constants[FADES_IN_1, row] > 0.0
        for j in range(width):
            out[row, j] = 1.0 if reflects_all else line[j]


@inline
def _trace(
    sc: float, cs: float, cc: float, ss: float, contrast: float, inverse: float
) -> tuple[float, float]:
    """Return x = cos KΛ and 1 − x² from products of the half phases' sines and cosines, first film first."""
    # The factor 2 goes where both polarisations share it.
    one_minus = (sc + contrast * cs) * (2.0 * sc + (2.0 * inverse) * cs)
    one_plus = (cc - contrast * ss) * (2.0 * cc - (2.0 * inverse) * ss)
    return 1.0 - one_minus, one_minus * one_plus


@inline
def _power(x: Float64, one_minus_x2: Float64, t: Float64, u: Float64, cells: int, count: int) -> None:
    """Put T_N(x), U_{N−1}(x) of the first `count` into t and u (optics/chebyshev_u.py); of N = 0, 1 and 0."""
    left = 0  # bits of N, the first apart
    while cells >> (left + 1) > 0:
        left += 1
    if left >= 2:
        left -= 2
        is_odd, is_next_odd = (cells >> (left + 1)) & 1 == 1, (cells >> left) & 1 == 1
        for j in range(count):
            once_t, once_u = _step(x[j], one_minus_x2[j], x[j], 1.0, is_odd)
            t[j], u[j] = _step(x[j], one_minus_x2[j], once_t, once_u, is_next_odd)
    elif left == 1:
        left = 0
        is_odd = cells & 1 == 1
        for j in range(count):
            t[j], u[j] = _step(x[j], one_minus_x2[j], x[j], 1.0, is_odd)
    else:
        for j in range(count):
            t[j], u[j] = x[j] if cells > 0 else 1.0, 1.0 if cells > 0 else 0.0
    while left >= 2:
        left -= 2
        is_odd, is_next_odd = (cells >> (left + 1)) & 1 == 1, (cells >> left) & 1 == 1
        for j in range(count):
            once_t, once_u = _step(x[j], one_minus_x2[j], t[j], u[j], is_odd)
            t[j], u[j] = _step(x[j], one_minus_x2[j], once_t, once_u, is_next_odd)
    if left == 1:
        is_odd = cells & 1 == 1
        for j in range(count):
            t[j], u[j] = _step(x[j], one_minus_x2[j], t[j], u[j], is_odd)


@inline
def _step(x: float, one_minus_x2: float, t: float, u: float, is_odd: bool) -> tuple[float, float]:
    double_t, double_u = t * t - one_minus_x2 * (u * u), 2.0 * t * u
    if is_odd:
        double_t, double_u = x * double_t - one_minus_x2 * double_u, x * double_u + double_t
    return double_t, double_u


@inline
def _ratio(
    phases: tuple[float, float, float, float],
    mean_contrast: float,
    imbalance: float,
    t: float,
    u: float,
    r: float,
    one_minus_r2: float,
) -> float:
    """Return F = R/T under a host; phases : sines and cosines of φ₁, then of φ₂."""
    sine_1, cosine_1, sine_2, cosine_2 = phases
    g = imbalance * sine_2
    sigma = sine_1 * cosine_2 + mean_contrast * cosine_1 * sine_2
    real, imaginary = r * t - g * sine_1 * u, u * (r * sigma - g * cosine_1)
    is_opaque = abs(t) > _OPAQUE or abs(u) > _OPAQUE
    return np.inf if is_opaque else (real * real + imaginary * imaginary) / one_minus_r2


@inline
def _mean(ratio_s: float, ratio_p: float) -> float:
    """Return the mean of F/(1 + F), with one division for both."""
    over_s, over_p = 1.0 + ratio_s, 1.0 + ratio_p
    over_s = _OPAQUE if over_s > _OPAQUE else over_s  # keeps their product from overflowing
    over_p = _OPAQUE if over_p > _OPAQUE else over_p
    return 1.0 - 0.5 * (over_s + over_p) / (over_s * over_p)
