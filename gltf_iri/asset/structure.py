"""The structural check: after it, every core property has its type, its range and a target for each index.

Driven by the rows of `tables`. What could mislead a reader further on is an error; what is wrong but cannot
hurt, such as an empty array, is a note. Unknown keys are kept as they are.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any, Final

from gltf_iri.asset.formats import COMPONENT_BYTES
from gltf_iri.asset.hierarchy import check_hierarchy
from gltf_iri.asset.limits import MAX_JSON_INTEGER, MAX_NUMBER
from gltf_iri.asset.tables import EXCLUSIVE, NAMED_BY_TYPE, OBJECTS, ONE_OF, Kind, Row, Shape
from gltf_iri.asset.words import join, kind_of, shown
from gltf_iri.errors import AssetError

__all__ = ["check_structure"]

# Exporters write a unit quaternion's component as 1.0000001: one rounding of float32.
_RANGE_SLACK: Final = 1e-6

_VERSION: Final = re.compile(r"(0|[1-9][0-9]{0,8})\.(0|[1-9][0-9]{0,8})")
_WANTED: Final = {
    Kind.INTEGER: "an integer",
    Kind.INDEX: "an index",
    Kind.NUMBER: "a number",
    Kind.FLAG: "true or false",
    Kind.TEXT: "text",
    Kind.OBJECT: "an object",
}


def check_structure(root: Any) -> list[str]:
    """Check parsed JSON against the core tables and return notes; AssetError names the first fault's pointer.

    Integers written as 1.0 become 1 in place (JSON does not tell them apart); nothing else is changed.
    """
    if not isinstance(root, dict):
        raise AssetError(f"the file holds {kind_of(root)}, but glTF is an object", pointer="")
    checker = _Checker(root)
    checker.object("glTF", root, "")
    check_hierarchy(root)
    return [*checker.notes(), *_version_notes(root["asset"]), *_alignment_notes(root)]


class _Checker:
    def __init__(self, root: dict[str, Any]) -> None:
        # Remark to the first place it was made at and how often: exporters repeat themselves on every node.
        self._remarks: dict[tuple[str, str], tuple[str, int]] = {}
        self._lengths = {key: len(value) for key, value in root.items() if isinstance(value, list)}

    def notes(self) -> list[str]:
        """One sentence a remark."""
        return [
            f"{place}: {what}{f', here and in {times - 1} more places' if times > 1 else ''}."
            for (_, what), (place, times) in self._remarks.items()
        ]

    def _remark(self, row: Row, what: str, pointer: str) -> None:
        place, times = self._remarks.get((row.key, what), (pointer, 0))
        self._remarks[row.key, what] = (place, times + 1)

    def object(self, table: str, value: dict[str, Any], pointer: str) -> None:
        self._check_extensions(value, pointer)
        for row in OBJECTS.get(table, ()):
            if row.kind is Kind.OBJECT and isinstance(value.get(row.key), list):
                self._lengths[f"{table}.{row.key}"] = len(value[row.key])
        for row in OBJECTS.get(table, ()):
            if row.key in value:
                self._property(row, value, join(pointer, row.key))
            elif row.required:
                raise AssetError(f"the property {row.key!r} is missing", pointer=pointer)
        self._check_company(table, value, pointer)

    def _check_extensions(self, value: dict[str, Any], pointer: str) -> None:
        extensions = value.get("extensions", {})
        if not isinstance(extensions, dict):
            raise _mismatch(extensions, "an object", join(pointer, "extensions"))
        for name, extension in extensions.items():
            if not isinstance(extension, dict):
                raise _mismatch(extension, "an object", join(join(pointer, "extensions"), name))

    def _check_company(self, table: str, value: dict[str, Any], pointer: str) -> None:
        for key, others in EXCLUSIVE.get(table, ()):
            for other in others:
                if key in value and other in value:
                    raise AssetError(f"{key!r} and {other!r} exclude each other; keep one", pointer=pointer)
        if table in NAMED_BY_TYPE and value["type"] not in value:
            raise AssetError(f"the property {value['type']!r} that 'type' names is missing", pointer=pointer)
        if table in ONE_OF and not any(key in value for key in ONE_OF[table]):
            raise AssetError(f"one of {' and '.join(map(repr, ONE_OF[table]))} is missing", pointer=pointer)

    def _property(self, row: Row, holder: dict[str, Any], pointer: str) -> None:
        value = holder[row.key]
        if row.shape is Shape.ONE:
            holder[row.key] = self._value(row, value, pointer)
        elif row.shape is Shape.MAP:
            self._map(row, value, pointer)
        else:
            self._array(row, value, pointer)
        if row.needs and row.needs not in holder:
            self._remark(row, f"{row.key!r} means nothing without {row.needs!r}", pointer)

    def _array(self, row: Row, value: Any, pointer: str) -> None:
        if not isinstance(value, list):
            raise _mismatch(value, "an array", pointer)
        if not value and row.max_items is None and not row.required:
            self._remark(row, "the array is empty and should be left out", pointer)
            return
        if len(value) < row.min_items or len(value) > (row.max_items or len(value)):
            raise AssetError(f"the array has {len(value)} items, not {_allowed_length(row)}", pointer=pointer)
        for position, item in enumerate(value):
            place = join(pointer, position)
            if row.shape is Shape.ARRAY_OF_MAPS:
                self._map(row, item, place)
            else:
                value[position] = self._value(row, item, place)
        if row.is_unique:
            _refuse_repeated(value, pointer)

    def _map(self, row: Row, value: Any, pointer: str) -> None:
        if not isinstance(value, dict):
            raise _mismatch(value, "an object", pointer)
        if not value:
            self._remark(row, "the object is empty, but should have an entry", pointer)
        for key, item in value.items():
            value[key] = self._value(row, item, join(pointer, key))

    def _value(self, row: Row, value: Any, pointer: str) -> Any:
        value = _typed(row.kind, value, pointer)
        if row.kind is Kind.OBJECT:
            self.object(row.table, value, pointer)
        elif row.choices and not row.is_open and value not in row.choices:
            listed = ", ".join(map(str, row.choices))
            raise AssetError(f"{shown(value)} is none of {listed}", pointer=pointer)
        elif row.kind in (Kind.INTEGER, Kind.NUMBER, Kind.INDEX):
            _check_range(row, value, pointer)
        if row.kind is Kind.INDEX and value >= self._lengths.get(row.refers_to, 0):
            length = self._lengths.get(row.refers_to, 0)
            raise AssetError(f"the index {value} points beyond the {length} {row.refers_to}", pointer=pointer)
        return value


def _typed(kind: Kind, value: Any, pointer: str) -> Any:
    """Return the value with its type checked; 1.0 becomes 1 where an integer is wanted."""
    if kind is Kind.FLAG and isinstance(value, bool):
        return value
    if kind is Kind.TEXT and isinstance(value, str):
        return value
    if kind is Kind.OBJECT and isinstance(value, dict):
        return value
    if not isinstance(value, bool) and isinstance(value, int | float):
        if kind is Kind.NUMBER:
            return value
        if kind in (Kind.INTEGER, Kind.INDEX) and value == int(value) and abs(value) <= MAX_JSON_INTEGER:
            return int(value)
    raise _mismatch(value, _WANTED[kind], pointer)


def _check_range(row: Row, value: float, pointer: str) -> None:
    slack = _RANGE_SLACK if row.kind is Kind.NUMBER and not row.low_is_excluded else 0.0
    too_low = row.low is not None and (value < row.low - slack or (row.low_is_excluded and value == row.low))
    if too_low or (row.high is not None and value > row.high + slack):
        raise AssetError(f"{shown(value)} is outside {_interval(row)}", pointer=pointer)
    if abs(value) > MAX_NUMBER:
        raise AssetError(f"{shown(value)} is beyond single precision", pointer=pointer)
    if row.multiple_of and value % row.multiple_of:
        raise AssetError(f"{shown(value)} is not a multiple of {row.multiple_of}", pointer=pointer)


def _interval(row: Row) -> str:
    low = "(−∞" if row.low is None else f"{'(' if row.low_is_excluded else '['}{row.low}"
    return f"{low}, {'∞)' if row.high is None else f'{row.high}]'}"


def _allowed_length(row: Row) -> str:
    if row.max_items is None:
        return f"at least {row.min_items}"
    return str(row.min_items) if row.min_items == row.max_items else f"{row.min_items} to {row.max_items}"


def _refuse_repeated(values: list[Any], pointer: str) -> None:
    seen = set()
    for position, value in enumerate(values):
        if value in seen:
            raise AssetError(f"{shown(value)} stands twice in the array", pointer=join(pointer, position))
        seen.add(value)


def _mismatch(value: Any, wanted: str, pointer: str) -> AssetError:
    found = shown(value) if isinstance(value, int | float) else kind_of(value)
    return AssetError(f"{found} stands where {wanted} is wanted", pointer=pointer)


def _alignment_notes(root: dict[str, Any]) -> Iterator[str]:
    """Remark on elements that a reader which maps memory could not take (§3.6.2.4); here they are copied."""
    crooked = [
        number
        for number, accessor in enumerate(root.get("accessors", ()))
        if "bufferView" in accessor
        and (accessor.get("byteOffset", 0) + root["bufferViews"][accessor["bufferView"]].get("byteOffset", 0))
        % COMPONENT_BYTES[accessor["componentType"]]
    ]
    if crooked:
        more = f", here and in {len(crooked) - 1} more accessors" if len(crooked) > 1 else ""
        yield f"/accessors/{crooked[0]}: the elements are not aligned to their components{more}."


def _version_notes(asset: dict[str, Any]) -> list[str]:
    for key in ("version", "minVersion"):
        version = asset.get(key, "2.0")
        parts = _VERSION.fullmatch(version)
        if parts is None:
            raise AssetError(f"{shown(version)} is not a version such as '2.0'", pointer=f"/asset/{key}")
        if parts[1] != "2" or (key == "minVersion" and parts[2] != "0"):
            raise AssetError(f"glTF {version} is not read, only glTF 2.0", pointer=f"/asset/{key}")
    if asset["version"] != "2.0":
        return [f"/asset/version: glTF {asset['version']} is read as 2.0."]
    return []
