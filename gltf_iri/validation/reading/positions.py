"""JSON Pointers to lines: where in the text of a file its remarks stand."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING

from gltf_iri.validation.entry import join

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any

__all__ = ["lines_of"]

# A string, or what structures the text; numbers and words lie between. An unterminated string runs to the
# end, which keeps the scan linear for any input.
_TOKENS = re.compile(rb'"[^"\\]*+(?:\\.[^"\\]*+)*+"?|[\[\]{},]', re.DOTALL)
_SPACE = re.compile(rb"[ \t\r\n]*")

# The Khronos validator's name for the root where a property of it is missing.
_ROOT = "/"


class _Wanted:
    """A place that pointers lead to or through: the places below it, by token."""

    __slots__ = ("below", "pointer")

    def __init__(self) -> None:
        self.below: dict[str, _Wanted] = {}
        self.pointer: str | None = None


class _Open:
    """An object or array that is being read; `child` is what is wanted of its current value."""

    __slots__ = ("awaits_key", "child", "index", "is_object", "wanted")

    def __init__(self, wanted: _Wanted, *, is_object: bool) -> None:
        self.wanted = wanted
        self.is_object = is_object
        self.awaits_key = is_object
        self.index = 0
        self.child = None if is_object else wanted.below.get("0")


def lines_of(text: bytes, pointers: Iterable[str]) -> dict[str, int]:
    """Return the line, from 1, of each value that is there: of a property the line of its key.

    `text` may be broken anywhere: what cannot be found is left out. Of a key that stands twice, the last
    counts, as it does for its value.
    """
    asked = set(pointers)
    offsets = _offsets(text, _tree_of(asked))
    if _ROOT in asked:
        offsets.setdefault(_ROOT, offsets[""])
    if "" not in asked:
        del offsets[""]
    lines: dict[str, int] = {}
    line, seen = 1, 0
    for pointer, offset in sorted(offsets.items(), key=lambda found: found[1]):
        line += text.count(b"\n", seen, offset)
        lines[pointer], seen = line, offset
    return lines


def _tree_of(pointers: Iterable[str]) -> _Wanted:
    root = _Wanted()
    for pointer in pointers:
        place = root
        for token in pointer.split("/")[1:]:
            place = place.below.setdefault(token, _Wanted())
        place.pointer = pointer
    return root


def _offsets(text: bytes, root: _Wanted) -> dict[str, int]:
    space = _SPACE.match(text)
    found = {"": 0 if space is None else space.end()}
    if not root.below:
        return found
    opened: list[_Open] = []
    unwanted = 0  # how deep it is inside something that no pointer leads into
    for token in _TOKENS.finditer(text):
        start = token.start()
        kind = text[start : start + 1]
        inner = opened[-1] if opened else None
        if unwanted:
            unwanted += (kind in b"[{") - (kind in b"]}")
        elif kind in b"[{":
            wanted = root if inner is None else inner.child
            if wanted is None or not wanted.below:
                unwanted = 1
            else:
                opened.append(_Open(wanted, is_object=kind == b"{"))
                _note_item(opened[-1], text, token.end(), found)
        elif inner is None:
            break
        elif kind in b"]}":
            opened.pop()
        elif kind == b",":
            inner.index += 1
            inner.awaits_key = inner.is_object
            inner.child = None if inner.is_object else inner.wanted.below.get(str(inner.index))
            _note_item(inner, text, token.end(), found)
        elif inner.awaits_key:
            inner.awaits_key = False
            inner.child = _child(inner.wanted, token.group())
            _note(inner.child, start, found)
        if not opened and not unwanted:
            break
    return found


def _note_item(array: _Open, text: bytes, offset: int, found: dict[str, int]) -> None:
    """Note where an array's item begins, which is no token where it is a number."""
    if array.child is not None:
        place = _SPACE.match(text, offset)
        start = offset if place is None else place.end()
        if text[start : start + 1] not in (b"", b"]"):
            _note(array.child, start, found)


def _note(wanted: _Wanted | None, offset: int, found: dict[str, int]) -> None:
    if wanted is not None and wanted.pointer is not None:
        found[wanted.pointer] = offset


def _child(wanted: _Wanted, quoted: bytes) -> _Wanted | None:
    """Return what is wanted of the property whose key stands `quoted` in the text."""
    try:
        key: Any = json.loads(quoted)
    except ValueError:
        return None
    return wanted.below.get(join("", key)[1:])
