"""How far away, and where, an eye must stand so that points just fit into its picture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["fit_eye"]

Float64 = NDArray[np.float64]


def fit_eye(points: Float64, slope_x: float, slope_y: float) -> Float64:
    """Return the eye (3,) closest to `points` (n, 3) that still sees all of them.

    Points and eye share the view's axes: x right, y up, z backward. A point is seen where
    |x − eₓ| ≤ slope_x (e_z − z), so with a = max(x + slope_x z) and b = max(−x + slope_x z) the width wants
    e_z ≥ (a + b) / 2 slope_x at eₓ = (a − b) / 2; the height likewise, and the larger e_z holds for both.
    """
    eye = np.zeros(3)
    for axis, slope in enumerate((slope_x, slope_y)):
        a = float(np.max(points[:, axis] + slope * points[:, 2]))
        b = float(np.max(-points[:, axis] + slope * points[:, 2]))
        eye[axis] = 0.5 * (a - b)
        needed = 0.5 * (a + b) / slope
        eye[2] = needed if axis == 0 else max(eye[2], needed)
    eye[2] = max(eye[2], float(points[:, 2].max()) + _least_distance(points))
    return eye


def _least_distance(points: Float64) -> float:
    """Return how far the eye keeps from the nearest point, so that neither a speck nor an edge is at 0."""
    size = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    return 0.1 * size if size > 0.0 else 1.0
