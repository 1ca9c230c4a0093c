"""Documents that hypothesis builds from the property tables: mostly legal, here and there a little mad."""

from __future__ import annotations

import base64
import json
from typing import Any

from hypothesis import strategies as st

from gltf_iri.validation.tables import EXTENSIONS, TABLES, Field

__all__ = ["documents"]

Json = st.SearchStrategy[Any]

# One pixel: what the random bytes of pictures start from.
_PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVQYV2P4z/AfAAQAAf+I0P3MAAAAAElFTkSuQmCC"
)
_MAD: Json = st.sampled_from(
    [
        None,
        True,
        -1,
        0,
        1.5,
        2**31,
        2**53,
        2**64,
        10**400,
        1e308,
        -0.0,
        "",
        "x",
        "\ud800",
        [],
        {},
        [[]],
        [None],
    ]
)
_TEXTS: Json = st.sampled_from(["a", "", "POSITION", "/nodes/0/scale", "/", "~2", "é\u202e", "x" * 300])
_ATTRIBUTES = [
    *("POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "TEXCOORD_9", "COLOR_0", "JOINTS_0"),
    *("WEIGHTS_0", "JOINTS_1", "WEIGHTS_1", "_OWN", "FOO", "TEXCOORD_01", "a~b/c"),
]


def _numbers(field: Field) -> Json:
    if field.choices:
        return st.sampled_from(list(field.choices))
    low = 0 if field.low is None else field.low
    high = low + 8 if field.high is None else field.high
    if field.kind == "NUMBER":
        return st.floats(float(low), float(high)) if high >= low else st.just(low)
    return st.integers(int(low), max(int(low), int(high))).map(lambda n: n - n % (field.multiple_of or 1))


def _one(field: Field) -> Json:
    if field.kind == "OBJECT":
        return _object(field.table)
    if field.kind == "INDEX":
        return st.integers(0, 3)
    if field.kind == "FLAG":
        return st.booleans()
    if field.kind == "TEXT":
        if field.key == "uri":
            return _uris()
        if field.key == "version":
            return st.just("2.0")
        return st.sampled_from(list(field.choices)) if field.choices else _TEXTS
    if field.key in ("byteLength", "byteOffset", "count"):
        return st.sampled_from([0, 1, 2, 3, 4, 6, 8, 12, 16, 24, 36, 48, 64, 96, 10**15])
    return _numbers(field)


def _uris() -> Json:
    data = st.binary(max_size=120).map(lambda b: f"data:application/octet-stream;base64,{_encoded(b)}")
    cut = st.integers(0, len(_PNG)).map(lambda n: f"data:image/png;base64,{_encoded(_PNG[:n])}")
    return st.one_of(
        data, cut, st.sampled_from(["a.bin", "../a.bin", "/etc/passwd", "data:,", "http://x/", "%zz"])
    )


def _encoded(data: bytes) -> str:
    return base64.b64encode(data).decode("ascii")


@st.composite
def _property(draw: st.DrawFn, field: Field) -> Any:
    if draw(st.integers(0, 11)) == 0:
        return draw(_MAD)
    one = _one(field)
    if field.shape == "ARRAY":
        most = field.max_items or 4
        return draw(st.lists(one, min_size=min(field.min_items, most), max_size=most))
    if field.shape == "MAP":
        return draw(st.dictionaries(st.sampled_from(_ATTRIBUTES), one, min_size=1, max_size=5))
    if field.shape == "ARRAY_OF_MAPS":
        return draw(st.lists(st.dictionaries(st.sampled_from(_ATTRIBUTES), one, max_size=3), max_size=3))
    return draw(one)


@st.composite
def _object(draw: st.DrawFn, name: str) -> dict[str, Any]:
    table = TABLES[name]
    built = {
        key: draw(_property(field))
        for key, field in table.fields.items()
        if draw(st.integers(0, 15)) < (15 if field.required else 8)
    }
    if draw(st.integers(0, 15)) == 0:
        built["extras"] = draw(_MAD)
    placed = {e.name: e.objects[name] for e in EXTENSIONS.values() if name in e.objects}
    chosen = [extension for extension in placed if draw(st.integers(0, 3)) == 0]
    if chosen:
        built["extensions"] = {extension: draw(_object(placed[extension])) for extension in chosen}
    return built


@st.composite
def documents(draw: st.DrawFn) -> bytes:
    """Return a whole document, as the bytes of a .gltf file."""
    return json.dumps({**draw(_object("glTF")), "extensionsUsed": sorted(EXTENSIONS)}).encode()
