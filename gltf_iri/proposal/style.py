"""Style: what every object and property of a schema states, as extensions/README.md and its schemas do."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from gltf_iri.asset.words import join, shown
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal
from gltf_iri.proposal.objects import (
    INHERITED,
    Kind,
    ObjectType,
    Property,
    extension_objects,
    texts,
    views,
)
from gltf_iri.proposal.schema_set import BASES, Target
from gltf_iri.proposal.schema_walk import subschemas

__all__ = ["descriptions", "objects", "openness", "ranges"]


def objects(proposal: Proposal) -> Iterator[Finding]:
    """Every object says that it is one, inherits glTFProperty, and lists extensions and extras."""
    for kind in _each_once(proposal):
        is_file = kind.pointer == ""
        if kind.file.is_stand_in:
            continue
        if not any(view.schema.get("type") == "object" for view in kind.views if not view.file.is_stand_in):
            yield Finding("type-object", 'it does not demand an object: add "type": "object"', kind.where)
        if not any(view.file.name in BASES for view in kind.views):
            told = "it does not inherit glTFProperty: add it to allOf"
            yield Finding("base-missing" if is_file else "base-missing-inside", told, kind.where)
        listed = {name for view in kind.views if not view.file.is_stand_in for name in _listed(view.schema)}
        if not listed >= INHERITED:
            told = f"it does not list {' and '.join(sorted(INHERITED - listed))} among its properties"
            yield Finding("members-missing", told, kind.where)


def _listed(schema: dict[str, Any]) -> dict[str, Any]:
    members = schema.get("properties")
    return members if isinstance(members, dict) else {}


def _each_once(proposal: Proposal) -> Iterator[ObjectType]:
    """Yield each object by the file that states it, however many places hold it."""
    seen = set()
    for kind in extension_objects(proposal):
        base = next(
            (view for view in kind.views if view.pointer == "" and not view.file.is_stand_in), kind.views[0]
        )
        key = (base.file.name, base.pointer)
        if key not in seen:
            seen.add(key)
            yield ObjectType(
                kind.scope, kind.path, base.file, base.pointer, views(proposal.schemas, base), kind.properties
            )


def descriptions(proposal: Proposal) -> Iterator[Finding]:
    """Every object and every property is described, and every property has a type."""
    for kind in _each_once(proposal):
        if kind.pointer == "" and not texts(kind.file.tree):
            yield Finding("description-missing-object", "it has no description", kind.where)
        for owner in kind.properties.values():
            if not _is_described(proposal, owner):
                told = f"the property {shown(owner.name)} has no description"
                yield Finding("description-missing", told, owner.where)
            if owner.kind is Kind.ANY and not _is_typed(owner):
                yield Finding("type-missing", f"the property {shown(owner.name)} has no type", owner.where)


def _is_described(proposal: Proposal, owner: Property) -> bool:
    """Look at the property, the folder's schemas that it refers to, and the items of an array."""
    held = list(owner.views)
    for view in owner.views:
        items = view.schema.get("items")
        if isinstance(items, dict):
            held += views(proposal.schemas, Target(view.file, join(view.pointer, "items"), items))
    return any(texts(view.schema) for view in held if not view.file.is_stand_in)


def _is_typed(owner: Property) -> bool:
    """Tell whether something else than a single type says what the value may be."""
    keywords = {keyword for view in owner.views for keyword in view.schema}
    return bool(keywords & {"type", "enum", "const", "anyOf", "oneOf"}) or any(
        view.file.is_stand_in for view in owner.views
    )


def openness(proposal: Proposal) -> Iterator[Finding]:
    """No object forbids additional properties."""
    for file in proposal.schemas.own.values():
        for place in subschemas(file.tree):
            for keyword in ("additionalProperties", "unevaluatedProperties"):
                if place.schema.get(keyword) is False:
                    told = f"it forbids additional properties: remove {keyword}"
                    yield Finding("closed-object", told, file.at(join(place.pointer, keyword)))


def ranges(proposal: Proposal) -> Iterator[Finding]:
    """Numbers have a range, or none on purpose; no range is empty."""
    for kind in _each_once(proposal):
        for owner in kind.properties.values():
            for pointer, schema in _numbers(owner):
                least, most = schema.get("minimum"), schema.get("maximum")
                if isinstance(least, int | float) and isinstance(most, int | float) and least > most:
                    told = f"the minimum {least} of {shown(owner.name)} is above its maximum {most}"
                    yield Finding("range-empty", told, owner.file.at(pointer))
                if not _is_bounded(schema):
                    told = f"{shown(owner.name)} has neither a minimum nor a maximum"
                    yield Finding("range-missing", told, owner.file.at(pointer))


def _numbers(owner: Property) -> Iterator[tuple[str, dict[str, Any]]]:
    """Yield the schemas of numbers in a property: its own, or an array's items'."""
    pointer, schema = owner.pointer, owner.schema
    while isinstance(schema.get("items"), dict):
        pointer, schema = join(pointer, "items"), schema["items"]
    if schema.get("type") in ("number", "integer"):
        yield pointer, schema


def _is_bounded(schema: dict[str, Any]) -> bool:
    bounds = {"minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum", "enum", "const"}
    alternatives = [
        member
        for keyword in ("anyOf", "oneOf", "allOf")
        if isinstance(schema.get(keyword), list)
        for member in schema[keyword]
        if isinstance(member, dict)
    ]
    return bool(schema.keys() & bounds) or any(member.keys() & bounds for member in alternatives)
