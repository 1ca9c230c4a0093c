"""Rows × wavelengths, worked through in tiles that fit a core's cache."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.blocks import scratch

__all__ = ["Grid", "Tile"]

Float64 = NDArray[np.float64]
Rows = slice | NDArray[np.intp]

_TILE: Final = 8192  # numbers in one temporary: some ten of them share a core's second cache
_LONGEST_SIDE: Final = 12288  # of a tile that is one line: to cut it in two costs more than the cache


@dataclass(frozen=True, slots=True)
class Tile:
    """Some rows at some wavelengths; arrays of a tile are rows × wavelengths, or turned the other way."""

    rows: Rows
    columns: slice
    is_turned: bool
    wavelength_nm: Float64  # 2-D, broadcasts with `of_rows`
    scratch: tuple[
        Float64, ...
    ]  # arrays of the tile's shape for what comes between, overwritten by the next tile

    def of_rows(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return what belongs to the tile's rows of an array (rows,), or (1,) for all, to broadcast in it."""
        mine = values if values.shape == (1,) else values[self.rows]
        return mine[None, :] if self.is_turned else mine[:, None]

    def put(self, values: Float64, into: Float64) -> None:
        """Write the tile's `values` into an array of `Grid.zeros`."""
        into[self.rows, self.columns] = values.T if self.is_turned else values


class Grid:
    """Arguments that broadcast, as rows × wavelengths: the last axis, where nothing else varies along it.

    Elsewhere every element is a row of one wavelength. `columns` holds the arguments as (rows,) or (1,).
    """

    def __init__(
        self, wavelength_nm: ArrayLike, arguments: Sequence[ArrayLike], scratch_arrays: int = 0
    ) -> None:
        wavelength = np.asarray(wavelength_nm, dtype=np.float64)
        arrays = [np.asarray(a) for a in arguments]
        self._shape = np.broadcast(wavelength, *arrays).shape
        has_axis = self._shape != () and all(a.shape[-1:] in ((), (1,)) for a in arrays)
        rows_shape = self._shape[:-1] if has_axis else self._shape
        self._width = self._shape[-1] if has_axis else 1
        self.count = math.prod(rows_shape)
        self.columns = [_column(a[..., 0] if has_axis and a.ndim > 0 else a, rows_shape) for a in arrays]
        is_shared = has_axis and wavelength.size == wavelength.shape[-1]
        spread = wavelength if is_shared else np.broadcast_to(wavelength, self._shape)
        self._wavelength_nm = spread.reshape(
            1 if is_shared else self.count, -1 if spread.size else self._width
        )
        # The longer axis runs innermost, so that one operation of numpy has many numbers.
        self._is_turned = is_shared and self.count > self._width
        self._scratch_arrays = scratch_arrays

    def zeros(self, *, is_turned: bool = True) -> Float64:
        """Return an array for a result, rows × wavelengths, whose memory lies as tiles do if `is_turned`."""
        return np.zeros((self.count, self._width), order="F" if self._is_turned and is_turned else "C")

    def shaped(self, values: Float64) -> Float64:
        """Return rows × wavelengths in the arguments' broadcast shape."""
        return values.reshape(self._shape)

    def rows_where(self, mask: NDArray[np.bool_]) -> Rows:
        """Return the rows where `mask` (rows,) or (1,) holds."""
        if mask.all():
            return slice(0, self.count)
        return np.flatnonzero(np.broadcast_to(mask, (self.count,))) if mask.any() else slice(0, 0)

    def table(self, values: Sequence[NDArray[Any]], rows: Rows) -> Float64:
        """Return (values, rows) of arrays (count,), or (1,) for all."""
        table = np.zeros((len(values), rows.stop if isinstance(rows, slice) else len(rows)))
        for line, each in zip(table, values, strict=True):
            line[:] = each if each.shape == (1,) else each[rows]
        return table

    def wavelengths_of(self, rows: Rows) -> Float64:
        """Return the wavelengths (1 or rows, k), one row where all rows share them."""
        return self._wavelength_nm if len(self._wavelength_nm) == 1 else self._wavelength_nm[rows]

    def tiles(self, rows: Rows) -> Iterator[Tile]:
        """Yield tiles that together cover `rows` at every wavelength."""
        count = rows.stop if isinstance(rows, slice) else len(rows)
        if count * self._width == 0:
            return
        inner = count if self._is_turned else self._width
        long_side = -(-inner // -(-inner // _LONGEST_SIDE))  # even shares, rounded up
        short_side = max(1, _TILE // long_side)
        row_step, column_step = (long_side, short_side) if self._is_turned else (short_side, long_side)
        size = min(row_step, count) * min(column_step, self._width)
        memory = scratch(self._scratch_arrays, size)
        for row in range(0, count, row_step):
            part = slice(row, min(row + row_step, count))
            chosen = part if isinstance(rows, slice) else rows[part]
            for column in range(0, self._width, column_step):
                columns = slice(column, min(column + column_step, self._width))
                wavelength = self._wavelength_nm[:, columns]
                if len(wavelength) > 1:
                    wavelength = wavelength[chosen]
                shape = part.stop - part.start, columns.stop - columns.start
                if self._is_turned:
                    wavelength, shape = wavelength.T, shape[::-1]
                lent = tuple(each[: shape[0] * shape[1]].reshape(shape) for each in memory)
                yield Tile(chosen, columns, self._is_turned, wavelength, lent)


def _column(values: NDArray[Any], rows_shape: tuple[int, ...]) -> NDArray[Any]:
    if values.size == 1:
        return values.reshape(1)
    return (values if values.shape == rows_shape else np.broadcast_to(values, rows_shape)).reshape(-1)
