"""Accessors to arrays (glTF 2.0 §3.6): types, strides, matrix padding, sparse values, normalisation.

Every extent is compared with the bytes that are there before an array is made.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.formats import FLOAT, TYPE_SHAPE, UNSIGNED_INT, column_bytes, used_bytes
from gltf_iri.asset.guard import Budget
from gltf_iri.asset.limits import MAX_BUFFERLESS_COUNT
from gltf_iri.errors import AssetError

__all__ = ["BufferView", "Views", "read_accessor"]

# glTF stores little-endian (§3.6.1), whatever the machine.
_DTYPES: Final[Mapping[int, str]] = {
    5120: "<i1",
    5121: "<u1",
    5122: "<i2",
    5123: "<u2",
    5125: "<u4",
    5126: "<f4",
}


@dataclass(frozen=True, slots=True)
class BufferView:
    """A slice of a buffer; `stride` None means that elements follow each other without gaps."""

    data: memoryview
    stride: int | None


# Index of a buffer view and pointer of who asks, to its bytes.
Views = Callable[[int, str], BufferView]


@dataclass(frozen=True, slots=True)
class _Layout:
    """How one element lies in memory; a vector is a matrix of one column."""

    dtype: np.dtype[Any]
    columns: int
    rows: int

    @property
    def column_bytes(self) -> int:
        return column_bytes(self.columns, self.rows, self.dtype.itemsize)

    @property
    def element_bytes(self) -> int:
        """Distance of tightly packed elements."""
        return self.columns * self.column_bytes

    @property
    def used_bytes(self) -> int:
        """Extent of the last element: the padding of its last column need not be there."""
        return used_bytes(self.columns, self.rows, self.dtype.itemsize)


def read_accessor(
    accessor: Mapping[str, Any], pointer: str, views: Views, budget: Budget
) -> NDArray[np.generic]:
    """Decode one accessor of checked JSON.

    Returns (count, components) — (count, n, n) with [row, column] for matrices — as float32 for FLOAT and
    normalised integers, else in the native integer type. Raises AssetError where the bytes do not suffice, a
    sparse index is out of order or range, or a float is not finite.
    """
    component = accessor["componentType"]
    columns, rows = TYPE_SHAPE[accessor["type"]]
    layout = _Layout(np.dtype(_DTYPES[component]), columns, rows)
    count = accessor["count"]
    is_normalized = accessor.get("normalized", False)
    if is_normalized and component == UNSIGNED_INT:
        raise AssetError("32-bit integers cannot be normalised", pointer=pointer)

    if "bufferView" in accessor:
        view = views(accessor["bufferView"], pointer)
        values = _elements(view, accessor.get("byteOffset", 0), count, layout, pointer)
    elif count > MAX_BUFFERLESS_COUNT:
        raise AssetError(
            f"{count} elements without a buffer view are more than the {MAX_BUFFERLESS_COUNT} that are read",
            pointer=f"{pointer}/count",
        )
    else:
        values = np.broadcast_to(np.zeros((), layout.dtype), (count, columns, rows))

    size = 4 if is_normalized else layout.dtype.itemsize
    budget.spend_on_accessor(count * columns * rows * size, pointer)
    values = values.astype(
        layout.dtype.newbyteorder("="), order="C"
    )  # a copy: what the file holds stays as it is
    if "sparse" in accessor:
        _apply_sparse(values, accessor["sparse"], layout, f"{pointer}/sparse", views)
    if component == FLOAT:
        _refuse_non_finite(values, pointer)
    elif is_normalized:
        values = _normalised(values)
    shaped = values.reshape(count, rows) if columns == 1 else np.ascontiguousarray(values.swapaxes(1, 2))
    shaped.setflags(write=False)
    return shaped


def _elements(
    view: BufferView, offset: int, count: int, layout: _Layout, pointer: str
) -> NDArray[np.generic]:
    """View `count` elements as (count, columns, rows) without copying."""
    stride = layout.element_bytes if view.stride is None else view.stride
    if stride < layout.used_bytes:
        raise AssetError(
            f"elements of {layout.used_bytes} bytes overlap in a buffer view with a stride of {stride}",
            pointer=pointer,
        )
    needed = offset + stride * (count - 1) + layout.used_bytes
    if needed > len(view.data):
        raise AssetError(
            f"its {count} elements need {needed} bytes of the buffer view, which has {len(view.data)}",
            pointer=pointer,
        )
    return np.ndarray(
        (count, layout.columns, layout.rows),
        layout.dtype,
        view.data,
        offset,
        (stride, layout.column_bytes, layout.dtype.itemsize),
    )


def _apply_sparse(
    values: NDArray[np.generic], sparse: Mapping[str, Any], layout: _Layout, pointer: str, views: Views
) -> None:
    """Replace the elements that the sparse part lists (§3.6.2.3)."""
    count = sparse["count"]
    if count > len(values):
        raise AssetError(f"{count} replacements for {len(values)} elements", pointer=f"{pointer}/count")
    indices_at, values_at = f"{pointer}/indices", f"{pointer}/values"
    index_layout = _Layout(np.dtype(_DTYPES[sparse["indices"]["componentType"]]), 1, 1)
    raw = _packed(sparse["indices"], count, index_layout, indices_at, views)
    indices = raw.reshape(count).astype(np.int64)
    if np.any(np.diff(indices) <= 0):
        position = int(np.argmax(np.diff(indices) <= 0)) + 1
        raise AssetError(
            f"index {indices[position]} at position {position} is not above the one before",
            pointer=indices_at,
        )
    if indices[-1] >= len(values):
        raise AssetError(f"index {indices[-1]} is beyond the {len(values)} elements", pointer=indices_at)
    values[indices] = _packed(sparse["values"], count, layout, values_at, views)


def _packed(
    part: Mapping[str, Any], count: int, layout: _Layout, pointer: str, views: Views
) -> NDArray[np.generic]:
    view = views(part["bufferView"], pointer)
    if view.stride is not None:
        raise AssetError("the buffer view of a sparse part must not have a byteStride", pointer=pointer)
    return _elements(view, part.get("byteOffset", 0), count, layout, pointer)


def _normalised(values: NDArray[Any]) -> NDArray[np.float32]:
    """§3.11: f = c / (2ᵇ − 1) for unsigned, f = max(c / (2ᵇ⁻¹ − 1), −1) for signed integers of b bits."""
    largest = np.float32(np.iinfo(values.dtype).max)
    # One rounding: integers of up to 16 bits are exact in float32.
    scaled: NDArray[np.float32] = np.maximum(values.astype(np.float32) / largest, np.float32(-1.0))
    return scaled


def _refuse_non_finite(values: NDArray[Any], pointer: str) -> None:
    finite = np.isfinite(values)
    if not finite.all():
        element, column, row = (int(i) for i in np.argwhere(~finite)[0])
        value = values[element, column, row]
        raise AssetError(f"element {element} has a component that is {value}", pointer=pointer)
