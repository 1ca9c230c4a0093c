"""Lines in 32 bits: what texels of a table of sensitivities are made of."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["line_words"]


def line_words(
    begin: NDArray[np.float64],
    middle: NDArray[np.float64],
    end: NDArray[np.float64],
    *,
    value_max: float,
    slope_max: float,
    slope_bits: int,
) -> NDArray[np.uint32]:
    """Return (...): the lines through three values (...) of a texel's span that err least between them.

    A word is the line's value where `value_max` is 2³¹; its last `slope_bits`, for which the value is
    rounded, are the slope from texel to texel, of which `slope_max` is the greatest that fits.
    """
    low = 1 << slope_bits
    slope = np.rint((end - begin) * (0.5 * low / slope_max)).astype(np.int64) & (low - 1)
    whole = (begin + 2.0 * middle + end) * (0.25 * 2.0**31 / value_max)
    value = np.rint((whole - slope) / low).astype(np.int64)
    return (value * low + slope).astype(np.uint32)
