"""Yeh's closed form compiled: the twin of optics/yeh.py, a row of wavelengths at a time.

Sines and cosines of half the phases stand for the tangents there. The steps of the doubling run over a
stretch of wavelengths each, because a loop within a loop keeps the compiler from using vector instructions;
two steps at a time and one polarisation after the other, because the rest of the time goes into loads and
stores.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sincos import sincos_turns

__all__ = ["bragg_rows", "bragg_rows_in_host"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]

_STRETCH = 96  # wavelengths; what belongs to them stays in a core's first cache
_OPAQUE_HALF_TURNS = 20.0  # that of optics/yeh.py
_OPAQUE = 1e150  # of T or U: beyond, squares overflow and nothing passes


@loop
def bragg_rows(films: Float64, cells: Int64, waves: Float64, out: Float64) -> None:
    """Fill `out` (rows, k), the mean of R_s and R_p, for lossless films that light runs in, in a host of n1.

    films : (6, rows), the first six of `bragg_cell.Films`; cells : (rows,); waves : (2, 1 or rows, k), 1/λ in
    nm⁻¹ as two floats.
    """
    x_s, w_s, t_s, u_s = np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH)
    x_p, w_p, t_p, u_p = np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH)
    sine_2 = np.zeros(_STRETCH)
    for row in range(len(cells)):
        half_1, half_2 = 0.5 * films[0, row], 0.5 * films[1, row]
        s, p, g_s, g_p = films[2, row], films[3, row], films[4, row], films[5, row]
        inverse_s, inverse_p = 1.0 / s, 1.0 / p
        wave_row = min(row, waves.shape[1] - 1)
        for start in range(0, out.shape[1], _STRETCH):
            stop = min(start + _STRETCH, out.shape[1])
            count = stop - start
            wave, rest = waves[0, wave_row, start:stop], waves[1, wave_row, start:stop]
            into = out[row, start:stop]
            for j in range(count):
                sin_1, cos_1 = sincos_turns(half_1 * wave[j] + half_1 * rest[j])
                sin_2, cos_2 = sincos_turns(half_2 * wave[j] + half_2 * rest[j])
                sc, cs, cc, ss = sin_1 * cos_2, cos_1 * sin_2, cos_1 * cos_2, sin_1 * sin_2
                x_s[j], w_s[j] = _trace(sc, cs, cc, ss, s, inverse_s)
                x_p[j], w_p[j] = _trace(sc, cs, cc, ss, p, inverse_p)
                sine_2[j] = 2.0 * sin_2 * cos_2
            _power(x_s, w_s, t_s, u_s, cells[row] // 2, count)
            _power(x_p, w_p, t_p, u_p, cells[row] // 2, count)
            if cells[row] % 2 == 0:
                for j in range(count):
                    root_s, root_p = 2.0 * t_s[j] * u_s[j] * g_s, 2.0 * t_p[j] * u_p[j] * g_p
                    into[j] = _mean((root_s * sine_2[j]) ** 2, (root_p * sine_2[j]) ** 2)
            else:
                for j in range(count):
                    _, root_s = _step(x_s[j], w_s[j], t_s[j], u_s[j], True)
                    _, root_p = _step(x_p[j], w_p[j], t_p[j], u_p[j], True)
                    into[j] = _mean((root_s * g_s * sine_2[j]) ** 2, (root_p * g_p * sine_2[j]) ** 2)


@loop
def bragg_rows_in_host(
    films: Float64, fades_in_2: NDArray[np.bool_], host: Float64, cells: Int64, waves: Float64, out: Float64
) -> None:
    """Fill `out` as `bragg_rows` does, under any host and where light may fade in n2.

    fades_in_2 : (rows,); host : (4, rows), the constants of `bragg_cell.Host`.
    """
    x_s, w_s, t_s, u_s = np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH)
    x_p, w_p, t_p, u_p = np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH), np.zeros(_STRETCH)
    sine_1, cosine_1 = np.zeros(_STRETCH), np.zeros(_STRETCH)
    sine_2, cosine_2 = np.zeros(_STRETCH), np.zeros(_STRETCH)
    for row in range(len(cells)):
        half_1, half_2 = 0.5 * films[0, row], 0.5 * films[1, row]
        sign = -1.0 if fades_in_2[row] else 1.0  # φ₂ = i|φ₂| and X = i|X|: X t₂ changes sign, t₂/X does not
        s, p = sign * films[2, row], sign * films[3, row]
        inverse_s, inverse_p = sign / s, sign / p
        mean_s, mean_p = 0.5 * (s + inverse_s), 0.5 * (p + inverse_p)
        wave_row = min(row, waves.shape[1] - 1)
        for start in range(0, out.shape[1], _STRETCH):
            stop = min(start + _STRETCH, out.shape[1])
            count = stop - start
            wave, rest = waves[0, wave_row, start:stop], waves[1, wave_row, start:stop]
            into = out[row, start:stop]
            if fades_in_2[row]:
                for j in range(count):
                    decay = np.pi * min(2.0 * half_2 * wave[j], _OPAQUE_HALF_TURNS)
                    sine_2[j], cosine_2[j] = np.sinh(decay), np.cosh(decay)
            else:
                for j in range(count):
                    sine_2[j], cosine_2[j] = sincos_turns(half_2 * wave[j] + half_2 * rest[j])
            for j in range(count):
                sin_1, cos_1 = sincos_turns(half_1 * wave[j] + half_1 * rest[j])
                sin_2, cos_2 = sine_2[j], cosine_2[j]
                sc, cs, cc, ss = sin_1 * cos_2, cos_1 * sin_2, cos_1 * cos_2, sin_1 * sin_2
                x_s[j], w_s[j] = _trace(sc, cs, cc, ss, s, inverse_s)
                x_p[j], w_p[j] = _trace(sc, cs, cc, ss, p, inverse_p)
                sine_1[j], cosine_1[j] = 2.0 * sin_1 * cos_1, 1.0 - 2.0 * sin_1 * sin_1
                sine_2[j], cosine_2[j] = 2.0 * sin_2 * cos_2, 1.0 - sign * 2.0 * sin_2 * sin_2
            _power(x_s, w_s, t_s, u_s, cells[row], count)
            _power(x_p, w_p, t_p, u_p, cells[row], count)
            for j in range(count):
                into[j] = _mean(
                    _ratio(
                        sine_1[j], cosine_1[j], sine_2[j], cosine_2[j], mean_s, films[4, row], t_s[j], u_s[j],
                        host[0, row], host[2, row],
                    ),
                    _ratio(
                        sine_1[j], cosine_1[j], sine_2[j], cosine_2[j], mean_p, films[5, row], t_p[j], u_p[j],
                        host[1, row], host[3, row],
                    ),
                )  # fmt: skip


@inline
def _trace(
    sc: float, cs: float, cc: float, ss: float, contrast: float, inverse: float
) -> tuple[float, float]:
    """Return x = cos KΛ and 1 − x² from products of the half phases' sines and cosines, first film first."""
    one_minus = 2.0 * (sc + contrast * cs) * (sc + inverse * cs)
    one_plus = 2.0 * (cc - contrast * ss) * (cc - inverse * ss)
    return 1.0 - one_minus, one_minus * one_plus


