"""Arrays in pieces that stay in the processor's cache while several operations run over them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["blocks", "part"]

# Ten float64 arrays of this length are a megabyte: second-level caches hold them, and numpy's calls pay.
_BLOCK = 16_384


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


def part(table: NDArray[Any], piece: tuple[slice, ...], axes: int) -> NDArray[Any]:
    """Return from `table` what a piece of an array of `axes` axes needs.

    The table's first axis counts values, and stays whole; the others broadcast to the array.
    """
    shape = (1,) * (axes + 1 - table.ndim) + table.shape[1:]
    chosen = (s if n != 1 else slice(None) for s, n in zip(piece, shape, strict=False))
    return table.reshape(table.shape[:1] + shape)[:, *chosen]
