"""What an animation pointer leads to: a property of the glTF Object Model, found by the tables.

Source: glTF 2.0 Asset Object Model Specification, and KHR_animation_pointer, "Operation". A property is there
if the file states it, or if its object is there and the property has a default.
"""

from __future__ import annotations

from typing import Any

from gltf_iri.asset.limits import MAX_JSON_DEPTH
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.tables import EXTENSIONS, TABLES, Field, Table

__all__ = ["Target", "Unresolved", "resolve"]

# Object Model, "Core Pointers" and "KHR_lights_punctual": everything that can change stands below these.
_MUTABLE_ARRAYS = frozenset({"cameras", "materials", "meshes", "nodes", "extensions"})

# The same, second table: what a node's own place makes of its properties.
_READ_ONLY = frozenset({"matrix", "globalMatrix"})

# KHR_materials_volume states "+Infinity" as a default, which the tables' JSON has no number for.
_INFINITE = "attenuationDistance"

# No array of a file that can be read has an index of more digits.
_LONGEST_INDEX = 10


class Unresolved(Exception):  # noqa: N818  # an answer of this module's own search, which `resolve` catches
    """The pointer leads nowhere, or to what cannot change; `reason` says why."""

    def __init__(self, code: str, reason: str) -> None:
        super().__init__(reason)
        self.code = code
        self.reason = reason


class Target:
    """What a pointer leads to.

    tokens : the pointer's parts, unescaped; two pointers with the same ones are the same.
    field : the property's row; None in extras and in extensions without tables, of which nothing is known.
    size : how many components one value has.
    length : how many values an array has (the weights of morph targets); 0 for what is no array.
    holder : the object that has the property, as the file has it.
    """

    __slots__ = ("field", "holder", "length", "size", "tokens")

    def __init__(
        self,
        tokens: tuple[str, ...],
        field: Field | None = None,
        *,
        size: int = 1,
        length: int = 0,
        holder: dict[str, Any] | None = None,
    ) -> None:
        self.tokens = tokens
        self.field = field
        self.size = size
        self.length = length
        self.holder = holder or {}


def resolve(root: Entry, pointer: str) -> Target | Unresolved:
    """Return what the JSON Pointer `pointer` leads to in the file of `root`, or why it leads nowhere."""
    if pointer.count("/") > MAX_JSON_DEPTH:
        return Unresolved("IRI_POINTER_UNDEFINED", "nothing in a file is nested so deep")
    tokens = tuple(token.replace("~1", "/").replace("~0", "~") for token in pointer.split("/")[1:])
    try:
        return _Search(root.raw, tokens).target()
    except Unresolved as reason:
        return reason.with_traceback(None)  # whose frames would be kept with it


