"""Indices of primitives: within the vertices, without restarts, and triangles with an area."""

from __future__ import annotations

from operator import eq
from typing import TYPE_CHECKING

from gltf_iri.asset.formats import INDEX_FORMATS, INTEGER_RANGES
from gltf_iri.validation.codes import issue
from gltf_iri.validation.data.access import blocks, elements_of
from gltf_iri.validation.rules.primitives import accessor_format
from gltf_iri.validation.tables import value_of

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.data.elements import Elements
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue

__all__ = ["count_of_vertices", "indices_name_vertices"]

_TRIANGLES = 4  # the drawing mode of triangle lists (glTF 2.0, §5.24.4)


def indices_name_vertices(primitive: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of indices beyond the vertices, of restarts, and of triangles that name a vertex twice."""
    accessor = asset.get("accessors", primitive.get("indices"))
    if accessor is None or accessor_format(accessor) not in INDEX_FORMATS:
        return
    elements = elements_of(accessor, asset)
    if elements is None:
        return
    is_list = value_of(primitive, "mode") == _TRIANGLES  # also where the mode is none
    largest, degenerate = _summary(accessor, elements, asset, is_list=is_list)
    vertices = count_of_vertices(primitive, asset)
    restart = INTEGER_RANGES[elements.component][1]
    if largest >= vertices or largest == restart:
        yield from _faulty(primitive, elements, asset, vertices, restart)
    if degenerate:
        yield issue(
            "ACCESSOR_INDEX_TRIANGLE_DEGENERATE",
            primitive.at("indices"),
            count=degenerate,
            total=elements.count // 3,
        )


def count_of_vertices(primitive: Entry, asset: Asset) -> int:
    """Return the count of the first attribute that has one: others with another were told of."""
    for index in primitive.get("attributes", {}).values():
        accessor = asset.get("accessors", index)
        if accessor is not None and "count" in accessor:
            count: int = accessor["count"]
            return count
    return 0


def _summary(accessor: Entry, elements: Elements, asset: Asset, *, is_list: bool) -> tuple[int, int]:
    """Return the largest index and, of a triangle list, how many triangles name a vertex twice."""
    found = asset.resources.found
    name = ("triangles" if is_list else "indices", accessor)
    if name not in found:
        largest = degenerate = 0
        for first in blocks(elements, asset, accessor.pointer):
            column = elements.columns(first)[0]
            largest = max(largest, max(column))
            if is_list:
                degenerate += _degenerate(column)
        found[name] = (largest, degenerate)
    summary: tuple[int, int] = found[name]
    return summary


def _degenerate(column: list[int]) -> int:
    whole = len(column) // 3 * 3
    first, second, third = column[0:whole:3], column[1:whole:3], column[2:whole:3]
    if any(map(eq, first, second)) or any(map(eq, second, third)) or any(map(eq, third, first)):
        return sum(a == b or b == c or c == a for a, b, c in zip(first, second, third, strict=True))
    return 0


def _faulty(
    primitive: Entry, elements: Elements, asset: Asset, vertices: int, restart: int
) -> Iterator[Issue]:
    pointer = primitive.at("indices")
    for first in blocks(elements, asset, pointer):
        column = elements.columns(first)[0]
        if max(column) < min(vertices, restart):
            continue
        for position, index in enumerate(column, first):
            if index >= vertices:
                yield issue("ACCESSOR_INDEX_OOB", pointer, index=position, value=index, last=vertices - 1)
            if index == restart:
                yield issue("ACCESSOR_INDEX_PRIMITIVE_RESTART", pointer, index=position, value=index)
