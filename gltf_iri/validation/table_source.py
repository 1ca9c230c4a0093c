"""The rows of all tables of the road, as one file that is read in a millisecond: validation/tables.json.

Materials and lights state their properties in dataclasses, which take longer to import than a file takes to
be checked. `python -m gltf_iri.generate` writes the file anew from them and from the core's tables, and
`--check` says when it is stale: no row stands twice.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from gltf_iri.asset.extension_tables import EXTENSION_OBJECTS, EXTENSIONS, PARTS, Extension
from gltf_iri.asset.tables import EXCLUSIVE, NAMED_BY_TYPE, OBJECTS, ONE_OF, Kind, Row, Shape
from gltf_iri.material import fields
from gltf_iri.material.fields import Property, properties
from gltf_iri.material.material import Material
from gltf_iri.material.texture import NormalTextureInfo, OcclusionTextureInfo, TextureInfo
from gltf_iri.scene.light import PunctualLight

__all__ = ["tables_json"]

_TEXTURE_TABLES: dict[type, str] = {
    TextureInfo: "textureInfo",
    NormalTextureInfo: "normalTextureInfo",
    OcclusionTextureInfo: "occlusionTextureInfo",
}

# A stated property's kind to that of the core's rows; extensions are no properties of their object.
_KINDS = {
    fields.Kind.NUMBER: Kind.NUMBER,
    fields.Kind.VECTOR: Kind.NUMBER,
    fields.Kind.FLAG: Kind.FLAG,
    fields.Kind.TEXT: Kind.TEXT,
    fields.Kind.CHOICE: Kind.TEXT,
    fields.Kind.WHOLE_NUMBER: Kind.INTEGER,
    fields.Kind.NESTED: Kind.OBJECT,
    fields.Kind.NESTED_LIST: Kind.OBJECT,
    fields.Kind.TEXTURE: Kind.OBJECT,
}


_TOLD_WHERE_STATED = (
    *("required", "low", "high", "low_is_excluded", "also_allowed", "multiple_of", "choices", "refers_to"),
    *("table", "min_items", "max_items", "is_unique", "needs", "pattern", "colour_space", "counts_as_use"),
    "is_per_component",
)


def tables_json() -> str:
    """Return the text of validation/tables.json: every object's rows, and where each extension stands."""
    objects = {**OBJECTS, **EXTENSION_OBJECTS}
    # The core's own check leaves materials to the dataclasses.
    objects["glTF"] = tuple(
        replace(row, table="material") if row.key == "materials" else row for row in OBJECTS["glTF"]
    )
    extensions = dict(EXTENSIONS)
    _add(objects, extensions, "material", Material)
    for cls, name in _TEXTURE_TABLES.items():
        _add(objects, extensions, name, cls)
    _add(objects, extensions, f"{PunctualLight.EXTENSION}.light", PunctualLight)
    stated = {
        "objects": {name: [_row(row) for row in rows] for name, rows in objects.items()},
        "oneOf": ONE_OF,
        "parts": {**_parts(), **PARTS},
        "extensions": {
            name: {
                "objects": dict(extension.objects),
                "isRequired": extension.is_required,
                "standsAlone": extension.stands_alone,
                "widens": extension.widens,
            }
            for name, extension in sorted(extensions.items())
        },
    }
    return (
        json.dumps(stated, separators=(",", ":")).replace('{"key"', '\n{"key"').replace("],", "],\n") + "\n"
    )


def _parts() -> dict[str, tuple[str, ...]]:
    """Return the properties among which an object's "type" chooses, by the object's table."""
    return {name: (key, *others) for name in NAMED_BY_TYPE for key, others in EXCLUSIVE[name]}


def _add(objects: dict[str, tuple[Row, ...]], extensions: dict[str, Extension], name: str, cls: type) -> None:
    """Add the rows that the dataclass `cls` states as table `name`, and those of all that it holds."""
    rows = []
    for _, row in properties(cls):
        if row.kind is fields.Kind.EXTENSION and row.cls is not None:
            known = extensions.get(row.key, Extension({}))
            places = {**known.objects, name: row.key}
            extensions[row.key] = replace(known, objects=places)
            if row.key not in objects:
                _add(objects, extensions, row.key, row.cls)
        else:
            table = _table_of(row, name)
            rows.append(_as_row(row, table))
            if row.cls is not None and table not in objects and row.cls not in _TEXTURE_TABLES:
                _add(objects, extensions, table, row.cls)
    objects[name] = tuple(rows)


def _table_of(row: Property, holder: str) -> str:
    if row.cls is None:
        return ""
    return _TEXTURE_TABLES.get(row.cls, f"{holder}.{row.key}")


def _as_row(row: Property, table: str) -> Row:
    is_list = row.kind is fields.Kind.NESTED_LIST
    is_vector = row.kind is fields.Kind.VECTOR
    # A number that refers to no array, such as a UV set's, is an integer and no index.
    kind = _KINDS.get(row.kind) or (Kind.INDEX if row.refers_to else Kind.INTEGER)
    return Row(
        row.key,
        kind,
        Shape.ARRAY if is_list or is_vector else Shape.ONE,
        required=row.required,
        # Of a text and of a list, empty says that it is absent.
        default=None if row.default in ("", ()) else row.default,
        low=row.low,
        high=row.high,
        low_is_excluded=row.low_is_excluded,
        also_allowed=row.also_allowed,
        choices=row.choices,
        refers_to=row.refers_to,
        table=table,
        min_items=row.length if is_vector else 1,
        max_items=row.length if is_vector else None,
        colour_space="srgb" if row.colour_space == "srgb" else "",
    )


def _row(row: Row) -> dict[str, Any]:
    return dict(_told(row))


def _told(row: Row) -> Iterator[tuple[str, Any]]:
    """Yield what differs from a plain row; an index needs its array, which its link says already."""
    yield "key", row.key
    yield "kind", row.kind.name
    if row.shape is not Shape.ONE:
        yield "shape", row.shape.name
    plain = Row(row.key, row.kind, row.shape)
    for name in _TOLD_WHERE_STATED:
        value = getattr(row, name)
        is_said_by_link = name == "needs" and value == row.refers_to
        if value != getattr(plain, name) and not is_said_by_link:
            yield name, value
    if row.default is not None and not (isinstance(row.default, float) and math.isinf(row.default)):
        yield "default", row.default