class _Search:
    """One way down the file, a token at a time."""

    def __init__(self, root: dict[str, Any], tokens: tuple[str, ...]) -> None:
        self._root = root
        self._tokens = tokens
        self._at = 0

    def target(self) -> Target:
        table, raw = TABLES["glTF"], self._root
        while True:
            key = self._next("it ends at an object, not at a property")
            if key == "extensions":
                name = self._next("it names no extension")
                raw = _inside(_inside(raw, "extensions"), name)
                carried = EXTENSIONS[name].objects.get(table.name) if name in EXTENSIONS else None
                if carried is None:
                    return Target(self._tokens)
                table = TABLES[carried]
                continue
            if key == "extras":
                return self._extra(_inside(raw, key))
            field = table.fields.get(key)
            if field is None:
                raise _unknown(table, key)
            if field.kind != "OBJECT":
                return self._property(table, field, raw)
            value = raw.get(key)
            if field.shape == "ONE":
                raw = _inside(raw, key)
            else:
                raw = _item(value, self._next("it ends at an array"), key)
            table = TABLES[field.table]

    def _next(self, missing: str) -> str:
        if self._at == len(self._tokens):
            raise Unresolved("IRI_POINTER_NOT_MUTABLE", missing)
        self._at += 1
        return self._tokens[self._at - 1]

    def _property(self, table: Table, field: Field, raw: dict[str, Any]) -> Target:
        rest = self._tokens[self._at :]
        if not _is_mutable(table, field) or self._tokens[0] not in _MUTABLE_ARRAYS:
            raise Unresolved("IRI_POINTER_NOT_MUTABLE", "the Object Model does not let it change")
        if field.shape == "ARRAY" and field.max_items is None:
            return self._weights(field, raw, rest)
        if rest:
            raise Unresolved("IRI_POINTER_UNDEFINED", f"{field.key} is one value, and has no parts")
        if field.key not in raw and field.default is None and field.key != _INFINITE:
            raise Unresolved("IRI_POINTER_UNDEFINED", f"{field.key} is not stated, and has no default")
        return Target(self._tokens, field, size=field.max_items or 1, holder=raw)

    def _weights(self, field: Field, raw: dict[str, Any], rest: tuple[str, ...]) -> Target:
        """Return the weights of a mesh or node, or one of them: as many as the mesh has morph targets."""
        stated = raw.get(field.key)
        count = self._morph_targets(raw) or (len(stated) if isinstance(stated, list) else 0)
        if count == 0:
            raise Unresolved("IRI_POINTER_UNDEFINED", "there are no morph targets")
        if not rest:
            return Target(self._tokens, field, length=count, holder=raw)
        if len(rest) > 1 or _index(rest[0]) >= count:
            raise Unresolved("IRI_POINTER_UNDEFINED", "it is beyond the last weight")
        return Target(self._tokens, field, holder=raw)

    def _morph_targets(self, raw: dict[str, Any]) -> int:
        mesh = raw
        if self._tokens[0] == "nodes":
            meshes: Any = self._root.get("meshes")
            index: Any = raw.get("mesh")
            is_there = (
                isinstance(meshes, list) and isinstance(index, int | float) and 0 <= index < len(meshes)
            )
            mesh = meshes[int(index)] if is_there else {}
        primitives = mesh.get("primitives") if isinstance(mesh, dict) else None
        first = primitives[0] if isinstance(primitives, list) and primitives else None
        targets = first.get("targets") if isinstance(first, dict) else None
        return len(targets) if isinstance(targets, list) else 0

    def _extra(self, value: Any) -> Target:
        """Follow a pointer into extras: values there need only be there."""
        for token in self._tokens[self._at :]:
            if isinstance(value, dict) and token in value:
                value = value[token]
            elif isinstance(value, list) and _index(token) < len(value):
                value = value[_index(token)]
            else:
                raise Unresolved("IRI_POINTER_UNDEFINED", "the extras have nothing there")
        return Target(self._tokens)


def _is_mutable(table: Table, field: Field) -> bool:
    """Numbers can change, and so can the switches of extensions; counts, UV sets and choices cannot."""
    if field.kind == "NUMBER":
        return field.key not in _READ_ONLY
    return field.kind == "FLAG" and table.name in EXTENSIONS


def _unknown(table: Table, key: str) -> Unresolved:
    if key.endswith(".length") or (table.name == "node" and key in _READ_ONLY):
        return Unresolved("IRI_POINTER_NOT_MUTABLE", "it follows from the rest, and can only be read")
    return Unresolved("IRI_POINTER_UNDEFINED", "glTF has no such property there")


def _inside(raw: Any, key: str) -> Any:
    if isinstance(raw, dict) and isinstance(raw.get(key), dict):
        return raw[key]
    raise Unresolved("IRI_POINTER_UNDEFINED", "an object on the way is missing")


def _item(values: Any, token: str, key: str) -> dict[str, Any]:
    count = len(values) if isinstance(values, list) else 0
    index = _index(token)
    if index >= count or not isinstance(values[index], dict):
        raise Unresolved("IRI_POINTER_UNDEFINED", f"{key!r} ends before it")
    found: dict[str, Any] = values[index]
    return found


def _index(token: str) -> int:
    """Return the index that a token means, one beyond every array where it means none (RFC 6901 §4)."""
    is_number = token.isascii() and token.isdigit() and len(token) <= _LONGEST_INDEX
    return int(token) if is_number and (token == "0" or token[0] != "0") else 10**_LONGEST_INDEX
