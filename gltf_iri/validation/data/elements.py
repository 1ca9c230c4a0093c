"""The elements of an accessor as columns of Python numbers, a block at a time.

Nothing is held but the block at hand, so that a buffer of a gigabyte takes no more than its own bytes.
"""

from __future__ import annotations

import sys
from array import array
from bisect import bisect_left
from typing import Any

from gltf_iri.asset.formats import COMPONENT_BYTES, FLOAT, TYPE_SHAPE, column_bytes

__all__ = ["BLOCK", "Elements", "cast"]

# Elements at a time: lists of them stay in the processor's cache. Divisible by 3, so that no triangle is cut.
BLOCK = 12288

_CODES = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}


def cast(data: memoryview, component: int) -> Any:
    """Return packed little-endian bytes (glTF 2.0, §3.6.1) as a sequence of numbers."""
    if sys.byteorder == "little":
        return data.cast(_CODES[component])  # type: ignore[call-overload]
    swapped = array(_CODES[component], bytes(data))
    swapped.byteswap()
    return swapped


class Elements:
    """The elements of a readable accessor.

    count, component, is_normalized : as the accessor has them.
    size : bytes of a component.
    places : where an element's components lie, as distances from its start in components.
    packed : the distance of elements without a gap between them, in components.
    stride : the distance of elements in the buffer view, in bytes.
    base : the bytes from the first element to the last, or None where all are 0 but for sparse ones.
    """

    __slots__ = (
        *("_indices", "_replaced", "_values", "base", "component", "count", "is_normalized"),
        *("packed", "places", "size", "stride"),
    )

    def __init__(self, kind: str, component: int, count: int, *, is_normalized: bool = False) -> None:
        columns, rows = TYPE_SHAPE[kind]
        self.component = component
        self.count = count
        self.is_normalized = is_normalized
        self.size = COMPONENT_BYTES[component]
        column = column_bytes(columns, rows, self.size) // self.size
        self.places = tuple(column * place + row for place in range(columns) for row in range(rows))
        self.packed = column * columns
        self.stride = self.packed * self.size
        self.base: memoryview | None = None
        self._indices: Any = ()
        self._replaced = 0
        self._values: Any = ()

    @property
    def width(self) -> int:
        """How many components an element has."""
        return len(self.places)

    @property
    def used(self) -> int:
        """The extent of an element in bytes: the padding of its last column need not be there."""
        return (self.places[-1] + 1) * self.size

    def replace(self, indices: Any, count: int, values: Any) -> None:
        """Let the first `count` of `indices`, which increase, have `values`, packed with their padding."""
        self._indices = indices
        self._replaced = count
        self._values = values

    def starts(self) -> range:
        """Return the first element of every block."""
        return range(0, self.count, BLOCK)

    def raw(self, first: int) -> memoryview | None:
        """Return the block's bytes; None where sparse elements count beside them."""
        if self.base is None or (self._replaced and len(self._span(first))):
            return None
        last = min(first + BLOCK, self.count) - 1
        return self.base[first * self.stride : last * self.stride + self.used]

    def columns(self, first: int) -> list[list[Any]]:
        """Return the numbers of the block from `first` on, a list for each component."""
        last = min(first + BLOCK, self.count) - 1
        if self.base is None:
            zero = 0.0 if self.component == FLOAT else 0
            columns = [[zero] * (last - first + 1) for _ in self.places]
        else:
            numbers = cast(self.base[first * self.stride : last * self.stride + self.used], self.component)
            step = self.stride // self.size
            columns = [numbers[place::step].tolist() for place in self.places]
        span = self._span(first)
        if span:
            elements = [index - first for index in self._indices[span.start : span.stop].tolist()]
            for column, place in zip(columns, self.places, strict=True):
                start = span.start * self.packed + place
                values = self._values[start : span.stop * self.packed : self.packed].tolist()
                for element, value in zip(elements, values, strict=True):
                    column[element] = value
        return columns

    def _span(self, first: int) -> range:
        """Return the positions of those sparse indices that fall into the block."""
        start = bisect_left(self._indices, first, 0, self._replaced)
        return range(start, bisect_left(self._indices, first + BLOCK, start, self._replaced))
