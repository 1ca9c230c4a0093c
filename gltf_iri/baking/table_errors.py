"""What a table errs at random places of a material's reach, before it is filled.

Linear interpolation errs along an axis of cells h by h²/2·s(1 − s)·∂²F, and along several by the sum; the
eight bits of graphics cards' filter weights add up to 1/512 of the step from texel to texel along each axis.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.lookup import axis_coordinate, axis_values
from gltf_iri.baking.table_values import Places, TableValues
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.quantile import bounds
from gltf_iri.planning.film_table import Quantity, TableAxis

__all__ = ["AxisErrors", "Judged", "p95_below"]

Float64 = NDArray[np.float64]

_FILTER_STEP: Final = 1.0 / 512.0  # half of the last of eight bits


def p95_below(errors: Float64) -> float:
    """Return a number that 95 % of all errors lie below, as surely as `gltf_iri.colour.quantile` says."""
    return bounds(errors.reshape(-1))[1]


@dataclass(frozen=True, slots=True)
class AxisErrors:
    """What each axis alone errs at n places, in units in which CIEDE2000 is a length: (n, 3) and (n,).

    offset : what is left with ever finer axes.
    bent : of the interpolation, which goes with h²; stepped : of the filter's weights, with h.
    """

    offset: Float64
    bent: tuple[Float64, ...]
    stepped: tuple[Float64, ...]

    def p95_below(self, finer: Sequence[float]) -> float:
        """Return what the p95 is where the cells of the axes are so many times as wide."""
        vector = self.offset + sum(q * q * e for q, e in zip(finer, self.bent, strict=True))
        steps = sum(q * e for q, e in zip(finer, self.stepped, strict=True))
        return p95_below(np.sqrt(np.sum(vector * vector, axis=-1)) + steps)


class Judged:
    """Places at which tables are judged: where they are read, what is true there, and how it is seen.

    read : where the table is looked up. truth : (n, m, 3). bare : (n, m, 3), of the surface without film,
    with which the film of `strength` is mixed.
    """

    def __init__(
        self, values: TableValues, read: Places, truth: Float64, bare: Float64, strength: float
    ) -> None:
        self._values, self._read, self._strength = values, read, strength
        self._truth = truth
        self._bare = (1.0 - strength) * bare
        self.at_best = values(read)
        self._metric: Float64 | None = None

    def _seen(self, film: Float64) -> Float64:
        return self._bare + self._strength * film

    def delta_e(self, film: Float64, other: Float64 | None = None) -> Float64:
        """Return CIEDE2000 (n, m) between the surface under `film` and under the truth, or the other film."""
        found = delta_e_2000(self._seen(film), self._seen(self._truth if other is None else other))
        return np.asarray(found, np.float64)

    def rounding(self) -> float:
        """Return what the p95 of half precision's rounding lies below."""
        return p95_below(self.delta_e(self.at_best.astype(np.float16).astype(np.float64), self.at_best))

    def axis_errors(self, axes: Sequence[TableAxis]) -> AxisErrors:
        """Measure each axis alone."""
        metric = self._metric = self._lengths() if self._metric is None else self._metric

        def lengths(change: Float64) -> Float64:
            return np.asarray(np.einsum("nij,nj->ni", metric, change.reshape(-1, 3)))

        bent, stepped = [], []
        for axis in axes:
            low, high, t = _cell(axis, self._read)
            below, above = (self._values(self._read.moved({axis.quantity: each})) for each in (low, high))
            t = t[:, None] if axis.quantity == "base_f0" else t[..., None]
            bent.append(lengths(below + t * (above - below) - self.at_best))
            stepped.append(_FILTER_STEP * np.sqrt(np.sum(lengths(above - below) ** 2, axis=-1)))
        return AxisErrors(lengths(self.at_best - self._truth), tuple(bent), tuple(stepped))

    def whole_errors(self, axes: Sequence[TableAxis], dtype: str) -> Float64:
        """Return the CIEDE2000 (n, m) of a table with these axes and texels."""
        cells = {axis.quantity: _cell(axis, self._read) for axis in axes}
        film = np.zeros_like(self._truth)
        steps = {quantity: np.zeros_like(self._truth) for quantity in cells}
        for ends in product((0, 1), repeat=len(axes)):
            chosen: dict[Quantity, int] = dict(zip(cells, ends, strict=True))
            corner = self._values(self._read.moved({q: cells[q][end] for q, end in chosen.items()}))
            corner = corner.astype(dtype).astype(np.float64)
            weights = {q: _wide(q, cells[q][2] if end else 1.0 - cells[q][2]) for q, end in chosen.items()}
            film += math.prod(weights.values(), start=np.ones(1)) * corner
            for quantity, end in chosen.items():
                others = math.prod((w for q, w in weights.items() if q != quantity), start=np.ones(1))
                steps[quantity] += others * (corner if end else -corner)
        by_filter = sum(self.delta_e(film, film + _FILTER_STEP * step) for step in steps.values())
        return np.asarray(self.delta_e(film) + by_filter)

    def _lengths(self) -> Float64:
        """Return matrices (n, 3, 3) that turn small changes of the film into vectors as long as CIEDE2000."""
        film = self._truth.reshape(-1, 3)
        bare = np.broadcast_to(self._bare, self._truth.shape).reshape(-1, 3)
        seen = np.maximum(bare + self._strength * film, 0.0)
        step = 1e-5
        units = np.eye(3) * step
        pairs = [(i, j) for i in range(3) for j in range(i, 3)]
        squares = {
            (i, j): delta_e_2000(seen + units[i] + (units[j] if i != j else 0.0), seen) ** 2 for i, j in pairs
        }
        form = np.zeros((len(seen), 3, 3))
        for i, j in pairs:
            mixed = 0.5 * (squares[i, j] - squares[i, i] - squares[j, j])
            form[:, i, j] = form[:, j, i] = squares[i, i] if i == j else mixed
        size, axes = np.linalg.eigh(form)
        roots = np.sqrt(np.maximum(size, 0.0)) * (self._strength / step)
        return np.asarray(roots[:, :, None] * np.swapaxes(axes, 1, 2))


def _cell(axis: TableAxis, places: Places) -> tuple[Float64, Float64, Float64]:
    """Return the axis' values on either side of each place's, and how far it lies from the first."""
    place = axis_coordinate(axis, places.value(axis.quantity)) * (axis.nodes - 1)
    first = np.minimum(np.floor(place), axis.nodes - 2).astype(np.intp)
    values = axis_values(axis)
    return values[first], values[first + 1], place - first


def _wide(quantity: Quantity, weight: Float64) -> Float64:
    """Return weights as colours (n, m, 3) want them: of base_f0 by channel."""
    return weight[:, None] if quantity == "base_f0" else weight[..., None]
