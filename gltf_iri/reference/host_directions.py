"""Directions on both sides of a smooth surface, of what Bragg layers lie in or of a body below them.

Vectors are unit, (n, 3), along axes of which +Z is the surface's normal. Snell's law divides what of them
lies in the surface by the index.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["in_host", "out_of_host"]

Float64 = NDArray[np.float64]


def in_host(outside: Float64, host_ior: float | Float64) -> Float64:
    """Return directions (n, 3), z > 0, inside of the host, of those outside; `host_ior` one, or (n, 1)."""
    level = outside[:, :2] / host_ior
    # In air rounding may take the level part past 1; nothing is drawn along the surface.
    height = np.sqrt(np.maximum(1.0 - np.sum(level * level, axis=1), 1e-30))
    return np.column_stack([level, height])


def out_of_host(inside: Float64, host_ior: float) -> tuple[Float64, NDArray[np.bool_]]:
    """Return directions (n, 3) outside of those inside, z ≥ 0, and which (n,) of them get out.

    Those that point down, or are reflected totally, do not; their directions mean nothing.
    """
    level = host_ior * inside[:, :2]
    squared = 1.0 - np.sum(level * level, axis=1)
    outside = np.column_stack([level, np.sqrt(np.maximum(squared, 0.0))])
    return outside, (squared > 0.0) & (inside[:, 2] > 0.0)
