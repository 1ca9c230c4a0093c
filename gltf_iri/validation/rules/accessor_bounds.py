"""The min and max of accessors of integers: numbers that the component type holds."""

from __future__ import annotations

from collections.abc import Iterator

from gltf_iri.asset.formats import COMPONENT_NAMES, INTEGER_RANGES
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
    return all(key in accessor and not any(_faults(accessor, key)) for key in _BOUNDS)


def _faults(accessor: Entry, key: str) -> Iterator[Issue]:
    component = accessor.get("componentType")
    if key not in accessor or component not in INTEGER_RANGES:
        return
    low, high = INTEGER_RANGES[component]
    for value in accessor[key]:
        if value != int(value):
            yield issue("ARRAY_TYPE_MISMATCH", accessor.at(key), value=shown(value), wanted="an integer")
        elif not low <= value <= high:
            name = COMPONENT_NAMES[component]
            yield issue("INVALID_GL_VALUE", accessor.at(key), value=shown(value), type=name)