@inline
def _power(x: Float64, one_minus_x2: Float64, t: Float64, u: Float64, cells: int, count: int) -> None:
    """Put T_N(x), U_{N−1}(x) of the first `count` into t and u (optics/chebyshev_u.py); of N = 0, 1 and 0."""
    top = 0
    while cells >> (top + 1) > 0:
        top += 1
    if top == 0:
        for j in range(count):
            t[j], u[j] = x[j] if cells > 0 else 1.0, 1.0 if cells > 0 else 0.0
    else:
        is_odd = (cells >> (top - 1)) & 1 == 1
        for j in range(count):
            t[j], u[j] = _step(x[j], one_minus_x2[j], x[j], 1.0, is_odd)
    left = top - 1
    while left >= 2:
        is_odd, is_next_odd = (cells >> (left - 1)) & 1 == 1, (cells >> (left - 2)) & 1 == 1
        for j in range(count):
            once_t, once_u = _step(x[j], one_minus_x2[j], t[j], u[j], is_odd)
            t[j], u[j] = _step(x[j], one_minus_x2[j], once_t, once_u, is_next_odd)
        left -= 2
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
    sine_1: float,
    cosine_1: float,
    sine_2: float,
    cosine_2: float,
    mean_contrast: float,
    imbalance: float,
    t: float,
    u: float,
    r: float,
    one_minus_r2: float,
) -> float:
    """Return F = R/T under a host."""
    g = imbalance * sine_2
    sigma = sine_1 * cosine_2 + mean_contrast * cosine_1 * sine_2
    real, imaginary = r * t - g * sine_1 * u, u * (r * sigma - g * cosine_1)
    is_opaque = abs(t) > _OPAQUE or abs(u) > _OPAQUE
    return np.inf if is_opaque else (real * real + imaginary * imaginary) / one_minus_r2


@inline
def _mean(ratio_s: float, ratio_p: float) -> float:
    return 1.0 - 0.5 * (1.0 / (1.0 + ratio_s) + 1.0 / (1.0 + ratio_p))
