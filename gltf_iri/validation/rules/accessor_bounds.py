"""The min and max of accessors: one number a component, each of the component type."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.formats import COMPONENT_NAMES, INTEGER_RANGES, TYPE_SHAPE
from gltf_iri.asset.words import shown
from gltf_iri.validation.asset import Asset
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import Entry
from gltf_iri.validation.issue import Issue

__all__ = ["bounds", "has_bounds"]

_BOUNDS = ("min", "max")


def bounds(accessor: Entry, asset: Asset) -> Iterator[Issue]:
    """Tell what is wrong with an accessor's min and max, and take out what cannot be a bound."""
    for key in _BOUNDS:
        faults = tuple(_faults(accessor, key))
        if faults:
            del accessor[key]
            yield from faults


def has_bounds(accessor: Entry) -> bool:
    """Whether the accessor has a min and a max that mean something; its own rules need not have run."""
    if "componentType" not in accessor or "type" not in accessor:
        return False
    return all(key in accessor and not any(_faults(accessor, key)) for key in _BOUNDS)


def _faults(accessor: Entry, key: str) -> Iterator[Issue]:
    values, component = accessor.get(key), accessor.get("componentType")
    if values is None or component is None or "type" not in accessor:
        return
    shape = TYPE_SHAPE[accessor["type"]]
    pointer, wanted = accessor.at(key), shape[0] * shape[1]
    if len(values) != wanted:
        yield issue("ARRAY_LENGTH_NOT_IN_LIST", pointer, length=len(values), allowed=wanted)
    elif component in INTEGER_RANGES:
        low, high = INTEGER_RANGES[component]
        for value in values:
            if value != int(value):
                yield issue("ARRAY_TYPE_MISMATCH", pointer, value=shown(value), wanted="an integer")
            elif not low <= value <= high:
                name = COMPONENT_NAMES[component]
                yield issue("INVALID_GL_VALUE", pointer, value=shown(value), type=name)
