"""JSON as glTF allows it (glTF 2.0 §2.7, RFC 8259): one meaning for every reader, or an error.

UTF-8 without byte order mark, no NaN or infinity, no number that overflows, no repeated key, no half of a
surrogate pair, bounded size and depth. Size and depth are checked on the bytes, before the parser allocates
or recurses.
"""

from __future__ import annotations

import json
import math
from typing import Any

from gltf_iri.asset.json_parts import BYTE_ORDER_MARK, ESCAPED_SURROGATE, Hooks, reason_of, too_deep_at
from gltf_iri.asset.limits import MAX_JSON_BYTES, MAX_JSON_DEPTH, MAX_JSON_VALUES
from gltf_iri.asset.words import join, shown
from gltf_iri.errors import AssetError

__all__ = ["parse_json"]


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
    hooks = Hooks()
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
    if hooks.is_suspicious or ESCAPED_SURROGATE.search(text):
        _refuse(tree, "", hooks)
    return tree


def _broken(error: json.JSONDecodeError, start: int) -> AssetError:
    if not error.doc.strip():
        return AssetError("there is no JSON, only blank space or nothing", offset=start)
    offset = start + len(error.doc[: error.pos].encode())
    return AssetError(f"the JSON is broken in {reason_of(error)}", offset=offset)


def _decoded(data: bytes) -> str:
    """Check size, depth and encoding, in that order, without building anything."""
    if len(data) > MAX_JSON_BYTES:
        raise AssetError(
            f"the JSON has {len(data)} bytes, more than the {MAX_JSON_BYTES} that are read; "
            "move embedded buffers and images into files of their own or write a .glb",
            pointer="",
        )
    if data.startswith(BYTE_ORDER_MARK):
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
    offset = too_deep_at(data)
    if offset is not None:
        raise AssetError(
            f"the JSON is nested deeper than {MAX_JSON_DEPTH} levels, the most that are read", offset=offset
        )


def _refuse(value: Any, pointer: str, hooks: Hooks) -> None:
    """Raise for the first forbidden thing in document order; depth is bounded by MAX_JSON_DEPTH."""
    if isinstance(value, dict):
        key = hooks.repeated(value)
        if key is not None:
            raise AssetError(f"the key {shown(key)} stands twice; keep one of them", pointer=pointer)
        for key, child in value.items():
            _refuse(key, join(pointer, key), hooks)
            _refuse(child, join(pointer, key), hooks)
    elif isinstance(value, list):
        for position, child in enumerate(value):
            _refuse(child, join(pointer, position), hooks)
    elif isinstance(value, str):
        if any("\ud800" <= character <= "\udfff" for character in value):
            raise AssetError(
                "the text holds half of a surrogate pair; write the character whole", pointer=pointer
            )
    elif isinstance(value, float) and not math.isfinite(value):
        raise AssetError("the number is not finite; JSON knows neither NaN nor infinity", pointer=pointer)
