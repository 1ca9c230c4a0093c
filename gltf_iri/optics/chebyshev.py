"""Smooth functions of two positive numbers as Chebyshev series in their logarithms.

Directional albedos cost thousands of evaluations of a lobe at each point, and are smooth over many decades of
cosine and roughness: a series of some thousand terms replaces them. Trefethen 2019, "Approximation Theory and
Approximation Practice", chapters 3 and 4: interpolation in the roots of T_n.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from numpy.typing import NDArray

__all__ = ["LogSeries"]

Float64 = NDArray[np.float64]

# Points at a time: what lies between the matrix products stays within a processor's cache.
_CHUNK: Final = 4096


@dataclass(frozen=True, slots=True)
class LogSeries:
    """f(x, y) ≈ Σ coefficients[:, j, i] T_j(log y) T_i(log x), both logarithms mapped to [−1, 1]."""

    coefficients: Float64  # (channels, terms in y, terms in x)
    x_range: tuple[float, float]
    y_range: tuple[float, float]

    @classmethod
    def of(
        cls,
        function: Callable[[Float64, float], Float64],
        x_range: tuple[float, float],
        y_range: tuple[float, float],
        *,
        terms: tuple[int, int],
    ) -> LogSeries:
        """Interpolate `function`, which maps (x (n,), y) to (channels, n), with `terms` in x and in y."""
        x_roots, y_roots = (np.cos(np.pi * (np.arange(n) + 0.5) / n) for n in terms)
        x, y = _from_unit(x_roots, x_range), _from_unit(y_roots, y_range)
        values = np.stack([function(x, float(row)) for row in y], axis=1)
        return cls(_transform(y_roots) @ values @ _transform(x_roots).T, x_range, y_range)

    def __call__(self, x: Float64, y: Float64) -> Float64:
        """Return (channels, n) at the points x (n,), y (n,), which lie in the two ranges.

        Points that repeat the one before them cost nothing: integrals over light ask many times for one view.
        """
        is_new = np.ones(x.size, np.bool_)
        is_new[1:] = (x[1:] != x[:-1]) | (y[1:] != y[:-1])
        starts = np.flatnonzero(is_new)
        return np.repeat(self._sum(x[starts], y[starts]), np.diff(starts, append=x.size), axis=1)

    def _sum(self, x: Float64, y: Float64) -> Float64:
        channels, y_terms, x_terms = self.coefficients.shape
        values = np.zeros((channels, x.size))
        for start in range(0, x.size, _CHUNK):
            here = slice(start, start + _CHUNK)
            along_x = chebvander(_to_unit(x[here], self.x_range), x_terms - 1)
            along_y = chebvander(_to_unit(y[here], self.y_range), y_terms - 1)
            for channel, coefficients in enumerate(self.coefficients):
                values[channel, here] = np.sum((along_x @ coefficients.T) * along_y, axis=-1)
        return values


def _transform(roots: Float64) -> Float64:
    """From values at the roots of T_n to coefficients, (n, n): 2/n Σ f T_j, half of it for j = 0."""
    n = len(roots)
    matrix = chebvander(roots, n - 1).T * (2.0 / n)
    matrix[0] /= 2.0
    return np.asarray(matrix)


def _to_unit(value: Float64, ends: tuple[float, float]) -> Float64:
    low, high = np.log(ends)
    return np.asarray((2.0 * np.log(value) - low - high) / (high - low))


def _from_unit(value: Float64, ends: tuple[float, float]) -> Float64:
    low, high = np.log(ends)
    return np.asarray(np.exp(0.5 * (low + high + value * (high - low))))
