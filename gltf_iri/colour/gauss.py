"""Gauss–Legendre quadrature in panels, for integrands that are smooth only between the observer's steps."""

from __future__ import annotations

import numpy as np
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

__all__ = ["gauss_panels"]

Float64 = NDArray[np.float64]


def gauss_panels(edges: Float64, points: int) -> tuple[Float64, Float64]:
    """Return nodes and weights (panels · points,) of the integral over all panels between rising `edges`.

    Exact where the integrand is a polynomial of degree 2 · points − 1 in each panel.
    """
    nodes, gauss = leggauss(points)
    half = 0.5 * np.diff(edges)[:, None]
    return (edges[:-1, None] + half + half * nodes).reshape(-1), (half * gauss).reshape(-1)
