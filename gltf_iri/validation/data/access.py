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

__all__ = ["blocks", "elements_of", "increasing", "sparse_indices"]

# Elements at a time where sparse indices are compared with their neighbours.
_STEP = 1 << 16

# How many numbers are looked at: each byte of the buffers so often, as if it were a number of its own, and
# some that no byte stands for. Sound files have each float looked at twice; the rest is room for accessors
# that many primitives share. Together they take a second for a hostile file of some kilobytes.
_NUMBERS_PER_BYTE = 8
_UNVOUCHED_NUMBERS = 1 << 22


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
    resources = asset.resources
    numbers = elements.count * elements.width
    resources.numbers += numbers
    allowed = _UNVOUCHED_NUMBERS + _NUMBERS_PER_BYTE * resources.buffer_bytes
    if resources.numbers <= allowed:
        return elements.starts()
    if resources.numbers - numbers <= allowed:
        reason = f"{allowed} are the most for {resources.buffer_bytes} bytes of buffers"
        asset.collector.add(issue("IRI_DATA_NOT_CHECKED", pointer, reason=reason))
        resources.numbers = allowed + 1
    return range(0)


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
        reason = f"of an accessor without buffer view, {MAX_BUFFERLESS_COUNT} elements are the most"
        asset.collector.add(issue("IRI_DATA_NOT_CHECKED", accessor.at("count"), reason=reason))
        return None
    if sparse is not None:
        if sparse["count"] > elements.count:
            return None
        indices = sparse_indices(accessor, asset)
        values = _packed(sparse["values"], sparse["count"], elements, asset)
        if indices is None or values is None:
            return None
        elements.replace(indices, increasing(indices, elements.count), values)
    return elements


def sparse_indices(accessor: Entry, asset: Asset) -> Any:
    """Return the numbers of the elements that an accessor's sparse part replaces; None where unreadable."""
    sparse = accessor.get("sparse")
    if sparse is None or not {"count", "indices", "values"} <= sparse.keys():
        return None
    if "componentType" not in sparse["indices"]:
        return None
    shape = Elements("SCALAR", sparse["indices"]["componentType"], sparse["count"])
    return _packed(sparse["indices"], sparse["count"], shape, asset)


def increasing(indices: Any, count: int) -> int:
    """Return how many indices from the first on increase and are below `count`: all, in a sound file."""
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
