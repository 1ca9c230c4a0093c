"""The schema: walks the parsed JSON by the tables, tells what does not fit, and keeps what does.

What is told here is said of one property alone; the rules see entries that hold nothing broken.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gltf_iri.asset.words import shown
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry, join
from gltf_iri.validation.schema.arrays import ARRAYS
from gltf_iri.validation.schema.values import BROKEN, WANTED, complaint, is_index, is_unlisted, typed
from gltf_iri.validation.schema.version import KNOWN, version_key
from gltf_iri.validation.tables import EXTENSIONS, TABLES, Field

if TYPE_CHECKING:
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
        self.tell = collector.add
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

    def let_go(self) -> None:
        """Take entries from those that they hold, so that all of them go when the last is asked for.

        Objects that hold each other would wait for Python to look for them, a large file's for long.
        """
        for entry in self.entries:
            entry.parent = None
        self.entries.clear()

    def object(
        self, table_name: str, raw: dict[str, Any], pointer: str = "", parent: Entry | None = None
    ) -> Entry:
        """Return the entry of the object `raw`; remarks go to the collector."""
        table = TABLES[table_name]
        fields = table.fields
        entry = Entry(table_name, pointer, raw, parent)
        # Of the parts that a "type" chooses from, the others are not looked at.
        unread = [part for part in table.parts if part != raw.get("type")]
        for key, value in raw.items():
            field = fields.get(key)
            if field is not None:
                if key not in unread:
                    self._property(entry, field, value)
            elif key == "extensions":
                self._extensions(entry, value)
            elif key == "extras":
                if value is not None and not isinstance(value, dict):
                    self.tell(issue("NON_OBJECT_EXTRAS", join(pointer, key)))
            else:
                self.tell(issue("UNEXPECTED_PROPERTY", join(pointer, key)))
        self._company(entry)
        self.entries.append(entry)
        return entry

    def _property(self, entry: Entry, field: Field, value: Any) -> None:
        if field.needs and field.kind == "INTEGER" and not is_index(entry.raw.get(field.needs)):
            # An offset into nothing is not looked at.
            self.tell(issue("UNSATISFIED_DEPENDENCY", entry.at(field.key), property=field.needs))
            return
        read = ARRAYS.get(field.shape)
        checked = self._one(field, value, entry) if read is None else read(self, field, value, entry)
        if checked is not BROKEN:
            entry[field.key] = checked
            if field.kind == "INDEX":
                self.references.append((entry, field))

    def _company(self, entry: Entry) -> None:
        """Tell of properties that are missing, and of those that must not stand together."""
        table, raw = TABLES[entry.table], entry.raw
        for key in table.required:
            if raw.get(key) is None:
                self.tell(issue("UNDEFINED_PROPERTY", entry.pointer or "/", property=key))
        for key, needs in table.needing:
            if key in entry and needs not in entry and not is_unlisted(table.fields[needs], raw.get(needs)):
                self.tell(issue("UNSATISFIED_DEPENDENCY", entry.at(key), property=needs))
        if table.one_of and sum(key in entry for key in table.one_of) != 1:
            self.tell(issue("ONE_OF_MISMATCH", entry.pointer, properties=" and ".join(table.one_of)))
        if len(table.parts) > 1:
            self._parts(entry, sorted(table.parts & raw.keys()))

    def _parts(self, entry: Entry, given: list[str]) -> None:
        """Tell of an object whose "type" names a part that is missing, or that has two parts."""
        named = entry.get("type")
        if len(given) > 1:
            self.tell(issue("ONE_OF_MISMATCH", entry.pointer, properties=" and ".join(given)))
        elif named is not None and entry.raw.get(named) is None:
            self.tell(issue("UNDEFINED_PROPERTY", entry.pointer, property=named))

    def _extensions(self, entry: Entry, value: Any) -> None:
        pointer = entry.at("extensions")
        if not isinstance(value, dict):
            self.mismatch(value, "an object", pointer)
            return
        for name, raw in value.items():
            place = join(pointer, name)
            if not isinstance(raw, dict):
                self.mismatch(raw, "an object", place)
            if name not in self.declared:
                self.tell(issue("UNDECLARED_EXTENSION", place))
            elif name in EXTENSIONS:
                table = EXTENSIONS[name].objects.get(entry.table)
                if table is None:
                    self.tell(issue("UNEXPECTED_EXTENSION_OBJECT", place))
                else:
                    # What is no object counts as an empty one, as for the Khronos validator.
                    stated = raw if isinstance(raw, dict) else {}
                    entry.carry(name, self.object(table, stated, place, entry))
        if len(value) > 1:
            for name in entry.extensions:
                if EXTENSIONS[name].stands_alone:
                    self.tell(issue("MULTIPLE_EXTENSIONS", join(pointer, name)))

    def _one(self, field: Field, value: Any, entry: Entry) -> Any:
        key = field.key
        if field.kind == "OBJECT":
            if isinstance(value, dict):
                return self.object(field.table, value, entry.at(key), entry)
            return self.mismatch(value, "an object", entry.at(key))
        found = typed(field.kind, value)
        if found is BROKEN:
            return self.mismatch(value, WANTED[field.kind], entry.at(key))
        wrong = complaint(field, found)
        if wrong is not None and found not in self._wider.get((entry.table, key), ()):
            return self.wrong(wrong, entry.at(key))
        if field.multiple_of and found % field.multiple_of:
            self.tell(issue("VALUE_MULTIPLE_OF", entry.at(key), value=found, factor=field.multiple_of))
        return found

    def mismatch(self, value: Any, wanted: str, pointer: str) -> Any:
        """Tell of a value of the wrong type; returns what stands for it."""
        return self.wrong(("TYPE_MISMATCH", {"value": shown(value), "wanted": wanted}), pointer)

    def wrong(self, complaint: tuple[str, dict[str, Any]], pointer: str) -> Any:
        """Tell of what `values.complaint` found; returns what stands for the value."""
        code, told = complaint
        self.tell(issue(code, pointer, **told))
        return BROKEN
