"""Numbers of every accessor, and its min and max; expectations are the Khronos validator's."""

from __future__ import annotations

from math import inf, nan
from typing import Any

import pytest
from judging import Codes
from small_data import BYTE, FLOAT, UNSIGNED_BYTE, UNSIGNED_INT, UNSIGNED_SHORT, Data

from gltf_iri.validation.data.elements import BLOCK


def told(codes: Codes, data: Data) -> list[str]:
    """Return what is told of the first accessor, as code and rest of the pointer."""
    found = {(code, str(pointer).removeprefix("/accessors/0")) for code, pointer in codes(data.asset)}
    return sorted(f"{code.removeprefix('ACCESSOR_')}{rest}" for code, rest in found)


@pytest.mark.parametrize("stride", [None, 16])
@pytest.mark.parametrize(
    ("numbers", "bounds", "expected"),
    [
        ([1, 2, 3, 4], {"min": [1, 2], "max": [3, 4]}, []),
        ([1, 2, 3, 4], {"min": [0, 2]}, ["MIN_MISMATCH/min/0"]),
        ([1, 2, 3, 4], {"max": [3, 3.5]}, ["ELEMENT_OUT_OF_MAX_BOUND/max/1", "MAX_MISMATCH/max/1"]),
        ([1, 2, 3, 4], {"min": [2, 2]}, ["ELEMENT_OUT_OF_MIN_BOUND/min/0", "MIN_MISMATCH/min/0"]),
        ([0.1, 0.7, 0.1, 0.7], {"min": [0.1, 0.7], "max": [0.1, 0.7]}, []),
        ([-0.0, 0, 0, -0.0], {"min": [0, -0.0]}, []),
        ([1, nan, 3, 4], {}, ["INVALID_FLOAT"]),
        ([1, 2, inf, -inf], {}, ["INVALID_FLOAT"]),
        ([1, 3e38, 3, -3e38], {}, []),
        ([1, 2, nan, 4], {"min": [1, 2], "max": [1, 4]}, ["INVALID_FLOAT"]),
        ([nan, 2, 3, 4], {"min": [3, 2]}, ["INVALID_FLOAT", "MIN_MISMATCH/min/0"]),
        ([0, 0, 1, 1], {"max": [1e300, 1]}, ["MAX_MISMATCH/max/0"]),
    ],
)
def test_floats_are_numbers_and_have_the_stated_bounds(
    numbers: list[float], bounds: dict[str, Any], expected: list[str], stride: int | None, codes: Codes
) -> None:
    data = Data()
    data.accessor("VEC2", FLOAT, numbers, stride, **bounds)
    assert told(codes, data) == expected


@pytest.mark.parametrize(
    ("component", "numbers", "bounds", "expected"),
    [
        (UNSIGNED_BYTE, [0, 255], {"min": [0.0], "max": [255.0]}, []),
        (BYTE, [-128, 127], {"min": [-128], "max": [127], "normalized": True}, []),
        (UNSIGNED_INT, [0, 2**32 - 1], {"max": [2**32 - 1]}, []),
        (UNSIGNED_SHORT, [1, 5], {"min": [2]}, ["ELEMENT_OUT_OF_MIN_BOUND/min/0", "MIN_MISMATCH/min/0"]),
        (UNSIGNED_SHORT, [1, 5], {"min": [0], "max": [6]}, ["MAX_MISMATCH/max/0", "MIN_MISMATCH/min/0"]),
    ],
)
def test_bounds_of_integers_are_those_of_the_stored_numbers(
    component: int, numbers: list[int], bounds: dict[str, Any], expected: list[str], codes: Codes
) -> None:
    data = Data()
    data.accessor("SCALAR", component, numbers, **bounds)
    assert told(codes, data) == expected


