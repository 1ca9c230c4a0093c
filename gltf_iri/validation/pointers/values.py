"""The values that an animation channel sets its property to, a block at a time."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from itertools import chain
from typing import TYPE_CHECKING

from gltf_iri.asset.formats import COMPONENT_BYTES, FLOAT, INTEGER_RANGES
from gltf_iri.validation.tables import value_of

if TYPE_CHECKING:
    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.pointers.target import Target

__all__ = ["values_key", "values_of"]

_COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

# Component types by their letters in struct.
_LETTERS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", FLOAT: "f"}

# Values that are unpacked at once: an animation of a gigabyte must not become ten.
_AT_ONCE = 1 << 16


def values_key(sampler: Entry, target: Target) -> tuple[object, ...]:
    """Return what `values_of` depends on: the same for two channels that take the same values."""
    return sampler.get("output"), value_of(sampler, "interpolation"), target.size * (target.length or 1)


def values_of(sampler: Entry, target: Target, asset: Asset) -> Iterator[tuple[float, ...]]:
    """Yield blocks of the values for `target`, tangents left out; nothing where they cannot be read.

    Vectors come component by component, in the order of the file.
    """
    output = asset.get("accessors", sampler.get("output"))
    if output is None or "sparse" in output.raw:
        return
    # A spline's keyframe is as many tangents, values and tangents as the property has numbers.
    own = target.size * (target.length or 1)
    keyframe = own * (3 if value_of(sampler, "interpolation") == "CUBICSPLINE" else 1)
    for block in _blocks(output, asset, keyframe):
        if keyframe == own:
            yield block
        else:
            starts = range(own, len(block), keyframe)
            yield tuple(chain.from_iterable(block[start : start + own] for start in starts))


def _blocks(accessor: Entry, asset: Asset, whole: int) -> Iterator[tuple[float, ...]]:
    """Yield all components of an accessor, in blocks of a multiple of `whole`."""
    size = _COMPONENTS.get(accessor.get("type", ""))
    component = accessor.get("componentType")
    index, count = accessor.get("bufferView"), accessor.get("count")
    view, described = asset.resources.view(index), asset.get("bufferViews", index)
    if size is None or component is None or count is None or view is None or described is None:
        return
    width = COMPONENT_BYTES[component]
    start, stride = value_of(accessor, "byteOffset"), described.get("byteStride", size * width)
    if start + stride * (count - 1) + size * width > len(view) or stride < size * width:
        return
    # A normalised component's greatest number means 1 (glTF 2.0, §3.11).
    divisor = INTEGER_RANGES[component][1] if accessor.get("normalized") and component != FLOAT else 1
    step = max(_AT_ONCE // whole, 1) * whole // size or 1
    for first in range(0, count, step):
        number = min(step, count - first)
        block = _unpacked(
            view, start + first * stride, _LETTERS[component], number, size, stride - size * width
        )
        yield block if divisor == 1 else tuple(max(value / divisor, -1.0) for value in block)


def _unpacked(
    view: memoryview, offset: int, letter: str, count: int, size: int, gap: int
) -> tuple[float, ...]:
    if gap == 0:
        return struct.unpack_from(f"<{count * size}{letter}", view, offset)
    # The last element has no gap behind it.
    return struct.unpack_from("<" + f"{size}{letter}{gap}x" * (count - 1) + f"{size}{letter}", view, offset)
