"""Vertex attributes: normals and tangents of length 1, colours between 0 and 1."""

from __future__ import annotations

from math import hypot, sqrt
from typing import TYPE_CHECKING

from gltf_iri.asset.formats import ATTRIBUTE_FORMATS, FLOAT, QUANTIZED_ATTRIBUTE_FORMATS
from gltf_iri.validation.codes import issue
from gltf_iri.validation.data.access import blocks, elements_of
from gltf_iri.validation.data.normalised import columns_of
from gltf_iri.validation.rules.attributes import semantic_of
from gltf_iri.validation.rules.primitives import accessor_format

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.data.elements import Elements
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue

__all__ = ["attribute_elements", "vertices_are_of_length_1_or_clamped"]

# How far a vector's length may be from 1. glTF asks for 1 and states no error; the Khronos validator
# (2.0.0-dev.3.10) lets 1.00674 pass and not 1.0067401, below 1 alike, and bytes, whose steps are 0.0079, too.
_LARGEST_LENGTH_ERROR = 0.00674

_SIGNS = frozenset((1.0, -1.0))


def vertices_are_of_length_1_or_clamped(primitive: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell of normals, tangents and colours that cannot be any, once for each primitive that has them."""
    for name, law in _LAWS.items():
        elements = attribute_elements(primitive, name, asset)
        if elements is None or (name, elements) in asset.resources.found:
            continue
        is_clean = True
        for remark in law(elements, asset, primitive.at("attributes", name)):
            is_clean = False
            yield remark
        if is_clean:
            asset.resources.found[name, elements] = True


def attribute_elements(primitive: Entry, name: str, asset: Asset) -> Elements | None:
    """Return the elements of an attribute; None where it has a format that it may not have, too."""
    accessor = asset.get("accessors", primitive.get("attributes", {}).get(name))
    if accessor is None:
        return None
    is_quantized = "KHR_mesh_quantization" in asset.declared
    formats = QUANTIZED_ATTRIBUTE_FORMATS if is_quantized else ATTRIBUTE_FORMATS
    return elements_of(accessor, asset) if accessor_format(accessor) in formats[semantic_of(name)] else None


def _vectors(elements: Elements, asset: Asset, pointer: str) -> Iterator[Issue]:
    for first in blocks(elements, asset, pointer):
        yield from _lengths(columns_of(elements, first), first, elements.width, pointer)


def _tangents(elements: Elements, asset: Asset, pointer: str) -> Iterator[Issue]:
    for first in blocks(elements, asset, pointer):
        *columns, signs = columns_of(elements, first)
        yield from _lengths(columns, first, elements.width, pointer)
        if not _SIGNS.issuperset(signs):
            for element, sign in enumerate(signs, first):
                if sign not in _SIGNS:
                    start = 4 * element
                    yield issue("ACCESSOR_INVALID_SIGN", pointer, first=start, last=start + 3, value=sign)


def _lengths(columns: list[list[float]], first: int, width: int, pointer: str) -> Iterator[Issue]:
    lengths = list(map(hypot, *columns))
    if max(lengths) <= 1.0 + _LARGEST_LENGTH_ERROR and min(lengths) >= 1.0 - _LARGEST_LENGTH_ERROR:
        return  # or the first is NaN, and those behind it are looked at one by one
    for element, vector in enumerate(zip(*columns, strict=True), first):
        length = sqrt(sum(value * value for value in vector))  # unlike hypot, NaN where one of them is
        if abs(length - 1.0) > _LARGEST_LENGTH_ERROR:
            start = width * element
            yield issue(
                "ACCESSOR_VECTOR3_NON_UNIT",
                pointer,
                first=start,
                last=start + len(columns) - 1,
                length=length,
            )


def _colours(elements: Elements, asset: Asset, pointer: str) -> Iterator[Issue]:
    if elements.component != FLOAT:
        return
    width = elements.width
    for first in blocks(elements, asset, pointer):
        columns = elements.columns(first)
        if all(min(column) >= 0.0 and max(column) <= 1.0 for column in columns):
            continue
        for element, values in enumerate(zip(*columns, strict=True), first):
            for place, value in enumerate(values):
                if value < 0.0 or value > 1.0:
                    index = element * width + place
                    yield issue("ACCESSOR_NON_CLAMPED", pointer, index=index, value=value)


# glTF bounds the first set of colours only (§3.7.2.1).
_LAWS: dict[str, Callable[[Elements, Asset, str], Iterator[Issue]]] = {
    "NORMAL": _vectors,
    "TANGENT": _tangents,
    "COLOR_0": _colours,
}
