"""A plane cut into cells about scattered points, in whole numbers: the same on every machine."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["nearest_points", "scrambled"]

Int64 = NDArray[np.int64]

_MASK = 0xFFFFFFFF


def scrambled(number: int) -> int:
    """Return a 32-bit number that looks unlike its neighbours': xorshifts and products mod 2³²."""
    x = (number + 1) * 0x9E3779B1 & _MASK
    for _ in range(2):
        x = (x ^ (x >> 15)) * 0x85EBCA77 & _MASK
    return x ^ (x >> 13)


def nearest_points(side: int, count: int) -> Int64:
    """Return for each texel of a square which of `count` scattered points is nearest, (side, side)."""
    points = [(scrambled(2 * i) % side, scrambled(2 * i + 1) % side) for i in range(count)]
    row, column = np.mgrid[:side, :side].astype(np.int64)
    return np.asarray(np.argmin([(row - y) ** 2 + (column - x) ** 2 for y, x in points], axis=0))
