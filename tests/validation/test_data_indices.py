"""Indices of primitives; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes, Judge
from small_data import FLOAT, UNSIGNED_BYTE, UNSIGNED_INT, UNSIGNED_SHORT, Data

from gltf_iri.validation.data.elements import BLOCK

AT = "/meshes/0/primitives/0/indices"


def indexed(indices: list[int], component: int = UNSIGNED_SHORT, vertices: int = 4, **more: Any) -> Data:
    """Return a primitive of that many vertices with those indices."""
    data = Data()
    attributes = {"POSITION": data.positions(vertices)}
    primitive = {"attributes": attributes, "indices": data.accessor("SCALAR", component, indices), **more}
    data.root["meshes"] = [{"primitives": [primitive]}]
    return data


def told(codes: Codes, data: Data) -> set[str]:
    """Return the codes about the indices' numbers."""
    found = {code for code, pointer in codes(data.asset) if pointer == AT}
    return found - {"BUFFER_VIEW_TARGET_MISSING"}


@pytest.mark.parametrize(
    ("indices", "component", "vertices", "expected"),
    [
        ([0, 1, 3], UNSIGNED_SHORT, 4, set()),
        ([0, 1, 4], UNSIGNED_SHORT, 4, {"ACCESSOR_INDEX_OOB"}),
        ([0, 1, 255], UNSIGNED_SHORT, 300, set()),
        ([0, 1, 255], UNSIGNED_BYTE, 300, {"ACCESSOR_INDEX_PRIMITIVE_RESTART"}),
        ([0, 1, 255], UNSIGNED_BYTE, 4, {"ACCESSOR_INDEX_PRIMITIVE_RESTART", "ACCESSOR_INDEX_OOB"}),
        ([0, 1, 65535], UNSIGNED_INT, 4, {"ACCESSOR_INDEX_OOB"}),
        ([0, 1, 2**32 - 1], UNSIGNED_INT, 4, {"ACCESSOR_INDEX_PRIMITIVE_RESTART", "ACCESSOR_INDEX_OOB"}),
    ],
)
def test_indices_name_vertices_and_never_restart(
    indices: list[int], component: int, vertices: int, expected: set[str], codes: Codes
) -> None:
    assert told(codes, indexed(indices, component, vertices)) == expected


@pytest.mark.parametrize(
    ("indices", "mode", "is_told"),
    [
        ([0, 1, 2, 1, 2, 3], 4, False),
        ([0, 1, 2, 1, 2, 1], 4, True),
        ([0, 1, 1], 4, True),
        ([0, 0, 1], 4, True),
        ([0, 1, 2, 3, 3], 4, False),
        ([0, 0, 0], 5, False),
        ([0, 0, 0], 6, False),
        ([0, 0, 0], 0, False),
    ],
)
def test_only_triangle_lists_have_degenerate_triangles(
    indices: list[int], mode: int, is_told: bool, codes: Codes
) -> None:
    found = told(codes, indexed(indices, mode=mode))
    assert ("ACCESSOR_INDEX_TRIANGLE_DEGENERATE" in found) is is_told


def test_degenerate_triangles_are_counted_once(judge: Judge) -> None:
    triangles = [0, 1, 2] * (BLOCK // 3 + 1) + [3, 3, 3]
    remarks = [i.message for i in judge(indexed([0, 0, 1, *triangles]).asset).issues if i.pointer == AT]
    assert [text for text in remarks if "triangles" in text] == [
        f"2 of {len(triangles) // 3 + 1} triangles name a vertex twice."
    ]


@pytest.mark.parametrize("place", [0, BLOCK - 1, BLOCK, BLOCK + 6])
def test_an_index_is_named_by_its_place_in_every_block(place: int, judge: Judge) -> None:
    indices = [0, 1, 2] * (BLOCK // 3 + 3)
    indices[place] = 7
    remarks = [i for i in judge(indexed(indices).asset).issues if i.code == "ACCESSOR_INDEX_OOB"]
    assert [(i.pointer, i.message) for i in remarks] == [
        (AT, f"The index at {place} is 7; the last vertex is 3.")
    ]


def test_every_primitive_tells_of_the_indices_it_shares(codes: Codes) -> None:
    data = indexed([0, 1, 3])
    few = {"POSITION": data.positions(2)}
    primitives = data.root["meshes"][0]["primitives"]
    data.root["meshes"].append({"primitives": [{"attributes": few, "indices": 1}, primitives[0]]})
    assert {p for code, p in codes(data.asset) if code == "ACCESSOR_INDEX_OOB"} == {
        "/meshes/1/primitives/0/indices"
    }


def test_sparse_indices_are_indices(codes: Codes) -> None:
    data = indexed([0, 1, 9])
    assert told(codes, data) == {"ACCESSOR_INDEX_OOB"}
    data.accessors[1]["sparse"] = data.sparse([2], UNSIGNED_SHORT, [2])
    assert told(codes, data) == set()


def test_indices_of_a_wrong_format_are_not_looked_at(codes: Codes) -> None:
    data = indexed([0, 1, 9])
    data.accessors[1] |= {"componentType": FLOAT, "count": 1}
    assert told(codes, data) == {"MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT"}
