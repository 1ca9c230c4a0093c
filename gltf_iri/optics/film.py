"""The exact reflectance of one thin film: every inter-reflection, both polarisations.

The Airy sum r = (r₁₂ + r₂₃e^{2iβ})/(1 + r₁₂r₂₃e^{2iβ}) (Belcour & Barla 2017, Eq. 2–3) equals

    r = (Y₁ − Y₃ + iu(Y₂² − Y₁Y₃)) / (Y₁ + Y₃ − iu(Y₂² + Y₁Y₃)),   u = tan β / Y₂,   β = 2π d q₂/λ

with the admittances Y = q (s) and Y = q/n² (p), q = n cos θ. This form is used: towards grazing light, where
r₁₂ → −1, it does not subtract nearly equal numbers as 1 + r₁₂r₂₃e^{2iβ} does, and it needs one tangent for
both polarisations. Convention exp(−iωt), index n + ik, k ≥ 0.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.refraction import normal_index, normal_index_squared

__all__ = ["FilmReflectance", "tangent_over_q"]

Float64 = NDArray[np.float64]

_NO_INDEX = 1e-150  # below, n² underflows; such a base reflects everything


class FilmReflectance:
    """What a film's reflectance keeps from one wavelength to the next.

    outside_ior, film_ior, cos_theta_1 : (...), real; base_index : (...), complex; they broadcast. A base
    index of ∞ or of 0 is the perfect mirror. Where an index depends on the wavelength, pass it with that
    axis.
    """

    def __init__(
        self, outside_ior: ArrayLike, film_ior: ArrayLike, base_index: ArrayLike, cos_theta_1: ArrayLike
    ) -> None:
        n1, n2, c1 = (np.asarray(a, dtype=np.float64) for a in (outside_ior, film_ior, cos_theta_1))
        n3 = np.asarray(base_index, dtype=np.complex128)
        self._is_mirror = np.isinf(n3) | (np.abs(n3) < _NO_INDEX)
        n3 = np.where(self._is_mirror, 1.0, n3)

        q1 = n1 * c1
        self.q2_squared = normal_index_squared(n2, n1, c1).real
        q3 = normal_index(normal_index_squared(n3, n1, c1))

        self._s = _Polarisation(q1, self.q2_squared, q3, np.ones(()))
        self._p = _Polarisation(q1 / (n1 * n1), self.q2_squared / n2**4, q3 / (n3 * n3), n2 * n2)

    def __call__(self, u: ArrayLike) -> Float64:
        """Return the mean of R_s and R_p for u = tan β/q₂ (`tangent_over_q`), broadcast with the film."""
        u = np.asarray(u, dtype=np.float64)
        mean = 0.5 * (self._s.reflectance(u) + self._p.reflectance(u))
        return np.asarray(np.where(self._is_mirror, 1.0, mean))

    def polarised(self, u: ArrayLike) -> tuple[Float64, Float64]:
        """Return R_s and R_p apart."""
        u = np.asarray(u, dtype=np.float64)
        s, p = self._s.reflectance(u), self._p.reflectance(u)
        return np.where(self._is_mirror, 1.0, s), np.where(self._is_mirror, 1.0, p)


class _Polarisation:
    """R(u) = |N₀ + iu N₁|² / |D₀ − iu D₁|², split into real and imaginary parts."""

    def __init__(self, y1: Any, y2_squared: Any, y3: Any, scale: Any) -> None:
        # tan β/Y₂ = scale · tan β/q₂ goes into the coefficients of u.
        self._num_real = y1 - y3.real, scale * y1 * y3.imag
        self._num_imag = -y3.imag, scale * (y2_squared - y1 * y3.real)
        self._den_real = y1 + y3.real, scale * y1 * y3.imag
        self._den_imag = y3.imag, -scale * (y2_squared + y1 * y3.real)
        self._absorbs_nothing = not np.any(y3.imag)

    def reflectance(self, u: Float64) -> Float64:
        if self._absorbs_nothing:  # half the terms are zero: the same sums in half the time
            u_squared = u * u
            numerator = self._num_real[0] ** 2 + self._num_imag[1] ** 2 * u_squared
            denominator = self._den_real[0] ** 2 + self._den_imag[1] ** 2 * u_squared
        else:
            numerator = _affine(self._num_real, u) ** 2 + _affine(self._num_imag, u) ** 2
            denominator = _affine(self._den_real, u) ** 2 + _affine(self._den_imag, u) ** 2
        # Only where all three media match at grazing do both vanish: then nothing reflects.
        is_nothing = denominator == 0.0
        if np.any(is_nothing):
            return np.asarray(np.where(is_nothing, 0.0, numerator / np.where(is_nothing, 1.0, denominator)))
        return np.asarray(numerator / denominator)


def tangent_over_q(q2_squared: ArrayLike, path_per_wavelength: ArrayLike) -> Float64:
    """Return tan β/q₂ with β = 2π (d/λ) q₂; real also for a frustrated film, whose q₂ is imaginary.

    q2_squared : (...); path_per_wavelength : d/λ, (...).
    """
    squared = np.asarray(q2_squared, dtype=np.float64)
    path = 2.0 * np.asarray(path_per_wavelength, dtype=np.float64)
    q2 = np.sqrt(np.abs(squared))
    half_turns = path * q2  # β/π
    # Whole half turns change nothing; taken off before π is multiplied in, they cost no digits.
    turned = np.tan(np.pi * (half_turns - np.rint(half_turns)))
    if np.any(squared < 0.0):
        turned = np.where(squared < 0.0, np.tanh(np.pi * half_turns), turned)
    is_flat = q2 == 0.0
    if np.any(is_flat):  # tan β/q₂ → 2πd/λ for light that just grazes inside the film
        return np.asarray(np.where(is_flat, np.pi * path, turned / np.where(is_flat, 1.0, q2)))
    return np.asarray(turned / q2)


def _affine(coefficients: tuple[Any, Any], u: Float64) -> Float64:
    return np.asarray(coefficients[0] + coefficients[1] * u)
