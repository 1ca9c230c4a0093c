"""Compiled twin of `gltf_iri.optics.two_floats`: a number as the sum of two, with twice float64's digits."""

from __future__ import annotations

import math

from gltf_iri.compiled.loops import as_written

__all__ = ["exact_product", "exact_sum", "ratio", "split", "square_root"]

_SPLITTER = 2.0**27 + 1.0


@as_written
def split(a: float) -> tuple[float, float]:
    """Return a as the sum of two numbers of 26 bits."""
    spread = a * _SPLITTER
    high = spread - (spread - a)
    return high, a - high


@as_written
def exact_product(a: float, b: float) -> tuple[float, float]:
    """Return a·b rounded, and what the rounding lost."""
    product = a * b
    a_high, a_low = split(a)
    b_high, b_low = split(b)
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


@as_written
def exact_sum(a: float, b: float) -> tuple[float, float]:
    """Return a + b rounded, and what the rounding lost."""
    total = a + b
    b_seen = total - a
    return total, (a - (total - b_seen)) + (b - b_seen)


@as_written
def square_root(a: float, a_low: float) -> tuple[float, float]:
    """Return √(a + a_low) as two floats; a > 0."""
    root = math.sqrt(a)
    square, square_low = exact_product(root, root)
    return root, ((a - square) + (a_low - square_low)) / (2.0 * root)


@as_written
def ratio(a: float, b: float) -> tuple[float, float]:
    """Return a/b as two floats."""
    quotient = a / b
    back, back_low = exact_product(quotient, b)
    return quotient, ((a - back) - back_low) / b
