"""JSON as glTF allows it (glTF 2.0 §2.7.1, RFC 8259): one meaning for every reader, or an error.

UTF-8 without byte order mark, no NaN or infinity, no number that overflows, no repeated key, no half of a
surrogate pair, bounded size and depth. Size and depth are checked on the bytes, before the parser allocates
or recurses.
"""

from __future__ import annotations

import json
import math
import re
from typing import Any, Final

from gltf_iri.asset.limits import MAX_JSON_BYTES, MAX_JSON_DEPTH, MAX_JSON_INTEGER, MAX_JSON_VALUES
from gltf_iri.asset.words import join, shown
from gltf_iri.errors import AssetError

__all__ = ["parse_json"]

_BYTE_ORDER_MARK: Final = b"\xef\xbb\xbf"

# A string or a bracket. An unterminated string runs to the end, which keeps the scan linear for any input.
_STRINGS_AND_BRACKETS: Final = re.compile(rb'"[^"\\]*+(?:\\.[^"\\]*+)*+"?|[\[\]{}]', re.DOTALL)

_ESCAPED_SURROGATE: Final = re.compile(r"\\u[dD][89a-fA-F]")
_LONGEST_EXACT_INTEGER: Final = 16  # characters of 2**53, and of −999 999 999 999 999


def parse_json(data: bytes | memoryview, start: int = 0) -> Any:
    """Parse strict JSON; raise AssetError with the pointer (or byte offset) of what is wrong.

    `start` is where the text begins in its file; offsets in errors count from the beginning of the file.
    """
    try:
        text = _decoded(bytes(data) if isinstance(data, memoryview) else data)
    except AssetError as error:
        if error.offset is not None:
            error.offset += start
        raise
    hooks = _Hooks()
    try:
        tree = json.loads(
            text,
            object_pairs_hook=hooks.object,
            parse_float=hooks.number,
            parse_int=hooks.integer,
            parse_constant=hooks.number,
        )
    except json.JSONDecodeError as error:
        raise _broken(error, start) from error
    if hooks.is_suspicious or _ESCAPED_SURROGATE.search(text):
        hooks.refuse(tree, "")
    return tree


def _broken(error: json.JSONDecodeError, start: int) -> AssetError:
    if not error.doc.strip():
        return AssetError("there is no JSON, only blank space or nothing", offset=start)
    # The parser's remarks end in "at", for it goes on to name the place.
    reason = (error.msg[0].lower() + error.msg[1:]).removesuffix(" at").removesuffix(" starting")
    return AssetError(
        f"the JSON is broken in line {error.lineno}, column {error.colno}: {reason}",
        offset=start + len(error.doc[: error.pos].encode()),
    )


def _decoded(data: bytes) -> str:
    """Check size, depth and encoding, in that order, without building anything."""
    if len(data) > MAX_JSON_BYTES:
        raise AssetError(
            f"the JSON has {len(data)} bytes, more than the {MAX_JSON_BYTES} that are read; "
            "move embedded buffers and images into files of their own or write a .glb",
            pointer="",
        )
    if data.startswith(_BYTE_ORDER_MARK):
        raise AssetError("the JSON starts with a byte order mark; save it as UTF-8 without one", offset=0)
    brackets = data.count(b"[") + data.count(b"{")
    if brackets + data.count(b",") > MAX_JSON_VALUES:
        raise AssetError(
            f"the JSON has more than {MAX_JSON_VALUES} values, the most that are read", pointer=""
        )
    if brackets > MAX_JSON_DEPTH:
        _refuse_depth(data)
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        raise AssetError(f"the JSON is not UTF-8 ({error.reason})", offset=error.start) from error


def _refuse_depth(data: bytes) -> None:
    depth = 0
    for token in _STRINGS_AND_BRACKETS.finditer(data):
        first = token.group()[:1]
        if first in b"[{":
            depth += 1
            if depth > MAX_JSON_DEPTH:
                raise AssetError(
                    f"the JSON is nested deeper than {MAX_JSON_DEPTH} levels, the most that are read",
                    offset=token.start(),
                )
        elif first in b"]}":
            depth -= 1


class _Hooks:
    """Lets the parser finish and remembers what must not pass, so that the error can say where it stands."""

    def __init__(self) -> None:
        self.is_suspicious = False
        # Keeps each object with a repeated key alive, so that its id stays its own.
        self._repeated: dict[int, tuple[dict[str, Any], str]] = {}

    def object(self, pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        built = dict(pairs)
        if len(built) < len(pairs):
            seen: set[str] = set()
            for key, _ in pairs:
                if key in seen:
                    self._repeated[id(built)] = (built, key)
                    break
                seen.add(key)
            self.is_suspicious = True
        return built

    def number(self, text: str) -> float:
        value = float(text)
        if not math.isfinite(value):
            self.is_suspicious = True
        return value

    def integer(self, text: str) -> int | float:
        # Long ones become doubles: int() refuses thousands of digits, and no exact integer is that long.
        if len(text) > _LONGEST_EXACT_INTEGER:
            return self.number(text)
        value = int(text)
        return value if abs(value) <= MAX_JSON_INTEGER else float(value)

    def refuse(self, value: Any, pointer: str) -> None:
        """Raise for the first forbidden thing in document order; depth is bounded by MAX_JSON_DEPTH."""
        if isinstance(value, dict):
            if id(value) in self._repeated:
                key = self._repeated[id(value)][1]
                raise AssetError(f"the key {shown(key)} stands twice; keep one of them", pointer=pointer)
            for key, child in value.items():
                self.refuse(key, join(pointer, key))
                self.refuse(child, join(pointer, key))
        elif isinstance(value, list):
            for position, child in enumerate(value):
                self.refuse(child, join(pointer, position))
        elif isinstance(value, str):
            if any("\ud800" <= character <= "\udfff" for character in value):
                raise AssetError(
                    "the text holds half of a surrogate pair; write the character whole", pointer=pointer
                )
        elif isinstance(value, float) and not math.isfinite(value):
            raise AssetError("the number is not finite; JSON knows neither NaN nor infinity", pointer=pointer)
