"""Normals, tangents and colours; expectations are the Khronos validator's."""

from __future__ import annotations

from math import inf, nan
from typing import Any

import pytest
from judging import Codes, Judge
from small_data import BYTE, FLOAT, SHORT, UNSIGNED_BYTE, Data

from gltf_iri.validation.data.elements import BLOCK

AT = "/meshes/0/primitives/0/attributes/"
OF_DATA = {"ACCESSOR_VECTOR3_NON_UNIT", "ACCESSOR_INVALID_SIGN", "ACCESSOR_NON_CLAMPED"}
QUANTIZED = ["KHR_mesh_quantization"]


def told(codes: Codes, name: str, kind: str, component: int, numbers: list[float], **more: Any) -> set[str]:
    """Return the codes about the numbers of one attribute."""
    data = Data(extensionsUsed=QUANTIZED, extensionsRequired=QUANTIZED)
    width = 3 if kind == "VEC3" else 4
    attributes = {"POSITION": data.positions(len(numbers) // width)}
    stride = 4 if component == BYTE and width == 3 else 8 if component == SHORT and width == 3 else None
    attributes[name] = data.accessor(kind, component, numbers, stride, **more)
    data.root["meshes"] = [{"primitives": [{"attributes": attributes}]}]
    return {code for code, pointer in codes(data.asset) if pointer == AT + name} & OF_DATA


@pytest.mark.parametrize(
    ("length", "is_unit"),
    [(1, True), (1.00673997, True), (1.0067401, False), (0.99326003, True), (0.99325996, False), (0, False)],
)
def test_normals_and_tangents_are_of_length_1(length: float, is_unit: bool, codes: Codes) -> None:
    expected = set() if is_unit else {"ACCESSOR_VECTOR3_NON_UNIT"}
    assert told(codes, "NORMAL", "VEC3", FLOAT, [0, 0, 1, 0, length, 0]) == expected
    assert told(codes, "TANGENT", "VEC4", FLOAT, [0, length, 0, 1]) == expected


@pytest.mark.parametrize(
    ("component", "value", "is_unit"),
    [(BYTE, 127, True), (BYTE, -128, True), (BYTE, 126, False), (SHORT, 32547, True), (SHORT, 32500, False)],
)
def test_quantized_normals_are_of_length_1(component: int, value: int, is_unit: bool, codes: Codes) -> None:
    found = told(codes, "NORMAL", "VEC3", component, [0, value, 0], normalized=True)
    assert found == (set() if is_unit else {"ACCESSOR_VECTOR3_NON_UNIT"})
    assert told(codes, "NORMAL", "VEC3", component, [0, 5, 0]) == set()


@pytest.mark.parametrize(
    ("vector", "is_told"), [([nan, 0, 2], False), ([nan, 0, inf], False), ([0, inf, 0], True)]
)
def test_a_length_that_is_no_number_is_told_as_the_component(
    vector: list[float], is_told: bool, codes: Codes
) -> None:
    for numbers in ([*vector, 0, 0, 1], [0, 0, 1, *vector]):
        found = told(codes, "NORMAL", "VEC3", FLOAT, numbers)
        assert found == ({"ACCESSOR_VECTOR3_NON_UNIT"} if is_told else set())


@pytest.mark.parametrize(
    ("component", "one", "sign", "is_sign"),
    [
        (FLOAT, 1, -1, True),
        (FLOAT, 1, 0, False),
        (FLOAT, 1, 1.0000001, False),
        (FLOAT, 1, nan, False),
        (BYTE, 127, -127, True),
        (BYTE, 127, -128, True),
        (BYTE, 127, 126, False),
        (SHORT, 32767, 32766, False),
    ],
)
def test_a_tangents_fourth_number_is_a_sign(
    component: int, one: int, sign: float, is_sign: bool, codes: Codes
) -> None:
    numbers = [0, 0, one, one, 0, 0, one, sign]
    found = told(codes, "TANGENT", "VEC4", component, numbers, normalized=component != FLOAT)
    assert found == (set() if is_sign else {"ACCESSOR_INVALID_SIGN"})


@pytest.mark.parametrize(
    ("value", "is_clamped"),
    [(0, True), (1, True), (-0.0, True), (1.0000001, False), (-1e-45, False), (nan, True), (inf, False)],
)
@pytest.mark.parametrize("kind", ["VEC3", "VEC4"])
def test_the_first_colours_are_between_0_and_1(
    value: float, is_clamped: bool, kind: str, codes: Codes
) -> None:
    numbers = [0.5, 0.5, value] if kind == "VEC3" else [0, 1, value, 0]
    assert told(codes, "COLOR_0", kind, FLOAT, numbers) == (set() if is_clamped else {"ACCESSOR_NON_CLAMPED"})
    assert told(codes, "COLOR_1", kind, FLOAT, numbers) == set()
    assert told(codes, "COLOR_0", "VEC4", UNSIGNED_BYTE, [255] * 4, normalized=True) == set()


def test_every_primitive_tells_of_the_normals_it_shares(judge: Judge) -> None:
    data = Data()
    count = BLOCK + 2
    normals = [0, 0, 1.0] * (count - 1) + [0, 0, 2.0]
    attributes = {"POSITION": data.positions(count), "NORMAL": data.accessor("VEC3", FLOAT, normals)}
    data.root["meshes"] = [{"primitives": [{"attributes": attributes}] * 2}]
    remarks = [i for i in judge(data.asset).issues if i.code == "ACCESSOR_VECTOR3_NON_UNIT"]
    first = 3 * (count - 1)
    assert [(i.pointer, i.message) for i in remarks] == [
        (
            f"/meshes/0/primitives/{primitive}/attributes/NORMAL",
            f"The vector at {first}..{first + 2} has the length 2.0.",
        )
        for primitive in (0, 1)
    ]
