"""The objects that an extension defines, with their properties, as tables and pointers speak of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from typing import Any

from gltf_iri.asset.words import join
from gltf_iri.proposal.bounds import MAX_EXPANSION, MAX_OBJECTS
from gltf_iri.proposal.folder import Proposal, scope_of
from gltf_iri.proposal.schema_set import TEXTURES, DanglingError, SchemaFile, SchemaSet, Target

__all__ = ["INHERITED", "Kind", "ObjectType", "Property", "extension_objects"]
__all__ += ["item_kind", "texts", "views"]

# Members that every object of glTF has.
INHERITED = frozenset({"extensions", "extras"})


class Kind(Enum):
    """What a value is; the words are those of the README's tables."""

    NUMBER = "number"
    INTEGER = "integer"
    BOOLEAN = "boolean"
    STRING = "string"
    TEXTURE = "textureInfo"
    OBJECT = "object"
    ARRAY = "array"
    ANY = "any"


@dataclass(frozen=True)
class Property:
    """A property: where it is stated, and every schema that its value must satisfy."""

    name: str
    file: SchemaFile
    pointer: str
    schema: dict[str, Any]
    views: tuple[Target, ...]
    is_required: bool

    @property
    def where(self) -> str:
        """The place of its schema."""
        return self.file.at(self.pointer)

    def first(self, keyword: str) -> Any:
        """Return the first value of a keyword among the views, None where none has it."""
        return next((view.schema[keyword] for view in self.views if keyword in view.schema), None)

    @cached_property
    def kind(self) -> Kind:
        """What its value is."""
        return _kind(self.views)

    @property
    def length(self) -> int | None:
        """How many items an array has, None where that is not fixed."""
        least, most = self.first("minItems"), self.first("maxItems")
        return least if least == most and isinstance(least, int) else None

    @property
    def texture_file(self) -> str:
        """The file name of the kind of texture reference that it is, or ""."""
        names = [view.file.name for view in self.views if view.file.name in TEXTURES]
        return names[0] if names else ""


@dataclass(frozen=True)
class ObjectType:
    """An object that the extension defines: the extension's own (`path` is empty), or one inside another.

    `path` are the steps from the extension's object, ``{}`` for an item of an array.
    """

    scope: str
    path: tuple[str, ...]
    file: SchemaFile
    pointer: str
    views: tuple[Target, ...]
    properties: Mapping[str, Property]

    @property
    def where(self) -> str:
        """The place of its schema."""
        return self.file.at(self.pointer)

    @property
    def label(self) -> str:
        """What people read for it."""
        return "/".join(self.path) or f"the extension's object ({self.file.name})"


def views(schemas: SchemaSet, target: Target) -> tuple[Target, ...]:
    """Return a schema and all that hold with it, through ``$ref`` and ``allOf``, each once."""
    found: dict[tuple[str, str], Target] = {}
    waiting = [target]
    while waiting and len(found) < MAX_EXPANSION:
        now = waiting.pop()
        key = (now.file.name, now.pointer)
        if key in found:
            continue
        found[key] = now
        inside: list[Target] = []
        if "$ref" in now.schema:
            with suppress(DanglingError):  # another finding tells of it
                inside.append(schemas.find(now.file, now.pointer, now.schema["$ref"]))
        members = now.schema.get("allOf")
        for position, member in enumerate(members if isinstance(members, list) else []):
            if isinstance(member, dict):
                inside.append(Target(now.file, join(join(now.pointer, "allOf"), position), member))
        waiting.extend(reversed(inside))
    return tuple(found.values())


def texts(schema: Mapping[str, Any]) -> str:
    """Return what a schema says of itself to people."""
    told = (schema.get("description"), schema.get("gltf_detailedDescription"))
    return " ".join(text for text in told if isinstance(text, str))


def extension_objects(proposal: Proposal) -> list[ObjectType]:
    """Return the objects of every entry, outermost first; what contains itself is followed once."""
    found: list[ObjectType] = []
    for entry in proposal.entries:
        scope = scope_of(entry, proposal.name)
        waiting: list[tuple[tuple[str, ...], Target, frozenset[tuple[str, str]]]]
        waiting = [((), Target(entry, "", entry.tree), frozenset[tuple[str, str]]())]
        while waiting and len(found) < MAX_OBJECTS:
            path, target, seen = waiting.pop(0)
            key = (target.file.name, target.pointer)
            if key in seen:
                continue
            kind = _object(proposal.schemas, scope, path, target)
            found.append(kind)
            for name, inner in kind.properties.items():
                for step, inside in _inside(proposal.schemas, inner):
                    waiting.append(((*path, name, *step), inside, seen | {key}))
    return found


def _object(schemas: SchemaSet, scope: str, path: tuple[str, ...], target: Target) -> ObjectType:
    seen = views(schemas, target)
    own = [view for view in seen if not view.file.is_stand_in]
    required = {
        name
        for view in seen
        if isinstance(view.schema.get("required"), list)
        for name in view.schema["required"]
        if isinstance(name, str)
    }
    inherited = {name for view in seen if view.file.is_stand_in for name in _members(view)}
    properties: dict[str, Property] = {}
    for view in own:
        for name, schema in _members(view).items():
            redeclared = not schema and name in inherited
            if name in INHERITED or redeclared or name in properties or not isinstance(schema, dict):
                continue
            pointer = join(join(view.pointer, "properties"), name)
            held = views(schemas, Target(view.file, pointer, schema))
            properties[name] = Property(name, view.file, pointer, schema, held, name in required)
    return ObjectType(scope, path, target.file, target.pointer, seen, properties)


def _members(view: Target) -> dict[str, Any]:
    members = view.schema.get("properties")
    return members if isinstance(members, dict) else {}


def _inside(schemas: SchemaSet, owner: Property) -> Iterator[tuple[tuple[str, ...], Target]]:
    """Yield the objects that a property holds: itself, or the items of an array, each with its steps."""
    if owner.kind is Kind.OBJECT and any(_members(v) for v in owner.views if not v.file.is_stand_in):
        yield (), Target(owner.file, owner.pointer, owner.schema)
    if owner.kind is Kind.ARRAY:
        for view in owner.views:
            items = view.schema.get("items")
            if isinstance(items, dict):
                target = Target(view.file, join(view.pointer, "items"), items)
                held = views(schemas, target)
                if _kind(held) is Kind.OBJECT and any(_members(v) for v in held if not v.file.is_stand_in):
                    yield ("{}",), target
                return


def item_kind(schemas: SchemaSet, owner: Property) -> Kind:
    """Return what the items of an array are; ANY where that is not stated."""
    for view in owner.views:
        items = view.schema.get("items")
        if isinstance(items, dict):
            return _kind(views(schemas, Target(view.file, join(view.pointer, "items"), items)))
    return Kind.ANY


def _kind(held: tuple[Target, ...]) -> Kind:
    if any(view.file.name in TEXTURES for view in held):
        return Kind.TEXTURE
    for view in held:
        named = view.schema.get("type")
        if isinstance(named, str) and named in Kind._value2member_map_:
            return Kind(named)
    if any("properties" in view.schema for view in held):
        return Kind.OBJECT
    return Kind.ANY
