"""Mirrors whose cells absorb: powers of the complex cell matrix, which neither overflow nor lose R.

With M the cell's matrix on the tangential fields (E, H) and x half its trace, M^N = T_N + U_{N−1}(M − x),
both at x, by the doubling of `chebyshev_u`, here in complex numbers. Fading light would overflow, so M is
taken times e^(−Im φ₁ − Im φ₂), and T and U are divided by a power of two after each step: reflectance is a
ratio of the two and needs no scale; the transmitted share gets it back as an exponent. Y = q (s), q/n² (p).
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.bragg_cell import NO_NORMAL_INDEX
from gltf_iri.optics.refraction import normal_index, normal_index_squared

__all__ = ["lossy_powers"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]


def lossy_powers(
    host_ior: Any, n1: Any, n2: Any, d1_nm: Any, d2_nm: Any, cells: Any, wavelength_nm: Any, cos_theta_h: Any
) -> tuple[Float64, Float64, Float64, Float64, Float64, Float64]:
    """Return R_s, R_p, T_s, T_p, A_s, A_p; arrays broadcast (Yeh 1988; Fourneau et al. 2024, Appendix D)."""
    with np.errstate(invalid="ignore"):  # a NaN argument: complex quotients warn of it, real ones do not
        return _powers(host_ior, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, cos_theta_h)


def _powers(
    host_ior: Any, n1: Any, n2: Any, d1_nm: Any, d2_nm: Any, cells: Any, wavelength_nm: Any, cos_theta_h: Any
) -> tuple[Float64, Float64, Float64, Float64, Float64, Float64]:
    n1, n2 = (np.asarray(n, dtype=np.complex128) for n in (n1, n2))
    q_h = np.maximum(np.asarray(host_ior * cos_theta_h), NO_NORMAL_INDEX)
    q_1, q_2 = (_index_along_normal(n, host_ior, cos_theta_h) for n in (n1, n2))
    halves = _HalfPhase(q_1, d1_nm, wavelength_nm), _HalfPhase(q_2, d2_nm, wavelength_nm)
    # Y₂² − Y₁² as products, without the cancellation of that difference (bragg_cell.film_optics).
    tangential = host_ior * host_ior * ((1.0 - cos_theta_h) * (1.0 + cos_theta_h))
    imbalance = 0.5 * (n2 - n1) * (n2 + n1) / (q_1 * q_2)
    brewster = tangential * ((n1 * n1 + n2 * n2) / (n1 * n1 * n2 * n2)) - 1.0
    s = _share(q_h, q_1, q_2, imbalance, *halves, cells)
    p = _share(q_h / host_ior**2, q_1 / n1**2, q_2 / n2**2, imbalance * brewster, *halves, cells)
    return s[0], p[0], s[1], p[1], s[2], p[2]


def _index_along_normal(index: Complex128, host_ior: Any, cos_theta_h: Any) -> Complex128:
    q = normal_index(normal_index_squared(index, host_ior, cos_theta_h))
    return np.asarray(np.where(np.abs(q) < NO_NORMAL_INDEX, NO_NORMAL_INDEX, q))


class _HalfPhase:
    """cos ½φ and sin ½φ times e^(−½Im φ), and e^(iφ) times e^(−Im φ)."""

    def __init__(self, q: Complex128, thickness_nm: Any, wavelength_nm: Any) -> None:
        half_turns = q.real * thickness_nm / wavelength_nm
        real = np.pi * (half_turns - np.rint(half_turns))  # the sign that this drops enters squared
        fading = np.pi * (q.imag * thickness_nm / wavelength_nm)
        grown = -0.5 * np.expm1(-2.0 * fading)  # sinh y · e^−y
        even = 1.0 - grown  # cosh y · e^−y
        sine, cosine = np.sin(real), np.cos(real)
        self.cosine = cosine * even - 1j * (sine * grown)
        self.sine = sine * even + 1j * (cosine * grown)
        self.onward = np.exp(-4.0 * fading) * (cosine + 1j * sine) ** 2
        self.log_scale = -2.0 * fading

    @property
    def full_sine(self) -> Complex128:
        return np.asarray(2.0 * self.sine * self.cosine)

    @property
    def full_cosine(self) -> Complex128:
        return np.asarray(self.cosine * self.cosine - self.sine * self.sine)


def _share(
    y_h: Any, y_1: Any, y_2: Any, imbalance: Any, half_1: _HalfPhase, half_2: _HalfPhase, cells: Any
) -> tuple[Float64, Float64, Float64]:
    """Return R, T and A of one polarisation from the admittances of host and films and ½(X − 1/X)."""
    contrast = y_2 / y_1
    r = (y_h - y_1) / (y_h + y_1)
    one_minus, one_plus = _trace_distances(half_1, half_2, contrast)
    t, u, log_scale = _scaled_pair(
        0.5 * (one_plus - one_minus), one_minus * one_plus, half_1.log_scale + half_2.log_scale, cells
    )
    g = imbalance * half_2.full_sine
    sigma = half_1.full_sine * half_2.full_cosine
    sigma = sigma + 0.5 * (contrast + 1.0 / contrast) * half_1.full_cosine * half_2.full_sine
    # Half the sum and half the difference of E and H/Y₁ in front of the first film.
    total, difference = t - 1j * u * sigma, 1j * u * g * half_1.onward
    electric, magnetic = total + difference, total - difference
    front = total + r * difference
    scale = 1.0 / np.abs(front) ** 2
    reflected = np.abs(difference + r * total) ** 2 * scale
    # Shares of the incident power: 4 Y_h Re(E H*) / |Y_h E + H|² at either face.
    incident = 4.0 * y_h / np.abs(y_h + y_1) ** 2 * scale
    passed = incident * y_1.real * np.exp(2.0 * log_scale)
    entering = incident * (electric * np.conj(y_1 * magnetic)).real
    # Rounding may put a mirror that reflects everything an ulp above 1, and one that absorbs nothing below 0.
    return np.minimum(reflected, 1.0), passed, np.maximum(entering - passed, 0.0)


def _trace_distances(
    half_1: _HalfPhase, half_2: _HalfPhase, contrast: Complex128
) -> tuple[Complex128, Complex128]:
    """Return 1 − x and 1 + x as the products that `yeh` explains, times e^(−Im φ₁ − Im φ₂)."""
    sc, cs = half_1.sine * half_2.cosine, half_1.cosine * half_2.sine
    cc, ss = half_1.cosine * half_2.cosine, half_1.sine * half_2.sine
    one_minus = 2.0 * (sc + contrast * cs) * (sc + cs / contrast)
    return one_minus, 2.0 * (cc - contrast * ss) * (cc - ss / contrast)


def _scaled_pair(
    x: Complex128, one_minus_x2: Complex128, log_scale_of_cell: Float64, cells: Any
) -> tuple[Complex128, Complex128, Float64]:
    """Return T_N and U_{N−1} times one common scale, and the logarithm of that scale."""
    count = np.broadcast_to(np.asarray(cells, dtype=np.int64), x.shape)
    t, u = np.ones_like(x), np.zeros_like(x)  # N = 0, which doubling leaves alone
    log_scale = np.zeros(x.shape)
    for bit in reversed(range(int(count.max(initial=1)).bit_length())):
        t, u = t * t - one_minus_x2 * u * u, 2.0 * t * u
        log_scale = 2.0 * log_scale
        is_odd = (count >> bit) % 2 == 1
        t, u = (
            np.where(is_odd, x * t - one_minus_x2 * u, t),
            np.where(is_odd, x * u + t, u),
        )
        log_scale = np.where(is_odd, log_scale + log_scale_of_cell, log_scale)
        _, exponent = np.frexp(np.maximum(np.abs(t), np.abs(u)))
        shrink = np.ldexp(1.0, -exponent)
        t, u, log_scale = t * shrink, u * shrink, log_scale - exponent * np.log(2.0)
    return t, u, log_scale
