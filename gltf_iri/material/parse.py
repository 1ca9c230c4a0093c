"""JSON to dataclasses, by the rows that the dataclasses state.

One reader serves every class built with fields.py. A value of the wrong type, length or range, a choice that
does not exist and a reference to nothing are refused with the JSON Pointer of the value; properties without a
row are ignored, and extensions without a row are collected by name.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any, Protocol, TypeVar

from gltf_iri.asset.limits import MAX_NUMBER
from gltf_iri.asset.words import shown
from gltf_iri.errors import AssetError
from gltf_iri.material.fields import Kind, Property, properties
from gltf_iri.material.material import Material

__all__ = ["Rows", "parse_materials"]

Built = TypeVar("Built")


class _HasJson(Protocol):
    @property
    def json(self) -> Mapping[str, Any]: ...


def parse_materials(document: _HasJson) -> tuple[Material, ...]:
    """Return the materials of a document, in glTF order; raises AssetError that points at a bad value."""
    entries = document.json.get("materials", [])
    if not isinstance(entries, list):
        raise _mismatch(entries, "an array of materials", Material.POINTER)
    materials = []
    for i, entry in enumerate(entries):
        rows = Rows(document.json)
        material = rows.build(Material, entry, f"{Material.POINTER}/{i}")
        materials.append(replace(material, unread_extensions=tuple(rows.unread_extensions)))
    return tuple(materials)


class Rows:
    """Fills dataclasses from one document and remembers the extensions that no row describes."""

    def __init__(self, root: Mapping[str, Any]) -> None:
        self._root = root
        self.unread_extensions: dict[str, None] = {}  # an ordered set
        self._readers: Mapping[Kind, Callable[[Property, Any, str], Any]] = {
            Kind.NUMBER: _number,
            Kind.VECTOR: _vector,
            Kind.FLAG: _flag,
            Kind.TEXT: _text,
            Kind.CHOICE: _choice,
            Kind.INDEX: self._index,
            Kind.WHOLE_NUMBER: _whole_number,
            Kind.NESTED: self._nested,
            Kind.NESTED_LIST: self._nested_list,
            Kind.TEXTURE: self._nested,
            Kind.EXTENSION: self._nested,
        }

    def build(self, cls: type[Built], value: Any, pointer: str) -> Built:
        """Return `cls` filled from the JSON object `value` at `pointer`."""
        entry = _object(value, pointer)
        extensions = _object(entry.get("extensions", {}), f"{pointer}/extensions")
        described = set()
        filled = {}
        for attribute, row in properties(cls):
            place, path = entry, pointer
            if row.kind is Kind.EXTENSION:
                place, path = extensions, f"{pointer}/extensions"
                described.add(row.key)
            if row.key in place:
                filled[attribute] = self._readers[row.kind](row, place[row.key], f"{path}/{row.key}")
            elif row.required:
                raise AssetError(f"the required property '{row.key}' is missing; add it", pointer=pointer)
        self.unread_extensions.update(dict.fromkeys(name for name in extensions if name not in described))
        return cls(**filled)

    def _nested(self, row: Property, value: Any, pointer: str) -> Any:
        if row.cls is None:
            raise TypeError(f"the row of '{row.key}' names no dataclass")
        return self.build(row.cls, value, pointer)

    def _nested_list(self, row: Property, value: Any, pointer: str) -> tuple[Any, ...]:
        if not isinstance(value, list):
            raise _mismatch(value, "an array of objects", pointer)
        return tuple(self._nested(row, item, f"{pointer}/{i}") for i, item in enumerate(value))

    def _index(self, row: Property, value: Any, pointer: str) -> int:
        index = _integer(value, pointer)
        if index < 0:
            raise AssetError(f"{shown(index)} is negative; write an integer from 0 on", pointer=pointer)
        if row.refers_to:
            entries = self._root.get(row.refers_to, [])
            count = len(entries) if isinstance(entries, list) else 0
            if index >= count:
                have = f"has {count} entries" if count else "is empty or absent"
                raise AssetError(
                    f"{shown(index)} refers to nothing, '{row.refers_to}' {have}; name one that exists",
                    pointer=pointer,
                )
        return index


def _number(row: Property, value: Any, pointer: str) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise _mismatch(value, "a number", pointer)
    if not abs(value) <= MAX_NUMBER:
        raise AssetError(
            f"{shown(value)} is beyond single precision; write a smaller number", pointer=pointer
        )
    number = float(value)
    if number != row.also_allowed and not _is_inside(row, number):
        raise AssetError(
            f"{value} is outside {row.range_text}; write a value inside that range", pointer=pointer
        )
    return number


def _integer(value: Any, pointer: str) -> int:
    is_whole = isinstance(value, int) or (isinstance(value, float) and value.is_integer())
    if isinstance(value, bool) or not is_whole:
        raise _mismatch(value, "an integer", pointer)
    return int(value)


def _whole_number(row: Property, value: Any, pointer: str) -> int:
    return _integer(_number(row, _integer(value, pointer), pointer), pointer)


def _is_inside(row: Property, number: float) -> bool:
    if row.low is not None and (number < row.low or (row.low_is_excluded and number == row.low)):
        return False
    if row.high is None or number <= row.high:
        return True
    # Exporters pass numbers through single precision, which rounds a bound such as π/2 up.
    (rounded,) = struct.unpack("<f", struct.pack("<f", row.high))
    return number <= float(rounded)


def _vector(row: Property, value: Any, pointer: str) -> tuple[float, ...]:
    if not isinstance(value, list):
        raise _mismatch(value, f"an array of {row.length} numbers", pointer)
    if len(value) != row.length:
        raise AssetError(
            f"{len(value)} numbers stand where {row.length} belong; write them all", pointer=pointer
        )
    return tuple(_number(row, item, f"{pointer}/{i}") for i, item in enumerate(value))


def _flag(row: Property, value: Any, pointer: str) -> bool:
    if not isinstance(value, bool):
        raise _mismatch(value, "true or false", pointer)
    return value


def _text(row: Property, value: Any, pointer: str) -> str:
    if not isinstance(value, str):
        raise _mismatch(value, "a string", pointer)
    return value


def _choice(row: Property, value: Any, pointer: str) -> str:
    if value not in row.choices:
        raise _mismatch(value, f"one of {', '.join(row.choices)}", pointer)
    return str(value)


def _object(value: Any, pointer: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise _mismatch(value, "an object", pointer)
    return value


def _mismatch(value: Any, wanted: str, pointer: str) -> AssetError:
    found = json.dumps(value) if value is None or isinstance(value, bool) else shown(value)
    return AssetError(f"{found} stands where {wanted} belongs; write {wanted}", pointer=pointer)
