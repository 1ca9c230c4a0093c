"""Smaller and smaller versions of an equirectangular map, averaged over solid angle.

OpenGL's own mipmaps average texels alike, although a texel at a pole covers next to nothing of the sphere.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["environment_levels", "resampled"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]


def environment_levels(radiance: Float32) -> list[Float32]:
    """Return `radiance` (height, width, 3) and its halvings down to (1, 1, 3), rounded down as in OpenGL."""
    levels = [radiance]
    height, width = radiance.shape[:2]
    while height > 1 or width > 1:
        height, width = max(height // 2, 1), max(width // 2, 1)
        levels.append(resampled(levels[-1], height, width))
    return levels


def resampled(image: Float32, height: int, width: int) -> Float32:
    """Return the mean of `image` over each cell of a grid of another size; cells may cut through texels."""
    # Row edges in cos of the polar angle: equal steps there are equal shares of the sphere.
    rows = _average(image.astype(np.float64), _cosines(image.shape[0]), _cosines(height))
    columns = _average(rows.swapaxes(0, 1), _steps(image.shape[1]), _steps(width))
    return columns.swapaxes(0, 1).astype(np.float32)


def _cosines(count: int) -> Float64:
    return (1.0 - np.cos(np.pi * _steps(count))) / 2.0


def _steps(count: int) -> Float64:
    return np.linspace(0.0, 1.0, count + 1)


def _average(values: Float64, edges: Float64, cells: Float64) -> Float64:
    """Return the means over m `cells` of n `values` along the first axis, constant between n + 1 `edges`."""
    along_first = (-1, *[1] * (values.ndim - 1))
    total = np.cumsum(values * np.diff(edges).reshape(along_first), axis=0)
    total = np.concatenate([np.zeros_like(total[:1]), total])
    at = np.clip(np.searchsorted(edges, cells, side="right") - 1, 0, len(values) - 1)
    share = ((cells - edges[at]) / np.diff(edges)[at]).reshape(along_first)
    integral = total[at] * (1.0 - share) + total[at + 1] * share
    return np.asarray(np.diff(integral, axis=0) / np.diff(cells).reshape(along_first))
