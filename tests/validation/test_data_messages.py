"""Remarks on data name the number that they mean: its place among all of the accessor, and what it is."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Judge
from small_data import FLOAT, IDENTITY, UNSIGNED_INT, Data

from gltf_iri.validation.data.elements import BLOCK


def messages(judge: Judge, asset: dict[str, Any], code: str) -> list[str]:
    """Return the sentences of the remarks with a code."""
    return [i.message for i in judge(asset).issues if i.code == code]


@pytest.mark.parametrize(
    ("name", "kind", "code", "sound", "wrong", "expected"),
    [
        ("NORMAL", "VEC3", "ACCESSOR_VECTOR3_NON_UNIT", [0, 0, 1], [0, 0, 2], ("at 6..8", "2")),
        ("TANGENT", "VEC4", "ACCESSOR_VECTOR3_NON_UNIT", [0, 0, 1, 1], [0, 0, 2, 1], ("at 8..10", "2")),
        ("TANGENT", "VEC4", "ACCESSOR_INVALID_SIGN", [0, 0, 1, 1], [0, 0, 1, 3], ("at 8..11", "3")),
        ("COLOR_0", "VEC3", "ACCESSOR_NON_CLAMPED", [0, 0, 1], [0, 2, 1], ("at 7 ", "2")),
    ],
)
def test_one_wrong_vertex_is_named_and_no_other(
    name: str,
    kind: str,
    code: str,
    sound: list[float],
    wrong: list[float],
    expected: tuple[str, str],
    judge: Judge,
) -> None:
    data = Data()
    numbers = [*sound, *sound, *wrong, *sound]
    attributes = {"POSITION": data.positions(4), name: data.accessor(kind, FLOAT, [*numbers])}
    data.root["meshes"] = [{"primitives": [{"attributes": attributes}]}]
    (message,) = messages(judge, data.asset, code)
    assert all(part in message for part in expected)


def test_one_wrong_component_of_a_matrix_is_named_and_no_other(judge: Judge) -> None:
    data = Data(nodes=[{}])
    matrices = data.accessor("MAT4", FLOAT, [*IDENTITY, *IDENTITY[:7], 0.5, *IDENTITY[8:]])
    data.root["skins"] = [{"joints": [0], "inverseBindMatrices": matrices}]
    (message,) = messages(judge, data.asset, "ACCESSOR_INVALID_IBM")
    assert "at 23 has 0.5 as component 7" in message


def test_matrices_of_another_type_are_not_looked_at(judge: Judge) -> None:
    data = Data(nodes=[{}])
    vectors = data.accessor("VEC4", FLOAT, [1.0, 2.0, 3.0, 4.0])
    data.root["skins"] = [{"joints": [0], "inverseBindMatrices": vectors}]
    assert messages(judge, data.asset, "SKIN_IBM_INVALID_FORMAT")
    assert not messages(judge, data.asset, "ACCESSOR_INVALID_IBM")


def test_a_wrong_rotation_of_a_spline_is_named_in_every_block(judge: Judge) -> None:
    keys = BLOCK // 3 + 2
    values = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0] * keys
    wrong = 3 * (keys - 1) + 1
    values[4 * wrong + 3] = 2.0
    data = Data(nodes=[{}])
    times = data.accessor("SCALAR", FLOAT, [*range(keys)], min=[0], max=[keys - 1])
    sampler = {
        "input": times,
        "output": data.accessor("VEC4", FLOAT, values),
        "interpolation": "CUBICSPLINE",
    }
    channel = {"sampler": 0, "target": {"node": 0, "path": "rotation"}}
    data.root["animations"] = [{"samplers": [sampler], "channels": [channel]}]
    code = "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION"
    (message,) = messages(judge, data.asset, code)
    assert f"at {4 * wrong}..{4 * wrong + 3} " in message


@pytest.mark.parametrize("has_view", [True, False])
@pytest.mark.parametrize("place", [1, BLOCK - 1, BLOCK, BLOCK + 2])
def test_sparse_vectors_stand_at_their_place_among_zeros(has_view: bool, place: int, judge: Judge) -> None:
    """What is not replaced is 0 where there is no view, and as the view has it elsewhere."""
    count = BLOCK + 4
    data = Data()
    bounds = {"min": [0, -3], "max": [2, 0]}
    data.accessor("VEC2", FLOAT, [0.0] * 2 * count, **bounds)
    first, second = (number.to_bytes(4, "little") for number in (0, place))
    sparse = data.sparse([0, 1], FLOAT, [0.0, 0.0, 2.0, -3.0])
    sparse["indices"] = {"bufferView": data.view(first + second), "componentType": UNSIGNED_INT}
    data.accessors[0]["sparse"] = sparse
    if not has_view:
        del data.accessors[0]["bufferView"]
    assert {i.code for i in judge(data.asset).issues} <= {"UNUSED_OBJECT"}
    data.accessors[0] |= {"min": [0, 0], "max": [1, 0]}
    assert messages(judge, data.asset, "ACCESSOR_MIN_MISMATCH")
    (message,) = messages(judge, data.asset, "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND")
    assert message.startswith("1 ")
