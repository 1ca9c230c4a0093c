"""Arrays in pieces that stay in the processor's cache while several operations run over them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["blocks", "part", "scratch"]

# Ten float64 arrays of this length are a megabyte: second-level caches hold them, and numpy's calls pay.
_BLOCK = 16_384
_LINE = 8  # numbers in a line of the cache, 64 bytes


def blocks(shape: tuple[int, ...], limit: int = _BLOCK) -> Iterator[tuple[slice, ...]]:
    """Yield slices, one for each leading axis, that tile `shape` in pieces of about `limit` elements."""
    if np.prod(shape, dtype=np.intp) <= limit:
        yield ()
        return
    inner = int(np.prod(shape[1:], dtype=np.intp))
    step = max(1, limit // inner)
    for start in range(0, shape[0], step):
        for rest in blocks(shape[1:], limit) if inner > limit else ((),):
            yield (slice(start, start + step), *rest)


def scratch(count: int, size: int) -> NDArray[np.float64]:
    """Return zeros (count, size), of which each row begins on a line of the cache.

    Elsewhere vector instructions read and write across two lines: a product of arrays takes twice as long.
    """
    stride = -(-size // _LINE) * _LINE
    memory = np.zeros(count * stride + _LINE)
    start = -(memory.__array_interface__["data"][0] // memory.itemsize) % _LINE
    return memory[start : start + count * stride].reshape(count, stride)[:, :size]


def part(table: NDArray[Any], piece: tuple[slice, ...], axes: int) -> NDArray[Any]:
    """Return from `table` what a piece of an array of `axes` axes needs.

    The table's first axis counts values, and stays whole; the others broadcast to the array.
    """
    shape = (1,) * (axes + 1 - table.ndim) + table.shape[1:]
    chosen = (s if n != 1 else slice(None) for s, n in zip(piece, shape, strict=False))
    return table.reshape(table.shape[:1] + shape)[:, *chosen]
