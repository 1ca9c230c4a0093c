"""One value of the file: whether it has the type, range or form that its row states."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gltf_iri.asset.words import shown

if TYPE_CHECKING:
    from gltf_iri.validation.tables import Field

__all__ = ["BROKEN", "WANTED", "complaint", "interval", "is_index", "is_unlisted", "typed"]

# Stands for a value that was told of already.
BROKEN: Any = object()

WANTED = {
    "INTEGER": "an integer",
    "INDEX": "an index",
    "NUMBER": "a number",
    "FLAG": "true or false",
    "TEXT": "text",
    "OBJECT": "an object",
}


def typed(kind: str, value: Any) -> Any:
    """Return the value where it has the type of `kind`, else BROKEN; 1.0 is an integer, as it is for JSON."""
    if kind == "TEXT":
        return value if isinstance(value, str) else BROKEN
    if type(value) is int and kind != "FLAG":
        return value
    if kind == "FLAG":
        return value if isinstance(value, bool) else BROKEN
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return BROKEN
    if kind == "NUMBER" or isinstance(value, int):
        return value
    return int(value) if math.isfinite(value) and value == int(value) else BROKEN


def complaint(field: Field, value: Any) -> tuple[str, dict[str, Any]] | None:
    """Return code and numbers of what is wrong with a value of the right type; None where nothing is."""
    kind = field.kind
    if kind == "INDEX":
        return ("INVALID_INDEX", {}) if value < 0 else None
    if field.choices:
        if value in field.choices:
            return None
        # A list that counts from 0 is a range, and what lies outside is an error.
        if field.choices[0] == 0:
            return "VALUE_NOT_IN_RANGE", {"value": shown(value), "range": f"[0, {field.choices[-1]}]"}
        listed = ", ".join(map(str, field.choices))
        return "VALUE_NOT_IN_LIST", {"value": shown(value), "allowed": listed}
    if kind == "TEXT":
        if field.pattern is None or field.pattern.fullmatch(value):
            return None
        return "PATTERN_MISMATCH", {"value": shown(value), "pattern": field.pattern.pattern}
    if kind == "FLAG" or _is_in_range(field, value):
        return None
    return "VALUE_NOT_IN_RANGE", {"value": shown(value), "range": interval(field)}


def is_index(value: Any) -> bool:
    """Tell whether the value could refer to something."""
    index = typed("INDEX", value)
    return index is not BROKEN and index >= 0


def is_unlisted(field: Field, value: Any) -> bool:
    """Tell whether a text that was told of is only none of those known: it is there, whatever it means."""
    return field.kind == "TEXT" and bool(field.choices) and isinstance(value, str)


def _is_in_range(field: Field, value: float) -> bool:
    if not field.has_range:
        return -math.inf < value < math.inf
    if value == field.also_allowed:
        return True
    if field.low is not None and (value < field.low or (field.low_is_excluded and value == field.low)):
        return False
    # Written so that NaN fails; a comparison, unlike math.isfinite, takes integers of any size.
    return -math.inf < value < math.inf if field.high is None else value <= field.high


def interval(field: Field) -> str:
    """Return the legal numbers of a field as people write them, such as "[1, ∞)"."""
    low = "(−∞" if field.low is None else f"{'(' if field.low_is_excluded else '['}{field.low:g}"
    return f"{low}, {'∞)' if field.high is None else f'{field.high:g}]'}"
