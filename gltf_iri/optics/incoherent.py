"""The reflectance of a film averaged over the phase: what stays where fringes are finer than can be seen.

The mean of the Airy reflectance over β, the constant term of Belcour & Barla 2017, Eq. 5-6, is 1 − G; with
the admittances Y = q (s) and Y ∝ q/n² (p), q = n cos θ, and X = Re Y₃,

    G = T₁₂T₂₃/(1 − R₁₂R₂₃) = 4 Y₁Y₂X / (Y₂²(Y₁ + X) + Y₁(|Y₃|² + Y₁X)),

in which nothing cancels: what `gltf_iri.optics.film_series` has, multiplied out. A frustrated film has no
phase; it stands for a thick one, which lets nothing through. Waves are exp(−iωt), indices n + ik.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.film_series import NEAR_ZERO
from gltf_iri.optics.modulus import squared_modulus
from gltf_iri.optics.refraction import normal_index, normal_index_squared, normal_index_squared_real

__all__ = ["film_reflectance_incoherent"]


def film_reflectance_incoherent(
    outside_ior: ArrayLike, film_ior: ArrayLike, base_index: ArrayLike, cos_theta_1: ArrayLike
) -> NDArray[np.float64]:
    """Return the mean of R̄_s and R̄_p; all arguments broadcast.

    base_index : n + ik, k ≥ 0; ∞ or 0 is the perfect mirror. outside_ior, film_ior : real.
    """
    n1, n2, c1 = (np.asarray(a, dtype=np.float64) for a in (outside_ior, film_ior, cos_theta_1))
    n3: Any = np.asarray(base_index)
    is_mirror = np.isinf(n3) | (np.abs(n3) < NEAR_ZERO)
    n3 = np.where(is_mirror, 1.0, n3)
    c1 = np.maximum(c1, NEAR_ZERO)
    q1 = n1 * c1
    # Not 0, so that no quotient below is 0/0 where neither film nor base lets light through.
    q2 = np.sqrt(np.maximum(normal_index_squared_real(n2, n1, c1), NEAR_ZERO**2))
    if np.any(n3.imag):
        q3: Any = normal_index(normal_index_squared(n3, n1, c1))
    else:  # what a real base reflects in total enters it nowhere: Re q₃ = 0
        n3 = n3.real
        q3 = np.sqrt(np.maximum(normal_index_squared_real(n3, n1, c1), 0.0))
    one, two = n1 * n1, n2 * n2
    # Common factors of the admittances cancel; so written, no index is divided by but the base's.
    s = _half_entering(q1, q2, q3)
    p = _half_entering(q1 * two, q2 * one, q3 * one * two / (n3 * n3))
    # A last bit below 0 is rounding, where nothing is reflected.
    return np.asarray(np.where(is_mirror, 1.0, np.maximum(1.0 - (s + p), 0.0)))


def _half_entering(y1: Any, y2: Any, y3: Any) -> Any:
    """Return G/2 of one polarisation."""
    x3 = np.maximum(y3.real, 0.0)  # a last bit below 0 would be light from inside
    whole = y2 * y2 * (y1 + x3) + y1 * (squared_modulus(y3) + y1 * x3)
    return 2.0 * y1 * y2 * x3 / whole
