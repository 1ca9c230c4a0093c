"""Primitives and their accessors: formats, counts, bounds and alignment of vertices and indices (§3.7.2)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from gltf_iri.asset.formats import (
    ATTRIBUTE_FORMATS,
    INDEX_FORMATS,
    QUANTIZED_ATTRIBUTE_FORMATS,
    QUANTIZED_TARGET_FORMATS,
    TARGET_FORMATS,
    UNSIGNED_INT,
    format_of,
)
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue
from gltf_iri.validation.rules.accessor_bounds import has_bounds
from gltf_iri.validation.rules.accessors import element_bytes, names_view
from gltf_iri.validation.rules.attributes import semantic_of
from gltf_iri.validation.rules.registry import Rules
from gltf_iri.validation.tables import sound_value_of

__all__ = ["RULES", "accessor_format"]

_VERTEX_ALIGNMENT = 4  # §3.6.2.4, in bytes

# Modes to what they draw, the least number of vertices, and of what the number is a multiple.
_MODES = {
    1: ("lines", 2, 2),
    2: ("line loops", 2, 1),
    3: ("line strips", 2, 1),
    4: ("triangles", 3, 3),
    5: ("triangle strips", 3, 1),
    6: ("triangle fans", 3, 1),
}


def accessor_format(accessor: Entry) -> str:
    """Return the format of an accessor; broken parts make one that nothing takes."""
    is_normalized = accessor.get("normalized", False)
    return format_of(accessor.get("type"), accessor.get("componentType"), is_normalized=is_normalized)


def _attributes(primitive: Entry, asset: Asset) -> Iterator[Issue]:
    is_quantized = "KHR_mesh_quantization" in asset.declared
    formats = QUANTIZED_ATTRIBUTE_FORMATS if is_quantized else ATTRIBUTE_FORMATS
    vertices: int | None = None
    for name, index in primitive.get("attributes", {}).items():
        accessor = asset.get("accessors", index)
        if accessor is None:
            continue
        pointer, count = primitive.at("attributes", name), accessor.get("count")
        if vertices is None:
            vertices = count
        elif count != vertices:
            yield issue("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", pointer)
        if semantic_of(name) not in formats and accessor.get("componentType") == UNSIGNED_INT:
            yield issue("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT", pointer)
        yield from _vertices(accessor, name, pointer, formats, asset)
    yield from _indices(primitive, asset, vertices)


def _indices(primitive: Entry, asset: Asset, vertices: int | None) -> Iterator[Issue]:
    """Check the indices, and whether they, or else all vertices, fill the drawing mode."""
    indices, count = asset.get("accessors", primitive.get("indices")), vertices
    if indices is not None:
        pointer, given, count = primitive.at("indices"), accessor_format(indices), indices.get("count")
        if given not in INDEX_FORMATS:
            code = "MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT"
            yield issue(code, pointer, format=given, allowed=", ".join(INDEX_FORMATS))
        view = asset.get("bufferViews", indices.get("bufferView"))
        if view is not None and "byteStride" in view:
            yield issue("MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE", pointer)
    drawn, least, multiple = _MODES.get(sound_value_of(primitive, "mode"), ("points", 1, 1))
    if count is not None and (count < least or count % multiple):
        yield issue("MESH_PRIMITIVE_INCOMPATIBLE_MODE", primitive.pointer, count=count, mode=drawn)


def _targets(primitive: Entry, asset: Asset) -> Iterator[Issue]:
    is_quantized = "KHR_mesh_quantization" in asset.declared
    formats = QUANTIZED_TARGET_FORMATS if is_quantized else TARGET_FORMATS
    moved = primitive.get("attributes", {})
    for position, target in enumerate(primitive.get("targets", ())):
        for name, index in target.items():
            accessor, base = asset.get("accessors", index), asset.get("accessors", moved.get(name))
            if accessor is None:
                continue
            pointer = primitive.at("targets", position, name)
            if base is None:
                yield issue("MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR", pointer)
            elif base.get("count") != accessor.get("count"):
                yield issue("MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT", pointer)
            yield from _vertices(accessor, name, pointer, formats, asset)


def _vertices(
    accessor: Entry, name: str, pointer: str, formats: Mapping[str, tuple[str, ...]], asset: Asset
) -> Iterator[Issue]:
    """Check the accessor that the attribute `name` at `pointer`, of vertices or a target, reads."""
    semantic = semantic_of(name)
    if name == "POSITION" and not has_bounds(accessor):
        yield issue("MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", pointer)
    if semantic in formats and accessor_format(accessor) not in formats[semantic]:
        code, allowed = "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT", ", ".join(formats[semantic])
        yield issue(code, pointer, format=accessor_format(accessor), allowed=allowed)
    view = asset.get("bufferViews", accessor.get("bufferView"))
    step = 0 if view is None or "byteStride" in view else element_bytes(accessor)
    offset = accessor.get("byteOffset", 0) if names_view(accessor) else 0
    if offset % _VERTEX_ALIGNMENT or step % _VERTEX_ALIGNMENT:
        yield issue("MESH_PRIMITIVE_ACCESSOR_UNALIGNED", pointer)


RULES: Rules = {"mesh.primitive": (_attributes, _targets)}
