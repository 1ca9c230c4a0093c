"""Breaks files at random: their bytes, the values in their JSON, and the shape of it."""

from __future__ import annotations

import copy
import json
import random
import re
from collections.abc import Iterator
from typing import Any, Final

__all__ = ["break_bytes", "break_gltf"]

# Values that a reader may trip over: negative, huge, tiny, fractional, of another type, legal elsewhere.
_VALUES: Final[tuple[Any, ...]] = (
    *(None, True, -1, 0, 1, 2, 3, 99, 2**20, 2**32, 1.5, -0.0, 1e38, 1e-40, "x", [], {}, [0], [0, 0, 0]),
    *(5121, 5123, 5126, "SCALAR", "VEC3", "MAT2", "MAT4", [1e38] * 3, {"index": 0}),
)
_TOKENS: Final = (
    *(b"-1", b"0", b"1", b"99", b"65536", b"4294967296", b"1.5", b"1e999", b"1e308", b"1e-320", b"-0.0"),
    *(b"NaN", b"null", b"true", b"[]", b"{}", b'"x"', b"5126", b'"MAT4"', b'"VEC3"'),
)
_KEYS: Final = (
    *("mesh", "skin", "camera", "children", "weights", "matrix", "scale", "sparse", "indices", "targets"),
    *("bufferView", "byteOffset", "byteStride", "count", "extensions", "normalized", "material", "mode"),
)
_SCALAR: Final = re.compile(rb'(?<=[:\[,])\s*(-?\d[\d.eE+-]*|"[^"]{0,40}"|true|false)')
_GLB_JSON: Final = 20  # where the JSON of a GLB begins: 12 bytes of header, 8 of the chunk's


def break_gltf(data: bytes, chance: random.Random, *, is_glb: bool) -> bytes:
    """Return a .gltf or .glb file with broken JSON (chunk lengths kept true) or, less often, broken bytes."""
    if chance.random() < 0.2:
        return break_bytes(data, chance)
    break_json = _break_tree if chance.random() < 0.65 else _break_token
    if not is_glb:
        return break_json(data, chance)
    length = int.from_bytes(data[12:16], "little")
    text, rest = break_json(data[_GLB_JSON : _GLB_JSON + length], chance), data[_GLB_JSON + length :]
    text += b" " * (-len(text) % 4)
    total = (_GLB_JSON + len(text) + len(rest)).to_bytes(4, "little")
    return data[:8] + total + len(text).to_bytes(4, "little") + data[16:20] + text + rest


def break_bytes(data: bytes, chance: random.Random) -> bytes:
    """Return `data` with bytes flipped, filled, cut off or repeated."""
    if not data:
        return b"x"
    broken = bytearray(data)
    at, kind = chance.randrange(len(broken)), chance.random()
    if kind < 0.6:
        for _ in range(chance.choice([1, 1, 4, 30])):
            broken[chance.randrange(len(broken))] = chance.randrange(256)
    elif kind < 0.75:
        del broken[at:]
    elif kind < 0.9:
        end = min(len(broken), at + chance.randrange(1, 64))
        broken[at:end] = bytes([chance.choice([0, 255, chance.randrange(256)])]) * (end - at)
    else:
        source = chance.randrange(len(broken))
        broken[at:at] = broken[source : source + chance.randrange(1, 100)]
    return bytes(broken)


def _break_token(text: bytes, chance: random.Random) -> bytes:
    """Replace one number, string or truth value in the text, also by what no writer of JSON writes."""
    found = list(_SCALAR.finditer(text))
    if not found:
        return text
    match = chance.choice(found)
    return text[: match.start(1)] + chance.choice(_TOKENS) + text[match.end(1) :]


def _break_tree(text: bytes, chance: random.Random) -> bytes:
    """Replace, delete, copy or add members of the parsed JSON; of what is no JSON, break the bytes."""
    try:
        tree = json.loads(text)
        is_tree = isinstance(tree, dict | list) and len(tree) > 0
    except (ValueError, RecursionError):
        is_tree = False
    if not is_tree:
        return break_bytes(text, chance)
    for _ in range(chance.choice([1, 1, 1, 2, 3])):
        places = list(_places(tree))
        holder, key = chance.choice(places)
        kind = chance.random()
        if kind < 0.5:
            holder[key] = copy.deepcopy(chance.choice(_VALUES))
        elif kind < 0.7:
            del holder[key]
        elif kind < 0.85:
            other, other_key = chance.choice(places)
            holder[key] = copy.deepcopy(other[other_key])
        elif isinstance(holder, list):
            holder.append(copy.deepcopy(holder[key]))
        else:
            holder[chance.choice(_KEYS)] = copy.deepcopy(chance.choice([*_VALUES, holder[key]]))
        if not any(True for _ in _places(tree)):
            break
    return json.dumps(tree, separators=(",", ":")).encode()


def _places(tree: Any) -> Iterator[tuple[Any, Any]]:
    """Yield (holder, key) for every member of `tree`; of long arrays the first forty."""
    keys = list(tree) if isinstance(tree, dict) else range(min(len(tree), 40))
    for key in keys:
        yield tree, key
        if isinstance(tree[key], dict | list):
            yield from _places(tree[key])
