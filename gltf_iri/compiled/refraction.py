"""Compiled twin of `gltf_iri.optics.refraction`, in real numbers."""

from __future__ import annotations

import math

from gltf_iri.compiled.loops import as_written
from gltf_iri.compiled.two_floats import exact_product, exact_sum

__all__ = ["normal_index", "normal_index_squared"]


@as_written
def normal_index_squared(n: float, k: float, outside_ior: float, cos_theta_1: float) -> tuple[float, float]:
    """Return Re q² = n² − k² − n₁² sin²θ₁ as two floats; Im q² is 2nk."""
    q1, q1_low = exact_product(outside_ior, cos_theta_1)
    total, low = exact_product(n, n)
    square, square_low = exact_product(outside_ior, outside_ior)
    total, error = exact_sum(total, -square)
    low += error - square_low
    square, square_low = exact_product(q1, q1)
    total, error = exact_sum(total, square)
    low += error + (square_low + 2.0 * q1 * q1_low)
    square, square_low = exact_product(k, k)
    total, error = exact_sum(total, -square)
    return exact_sum(total, low + (error - square_low))


@as_written
def normal_index(real: float, imag: float) -> tuple[float, float]:
    """Return Re q and Im q, both ≥ 0, of q² = real + i·imag with imag ≥ 0."""
    longer = math.sqrt(0.5 * (abs(real) + math.hypot(real, imag)))
    shorter = 0.5 * imag / longer if longer != 0.0 else 0.0
    return (longer, shorter) if real >= 0.0 else (shorter, longer)
