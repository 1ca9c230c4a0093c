"""Every accessor: numbers that are none, sparse indices out of order, and what min and max say."""

from __future__ import annotations

from array import array
from itertools import repeat
from math import inf
from operator import gt, lt
from typing import TYPE_CHECKING, Any

from gltf_iri.asset.formats import FLOAT
from gltf_iri.validation.codes import issue
from gltf_iri.validation.data.access import blocks, elements_of, sparse_indices

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.data.elements import Elements
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue

__all__ = ["accessors_hold_what_they_say", "sparse_indices_increase"]

# The highest byte of a float32 that is infinite, no number, or at least 2^127: sign, and seven bits of
# exponent (IEEE 754). Searching for it costs a thousandth of looking at numbers.
_SUSPECT_BYTES = (b"\x7f", b"\xff")

# Of each bound: the code where the data's own is another, and that where elements lie beyond it.
_CODES = {
    "min": ("ACCESSOR_MIN_MISMATCH", "ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND"),
    "max": ("ACCESSOR_MAX_MISMATCH", "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND"),
}


def sparse_indices_increase(accessor: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of sparse indices that do not increase, or are beyond the accessor."""
    count = accessor.get("count")
    indices, increasing = sparse_indices(accessor, asset)
    if count is None or indices is None or increasing == len(indices):
        return
    pointer, previous = accessor.at("sparse"), -1
    for position, index in enumerate(indices):
        if index <= previous:
            yield issue(
                "ACCESSOR_SPARSE_INDICES_NON_INCREASING",
                pointer,
                index=position,
                value=index,
                previous=previous,
            )
        if index >= count:
            yield issue("ACCESSOR_SPARSE_INDEX_OOB", pointer, index=position, value=index, count=count)
        previous = index


def accessors_hold_what_they_say(accessor: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of floats that are none, and of a min or max that is not the data's."""
    elements = elements_of(accessor, asset)
    if elements is None:
        return
    has_bounds = "min" in accessor or "max" in accessor
    if elements.component != FLOAT and not has_bounds:
        return
    low: list[Any] = []
    high: list[Any] = []
    for first in blocks(elements, asset, accessor.pointer):
        is_suspect = elements.component == FLOAT and _is_suspect(elements, first)
        if not is_suspect and not has_bounds:
            continue
        columns = elements.columns(first)
        if is_suspect:
            yield from _invalid_floats(accessor, columns, first)
        if has_bounds:
            _widen(low, high, columns, is_suspect=is_suspect)
    if low:
        yield from _compare(accessor, asset, elements, low, high)


def _is_suspect(elements: Elements, first: int) -> bool:
    """Whether the block may hold an infinity or NaN."""
    raw = elements.raw(first)
    if raw is None:
        return True
    data = bytes(raw)
    if elements.stride == elements.width * elements.size:
        tops = [data[3::4]]
    else:
        tops = [data[4 * place + 3 :: elements.stride] for place in elements.places]
    return any(byte in top for byte in _SUSPECT_BYTES for top in tops)


def _invalid_floats(accessor: Entry, columns: list[list[float]], first: int) -> Iterator[Issue]:
    width = len(columns)
    for element, values in enumerate(zip(*columns, strict=True), first):
        for place, value in enumerate(values):
            if value - value != 0.0:  # of an infinity or NaN, the difference is NaN
                index = element * width + place
                yield issue("ACCESSOR_INVALID_FLOAT", accessor.pointer, index=index, value=value)


def _widen(low: list[Any], high: list[Any], columns: list[list[Any]], *, is_suspect: bool) -> None:
    """Let `low` and `high` take in a block; a NaN counts where it is the first value of all, else not."""
    if not low:
        low.extend(column[0] for column in columns)
        high.extend(low)
    for place, column in enumerate(columns):
        if is_suspect:
            column = [value for value in column if value == value]  # NaN is not itself
        if column and low[place] == low[place]:
            low[place] = min(low[place], min(column))
            high[place] = max(high[place], max(column))


def _compare(
    accessor: Entry, asset: Asset, elements: Elements, low: list[Any], high: list[Any]
) -> Iterator[Issue]:
    beyond: list[tuple[str, str, int, Any]] = []
    for key, actual in (("min", low), ("max", high)):
        mismatch, out_of_bound = _CODES[key]
        for place, stated in enumerate(accessor.get(key, ())):
            declared = _single(stated) if elements.component == FLOAT else stated
            if actual[place] != declared:
                pointer = accessor.at(key, place)
                yield issue(mismatch, pointer, declared=declared, actual=actual[place])
                # Where the first value is NaN, so is what was found, and those behind it may be beyond.
                if not (actual[place] > declared if key == "min" else actual[place] < declared):
                    beyond.append((out_of_bound, key, place, declared))
    counts = [0] * len(beyond)
    for first in blocks(elements, asset, accessor.pointer) if beyond else ():
        columns = elements.columns(first)
        for number, (_, key, place, bound) in enumerate(beyond):
            compare = gt if key == "min" else lt
            counts[number] += sum(map(compare, repeat(bound), columns[place]))
    for count, (code, key, place, bound) in zip(counts, beyond, strict=True):
        if count:
            yield issue(code, accessor.at(key, place), count=count, bound=bound)


def _single(value: float) -> float:
    """Round a bound to float32, which the data is (§3.6.2.5)."""
    try:
        return array("f", (value,))[0]
    except OverflowError:  # an integer of more than 308 digits
        return inf if value > 0 else -inf
