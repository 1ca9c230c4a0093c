"""What strict and lenient readers of JSON share: a scan for depth, hooks that remember, words for faults."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING

from gltf_iri.asset.limits import MAX_JSON_DEPTH, MAX_JSON_INTEGER

if TYPE_CHECKING:
    from json import JSONDecodeError
    from typing import Any, Final

__all__ = ["BYTE_ORDER_MARK", "ESCAPED_SURROGATE", "Hooks", "reason_of", "too_deep_at"]

BYTE_ORDER_MARK: Final = b"\xef\xbb\xbf"

# Either half of a surrogate pair, written as an escape; most are whole pairs.
ESCAPED_SURROGATE: Final = re.compile(r"\\u[dD][89a-fA-F]")

# A string or a bracket. An unterminated string runs to the end, which keeps the scan linear for any input.
_STRINGS_AND_BRACKETS: Final = re.compile(rb'"[^"\\]*+(?:\\.[^"\\]*+)*+"?|[\[\]{}]', re.DOTALL)

# Objects whose repeated key is remembered: whoever hears of so many knows enough.
_MOST_REPEATED: Final = 10_000

_LONGEST_EXACT_INTEGER: Final = 16  # characters of 2**53, and of −999 999 999 999 999


def too_deep_at(data: bytes) -> int | None:
    """Return the place of the first bracket that nests deeper than MAX_JSON_DEPTH, if there is one."""
    depth = 0
    for token in _STRINGS_AND_BRACKETS.finditer(data):
        first = token.group()[:1]
        if first in b"[{":
            depth += 1
            if depth > MAX_JSON_DEPTH:
                return token.start()
        elif first in b"]}":
            depth -= 1
    return None


def reason_of(error: JSONDecodeError) -> str:
    """Say where the text broke, and why."""
    # The parser's remarks end in "at", for it goes on to name the place.
    reason = (error.msg[0].lower() + error.msg[1:]).removesuffix(" at").removesuffix(" starting")
    return f"line {error.lineno}, column {error.colno}: {reason}"


class Hooks:
    """Lets the parser finish and remembers what a reader may want to refuse or to tell.

    is_suspicious : a key stood twice, or a number is not finite.
    """

    def __init__(self) -> None:
        self.is_suspicious = False
        # Keeps each object with a repeated key alive, so that its id stays its own.
        self._repeated: dict[int, tuple[dict[str, Any], str]] = {}

    def object(self, pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        """Build an object; of a key that stands twice the last value holds."""
        built = dict(pairs)
        if len(built) < len(pairs):
            self.is_suspicious = True
            if len(self._repeated) == _MOST_REPEATED:
                return built
            seen: set[str] = set()
            for key, _ in pairs:
                if key in seen:
                    self._repeated[id(built)] = (built, key)
                    break
                seen.add(key)
        return built

    def number(self, text: str) -> float:
        """Read a number that may be infinite, or NaN."""
        value = float(text)
        if not math.isfinite(value):
            self.is_suspicious = True
        return value

    def integer(self, text: str) -> int | float:
        """Read an integer, as a double where no exact integer is that long: int() refuses 4301 digits."""
        if len(text) > _LONGEST_EXACT_INTEGER:
            return self.number(text)
        value = int(text)
        return value if abs(value) <= MAX_JSON_INTEGER else float(value)

    def repeated(self, value: dict[str, Any]) -> str | None:
        """Return the first key that stood twice in an object of the tree."""
        found = self._repeated.get(id(value))
        return None if found is None else found[1]
