"""The schema: walks the parsed JSON by the tables, tells what does not fit, and keeps what does.

What is told here is said of one property alone; the rules see entries that hold nothing broken.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from gltf_iri.asset.words import shown
from gltf_iri.validation.codes import issue
from gltf_iri.validation.collector import Collector
from gltf_iri.validation.entry import Entry, join
from gltf_iri.validation.tables import EXTENSIONS, TABLES, Field

__all__ = ["Reference", "Walk"]

_WANTED = {
    "INTEGER": "an integer",
    "INDEX": "an index",
    "NUMBER": "a number",
    "FLAG": "true or false",
    "TEXT": "text",
    "OBJECT": "an object",
}

# An entry and the field that holds one index or several.
Reference = tuple[Entry, Field]

# Stands for a value that was told of already.
_BROKEN: Any = object()


class Walk:
    """One walk over one file; `declared` are the names in its extensionsUsed.

    `entries` are all objects, each after those that it holds; `references` all indices into arrays.
    """

    def __init__(self, collector: Collector, declared: frozenset[str]) -> None:
        self._tell = collector.add
        self._declared = declared
        self.entries: list[Entry] = []
        self.references: list[Reference] = []

    def object(
        self, table_name: str, raw: dict[str, Any], pointer: str = "", parent: Entry | None = None
    ) -> Entry:
        """Return the entry of the object `raw`; remarks go to the collector."""
        table = TABLES[table_name]
        fields = table.fields
        entry = Entry(table_name, pointer, raw, parent)
        for key, value in raw.items():
            field = fields.get(key)
            if field is not None:
                checked = _READERS[field.shape](self, field, value, join(pointer, key), entry)
                if checked is not _BROKEN:
                    entry[key] = checked
                    if field.kind == "INDEX":
                        self.references.append((entry, field))
            elif key == "extensions":
                self._extensions(entry, value)
            elif key == "extras":
                if not isinstance(value, dict):
                    self._tell(issue("NON_OBJECT_EXTRAS", join(pointer, key)))
            else:
                self._tell(issue("UNEXPECTED_PROPERTY", join(pointer, key)))
        self._company(entry)
        self.entries.append(entry)
        return entry

    def _company(self, entry: Entry) -> None:
        """Tell of properties that are missing, and of those that must not stand together."""
        table, raw = TABLES[entry.table], entry.raw
        for key in table.required:
            if key not in raw:
                self._tell(issue("UNDEFINED_PROPERTY", entry.pointer or "/", property=key))
        for key, needs in table.needing:
            if key in raw and needs not in raw:
                self._tell(issue("UNSATISFIED_DEPENDENCY", entry.at(key), property=needs))
        if table.one_of and sum(key in entry for key in table.one_of) != 1:
            self._tell(issue("ONE_OF_MISMATCH", entry.pointer, properties=" and ".join(table.one_of)))
        if table.is_named_by_type:
            self._named_by_type(entry)

    def _named_by_type(self, entry: Entry) -> None:
        """Tell of an object whose "type" names a part that is missing, or that has two parts."""
        parts = {part for key, others in TABLES[entry.table].exclusive for part in (key, *others)}
        if len(parts & entry.raw.keys()) > 1:
            self._tell(issue("ONE_OF_MISMATCH", entry.pointer, properties=" and ".join(sorted(parts))))
        elif entry.get("type") in parts and entry["type"] not in entry.raw:
            self._tell(issue("UNDEFINED_PROPERTY", entry.pointer, property=entry["type"]))

    def _extensions(self, entry: Entry, value: Any) -> None:
        pointer = entry.at("extensions")
        if not isinstance(value, dict):
            self._mismatch(value, "an object", pointer)
            return
        for name, raw in value.items():
            place = join(pointer, name)
            if not isinstance(raw, dict):
                self._mismatch(raw, "an object", place)
            if name not in self._declared:
                self._tell(issue("UNDECLARED_EXTENSION", place))
            elif name in EXTENSIONS and isinstance(raw, dict):
                table = EXTENSIONS[name].objects.get(entry.table)
                if table is None:
                    self._tell(issue("UNEXPECTED_EXTENSION_OBJECT", place))
                else:
                    entry.extensions[name] = self.object(table, raw, place, entry)
        if len(value) > 1:
            for name in entry.extensions:
                if EXTENSIONS[name].stands_alone:
                    self._tell(issue("MULTIPLE_EXTENSIONS", join(pointer, name)))

    def _one(self, field: Field, value: Any, pointer: str, holder: Entry) -> Any:
        if field.kind == "OBJECT":
            if isinstance(value, dict):
                return self.object(field.table, value, pointer, holder)
            return self._mismatch(value, "an object", pointer)
        typed = _typed(field.kind, value)
        if typed is _BROKEN:
            return self._mismatch(value, _WANTED[field.kind], pointer)
        return self._checked(field, typed, pointer)

    def _array(self, field: Field, value: Any, pointer: str, holder: Entry) -> Any:
        if not isinstance(value, list):
            return self._mismatch(value, "an array", pointer)
        if not value:
            self._tell(issue("EMPTY_ENTITY", pointer))
            return _BROKEN
        if field.max_items is not None and not field.min_items <= len(value) <= field.max_items:
            allowed = (
                f"{field.min_items}" if field.min_items == field.max_items else f"up to {field.max_items}"
            )
            self._tell(issue("ARRAY_LENGTH_NOT_IN_LIST", pointer, length=len(value), allowed=allowed))
            return _BROKEN
        items = _ITEMS[field.kind](self, field, value, pointer, holder)
        if field.is_unique and isinstance(items, list):
            self._repeated(items, pointer)
        return items

    def _repeated(self, items: list[Any], pointer: str) -> None:
        seen = set()
        for position, item in enumerate(items):
            if item is not None and item in seen:
                self._tell(issue("DUPLICATE_ELEMENTS", join(pointer, position)))
            seen.add(item)

    def _objects(self, field: Field, values: list[Any], pointer: str, holder: Entry) -> Any:
        entries: list[Entry | None] = []
        for position, value in enumerate(values):
            place = join(pointer, position)
            if isinstance(value, dict):
                entries.append(self.object(field.table, value, place, holder))
            else:
                self._mismatch(value, "an object", place)
                entries.append(None)
        return entries

    def _indices(self, field: Field, values: list[Any], pointer: str, holder: Entry) -> Any:
        indices: list[int | None] = []
        for position, value in enumerate(values):
            index = _typed("INDEX", value)
            if index is _BROKEN or index < 0:
                self._tell(issue("INVALID_INDEX", join(pointer, position)))
                index = None
            indices.append(index)
        return indices

    def _numbers(self, field: Field, values: list[Any], pointer: str, holder: Entry) -> Any:
        numbers = [self._item(field, value, pointer, pointer) for value in values]
        if _BROKEN in numbers:
            return _BROKEN
        for position, number in enumerate(numbers):
            if self._checked(field, number, join(pointer, position)) is _BROKEN:
                numbers[position] = _BROKEN
        return _BROKEN if _BROKEN in numbers else numbers

    def _texts(self, field: Field, values: list[Any], pointer: str, holder: Entry) -> Any:
        items = [self._item(field, v, pointer, join(pointer, i)) for i, v in enumerate(values)]
        return [None if item is _BROKEN else item for item in items]

    def _item(self, field: Field, value: Any, pointer: str, place: str) -> Any:
        typed = _typed(field.kind, value)
        if typed is _BROKEN:
            self._tell(issue("ARRAY_TYPE_MISMATCH", place, value=shown(value), wanted=_WANTED[field.kind]))
        return typed

    def _map(self, field: Field, value: Any, pointer: str, holder: Entry) -> Any:
        if not isinstance(value, dict):
            return self._mismatch(value, "an object", pointer)
        if not value:
            self._tell(issue("EMPTY_ENTITY", pointer))
            return _BROKEN
        checked = {key: self._one(field, item, join(pointer, key), holder) for key, item in value.items()}
        return {key: item for key, item in checked.items() if item is not _BROKEN}

    def _maps(self, field: Field, value: Any, pointer: str, holder: Entry) -> Any:
        if not isinstance(value, list):
            return self._mismatch(value, "an array", pointer)
        if not value:
            self._tell(issue("EMPTY_ENTITY", pointer))
            return _BROKEN
        maps: list[dict[str, int] | None] = []
        for position, item in enumerate(value):
            if isinstance(item, dict):
                checked = self._map(field, item, join(pointer, position), holder)
                maps.append(None if checked is _BROKEN else checked)
            else:
                self._tell(issue("ARRAY_TYPE_MISMATCH", pointer, value=shown(item), wanted="an object"))
                maps.append(None)
        return maps

    def _checked(self, field: Field, value: Any, pointer: str) -> Any:
        """Return a value of the right type, or _BROKEN where it is not one that the field may have."""
        if field.kind == "INDEX":
            if value < 0:
                self._tell(issue("INVALID_INDEX", pointer))
                return _BROKEN
        elif field.choices:
            if value not in field.choices:
                listed = ", ".join(map(str, field.choices))
                self._tell(issue("VALUE_NOT_IN_LIST", pointer, value=shown(value), allowed=listed))
                return _BROKEN
        elif field.kind == "TEXT":
            if field.pattern is not None and not field.pattern.fullmatch(value):
                self._tell(
                    issue("PATTERN_MISMATCH", pointer, value=shown(value), pattern=field.pattern.pattern)
                )
                return _BROKEN
        elif field.kind != "FLAG" and not _is_in_range(field, value):
            self._tell(issue("VALUE_NOT_IN_RANGE", pointer, value=shown(value), range=_interval(field)))
            return _BROKEN
        if field.multiple_of and value % field.multiple_of:
            self._tell(issue("VALUE_MULTIPLE_OF", pointer, value=value, factor=field.multiple_of))
        return value

    def _mismatch(self, value: Any, wanted: str, pointer: str) -> Any:
        self._tell(issue("TYPE_MISMATCH", pointer, value=shown(value), wanted=wanted))
        return _BROKEN


_READERS: dict[str, Callable[[Walk, Field, Any, str, Entry], Any]] = {
    "ONE": Walk._one,
    "ARRAY": Walk._array,
    "MAP": Walk._map,
    "ARRAY_OF_MAPS": Walk._maps,
}
_ITEMS: dict[str, Callable[[Walk, Field, list[Any], str, Entry], Any]] = {
    "OBJECT": Walk._objects,
    "INDEX": Walk._indices,
    "NUMBER": Walk._numbers,
    "TEXT": Walk._texts,
}


def _typed(kind: str, value: Any) -> Any:
    """Return the value where it has the type of `kind`; 1.0 is an integer, as it is for JSON."""
    if kind == "TEXT":
        return value if isinstance(value, str) else _BROKEN
    if kind == "FLAG":
        return value if isinstance(value, bool) else _BROKEN
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return _BROKEN
    if kind == "NUMBER":
        return value
    return int(value) if math.isfinite(value) and value == int(value) else _BROKEN


def _is_in_range(field: Field, value: float) -> bool:
    if not math.isfinite(value):
        return False
    if not field.has_range or value == field.also_allowed:
        return True
    if field.low is not None and (value < field.low or (field.low_is_excluded and value == field.low)):
        return False
    return field.high is None or value <= field.high


def _interval(field: Field) -> str:
    low = "(−∞" if field.low is None else f"{'(' if field.low_is_excluded else '['}{field.low:g}"
    return f"{low}, {'∞)' if field.high is None else f'{field.high:g}]'}"
