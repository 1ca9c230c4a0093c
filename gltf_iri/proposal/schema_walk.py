"""Where schemas stand inside schemas; a property called "items" is no keyword."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Final

from gltf_iri.asset.words import join
from gltf_iri.proposal.word_list import words

__all__ = ["IN_PLACE", "Place", "children", "subschemas"]

_ONE: Final = words(
    "additionalItems additionalProperties not if then else contains propertyNames unevaluatedItems "
    "unevaluatedProperties contentSchema"
)
_MANY: Final = frozenset({"allOf", "anyOf", "oneOf", "prefixItems"})
_NAMED: Final = words("properties patternProperties definitions $defs dependentSchemas dependencies")

# Their subschemas judge the same value again; all others judge a part of it.
IN_PLACE: Final = words("allOf anyOf oneOf not if then else dependentSchemas dependencies")


@dataclass(frozen=True)
class Place:
    """A subschema: its JSON Pointer in the file, and the keyword and the schema that it stands under."""

    pointer: str
    schema: dict[str, Any]
    keyword: str = ""
    parent: Mapping[str, Any] | None = None


def children(place: Place) -> Iterator[Place]:
    """Yield the schemas directly inside one; what is not an object is passed over."""
    schema = place.schema
    for keyword, value in schema.items():
        below = join(place.pointer, keyword)
        if keyword in _ONE or (keyword == "items" and isinstance(value, dict)):
            found = [(below, value)]
        elif (keyword in _MANY or keyword == "items") and isinstance(value, list):
            found = [(join(below, position), child) for position, child in enumerate(value)]
        elif keyword in _NAMED and isinstance(value, dict):
            found = [(join(below, name), child) for name, child in value.items()]
        else:
            continue
        for pointer, child in found:
            if isinstance(child, dict):
                yield Place(pointer, child, keyword, schema)


def subschemas(schema: dict[str, Any]) -> Iterator[Place]:
    """Yield a file's schema and all within it, in the order of the text; depth is bounded by the reader."""
    waiting = [Place("", schema)]
    while waiting:
        place = waiting.pop()
        yield place
        waiting.extend(reversed(list(children(place))))
