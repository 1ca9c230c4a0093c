"""Snell's law: how steeply light runs inside the film and the base."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.two_floats import exact_product, exact_sum

__all__ = ["cos_theta_2_squared", "normal_index", "normal_index_squared"]
__all__ += ["normal_index_squared_exact", "normal_index_squared_real"]


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
    difference of products) then keep every digit of q² that the inputs determine.
    """
    n = np.asarray(index, dtype=np.complex128)
    outside_ior = np.asarray(outside_ior, dtype=np.float64)
    imaginary = 2j * n.real * n.imag
    if np.all(n.real >= outside_ior):  # nothing cancels, or next to a larger imaginary part
        return np.asarray((_rising(n.real, outside_ior, cos_theta_1) - n.imag * n.imag) + imaginary)
    extinction = exact_product(n.imag, n.imag)
    total, low = normal_index_squared_exact(n.real, outside_ior, cos_theta_1)
    total, error = exact_sum(total, -extinction[0])
    return np.asarray((total + (low + (error - extinction[1]))) + imaginary)


def normal_index_squared_real(index: ArrayLike, outside_ior: ArrayLike, cos_theta_1: ArrayLike) -> Any:
    """Return q² of a medium of real index, as accurate as `normal_index_squared`."""
    n, n1 = np.asarray(index, dtype=np.float64), np.asarray(outside_ior, dtype=np.float64)
    return (
        _rising(n, n1, cos_theta_1) if np.all(n >= n1) else normal_index_squared_exact(n, n1, cos_theta_1)[0]
    )


def normal_index_squared_exact(
    index: ArrayLike, outside_ior: ArrayLike, cos_theta_1: ArrayLike
) -> tuple[Any, Any]:
    """Return q² of a medium of real index as two floats, whose sum has twice the digits of float64."""
    n, n1, c1 = (np.asarray(a, dtype=np.float64) for a in (index, outside_ior, cos_theta_1))
    n1c1, n1c1_low = exact_product(n1, c1)
    nn, n1n1, tilted = (exact_product(a, a) for a in (n, n1, n1c1))
    total, error = exact_sum(nn[0], -n1n1[0])
    low = nn[1] + (error - n1n1[1])
    total, error = exact_sum(total, tilted[0])
    low = low + (error + (tilted[1] + 2.0 * n1c1 * n1c1_low))
    return exact_sum(total, low)


def _rising(index: Any, outside_ior: Any, cos_theta_1: Any) -> Any:
    """Return (n − n₁)(n + n₁) + n₁² cos²θ₁, in which nothing cancels for n ≥ n₁."""
    q1 = outside_ior * np.asarray(cos_theta_1, dtype=np.float64)
    return (index - outside_ior) * (index + outside_ior) + q1 * q1


def normal_index(squared: ArrayLike) -> NDArray[np.complex128]:
    """Return q with Re q ≥ 0 and Im q ≥ 0: under exp(−iωt), the wave that runs, or fades, onward."""
    root = np.sqrt(np.asarray(squared, dtype=np.complex128))
    # A negative zero imaginary part puts the principal root on the growing wave's side.
    return np.asarray(np.abs(root.real) + 1j * np.abs(root.imag))