def test_the_padding_of_matrix_columns_is_no_component(codes: Codes) -> None:
    numbers = [1, 2, 3, 99, 4, 5, 6, 99, 7, 8, 9]
    for last, expected in ((9, []), (8, ["ELEMENT_OUT_OF_MAX_BOUND/max/8", "MAX_MISMATCH/max/8"])):
        data = Data()
        data.accessor("MAT3", UNSIGNED_BYTE, numbers, count=1, min=[*range(1, 10)], max=[*range(1, 9), last])
        assert told(codes, data) == expected


@pytest.mark.parametrize("change", [{"count": 5}, {"byteOffset": 2, "count": 1}, {"bufferView": 9}])
def test_accessors_that_cannot_be_read_are_not_looked_at(change: dict[str, Any], codes: Codes) -> None:
    data = Data()
    data.accessor("SCALAR", FLOAT, [1, nan], **{"min": [5], **change})
    assert not {code for code, _ in codes(data.asset)} & {"ACCESSOR_INVALID_FLOAT", "ACCESSOR_MIN_MISMATCH"}


@pytest.mark.parametrize(
    ("indices", "numbers", "expected"),
    [
        ([1, 3], [5, 6], []),
        ([1, 3], [5, nan], ["INVALID_FLOAT", "MAX_MISMATCH/max/0"]),
        ([3, 1], [6, 5], ["SPARSE_INDICES_NON_INCREASING/sparse"]),
        ([1, 1], [6, 5], ["SPARSE_INDICES_NON_INCREASING/sparse"]),
        ([1, 4], [6, 9], ["SPARSE_INDEX_OOB/sparse"]),
        (
            [4, 3],
            [9, 9],
            ["MAX_MISMATCH/max/0", "SPARSE_INDEX_OOB/sparse", "SPARSE_INDICES_NON_INCREASING/sparse"],
        ),
    ],
)
@pytest.mark.parametrize("has_view", [True, False])
def test_sparse_elements_count_until_their_indices_go_wrong(
    indices: list[int], numbers: list[float], expected: list[str], has_view: bool, codes: Codes
) -> None:
    data = Data()
    data.accessor("SCALAR", FLOAT, [0, nan if expected == [] and has_view else 0, 0, 0], max=[6])
    data.accessors[0]["sparse"] = data.sparse(indices, FLOAT, numbers)
    if not has_view:
        del data.accessors[0]["bufferView"]
    assert told(codes, data) == expected


@pytest.mark.parametrize("place", [0, BLOCK - 1, BLOCK, 2 * BLOCK, 2 * BLOCK + 4])
@pytest.mark.parametrize("stride", [None, 8])
def test_every_element_of_every_block_is_looked_at(place: int, stride: int | None, codes: Codes) -> None:
    numbers = [1.0] * (2 * BLOCK + 5)
    data = Data()
    data.accessor("SCALAR", FLOAT, [*numbers[:place], 2.0, *numbers[place + 1 :]], stride, min=[1], max=[2])
    data.accessor("SCALAR", FLOAT, [*numbers[:place], nan, *numbers[place + 1 :]], stride)
    data.accessor("SCALAR", FLOAT, numbers, max=[2], sparse=data.sparse([3], FLOAT, [2]))
    data.accessors[2]["sparse"]["indices"] = {
        "bufferView": data.view(place.to_bytes(4, "little")),
        "componentType": UNSIGNED_INT,
    }
    assert codes(data.asset) == {("ACCESSOR_INVALID_FLOAT", "/accessors/1")}


def test_messages_name_the_element_and_the_numbers(judge: Any) -> None:
    data = Data()
    data.accessor("VEC3", FLOAT, [0, 0, 0, 1, nan, 1], 16, max=[1, 0, 0.5])
    told = [i.message for i in judge(data.asset).issues if i.code != "UNUSED_OBJECT"]
    assert "at 4 is nan" in told[0]
    assert "maximum is 0.5, but the data's is 1.0" in told[1]
    assert told[2].startswith("1 elements are greater than the maximum 0.5")
