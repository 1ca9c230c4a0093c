"""Reflection at one interface: exact amplitudes, and the approximations that glTF's text is written in.

Wave convention exp(−iωt), index n + ik with k ≥ 0. q = n cos θ is the component of the index along the normal
(`gltf_iri.optics.refraction`).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["amplitude_p", "amplitude_s", "f_schlick"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]


def f_schlick(f0: ArrayLike, cos_theta: ArrayLike) -> Float64:
    """Return F₀ + (1 − F₀)(1 − cos θ)⁵ (Schlick 1994, Eq. 15; glTF 2.0 §B.3.4)."""
    f0 = np.asarray(f0, dtype=np.float64)
    return np.asarray(f0 + (1.0 - f0) * _fifth_power(1.0 - np.asarray(cos_theta, dtype=np.float64)))


def amplitude_s(q_1: ArrayLike, q_2: ArrayLike) -> Complex128:
    """Return r_s = (q₁ − q₂)/(q₁ + q₂), electric field perpendicular to the plane of incidence.

    q₁ = q₂ = 0 (grazing light on a matched interface) reflects nothing: r = 0.
    """
    return _contrast(np.asarray(q_1, dtype=np.complex128), np.asarray(q_2, dtype=np.complex128))


def amplitude_p(n_1: ArrayLike, q_1: ArrayLike, n_2: ArrayLike, q_2: ArrayLike) -> Complex128:
    """Return r_p = (n₂²q₁ − n₁²q₂)/(n₂²q₁ + n₁²q₂), magnetic field perpendicular to the plane of incidence.

    At normal incidence r_p = −r_s (the magnetic field's convention); reflectances do not depend on it.
    """
    n_1 = np.asarray(n_1, dtype=np.complex128)
    n_2 = np.asarray(n_2, dtype=np.complex128)
    first = n_2 * n_2 * np.asarray(q_1, dtype=np.complex128)
    second = n_1 * n_1 * np.asarray(q_2, dtype=np.complex128)
    return _contrast(first, second)


def _contrast(a: Complex128, b: Complex128) -> Complex128:
    total = a + b
    is_empty = total == 0.0
    return np.asarray(np.where(is_empty, 0.0, (a - b) / np.where(is_empty, 1.0, total)))


def _fifth_power(x: Float64) -> Float64:
    square = x * x
    return np.asarray(square * square * x)
