"""The environment map in float64: its radiance in a direction, and directions drawn where it is bright."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.scene.model import Environment

__all__ = ["EnvironmentMap"]

Float64 = NDArray[np.float64]

# Rec.709's share of each channel in luminance (ITU-R BT.709-6, item 3.2).
_LUMINANCE: Final = np.array([0.2126, 0.7152, 0.0722])

# Keeps a place drawn in the last cell inside of it: 1 − 2⁻⁵³.
_BELOW_ONE: Final = float(np.nextafter(1.0, 0.0))


class EnvironmentMap:
    """Directions are unit vectors (n, 3) in world space.

    The map's convention is that of `Environment`; between texel centres radiance is interpolated linearly in
    (u, v), around the horizon and up to the poles' rows, as OpenGL filters the base level.

    Directions are drawn by texel, with a chance proportional to its solid angle times the luminance that the
    interpolation leaves on it on average, and evenly by solid angle within the texel.
    """

    def __init__(self, environment: Environment) -> None:
        self._texels = environment.radiance
        self._height, self._width = environment.radiance.shape[:2]
        edges = np.cos(np.pi * np.arange(self._height + 1) / self._height)
        self._row_cosines = edges
        solid_angle = (edges[:-1] - edges[1:]) * (2.0 * np.pi / self._width)
        luminance = _averaged(environment.radiance.astype(np.float64) @ _LUMINANCE)
        if not luminance.any():
            luminance = np.ones_like(luminance)  # nothing to prefer in the dark
        weight = luminance * solid_angle[:, None]
        rows = weight.sum(axis=1)
        self._density = luminance / rows.sum()
        self._row_cdf = np.concatenate([[0.0], np.cumsum(rows)])
        self._row_cdf /= self._row_cdf[-1]
        # A dark row is never drawn; its even distribution keeps the division defined.
        within: Float64 = np.cumsum(np.where(rows[:, None] > 0.0, weight, 1.0), axis=1)
        within /= within[:, -1:]
        # Row r's distribution, raised by r: one sorted list that a single search finds any column in.
        self._column_cdf = (within + np.arange(self._height)[:, None]).ravel()

    def radiance(self, direction: Float64) -> Float64:
        """Return linear Rec.709 radiance (n, 3)."""
        u, v = _map_place(direction)
        across, down = u * self._width - 0.5, v * self._height - 0.5
        left, top = np.floor(across), np.floor(down)
        beta, gamma = (across - left)[:, None], (down - top)[:, None]
        columns = [np.mod(left.astype(np.int64) + i, self._width) for i in (0, 1)]
        rows = [np.clip(top.astype(np.int64) + i, 0, self._height - 1) for i in (0, 1)]
        first, second = (
            (1.0 - beta) * self._texels[row, columns[0]] + beta * self._texels[row, columns[1]]
            for row in rows
        )
        return np.asarray((1.0 - gamma) * first + gamma * second)

    def sample(self, place: Float64) -> Float64:
        """Return directions (n, 3) for places (n, 2) in the unit square, distributed as `density` says."""
        row = np.searchsorted(self._row_cdf, place[:, 1], side="right") - 1
        row = np.clip(row, 0, self._height - 1)
        start, end = self._row_cdf[row], self._row_cdf[row + 1]
        down = _share(place[:, 1], start, end)
        index = np.searchsorted(self._column_cdf, row + place[:, 0], side="right")
        index = np.clip(index, row * self._width, (row + 1) * self._width - 1)
        column = index - row * self._width
        before = np.where(column > 0, self._column_cdf[index - 1], row.astype(np.float64))
        across = _share(place[:, 0] + row, before, self._column_cdf[index])
        cosine = self._row_cosines[row] + down * (self._row_cosines[row + 1] - self._row_cosines[row])
        sine = np.sqrt(np.maximum(1.0 - cosine * cosine, 0.0))
        azimuth = 2.0 * np.pi * ((column + across) / self._width - 0.5)
        return np.column_stack([sine * np.cos(azimuth), cosine, sine * np.sin(azimuth)])

    def density(self, direction: Float64) -> Float64:
        """Return how densely `sample` draws each direction, (n,), per steradian."""
        u, v = _map_place(direction)
        column = np.minimum((u * self._width).astype(np.int64), self._width - 1)
        row = np.minimum((v * self._height).astype(np.int64), self._height - 1)
        return np.asarray(self._density[row, column])


def _map_place(direction: Float64) -> tuple[Float64, Float64]:
    """Return (u, v) = (½ + atan2(z, x) / 2π, acos(y) / π); acos as atan2 keeps its digits at the poles."""
    x, y, z = direction.T
    return 0.5 + np.arctan2(z, x) / (2.0 * np.pi), np.arctan2(np.hypot(x, z), y) / np.pi


def _averaged(values: Float64) -> Float64:
    """Return what linear interpolation leaves of `values` on each texel on average: ⅛, ¾, ⅛ each way."""
    padded = np.pad(values, ((1, 1), (0, 0)), mode="edge")
    rows = 0.125 * (padded[:-2] + padded[2:]) + 0.75 * values
    return np.asarray(0.125 * (np.roll(rows, 1, axis=1) + np.roll(rows, -1, axis=1)) + 0.75 * rows)


def _share(value: Float64, low: Float64, high: Float64) -> Float64:
    """Return where `value` lies between `low` and `high`, in [0, 1)."""
    width = high - low
    return np.clip((value - low) / np.where(width > 0.0, width, 1.0), 0.0, _BELOW_ONE)
