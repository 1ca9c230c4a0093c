"""Numbers that come out alike on every processor.

Sines differ in their last bit between processors and libraries. What is written is rounded to 2⁻²⁰ first
(a micrometre in a metre), so that the files are the same bytes everywhere.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["rounded", "rounded_list"]

_STEPS = 2.0**20


def rounded(values: ArrayLike) -> NDArray[np.float64]:
    """Return `values` on the 2⁻²⁰ grid, without negative zeros."""
    return np.asarray(np.rint(np.asarray(values, dtype=np.float64) * _STEPS) / _STEPS + 0.0)


def rounded_list(values: ArrayLike) -> list[float]:
    """Return `values` with six decimals, for JSON."""
    return [round(float(value), 6) + 0.0 for value in np.asarray(values).ravel()]
