"""Joints and weights; expectations are the Khronos validator's."""

from __future__ import annotations

from math import inf, nan
from typing import Any

import pytest
from judging import Codes
from small_data import FLOAT, UNSIGNED_BYTE, UNSIGNED_SHORT, Data

AT = "/meshes/0/primitives/0/attributes/"


def skinned(
    joints: list[list[int]],
    weights: list[list[float]],
    component: int = FLOAT,
    joint_counts: tuple[int, ...] = (9,),
) -> Data:
    """Return a primitive with sets of joints and weights, on a node for each skin."""
    data = Data()
    attributes = {"POSITION": data.positions(len(joints[0]) // 4)}
    for number, (places, shares) in enumerate(zip(joints, weights, strict=True)):
        attributes[f"JOINTS_{number}"] = data.accessor("VEC4", UNSIGNED_BYTE, list(places))
        is_normalized = component != FLOAT
        attributes[f"WEIGHTS_{number}"] = data.accessor(
            "VEC4", component, list(shares), normalized=is_normalized
        )
    below = [{"name": f"joint {number}"} for number in range(9)]
    data.root["nodes"] = [*below, {"children": [*range(9)]}]
    data.root["nodes"] += [{"mesh": 0, "skin": skin} for skin in range(len(joint_counts))]
    data.root["skins"] = [{"joints": [*range(count)]} for count in joint_counts]
    data.root["meshes"] = [{"primitives": [{"attributes": attributes}]}]
    data.root["scenes"] = [{"nodes": [9, *range(10, 10 + len(joint_counts))]}]
    return data


def told(codes: Codes, data: Data) -> list[str]:
    """Return what is told of the numbers of the sets."""
    found = {(code, str(pointer).removeprefix(AT)) for code, pointer in codes(data.asset)}
    of_data = ("ACCESSOR_JOINTS_", "ACCESSOR_WEIGHTS_")
    return sorted(f"{rest} {code[9:]}" for code, rest in found if code.startswith(of_data))


SUM = "WEIGHTS_0 WEIGHTS_NON_NORMALIZED"
ZERO = "JOINTS_0 JOINTS_USED_ZERO_WEIGHT"
TWICE = "JOINTS_0 JOINTS_INDEX_DUPLICATE"
BEYOND = "JOINTS_0 JOINTS_INDEX_OOB"
NEGATIVE = "WEIGHTS_0 WEIGHTS_NEGATIVE"


@pytest.mark.parametrize(
    ("joints", "weights", "expected"),
    [
        ([0, 1, 0, 0], [0.5, 0.5, 0, 0], []),
        ([0, 1, 0, 0], [0.5, 0.4, 0, 0], [SUM]),
        ([0, 1, 0, 0], [0.5, 0.6, 0, 0], [SUM]),
        ([0, 9, 0, 0], [0.5, 0.5, 0, 0], [BEYOND, SUM]),
        ([0, 9, 0, 0], [1, 0, 0, 0], [BEYOND]),
        ([1, 1, 0, 0], [0.5, 0.5, 0, 0], [TWICE, SUM]),
        ([1, 0, 0, 1], [0.5, 0, 0, 0.5], [TWICE, SUM]),
        ([1, 1, 0, 0], [1, 0, 0, 0], [ZERO]),
        ([0, 1, 0, 0], [1, -0.0, 0, 0], [ZERO]),
        ([1, 2, 3, 4], [0, 0, 0, 0], [ZERO, SUM]),
        ([0, 1, 0, 0], [1.5, -0.5, 0, 0], [NEGATIVE, SUM]),
        ([1, 1, 0, 0], [1.5, -0.5, 0, 0], [TWICE, NEGATIVE, SUM]),
        ([0, 1, 0, 0], [0.5, nan, 0, 0], []),
        ([0, 1, 0, 0], [0.5, inf, 0, 0], [SUM]),
    ],
)
def test_each_joint_is_there_once_with_a_weight_and_weights_add_up(
    joints: list[int], weights: list[float], expected: list[str], codes: Codes
) -> None:
    assert told(codes, skinned([joints], [weights])) == expected
    sound = ([0, 1, 0, 0], [0.25, 0.75, 0, 0])
    assert told(codes, skinned([[*sound[0], *joints]], [[*sound[1], *weights]])) == expected


@pytest.mark.parametrize(
    ("count", "off", "is_told"),
    [
        (1, 1.2e-7, False),
        (1, 2.4e-7, True),
        (2, 3.6e-7, False),
        (2, 4.8e-7, True),
        (4, 7.2e-7, False),
        (4, 9.6e-7, True),
    ],
)
def test_the_sum_may_be_off_by_so_much_for_each_weight(
    count: int, off: float, is_told: bool, codes: Codes
) -> None:
    weights = [*[1 / count] * (count - 1), 1 / count + off, *[0.0] * (4 - count)]
    joints = [*range(count), *[0] * (4 - count)]
    assert told(codes, skinned([joints], [weights])) == ([SUM] if is_told else [])


@pytest.mark.parametrize(
    ("component", "weights", "is_told"),
    [
        (UNSIGNED_BYTE, [128, 127, 0, 0], False),
        (UNSIGNED_BYTE, [128, 126, 0, 0], True),
        (UNSIGNED_SHORT, [32768, 32767, 0, 0], False),
        (UNSIGNED_SHORT, [32768, 32768, 0, 0], True),
    ],
)
def test_normalised_weights_add_up(component: int, weights: list[float], is_told: bool, codes: Codes) -> None:
    assert told(codes, skinned([[0, 1, 0, 0]], [weights], component)) == ([SUM] if is_told else [])


def test_sets_add_up_together_and_share_no_joint(codes: Codes) -> None:
    quarter, eighth = [0.25] * 4, [0.125] * 4
    assert told(codes, skinned([[0, 1, 2, 3], [4, 5, 6, 7]], [eighth, eighth])) == []
    assert told(codes, skinned([[0, 1, 2, 3], [0, 0, 0, 0]], [quarter, [0.0] * 4])) == []
    sums = [SUM, "WEIGHTS_1 WEIGHTS_NON_NORMALIZED"]
    assert told(codes, skinned([[0, 1, 2, 3], [4, 5, 6, 7]], [quarter, eighth])) == sums
    twice = told(codes, skinned([[8, 1, 2, 3], [4, 5, 6, 8]], [eighth, eighth]))
    assert twice == ["JOINTS_1 JOINTS_INDEX_DUPLICATE", *sums]
    # First components are looked at before second ones, so that here it is the first set's that comes later.
    twice = told(codes, skinned([[0, 8, 2, 3], [8, 5, 6, 7]], [eighth, eighth]))
    assert twice == [TWICE, *sums]


def test_the_smallest_skin_that_a_node_gives_the_mesh_counts(codes: Codes) -> None:
    joints, weights = [[0, 1, 2, 0]], [[0.5, 0.25, 0.25, 0]]
    assert told(codes, skinned(joints, weights, joint_counts=(9, 3))) == []
    assert told(codes, skinned(joints, weights, joint_counts=(9, 2))) == [BEYOND, SUM]


@pytest.mark.parametrize("broken", ["skin", "count", "format", "bytes"])
def test_without_a_skin_or_whole_sets_nothing_is_said(broken: str, codes: Codes) -> None:
    data = skinned([[1, 1, 9, 0]], [[0.5, 0.4, 0, 0]])
    changes: dict[str, dict[str, Any]] = {
        "count": {"count": 2, "bufferView": 0},
        "format": {"type": "VEC3"},
        "bytes": {"count": 9},
    }
    assert told(codes, data)
    if broken == "skin":
        del data.root["nodes"][10]["skin"]
    else:
        data.accessors[2] |= changes[broken]
    assert told(codes, data) == []
