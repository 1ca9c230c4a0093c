"""Gauss's quadrature on the unit interval."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

__all__ = ["gauss_unit"]

Float64 = NDArray[np.float64]


def gauss_unit(count: int) -> tuple[Float64, Float64]:
    """Return nodes and weights (count,) of ∫₀¹ f, exact for polynomials of degree 2·count − 1."""
    nodes, weights = _gauss(count)
    return 0.5 + 0.5 * nodes, 0.5 * weights


@cache
def _gauss(count: int) -> tuple[Float64, Float64]:
    return leggauss(count)
