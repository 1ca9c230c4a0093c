"""An object of the file after its schema was checked: what it holds can be used without asking again."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

__all__ = ["Entry", "join"]

# Longer names are cut in pointers: a million remarks on a key of a megabyte must not take a terabyte.
_LONGEST_TOKEN = 1000

# One for all: hardly any object has extensions, and a dict each would be a fifth of a million objects.
_NO_EXTENSIONS: Mapping[str, Entry] = MappingProxyType({})


class Entry(dict[str, Any]):
    """Those properties of a JSON object that have the type and range that glTF states; all others are absent.

    Objects inside are entries again, arrays of objects and of indices hold None where an item is broken.
    After the links are checked, an index is one that exists.

    table : name of the object's table, such as "mesh.primitive".
    pointer : JSON Pointer of the object.
    raw : the object as the file has it.
    parent : the entry that holds this one, directly or in an array; of an extension, its carrier.
    extensions : the extension objects that are known and stand where they may, by name; see `carry`.
    is_used : something refers to it.
    """

    __slots__ = ("extensions", "is_used", "parent", "pointer", "raw", "table")

    def __init__(self, table: str, pointer: str, raw: dict[str, Any], parent: Entry | None) -> None:
        self.table = table
        self.pointer = pointer
        self.raw = raw
        self.parent = parent
        self.extensions: Mapping[str, Entry] = _NO_EXTENSIONS
        self.is_used = False

    # Two objects of a file are never the same, whatever they hold.
    def __hash__(self) -> int:  # type: ignore[override]
        return id(self)

    def __eq__(self, other: object) -> bool:
        return self is other

    def carry(self, name: str, extension: Entry) -> None:
        """Add one of its extension objects."""
        if not isinstance(self.extensions, dict):
            self.extensions = {}
        self.extensions[name] = extension

    def at(self, *keys: str | int) -> str:
        """Return the pointer of a value inside this object."""
        pointer = self.pointer
        for key in keys:
            pointer = join(pointer, key)
        return pointer


def join(pointer: str, key: str | int) -> str:
    """Append one token to a JSON Pointer (RFC 6901)."""
    if isinstance(key, int):
        return f"{pointer}/{key}"
    if len(key) > _LONGEST_TOKEN:
        key = f"{key[:_LONGEST_TOKEN]}…"
    return f"{pointer}/{key.replace('~', '~0').replace('/', '~1')}"
