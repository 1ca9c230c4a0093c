"""The JSON of a file, read as far as it can be; what is wrong with it is told, never raised."""

from __future__ import annotations

import json
from itertools import accumulate
from typing import TYPE_CHECKING

from gltf_iri.asset.json_parts import BYTE_ORDER_MARK, ESCAPED_SURROGATE, Hooks, reason_of, too_deep_at
from gltf_iri.asset.limits import MAX_JSON_BYTES, MAX_JSON_DEPTH, MAX_JSON_OBJECTS, MAX_JSON_VALUES
from gltf_iri.asset.words import shown
from gltf_iri.validation.codes import issue
from gltf_iri.validation.entry import join
from gltf_iri.validation.reading import codes as _codes  # noqa: F401  # makes them known

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from typing import Any

    from gltf_iri.validation.issue import Issue

__all__ = ["read_json"]

# Pointers into deep trees are long, and whoever sees a hundred such remarks knows enough.
_MOST_TOLD = 100

# Each round of `_may_be_deep` takes one or two levels away, which nearly all files have no more of.
_ROUNDS = 8

_ALL_BUT_BRACKETS = bytes(byte for byte in range(256) if byte not in b"[]{}")
_STEPS = tuple((chr(byte) in "[{") - (chr(byte) in "]}") for byte in range(256))
_DIGITS_AS_ZEROS = bytes(ord("0") if chr(byte) in "0123456789" else 0 for byte in range(256))

# So many digits on end may be an integer that a double does not hold.
_LONG_INTEGER = b"0" * 16

# A way to a value: the way to what holds it, and the key there; None is the root.
_Way = tuple["_Way", "str | int"] | None


def read_json(given: bytes | memoryview, tell: Callable[[Issue], None]) -> dict[str, Any] | None:
    """Return the glTF object, or None where there is none; `tell` hears what is wrong.

    As for the Khronos validator, a byte order mark is told and what follows it is read, numbers beyond
    doubles are infinite, and of a key that stands twice the last value holds.
    """
    if len(given) > MAX_JSON_BYTES:
        tell(issue("IRI_JSON_TOO_LARGE", "", size=f"{len(given)} bytes", most=MAX_JSON_BYTES))
        return None
    data = bytes(given)  # the bytes themselves where they are no part of a GLB
    if data.startswith(BYTE_ORDER_MARK):
        tell(issue("INVALID_JSON", "", reason="it starts with a byte order mark"))
        data = data[len(BYTE_ORDER_MARK) :]
    if _is_beyond_limits(data, tell):
        return None
    try:
        text = data.decode()
    except UnicodeDecodeError as error:
        tell(issue("INVALID_JSON", "", reason=f"byte {error.start} is not UTF-8 ({error.reason})"))
        return None
    hooks = Hooks()
    has_long_integers = _LONG_INTEGER in data.translate(_DIGITS_AS_ZEROS)
    try:
        tree = json.loads(
            text,
            object_pairs_hook=hooks.object,
            parse_int=hooks.integer if has_long_integers else None,
            parse_constant=_refuse_constant,
        )
    except json.JSONDecodeError as error:
        reason = reason_of(error) if text.strip() else "there is nothing in it"
        tell(issue("INVALID_JSON", "", reason=reason))
        return None
    except ValueError as error:
        tell(issue("INVALID_JSON", "", reason=str(error)))
        return None
    except RecursionError:
        tell(_too_deep(too_deep_at(data) or 0))
        return None
    if not isinstance(tree, dict):
        tell(issue("TYPE_MISMATCH", "", value=shown(tree), wanted="an object"))
        return None
    if hooks.is_suspicious or ESCAPED_SURROGATE.search(text):
        for remark, _ in zip(_oddities(tree, hooks), range(_MOST_TOLD), strict=False):
            tell(remark)
    return tree


def _refuse_constant(word: str) -> Any:
    raise ValueError(f"it holds {word}, which JSON does not know")


def _is_beyond_limits(data: bytes, tell: Callable[[Issue], None]) -> bool:
    objects = data.count(b"{")
    if objects > MAX_JSON_OBJECTS:
        tell(issue("IRI_JSON_TOO_LARGE", "", size=f"about {objects} objects", most=MAX_JSON_OBJECTS))
        return True
    brackets = data.count(b"[") + objects
    values = brackets + data.count(b",")
    if values > MAX_JSON_VALUES:
        tell(issue("IRI_JSON_TOO_LARGE", "", size=f"about {values} values", most=MAX_JSON_VALUES))
        return True
    if brackets > MAX_JSON_DEPTH and _may_be_deep(data):
        place = too_deep_at(data)
        if place is not None:
            tell(_too_deep(place))
            return True
    return False


def _too_deep(place: int) -> Issue:
    return issue("IRI_JSON_TOO_DEEP", "", place=place, most=MAX_JSON_DEPTH)


def _may_be_deep(data: bytes) -> bool:
    """Tell whether a scan for depth is worth its time, by taking pairs of brackets away from inside out, and
    where many are left by counting them.

    Brackets within strings may make shallow JSON look deep, which the scan finds out, or deep JSON shallow,
    which the parser's own bound on recursion finds out.
    """
    brackets = left = data.translate(None, _ALL_BUT_BRACKETS)
    for _ in range(_ROUNDS):
        left = left.replace(b"[]", b"").replace(b"{}", b"")
        if not left:
            return False
    return max(accumulate(map(_STEPS.__getitem__, brackets))) > MAX_JSON_DEPTH


def _oddities(tree: dict[str, Any], hooks: Hooks) -> Iterator[Issue]:
    """Tell of keys that stand twice and of lone surrogates."""
    waiting: list[tuple[Any, _Way]] = [(tree, None)]
    while waiting:
        holder, way = waiting.pop()
        is_object = isinstance(holder, dict)
        twice = hooks.repeated(holder) if is_object else None
        if twice is not None:
            yield issue("IRI_DUPLICATE_KEY", _pointer((way, twice)))
        items: Iterable[tuple[Any, Any]] = holder.items() if is_object else enumerate(holder)
        for key, value in items:
            if is_object and _has_lone_surrogate(key):
                yield issue("IRI_LONE_SURROGATE", _pointer((way, key)))
            if isinstance(value, (dict, list)):
                waiting.append((value, (way, key)))
            elif isinstance(value, str) and _has_lone_surrogate(value):
                yield issue("IRI_LONE_SURROGATE", _pointer((way, key)))


def _has_lone_surrogate(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return True
    return False


def _pointer(way: _Way) -> str:
    keys = []
    while way is not None:
        way, key = way
        keys.append(key)
    pointer = ""
    for key in reversed(keys):
        pointer = join(pointer, key)
    return pointer
