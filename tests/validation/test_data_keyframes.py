"""Times, rotations and inverse bind matrices; expectations are the Khronos validator's."""

from __future__ import annotations

from math import inf, nan
from typing import Any

import pytest
from judging import Codes, Judge
from small_data import BYTE, FLOAT, IDENTITY, SHORT, UNSIGNED_BYTE, UNSIGNED_SHORT, Data

from gltf_iri.validation.data.elements import BLOCK

NEGATIVE, NOT_LATER = "ACCESSOR_ANIMATION_INPUT_NEGATIVE", "ACCESSOR_ANIMATION_INPUT_NON_INCREASING"
NOT_UNIT = "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION"


def moving(times: list[float], kind: str, component: int, numbers: list[float], **more: Any) -> Data:
    """Return an animation of a node."""
    data = Data(nodes=[{}])
    path, interpolation = more.pop("path", "rotation"), more.pop("interpolation", "LINEAR")
    sampler = {
        "input": data.accessor("SCALAR", FLOAT, times),
        "output": data.accessor(kind, component, numbers, **more),
        "interpolation": interpolation,
    }
    channel = {"sampler": 0, "target": {"node": 0, "path": path}}
    data.root["animations"] = [{"samplers": [sampler], "channels": [channel]}]
    return data


def places(judge: Judge, data: Data, code: str) -> list[tuple[str, str | None]]:
    """Return the numbers that remarks of a code begin with, and their pointers."""
    return [
        (i.message.split(" has ")[0].split(" is ")[0].split()[-1], i.pointer)
        for i in judge(data.asset).issues
        if i.code == code
    ]


@pytest.mark.parametrize(
    ("times", "negative", "not_later"),
    [
        ([0, 1, 2], [], []),
        ([-0.0, 1, 2], [], []),
        ([-1, 1, 2], [0], []),
        ([-2, -1, 2], [0, 1], []),
        ([0, 0, 0], [], [1, 2]),
        ([0, 2, 1, 3], [], [2]),
        ([0, 2, 1, 1.5], [], [2]),
        ([5, -1, 3, 6], [1], [2]),
        ([0, nan, -1, 0], [2], []),
        ([0, inf, inf], [], [2]),
    ],
)
def test_times_increase_from_0_on(
    times: list[float], negative: list[int], not_later: list[int], judge: Judge
) -> None:
    data = moving(times, "VEC4", FLOAT, [0, 0, 0, 1] * len(times))
    at = "/animations/0/samplers/0/input"
    assert places(judge, data, NEGATIVE) == [(str(place), at) for place in negative]
    assert places(judge, data, NOT_LATER) == [(str(place), at) for place in not_later]


@pytest.mark.parametrize("key", ["samplers", "channels"])
def test_half_an_animation_has_no_times(key: str, codes: Codes) -> None:
    asset = moving([1, 0], "VEC3", FLOAT, [0, 0, 0] * 2, path="scale", min=None).asset
    assert NOT_LATER in {code for code, _ in codes(asset)}
    asset["animations"][0][key] = 5
    assert {code for code, _ in codes(asset)} == {"TYPE_MISMATCH", "NODE_EMPTY"}


def test_times_increase_from_block_to_block(judge: Judge) -> None:
    times = [float(number) for number in range(BLOCK + 2)]
    assert places(judge, moving(times, "SCALAR", FLOAT, [0], path="weights"), NOT_LATER) == []
    times[BLOCK] = times[BLOCK - 1]
    found = places(judge, moving(times, "SCALAR", FLOAT, [0], path="weights"), NOT_LATER)
    assert [place for place, _ in found] == [str(BLOCK)]


@pytest.mark.parametrize(
    ("component", "one", "is_unit"),
    [
        (FLOAT, 1.00768995, True),
        (FLOAT, 1.00769007, False),
        (FLOAT, 0.99231005, True),
        (FLOAT, 0.99230999, False),
        (FLOAT, nan, True),
        (FLOAT, inf, False),
        (BYTE, 127, True),
        (BYTE, 126, False),
        (UNSIGNED_BYTE, 254, True),
        (UNSIGNED_BYTE, 253, False),
        (SHORT, -32768, True),
        (SHORT, 32500, False),
        (UNSIGNED_SHORT, 65050, True),
        (UNSIGNED_SHORT, 65000, False),
    ],
)
def test_rotations_are_of_length_1(component: int, one: float, is_unit: bool, judge: Judge) -> None:
    data = moving([0], "VEC4", component, [0, 0, 0, one], normalized=component != FLOAT)
    found = places(judge, data, NOT_UNIT)
    assert found == ([] if is_unit else [("0..3", "/animations/0/channels/0/sampler")])
    other = moving([0], "VEC4", component, [0, 0, 0, one], path="translation")
    assert places(judge, other, NOT_UNIT) == []


def test_of_a_spline_only_values_are_of_length_1(judge: Judge) -> None:
    tangent, unit, half = [9, 9, 9, 9], [0, 0, 0, 1], [0, 0, 0, 0.5]
    keys = [*tangent, *unit, *tangent] * (BLOCK // 3) + [*unit, *half, *unit]
    data = moving([0, 1], "VEC4", FLOAT, keys, interpolation="CUBICSPLINE")
    first = 4 * BLOCK + 4
    assert [place for place, _ in places(judge, data, NOT_UNIT)] == [f"{first}..{first + 3}"]


@pytest.mark.parametrize(
    ("place", "value", "is_affine"),
    [
        (3, -0.0, True),
        (3, 1e-45, False),
        (7, 1, False),
        (11, nan, False),
        (15, 1.0000001, False),
        (12, 7, True),
        (0, 0, True),
    ],
)
def test_bind_matrices_end_in_0_0_0_1(place: int, value: float, is_affine: bool, codes: Codes) -> None:
    data = Data(nodes=[{"children": [1]}, {}])
    matrix = [*IDENTITY[:place], value, *IDENTITY[place + 1 :]]
    matrices = data.accessor("MAT4", FLOAT, IDENTITY + matrix)
    data.root["skins"] = [{"joints": [0, 1], "inverseBindMatrices": matrices}] * 2
    found = {pointer for code, pointer in codes(data.asset) if code == "ACCESSOR_INVALID_IBM"}
    assert found == (set() if is_affine else {f"/skins/{skin}/inverseBindMatrices" for skin in (0, 1)})
