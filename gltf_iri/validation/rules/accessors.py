"""Accessors: what they may hold, and whether they fit the buffer views that they read."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.formats import COMPONENT_BYTES, FLOAT, TYPE_SHAPE, UNSIGNED_INT, column_bytes, used_bytes
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.accessor_bounds import bounds
from gltf_iri.validation.rules.registry import Rules
from gltf_iri.validation.tables import sound_value_of

__all__ = ["RULES", "element_bytes", "names_view", "sparse_parts"]

# §3.6.2.4, in bytes.
_MATRIX_ALIGNMENT = 4


def element_bytes(accessor: Entry) -> int:
    """Return the bytes of one element, without padding behind it; 0 where the type is none."""
    columns, rows = TYPE_SHAPE.get(accessor.get("type", ""), (0, 0))
    return used_bytes(columns, rows, COMPONENT_BYTES.get(accessor.get("componentType", 0), 0))


def names_view(accessor: Entry) -> bool:
    """Whether the file gives the accessor a buffer view, be it one that does not exist."""
    index = accessor.raw.get("bufferView")
    return isinstance(index, int) and index >= 0


def sparse_parts(accessor: Entry, asset: Asset) -> Iterator[tuple[Entry, Entry]]:
    """Yield the indices and values of an accessor's sparse elements, each with the buffer view it reads."""
    sparse = accessor.get("sparse")
    if sparse is None or not _is_readable(accessor) or not {"count", "indices", "values"} <= sparse.keys():
        return
    for key in ("indices", "values"):
        view = asset.get("bufferViews", sparse[key].get("bufferView"))
        if view is not None:
            yield sparse[key], view


def _is_readable(accessor: Entry) -> bool:
    return "componentType" in accessor and "count" in accessor and isinstance(accessor.raw.get("type"), str)


def _normalized(accessor: Entry, asset: Asset) -> Iterator[Issue]:
    if accessor.get("normalized") and accessor.get("componentType") in (FLOAT, UNSIGNED_INT):
        yield issue("ACCESSOR_NORMALIZED_INVALID", accessor.at("normalized"))


def _matrix_alignment(accessor: Entry, asset: Asset) -> Iterator[Issue]:
    columns, _ = TYPE_SHAPE.get(accessor.get("type", ""), (1, 1))
    if columns > 1 and accessor.get("byteOffset", 0) % _MATRIX_ALIGNMENT and names_view(accessor):
        yield issue("ACCESSOR_MATRIX_ALIGNMENT", accessor.at("byteOffset"))


def _elements_in_view(accessor: Entry, asset: Asset) -> Iterator[Issue]:
    view = asset.get("bufferViews", accessor.get("bufferView"))
    if view is None or not _is_readable(accessor):
        return
    columns, rows = TYPE_SHAPE.get(accessor.get("type", ""), (0, 0))
    size = COMPONENT_BYTES[accessor["componentType"]]
    used, packed = used_bytes(columns, rows, size), columns * column_bytes(columns, rows, size)
    stride = view.get("byteStride")
    if stride is not None and stride < used:
        yield issue("ACCESSOR_SMALL_BYTESTRIDE", accessor.pointer, stride=stride, size=used)
    length = (packed if stride is None else stride) * (accessor["count"] - 1) + used
    yield from _place(accessor, view, size, length)


def _sparse_elements(accessor: Entry, asset: Asset) -> Iterator[Issue]:
    sparse = accessor.get("sparse")
    if sparse is None or not _is_readable(accessor) or not {"count", "indices", "values"} <= sparse.keys():
        return
    count, total = sparse["count"], accessor["count"]
    if count > total:
        yield issue("ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", sparse.at("count"), count=count, total=total)
    columns, rows = TYPE_SHAPE.get(accessor.get("type", ""), (0, 0))
    for part, view in sparse_parts(accessor, asset):
        if part is sparse["indices"]:
            size = COMPONENT_BYTES.get(part.get("componentType", 0), 0)
            used = packed = size
        else:
            size = COMPONENT_BYTES[accessor["componentType"]]
            used, packed = used_bytes(columns, rows, size), columns * column_bytes(columns, rows, size)
        if size:
            yield from _place(part, view, size, packed * (count - 1) + used)


def _place(reader: Entry, view: Entry, size: int, length: int) -> Iterator[Issue]:
    """Tell of components off their alignment, and of `length` bytes that end beyond the view."""
    start, view_start = sound_value_of(reader, "byteOffset"), sound_value_of(view, "byteOffset")
    if start is None:
        return
    if start % size:
        yield issue("ACCESSOR_OFFSET_ALIGNMENT", reader.at("byteOffset"), start=start, size=size)
    if view_start is None:
        return
    total, available = start + view_start, view.get("byteLength", -1)
    if total % size:
        yield issue("ACCESSOR_TOTAL_OFFSET_ALIGNMENT", reader.pointer, start=total, size=size)
    if start + length > available:
        pointer = reader.at("byteOffset") if start > available else reader.pointer
        view_index = reader["bufferView"]
        yield issue(
            "ACCESSOR_TOO_LONG", pointer, start=start, length=length, view=view_index, available=available
        )


RULES: Rules = {
    "accessor": (_normalized, bounds, _matrix_alignment, _elements_in_view, _sparse_elements),
}
