"""Points that fill the unit square evenly, and independent random copies of them.

Van der Corput's sequence beside Sobol's second dimension: the first 2ᵏ points are a (0, k, 2)-net (Sobol
1967). XOR with a random number (a digital shift: Cranley & Patterson's rotation, bit by bit) keeps that, and
makes every point uniform: the mean over copies is unbiased, and their spread tells the error.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["net", "shifted", "standard_error"]

Float64 = NDArray[np.float64]
UInt32 = NDArray[np.uint32]

_BITS: Final = 32


def net(count: int) -> UInt32:
    """Return the first `count` points, (count, 2), as fractions of 2³²."""
    number = np.arange(count, dtype=np.uint32)
    points = np.zeros((count, 2), np.uint32)
    mirrored = np.uint32(1) << np.uint32(_BITS - 1)
    second = mirrored
    while number.any():
        odd = (number & np.uint32(1)).astype(np.bool_)
        points[odd, 0] ^= mirrored
        points[odd, 1] ^= second
        number = number >> np.uint32(1)
        mirrored = mirrored >> np.uint32(1)
        second = second ^ (second >> np.uint32(1))
    return points


def shifted(points: UInt32, rng: np.random.Generator, copies: int) -> Float64:
    """Return independent copies of `points` (k, 2), each in (0, 1)²: (copies, k, 2)."""
    shift = rng.integers(0, 1 << _BITS, (copies, 1, 2), dtype=np.uint32)
    return np.asarray(((points ^ shift) + 0.5) / 2.0**_BITS)


def standard_error(estimates: Float64) -> tuple[Float64, Float64]:
    """Return mean and standard error of independent `estimates` along their first axis, two at least."""
    count = len(estimates)
    return estimates.mean(axis=0), estimates.std(axis=0, ddof=1) / np.sqrt(count)
