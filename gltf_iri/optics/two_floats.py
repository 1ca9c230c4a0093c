"""Twice the digits of float64: a number as the sum of two, where a difference or a phase asks for them.

Products and sums without rounding error (Dekker 1971; Knuth, "The Art of Computer Programming", vol. 2,
§4.2.2), and what follows from them. Arrays broadcast.
"""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = ["exact_product", "exact_sum", "reciprocal", "split", "square_root"]

_SPLITTER = 2.0**27 + 1.0  # Veltkamp's constant for float64: halves of 26 bits


def split(a: Any) -> tuple[Any, Any]:
    """Return a as the sum of two numbers of 26 bits; products of such halves are exact."""
    spread = a * _SPLITTER
    high = spread - (spread - a)
    return high, a - high


def exact_product(a: Any, b: Any) -> tuple[Any, Any]:
    """Return a·b rounded, and what the rounding lost."""
    product = a * b
    (a_high, a_low), (b_high, b_low) = split(a), split(b)
    return product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low


def exact_sum(a: Any, b: Any) -> tuple[Any, Any]:
    """Return a + b rounded, and what the rounding lost."""
    total = a + b
    b_seen = total - a
    return total, (a - (total - b_seen)) + (b - b_seen)


def square_root(a: Any, a_low: Any) -> tuple[Any, Any]:
    """Return √(a + a_low) as two floats; a > 0."""
    root = np.sqrt(a)
    square, square_low = exact_product(root, root)
    return root, ((a - square) + (a_low - square_low)) / (2.0 * root)


def reciprocal(a: Any) -> tuple[Any, Any]:
    """Return 1/a as two floats."""
    inverse = 1.0 / a
    one, one_low = exact_product(inverse, a)
    return inverse, ((1.0 - one) - one_low) * inverse
