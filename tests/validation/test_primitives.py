"""Primitives and their accessors; expectations are the Khronos validator's, formats glTF's tables."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes
from small_meshes import (
    BUFFER,
    BYTE,
    FLOAT,
    INDICES,
    INDICES_TARGET,
    POSITIONS,
    SHORT,
    UNSIGNED_BYTE,
    UNSIGNED_INT,
    UNSIGNED_SHORT,
    VERTICES_TARGET,
    accessor,
    mesh,
    view,
)

AT = "/meshes/0/primitives/0"
INVALID = "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT"


def two(second: dict[str, Any], name: str, *, moved: bool = False) -> dict[str, Any]:
    """Return an asset whose attribute, or morph target, `name` reads the accessor `second`."""
    attributes = {"POSITION": 0, "NORMAL": 0, "_OWN": 0}
    read = mesh(attributes, targets=[{name: 1}]) if moved else mesh({"POSITION": 0, "NORMAL": 0, name: 1})
    return {"accessors": [POSITIONS, second], "meshes": [read]}


FORMATS = [
    (kind, component, is_normalized)
    for kind in ("SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4")
    for component in (BYTE, UNSIGNED_BYTE, SHORT, UNSIGNED_SHORT, UNSIGNED_INT, FLOAT)
    for is_normalized in (False, True)
]
SHORT_NAMES = {BYTE: "s8", UNSIGNED_BYTE: "u8", SHORT: "s16", UNSIGNED_SHORT: "u16", FLOAT: "f32"}


def accepted(codes: Codes, name: str, *, moved: bool, quantized: bool) -> set[str]:
    """Return which of all formats the attribute takes: type, short component type, n where normalized."""
    elements = [accessor(kind, component, normalized=n) for kind, component, n in FORMATS]
    primitives = [
        {"attributes": {"POSITION": 0}, "targets": [{name: number}]}
        if moved
        else {"attributes": {name: number}}
        for number in range(1, len(elements) + 1)
    ]
    used = ["KHR_mesh_quantization"]
    declared = {"extensionsUsed": used, "extensionsRequired": used} if quantized else {}
    found = codes({"accessors": [POSITIONS, *elements], "meshes": [{"primitives": primitives}], **declared})
    refused = {int(str(pointer).split("/")[4]) for code, pointer in found if code == INVALID}
    return {
        f"{kind} {SHORT_NAMES.get(component, component)}{'n' if is_normalized else ''}"
        for number, (kind, component, is_normalized) in enumerate(FORMATS)
        if number not in refused
    }


@pytest.mark.parametrize(
    ("name", "types", "components", "quantized"),
    [
        ("POSITION", "VEC3", "f32", "f32 s8 s8n u8 u8n s16 s16n u16 u16n"),
        ("NORMAL", "VEC3", "f32", "f32 s8n s16n"),
        ("TANGENT", "VEC4", "f32", "f32 s8n s16n"),
        ("TEXCOORD_0", "VEC2", "f32 u8n u16n", "f32 s8 s8n u8 u8n s16 s16n u16 u16n"),
        ("COLOR_0", "VEC3 VEC4", "f32 u8n u16n", "f32 u8n u16n"),
        ("JOINTS_0", "VEC4", "u8 u16", "u8 u16"),
        ("WEIGHTS_0", "VEC4", "f32 u8n u16n", "f32 u8n u16n"),
    ],
)
def test_attributes_take_their_formats(
    codes: Codes, name: str, types: str, components: str, quantized: str
) -> None:
    for is_quantized, allowed in ((False, components), (True, quantized)):
        expected = {f"{kind} {component}" for kind in types.split() for component in allowed.split()}
        assert accepted(codes, name, moved=False, quantized=is_quantized) == expected


@pytest.mark.parametrize(
    ("name", "types", "components", "quantized"),
    [
        ("POSITION", "VEC3", "f32", "f32 s8 s8n s16 s16n"),
        ("NORMAL", "VEC3", "f32", "f32 s8n s16n"),
        ("TANGENT", "VEC3", "f32", "f32 s8n s16n"),
        ("TEXCOORD_0", "VEC2", "f32 s8n u8n s16n u16n", "f32 s8 s8n u8n s16 s16n u16n"),
        ("COLOR_0", "VEC3 VEC4", "f32 s8n u8n s16n u16n", "f32 s8n u8n s16n u16n"),
    ],
)
def test_targets_take_their_formats(
    codes: Codes, name: str, types: str, components: str, quantized: str
) -> None:
    for is_quantized, allowed in ((False, components), (True, quantized)):
        expected = {f"{kind} {component}" for kind in types.split() for component in allowed.split()}
        assert accepted(codes, name, moved=True, quantized=is_quantized) == expected


def test_own_attributes_have_no_wide_integers(codes: Codes) -> None:
    wide = ("MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT", f"{AT}/attributes/_OWN")
    assert codes(two(accessor(component=UNSIGNED_INT), "_OWN")) == {wide}
    assert codes(two(accessor(component=UNSIGNED_SHORT), "_OWN")) == set()


@pytest.mark.parametrize("key", ["min", "max"])
def test_positions_have_bounds(codes: Codes, key: str) -> None:
    unbounded = {name: value for name, value in POSITIONS.items() if name != key}
    missing = "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS"
    asset = {"accessors": [unbounded], "meshes": [mesh({"POSITION": 0})]}
    assert codes(asset) == {(missing, f"{AT}/attributes/POSITION")}
    assert codes(two(unbounded, "POSITION", moved=True)) == {(missing, f"{AT}/targets/0/POSITION")}
    assert codes(two({**unbounded, key: [0, 0, 0]}, "POSITION", moved=True)) == set()


def test_broken_bounds_are_none_wherever_meshes_stand(codes: Codes) -> None:
    accessors = [accessor(component=UNSIGNED_BYTE, min=[0.5, 0, 0], max=[1, 1, 1])]
    expected = {
        ("ARRAY_TYPE_MISMATCH", "/accessors/0/min"),
        (INVALID, f"{AT}/attributes/POSITION"),
        ("MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS", f"{AT}/attributes/POSITION"),
    }
    meshes = [mesh({"POSITION": 0})]
    assert codes({"accessors": accessors, "meshes": meshes}) == expected
    assert codes({"meshes": meshes, "accessors": accessors}) == expected


@pytest.mark.parametrize(
    ("element", "of_view", "is_aligned"),
    [
        (accessor("VEC4", UNSIGNED_BYTE), {}, True),
        (accessor("VEC3", UNSIGNED_BYTE), {}, False),
        (accessor("VEC3", UNSIGNED_BYTE), {"byteStride": 4}, True),
        (accessor("VEC4", UNSIGNED_BYTE, byteOffset=2), {}, False),
        (accessor("VEC4", UNSIGNED_BYTE, byteOffset=2), {"byteStride": 8}, False),
        (accessor("VEC4", UNSIGNED_BYTE), {"byteOffset": 2}, True),
    ],
)
def test_vertices_start_on_multiples_of_four_bytes(
    codes: Codes, element: dict[str, Any], of_view: dict[str, Any], is_aligned: bool
) -> None:
    asset = two({**element, "bufferView": 0}, "_OWN")
    asset |= {"buffers": [BUFFER], "bufferViews": [view(target=VERTICES_TARGET, **of_view)]}
    expected = set() if is_aligned else {("MESH_PRIMITIVE_ACCESSOR_UNALIGNED", f"{AT}/attributes/_OWN")}
    assert codes(asset) == expected


def test_attributes_have_the_count_of_the_first(codes: Codes) -> None:
    asset = two(accessor(count=4), "_OWN")
    assert codes(asset) == {("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", f"{AT}/attributes/_OWN")}


def test_targets_move_attributes_that_are_there_and_of_their_count(codes: Codes) -> None:
    missing = ("MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR", f"{AT}/targets/0/TEXCOORD_0")
    assert codes(two(accessor("VEC2"), "TEXCOORD_0", moved=True)) == {missing}
    other = ("MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT", f"{AT}/targets/0/NORMAL")
    assert codes(two(accessor(count=4), "NORMAL", moved=True)) == {other}
    assert codes(two(accessor(count=3), "NORMAL", moved=True)) == set()


@pytest.mark.parametrize(
    ("mode", "whole", "broken"),
    [
        (0, (1, 2), ()),
        (1, (2, 4), (1, 3)),
        (2, (2, 3), (1,)),
        (3, (2, 3), (1,)),
        (4, (3, 6), (1, 2, 4)),
        (5, (3, 4), (2,)),
        (6, (3, 4), (2,)),
    ],
)
def test_vertices_or_indices_fill_the_mode(
    codes: Codes, mode: int, whole: tuple[int, ...], broken: tuple[int, ...]
) -> None:
    wrong = ("MESH_PRIMITIVE_INCOMPATIBLE_MODE", AT)
    for count in (*whole, *broken):
        expected = {wrong} if count in broken else set()
        vertices = {**POSITIONS, "count": count}
        assert codes({"accessors": [vertices], "meshes": [mesh({"POSITION": 0}, mode=mode)]}) == expected
        indexed = {"accessors": [{**POSITIONS, "count": 1}, {**INDICES, "count": count}]}
        found = codes({**indexed, "meshes": [mesh({"POSITION": 0}, mode=mode, indices=1)]})
        assert ("MESH_PRIMITIVE_INCOMPATIBLE_MODE" in {code for code, _ in found}) == (count in broken)


@pytest.mark.parametrize(
    ("element", "is_accepted_as_index"),
    [
        (accessor("SCALAR", UNSIGNED_BYTE), True),
        (accessor("SCALAR", UNSIGNED_INT), True),
        (accessor("SCALAR", SHORT), False),
        (accessor("SCALAR", FLOAT), False),
        (accessor("VEC2", UNSIGNED_BYTE), False),
        (accessor("SCALAR", UNSIGNED_BYTE, normalized=True), False),
    ],
)
def test_indices_are_unsigned_scalars(
    codes: Codes, element: dict[str, Any], is_accepted_as_index: bool
) -> None:
    found = codes({"accessors": [POSITIONS, element], "meshes": [mesh({"POSITION": 0}, indices=1)]})
    wrong = ("MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT", f"{AT}/indices")
    assert (wrong not in found) == is_accepted_as_index


def test_indices_lie_without_gaps(codes: Codes) -> None:
    accessors = [POSITIONS, {**INDICES, "bufferView": 0}]
    asset = {"buffers": [BUFFER], "accessors": accessors, "meshes": [mesh({"POSITION": 0}, indices=1)]}
    assert codes({**asset, "bufferViews": [view(target=INDICES_TARGET)]}) == set()
    found = codes({**asset, "bufferViews": [view(byteStride=4)]})
    assert ("MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE", f"{AT}/indices") in found


def test_a_broken_target_takes_all_with_it(codes: Codes) -> None:
    asset = {"accessors": [POSITIONS], "meshes": [mesh({"POSITION": 0}, targets=[{"NORMAL": 0}, 5])]}
    assert codes(asset) == {("ARRAY_TYPE_MISMATCH", f"{AT}/targets")}
