"""The schema of arrays and maps: the walk's second half.

A wrong item breaks the array that holds it, with two exceptions: the arrays of the file itself and those of
indices live on without it, so that what refers to the other items stays right.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gltf_iri.asset.formats import COMPONENT_BYTES, FLOAT, TYPE_SHAPE
from gltf_iri.asset.words import shown
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import join
from gltf_iri.validation.schema.values import BROKEN, WANTED, complaint, typed

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.schema.walk import Walk
    from gltf_iri.validation.tables import Field

__all__ = ["ARRAYS"]


def _array(walk: Walk, field: Field, value: Any, entry: Entry) -> Any:
    pointer = entry.at(field.key)
    least, most = field.min_items, field.max_items
    if field.is_per_component:
        least = most = _components(entry)
        if not most:
            return BROKEN
    if not isinstance(value, list):
        return walk.mismatch(value, "an array", pointer)
    # Bounds of integers are told of by their number, however few there are.
    if not value and not (field.is_per_component and entry.raw["componentType"] != FLOAT):
        return walk.wrong(("EMPTY_ENTITY", {}), pointer)
    if most is not None and not least <= len(value) <= most:
        allowed = f"{least}" if least == most else f"up to {most}"
        return walk.wrong(("ARRAY_LENGTH_NOT_IN_LIST", {"length": len(value), "allowed": allowed}), pointer)
    return _ITEMS[field.kind](walk, field, value, pointer, entry)


def _components(accessor: Entry) -> int:
    """Return how many components an element has; 0 where type or component type do not say what one is."""
    kind, component = accessor.raw.get("type"), typed("INTEGER", accessor.raw.get("componentType"))
    if not isinstance(kind, str) or kind not in TYPE_SHAPE or component not in COMPONENT_BYTES:
        return 0
    columns, rows = TYPE_SHAPE[kind]
    return columns * rows


def _objects(walk: Walk, field: Field, values: list[Any], pointer: str, entry: Entry) -> Any:
    objects: list[Entry | None] = []
    if entry.parent is None:
        for position, value in enumerate(values):
            place = f"{pointer}/{position}"
            if isinstance(value, dict):
                objects.append(walk.object(field.table, value, place, entry))
            else:
                walk.mismatch(value, "an object", place)
                objects.append(None)
        return objects
    if _has_others(walk, values, pointer):
        return BROKEN
    for position, value in enumerate(values):
        objects.append(walk.object(field.table, value, f"{pointer}/{position}", entry))
    return objects


def _has_others(walk: Walk, values: list[Any], pointer: str) -> bool:
    """Tell whether the list holds anything but objects."""
    others = [value for value in values if not isinstance(value, dict)]
    for value in others:
        walk.tell(issue("ARRAY_TYPE_MISMATCH", pointer, value=shown(value), wanted="an object"))
    return bool(others)


def _indices(walk: Walk, field: Field, values: list[Any], pointer: str, entry: Entry) -> Any:
    indices = [_index(walk, value, pointer, position) for position, value in enumerate(values)]
    if field.is_unique:
        _tell_repeated(walk, indices, pointer)
    return indices


def _index(walk: Walk, value: Any, pointer: str, key: str | int) -> int | None:
    index = typed("INDEX", value)
    if index is BROKEN or index < 0:
        walk.tell(issue("INVALID_INDEX", join(pointer, key)))
        return None
    return int(index)


def _numbers(walk: Walk, field: Field, values: list[Any], pointer: str, entry: Entry) -> Any:
    if not field.has_range and _are_finite(values):
        return list(values)
    numbers = [_item(walk, field, value, pointer) for value in values]
    for position, number in enumerate(numbers):
        wrong = complaint(field, number) if number is not BROKEN else None
        if wrong is not None:
            numbers[position] = walk.wrong(wrong, f"{pointer}/{position}")
    return BROKEN if BROKEN in numbers else numbers


def _are_finite(values: list[Any]) -> bool:
    """Tell at once what is true of nearly every array of numbers."""
    try:
        return set(map(type, values)) <= {int, float} and all(map(math.isfinite, values))
    except OverflowError:  # an integer beyond the largest double
        return False


def _texts(walk: Walk, field: Field, values: list[Any], pointer: str, entry: Entry) -> Any:
    texts = [_item(walk, field, value, f"{pointer}/{position}") for position, value in enumerate(values)]
    if field.is_unique:
        _tell_repeated(walk, texts, pointer)
    return BROKEN if BROKEN in texts else texts


def _item(walk: Walk, field: Field, value: Any, pointer: str) -> Any:
    found = typed(field.kind, value)
    if found is BROKEN:
        walk.tell(issue("ARRAY_TYPE_MISMATCH", pointer, value=shown(value), wanted=WANTED[field.kind]))
    return found


def _tell_repeated(walk: Walk, items: list[Any], pointer: str) -> None:
    seen = set()
    for position, item in enumerate(items):
        if item in seen and item is not None and item is not BROKEN:
            walk.tell(issue("DUPLICATE_ELEMENTS", f"{pointer}/{position}"))
        seen.add(item)


def _map(walk: Walk, field: Field, value: Any, entry: Entry) -> Any:
    pointer = entry.at(field.key)
    if not isinstance(value, dict):
        return walk.mismatch(value, "an object", pointer)
    return _index_map(walk, value, pointer)


def _maps(walk: Walk, field: Field, value: Any, entry: Entry) -> Any:
    pointer = entry.at(field.key)
    if not isinstance(value, list):
        return walk.mismatch(value, "an array", pointer)
    if not value:
        return walk.wrong(("EMPTY_ENTITY", {}), pointer)
    has_others = _has_others(walk, value, pointer)
    maps = [
        _index_map(walk, item, f"{pointer}/{position}")
        for position, item in enumerate(value)
        if isinstance(item, dict)
    ]
    return BROKEN if has_others or BROKEN in maps else maps


def _index_map(walk: Walk, value: dict[str, Any], pointer: str) -> Any:
    if not value:
        return walk.wrong(("EMPTY_ENTITY", {}), pointer)
    indices = {key: _index(walk, item, pointer, key) for key, item in value.items()}
    return {key: index for key, index in indices.items() if index is not None}


# By the shape of a field; then, for arrays, by what their items are.
ARRAYS: dict[str, Callable[[Walk, Field, Any, Entry], Any]] = {
    "ARRAY": _array,
    "MAP": _map,
    "ARRAY_OF_MAPS": _maps,
}
_ITEMS: dict[str, Callable[[Walk, Field, list[Any], str, Entry], Any]] = {
    "OBJECT": _objects,
    "INDEX": _indices,
    "NUMBER": _numbers,
    "TEXT": _texts,
}
