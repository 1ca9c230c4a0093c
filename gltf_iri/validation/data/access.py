"""From an accessor to its elements, where everything that says where they lie is sound."""

from __future__ import annotations

from operator import lt
from typing import TYPE_CHECKING, Any

from gltf_iri.asset.limits import MAX_BUFFERLESS_COUNT
from gltf_iri.validation.codes import issue
from gltf_iri.validation.data.codes import DATA_CODES as _DATA_CODES  # noqa: F401  # makes them known
from gltf_iri.validation.data.elements import Elements, cast
from gltf_iri.validation.tables import sound_value_of

if TYPE_CHECKING:
    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry

__all__ = ["blocks", "elements_of", "sparse_indices", "tell_unread"]

# Elements at a time where sparse indices are compared with their neighbours.
_STEP = 1 << 16

# How many numbers are looked at: each byte of the buffers so often, as if it were a number of its own, and
# some that no byte stands for. Sound files have each float looked at twice; the rest is room for accessors
# that many primitives share. Together they take a second for a hostile file of some kilobytes.
_NUMBERS_PER_BYTE = 4
_UNVOUCHED_NUMBERS = 1 << 21


def elements_of(accessor: Entry | None, asset: Asset) -> Elements | None:
    """Return the accessor's elements; None where they cannot be read, of which its rules told.

    An accessor without buffer view and sparse elements has none that a file holds, and those that would go
    round and round in a few bytes are not read either.
    """
    if accessor is None:
        return None
    known = asset.resources.elements
    if accessor not in known:
        known[accessor] = _read(accessor, asset)
    return known[accessor]


def blocks(elements: Elements, asset: Asset, pointer: str) -> range:
    """Return the first element of every block; none where the file has had enough numbers looked at."""
    return elements.starts() if _spend(elements.count * elements.width, asset, pointer) else range(0)


def _spend(numbers: int, asset: Asset, pointer: str) -> bool:
    """Account for numbers that are about to be looked at; tell once that no more are."""
    resources = asset.resources
    allowed = _UNVOUCHED_NUMBERS + _NUMBERS_PER_BYTE * resources.buffer_bytes
    if resources.numbers <= allowed:
        resources.numbers += numbers
        if resources.numbers <= allowed:
            return True
        most = f"{allowed} are the most for {resources.buffer_bytes} bytes of buffers"
        tell_unread(asset, pointer, f"{most}; from here on nothing is looked at")
    return False


def tell_unread(asset: Asset, pointer: str, reason: str) -> None:
    """Tell that the numbers at `pointer` are not looked at, because so many are the most."""
    asset.collector.add(issue("IRI_DATA_NOT_CHECKED", pointer, reason=reason))


def _read(accessor: Entry, asset: Asset) -> Elements | None:
    if not {"type", "componentType", "count"} <= accessor.keys():
        return None
    elements = Elements(
        accessor["type"],
        accessor["componentType"],
        accessor["count"],
        is_normalized=accessor.get("normalized", False),
    )
    sparse = accessor.get("sparse")
    if sparse is not None and not {"count", "indices", "values"} <= sparse.keys():
        sparse = None  # its schema told; the elements below are there all the same
    view = asset.get("bufferViews", accessor.get("bufferView"))
    if view is not None:
        elements.base = _bytes_of(accessor, view, asset, elements)
        if elements.base is None:
            return None
    elif sparse is None:
        return None
    elif elements.count > MAX_BUFFERLESS_COUNT:
        most = f"of an accessor without buffer view, {MAX_BUFFERLESS_COUNT} elements are the most"
        tell_unread(asset, accessor.at("count"), most)
        return None
    if sparse is not None:
        if sparse["count"] > elements.count:
            return None
        indices, increasing = sparse_indices(accessor, asset)
        values = _packed(sparse["values"], sparse["count"], elements, asset)
        if indices is None or values is None:
            return None
        elements.replace(indices, increasing, values)
    return elements


def sparse_indices(accessor: Entry, asset: Asset) -> tuple[Any, int]:
    """Return the numbers of the elements that an accessor replaces, and how many of them from the first on
    increase and are such numbers; None and 0 where they cannot be read.
    """
    found = asset.resources.found
    name = ("sparse", accessor)
    if name not in found:
        indices = _sparse_indices(accessor, asset)
        found[name] = (indices, 0 if indices is None else _increasing(indices, accessor.get("count", 0)))
    known: tuple[Any, int] = found[name]
    return known


def _sparse_indices(accessor: Entry, asset: Asset) -> Any:
    sparse = accessor.get("sparse")
    if sparse is None or not {"count", "indices", "values"} <= sparse.keys():
        return None
    if "componentType" not in sparse["indices"]:
        return None
    shape = Elements("SCALAR", sparse["indices"]["componentType"], sparse["count"])
    indices = _packed(sparse["indices"], sparse["count"], shape, asset)
    return indices if indices is not None and _spend(len(indices), asset, sparse.pointer) else None


def _increasing(indices: Any, count: int) -> int:
    previous = -1
    for start in range(0, len(indices), _STEP):
        block = indices[start : start + _STEP].tolist()
        if block[0] <= previous or block[-1] >= count or not all(map(lt, block, block[1:])):
            for position, index in enumerate(block, start):
                if index <= previous or index >= count:
                    return position
                previous = index
        previous = block[-1]
    return len(indices)


def _packed(part: Entry, count: int, shape: Elements, asset: Asset) -> Any:
    """Return `count` elements of a sparse part, packed; None where they are not all there."""
    length = (count - 1) * shape.packed * shape.size + shape.used
    data = _place(part, asset, shape.size, length)
    return None if data is None else cast(data, shape.component)


def _bytes_of(accessor: Entry, view: Entry, asset: Asset, elements: Elements) -> memoryview | None:
    stride = view.get("byteStride", elements.stride)
    if stride < elements.used or stride % elements.size:
        return None
    elements.stride = stride
    return _place(accessor, asset, elements.size, (elements.count - 1) * stride + elements.used)


def _place(reader: Entry, asset: Asset, size: int, length: int) -> memoryview | None:
    """Return `length` bytes from where `reader` starts in its buffer view, aligned to `size`."""
    view = asset.get("bufferViews", reader.get("bufferView"))
    start = sound_value_of(reader, "byteOffset")
    if view is None or start is None:
        return None
    view_start, available = sound_value_of(view, "byteOffset"), view.get("byteLength", 0)
    if view_start is None or start % size or (start + view_start) % size or start + length > available:
        return None
    # Not the view's own bytes: a view that is too long may still hold these elements.
    data = asset.resources.buffer(view.get("buffer"))
    begin = view_start + start
    return data[begin : begin + length] if data is not None and begin + length <= len(data) else None
