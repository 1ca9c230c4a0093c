"""The schema: walks the parsed JSON by the tables, tells what does not fit, and keeps what does.

What is told here is said of one property alone; the rules see entries that hold nothing broken.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gltf_iri.asset.words import shown
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry, join
from gltf_iri.validation.tables import EXTENSIONS, TABLES, Field, Table
from gltf_iri.validation.values import BROKEN, WANTED, complaint, typed
from gltf_iri.validation.version import KNOWN, version_key

if TYPE_CHECKING:
    from collections.abc import Callable

    from gltf_iri.validation.collector import Collector

    # An entry and the field that holds one index or several.
    Reference = tuple[Entry, Field]

__all__ = ["Walk"]

# What tells how the file is to be read, whatever its version.
_READ_FIRST = ("asset", "extensionsUsed", "extensionsRequired")


class Walk:
    """One walk over one file.

    entries : all objects, each after those that it holds.
    references : all indices into arrays.
    declared : the names in extensionsUsed.
    is_known_version : the file says that it is of the version whose tables these are.
    """

    def __init__(self, collector: Collector) -> None:
        self._tell = collector.add
        # Table and key to the values that declared extensions allow beside those of the core.
        self._wider: dict[tuple[str, str], list[str]] = {}
        self.declared: frozenset[str] = frozenset()
        self.entries: list[Entry] = []
        self.references: list[Reference] = []
        self.is_known_version = False

    def root(self, raw: dict[str, Any]) -> Entry:
        """Return the entry of a whole file; of an unknown version only what says what the file is."""
        used = raw.get("extensionsUsed")
        if isinstance(used, list) and all(isinstance(name, str) for name in used):
            self.declared = frozenset(used)
        for name in self.declared & EXTENSIONS.keys():
            for table, key, choice in EXTENSIONS[name].widens:
                self._wider.setdefault((table, key), []).append(choice)
        asset = raw.get("asset")
        version = asset.get("version") if isinstance(asset, dict) else None
        pattern = TABLES["asset"].fields["version"].pattern
        if isinstance(version, str) and pattern is not None and pattern.fullmatch(version):
            self.is_known_version = version_key(version)[0] == version_key(KNOWN)[0]
        if self.is_known_version:
            return self.object("glTF", raw)
        known = TABLES["glTF"].fields.keys() | {"extensions", "extras"}
        return self.object("glTF", {key: raw[key] for key in raw if key in _READ_FIRST or key not in known})

    def object(
        self, table_name: str, raw: dict[str, Any], pointer: str = "", parent: Entry | None = None
    ) -> Entry:
        """Return the entry of the object `raw`; remarks go to the collector."""
        table = TABLES[table_name]
        fields = table.fields
        entry = Entry(table_name, pointer, raw, parent)
        # Of the parts that a "type" chooses from, the others are not looked at.
        unread = [part for part in table.parts if part != raw["type"]] if "type" in raw else ()
        for key, value in raw.items():
            field = fields.get(key)
            if field is not None:
                if key not in unread:
                    self._property(entry, field, value)
            elif key == "extensions":
                self._extensions(entry, value)
            elif key == "extras":
                if value is not None and not isinstance(value, dict):
                    self._tell(issue("NON_OBJECT_EXTRAS", join(pointer, key)))
            else:
                self._tell(issue("UNEXPECTED_PROPERTY", join(pointer, key)))
        self._company(entry)
        self.entries.append(entry)
        return entry

    def _property(self, entry: Entry, field: Field, value: Any) -> None:
        checked = _READERS[field.shape](self, field, value, entry)
        if checked is not BROKEN:
            entry[field.key] = checked
            if field.kind == "INDEX":
                self.references.append((entry, field))

    def _company(self, entry: Entry) -> None:
        """Tell of properties that are missing, and of those that must not stand together."""
        table, raw = TABLES[entry.table], entry.raw
        for key in table.required:
            if raw.get(key) is None:
                self._tell(issue("UNDEFINED_PROPERTY", entry.pointer or "/", property=key))
        for key, needs in table.needing:
            if key in entry and needs not in entry and not self._is_unlisted(table, raw, needs):
                self._tell(issue("UNSATISFIED_DEPENDENCY", entry.at(key), property=needs))
        if table.one_of and sum(key in entry for key in table.one_of) != 1:
            self._tell(issue("ONE_OF_MISMATCH", entry.pointer, properties=" and ".join(table.one_of)))
        if table.parts:
            self._parts(entry, sorted(table.parts & raw.keys()))

    def _is_unlisted(self, table: Table, raw: dict[str, Any], key: str) -> bool:
        """Whether a property is there, with a value of its type that is not in the list of those known."""
        field = table.fields[key]
        return bool(field.choices) and typed(field.kind, raw.get(key)) is not BROKEN

    def _parts(self, entry: Entry, given: list[str]) -> None:
        """Tell of an object whose "type" names a part that is missing, or that has two parts."""
        named = entry.get("type")
        if len(given) > 1:
            self._tell(issue("ONE_OF_MISMATCH", entry.pointer, properties=" and ".join(given)))
        elif named is not None and entry.raw.get(named) is None:
            self._tell(issue("UNDEFINED_PROPERTY", entry.pointer, property=named))

    def _extensions(self, entry: Entry, value: Any) -> None:
        pointer = entry.at("extensions")
        if not isinstance(value, dict):
            self._mismatch(value, "an object", pointer)
            return
        for name, raw in value.items():
            place = join(pointer, name)
            if not isinstance(raw, dict):
                self._mismatch(raw, "an object", place)
            if name not in self.declared:
                self._tell(issue("UNDECLARED_EXTENSION", place))
            elif name in EXTENSIONS:
                table = EXTENSIONS[name].objects.get(entry.table)
                if table is None:
                    self._tell(issue("UNEXPECTED_EXTENSION_OBJECT", place))
                else:
                    # What is no object counts as an empty one, as for the Khronos validator.
                    stated = raw if isinstance(raw, dict) else {}
                    entry.extensions[name] = self.object(table, stated, place, entry)
        if len(value) > 1:
            for name in entry.extensions:
                if EXTENSIONS[name].stands_alone:
                    self._tell(issue("MULTIPLE_EXTENSIONS", join(pointer, name)))

    def _one(self, field: Field, value: Any, entry: Entry) -> Any:
        key = field.key
        if field.kind == "OBJECT":
            if isinstance(value, dict):
                return self.object(field.table, value, entry.at(key), entry)
            return self._mismatch(value, "an object", entry.at(key))
        found = typed(field.kind, value)
        if found is BROKEN:
            return self._mismatch(value, WANTED[field.kind], entry.at(key))
        wrong = complaint(field, found)
        if wrong is not None and found not in self._wider.get((entry.table, key), ()):
            return self._wrong(wrong, entry.at(key))
        if field.multiple_of and found % field.multiple_of:
            self._tell(issue("VALUE_MULTIPLE_OF", entry.at(key), value=found, factor=field.multiple_of))
        return found

    def _array(self, field: Field, value: Any, entry: Entry) -> Any:
        pointer = entry.at(field.key)
        if not isinstance(value, list):
            return self._mismatch(value, "an array", pointer)
        if not value:
            return self._wrong(("EMPTY_ENTITY", {}), pointer)
        if field.max_items is not None and not field.min_items <= len(value) <= field.max_items:
            is_fixed = field.min_items == field.max_items
            allowed = f"{field.min_items}" if is_fixed else f"up to {field.max_items}"
            return self._wrong(
                ("ARRAY_LENGTH_NOT_IN_LIST", {"length": len(value), "allowed": allowed}), pointer
            )
        return _ITEMS[field.kind](self, field, value, pointer, entry)

    def _objects(self, field: Field, values: list[Any], pointer: str, entry: Entry) -> Any:
        objects: list[Entry | None] = []
        if entry.parent is None:
            # The file's own arrays live on without their broken items: indices of the others stay right.
            for position, value in enumerate(values):
                place = f"{pointer}/{position}"
                if isinstance(value, dict):
                    objects.append(self.object(field.table, value, place, entry))
                else:
                    self._mismatch(value, "an object", place)
                    objects.append(None)
            return objects
        if self._has_others(values, pointer):
            return BROKEN
        for position, value in enumerate(values):
            objects.append(self.object(field.table, value, f"{pointer}/{position}", entry))
        return objects

    def _has_others(self, values: list[Any], pointer: str) -> bool:
        """Tell whether the list holds anything but objects."""
        others = [value for value in values if not isinstance(value, dict)]
        for value in others:
            self._tell(issue("ARRAY_TYPE_MISMATCH", pointer, value=shown(value), wanted="an object"))
        return bool(others)

    def _indices(self, field: Field, values: list[Any], pointer: str, entry: Entry) -> Any:
        indices = [self._index(value, pointer, position) for position, value in enumerate(values)]
        if field.is_unique:
            self._repeated(indices, pointer)
        return indices

    def _index(self, value: Any, pointer: str, key: str | int) -> int | None:
        index = typed("INDEX", value)
        if index is BROKEN or index < 0:
            self._tell(issue("INVALID_INDEX", join(pointer, key)))
            return None
        return int(index)

    def _numbers(self, field: Field, values: list[Any], pointer: str, entry: Entry) -> Any:
        numbers = [self._item(field, value, pointer) for value in values]
        if BROKEN in numbers:
            return BROKEN
        for position, number in enumerate(numbers):
            wrong = complaint(field, number)
            if wrong is not None:
                numbers[position] = self._wrong(wrong, f"{pointer}/{position}")
        return BROKEN if BROKEN in numbers else numbers

    def _texts(self, field: Field, values: list[Any], pointer: str, entry: Entry) -> Any:
        texts = [self._item(field, v, f"{pointer}/{position}") for position, v in enumerate(values)]
        if field.is_unique:
            self._repeated(texts, pointer)
        return BROKEN if BROKEN in texts else texts

    def _item(self, field: Field, value: Any, pointer: str) -> Any:
        found = typed(field.kind, value)
        if found is BROKEN:
            self._tell(issue("ARRAY_TYPE_MISMATCH", pointer, value=shown(value), wanted=WANTED[field.kind]))
        return found

    def _repeated(self, items: list[Any], pointer: str) -> None:
        seen = set()
        for position, item in enumerate(items):
            if item in seen and item is not None and item is not BROKEN:
                self._tell(issue("DUPLICATE_ELEMENTS", f"{pointer}/{position}"))
            seen.add(item)

    def _map(self, field: Field, value: Any, entry: Entry) -> Any:
        pointer = entry.at(field.key)
        if not isinstance(value, dict):
            return self._mismatch(value, "an object", pointer)
        return self._index_map(value, pointer)

    def _maps(self, field: Field, value: Any, entry: Entry) -> Any:
        pointer = entry.at(field.key)
        if not isinstance(value, list):
            return self._mismatch(value, "an array", pointer)
        if not value:
            return self._wrong(("EMPTY_ENTITY", {}), pointer)
        has_others = self._has_others(value, pointer)
        maps = [
            self._index_map(item, f"{pointer}/{position}")
            for position, item in enumerate(value)
            if isinstance(item, dict)
        ]
        return BROKEN if has_others or BROKEN in maps else maps

    def _index_map(self, value: dict[str, Any], pointer: str) -> Any:
        if not value:
            return self._wrong(("EMPTY_ENTITY", {}), pointer)
        indices = {key: self._index(item, pointer, key) for key, item in value.items()}
        return {key: index for key, index in indices.items() if index is not None}

    def _mismatch(self, value: Any, wanted: str, pointer: str) -> Any:
        return self._wrong(("TYPE_MISMATCH", {"value": shown(value), "wanted": wanted}), pointer)

    def _wrong(self, complaint: tuple[str, dict[str, Any]], pointer: str) -> Any:
        code, told = complaint
        self._tell(issue(code, pointer, **told))
        return BROKEN


_READERS: dict[str, Callable[[Walk, Field, Any, Entry], Any]] = {
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
