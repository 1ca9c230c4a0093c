"""Snell's law: how steeply light runs inside the film and the base."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["cos_theta_2_squared", "normal_index", "normal_index_squared"]

_SPLITTER = 2.0**27 + 1.0  # Veltkamp's constant for float64: halves of 26 bits


def cos_theta_2_squared(
    outside_ior: ArrayLike, film_ior: ArrayLike, cos_theta_1: ArrayLike
) -> NDArray[np.float64]:
    """Return cos²θ₂ = 1 − (n₁/n₂)²(1 − cos²θ₁), negative under total internal reflection.

    The form in which the extension's text writes Snell's law; `normal_index_squared` is the accurate one.
    """
    ratio = np.asarray(outside_ior, dtype=np.float64) / np.asarray(film_ior, dtype=np.float64)
    cosine = np.asarray(cos_theta_1, dtype=np.float64)
    return np.asarray(1.0 - ratio * ratio * (1.0 - cosine * cosine))


def normal_index_squared(
    index: ArrayLike, outside_ior: ArrayLike, cos_theta_1: ArrayLike
) -> NDArray[np.complex128]:
    """Return q² = (n cos θ)² = n² − n₁² sin²θ₁ in a medium of index n = `index` (real or complex).

    Near the critical angle and near equal indices the terms cancel; exact products (Dekker 1971, Kahan's
    difference of products) keep every digit of q² that the inputs determine.
    """
    n = np.asarray(index, dtype=np.complex128)
    n1 = np.asarray(outside_ior, dtype=np.float64)
    c1 = np.asarray(cos_theta_1, dtype=np.float64)
    n1c1, n1c1_low = _exact_product(n1, c1)
    terms = [
        _exact_product(n.real, n.real),
        _negated(_exact_product(n1, n1)),
        _exact_product(n1c1, n1c1),
        (2.0 * n1c1 * n1c1_low, np.zeros(())),
        _negated(_exact_product(n.imag, n.imag)),
    ]
    total, low = terms[0]
    for high_part, low_part in terms[1:]:
        total, error = _exact_sum(total, high_part)
        low = low + (error + low_part)
    return np.asarray((total + low) + 2j * n.real * n.imag)


def normal_index(squared: ArrayLike) -> NDArray[np.complex128]:
    """Return q with Re q ≥ 0 and Im q ≥ 0: under exp(−iωt), the wave that runs, or fades, onward."""
    root = np.sqrt(np.asarray(squared, dtype=np.complex128))
    # A negative zero imaginary part puts the principal root on the growing wave's side.
    return np.asarray(np.abs(root.real) + 1j * np.abs(root.imag))


def _exact_product(a: Any, b: Any) -> tuple[Any, Any]:
    product = a * b
    a_high = a * _SPLITTER - (a * _SPLITTER - a)
    b_high = b * _SPLITTER - (b * _SPLITTER - b)
    a_low, b_low = a - a_high, b - b_high
    error = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    return product, error


def _exact_sum(a: Any, b: Any) -> tuple[Any, Any]:
    total = a + b
    b_seen = total - a
    return total, (a - (total - b_seen)) + (b - b_seen)


def _negated(pair: tuple[Any, Any]) -> tuple[Any, Any]:
    return -pair[0], -pair[1]
