"""Names of attributes, and what primitives of a mesh share; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes
from small_meshes import POSITIONS, UNSIGNED_BYTE, accessor, mesh

AT = "/meshes/0/primitives/0"
ACCESSORS = [POSITIONS, accessor("VEC2"), accessor("VEC4"), accessor("VEC4", UNSIGNED_BYTE), accessor()]
POSITION, UV, VEC4, JOINTS, NORMAL = range(5)


def of(attributes: dict[str, Any], **more: Any) -> dict[str, Any]:
    return {"accessors": ACCESSORS, "meshes": [mesh({"POSITION": POSITION, **attributes}, **more)]}


@pytest.mark.parametrize("name", ["_", "_OWN", "_JOINTS_5", "_x/~y"])
def test_names_that_start_with_an_underscore_are_free(codes: Codes, name: str) -> None:
    assert codes(of({name: UV})) == set()


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("TEXCOORD", "TEXCOORD"),
        ("TEXCOORD_", "TEXCOORD_"),
        ("TEXCOORD_00", "TEXCOORD_00"),
        ("TEXCOORD_-1", "TEXCOORD_-1"),
        ("TEXCOORD_0_1", "TEXCOORD_0_1"),
        ("TEXCOORD_²", "TEXCOORD_²"),
        ("position", "position"),
        ("", ""),
        ("x/~y", "x~1~0y"),
    ],
)
def test_no_other_names_are_there(codes: Codes, name: str, told: str) -> None:
    assert codes(of({name: UV})) == {("MESH_PRIMITIVE_INVALID_ATTRIBUTE", f"{AT}/attributes/{told}")}


def test_only_some_semantics_have_sets(codes: Codes) -> None:
    wrong = ("MESH_PRIMITIVE_INVALID_ATTRIBUTE", f"{AT}/attributes/NORMAL_0")
    assert codes(of({"NORMAL_0": NORMAL})) == {wrong}


@pytest.mark.parametrize("numbers", [("0", "2"), ("1",), ("1", "2", "3"), ("9" * 5000,)])
def test_sets_count_from_zero_without_a_gap(codes: Codes, numbers: tuple[str, ...]) -> None:
    found = codes(of({f"TEXCOORD_{number}": UV for number in numbers}))
    assert found == {("MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY", f"{AT}/attributes")}


def test_sets_stand_in_any_order(codes: Codes) -> None:
    assert codes(of({"TEXCOORD_1": UV, "TEXCOORD_0": UV})) == set()


def test_joints_have_weights(codes: Codes) -> None:
    assert codes(of({"JOINTS_0": JOINTS, "WEIGHTS_0": VEC4})) == set()
    mismatch = ("MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", f"{AT}/attributes")
    assert codes(of({"JOINTS_0": JOINTS})) == {mismatch}
    assert codes(of({"WEIGHTS_0": VEC4})) == {mismatch}


def test_tangents_have_normals(codes: Codes) -> None:
    lonely = ("MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL", f"{AT}/attributes/TANGENT")
    assert lonely in codes(of({"TANGENT": VEC4}))
    assert lonely not in codes(of({"TANGENT": VEC4, "NORMAL": NORMAL}))


def test_a_primitive_has_positions(codes: Codes) -> None:
    asset = {"accessors": ACCESSORS, "meshes": [mesh({"NORMAL": NORMAL})]}
    assert codes(asset) == {("MESH_PRIMITIVE_NO_POSITION", f"{AT}/attributes")}


def test_names_that_refer_to_nothing_still_count(codes: Codes) -> None:
    unresolved = ("UNRESOLVED_REFERENCE", f"{AT}/attributes/TEXCOORD_0")
    assert codes(of({"TEXCOORD_0": 99, "TEXCOORD_1": UV})) == {unresolved}


@pytest.mark.parametrize("name", ["FOO", "JOINTS_0", "TEXCOORD_X", "POSITION_0"])
def test_targets_move_what_can_be_moved(codes: Codes, name: str) -> None:
    wrong = ("MESH_PRIMITIVE_INVALID_ATTRIBUTE", f"{AT}/targets/0/{name}")
    assert wrong in codes(of({}, targets=[{name: NORMAL}]))
    fine = of({"_OWN": NORMAL, "NORMAL": NORMAL}, targets=[{"_OWN": NORMAL, "NORMAL": NORMAL}])
    assert codes(fine) == set()


def morphed(*counts: int, weights: int | None = None) -> dict[str, Any]:
    """Return an asset whose primitives have so many morph targets, and the mesh so many weights."""
    primitives = [
        {"attributes": {"POSITION": 0}, **({"targets": [{"POSITION": 0}] * count} if count else {})}
        for count in counts
    ]
    described = {"primitives": primitives, **({"weights": [0] * weights} if weights else {})}
    return {"accessors": [POSITIONS], "meshes": [described]}


def test_primitives_have_as_many_targets_as_the_first(codes: Codes) -> None:
    unequal = "MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT"
    assert codes(morphed(2, 2)) == set()
    assert codes(morphed(1, 1, 2, 1)) == {(unequal, "/meshes/0/primitives/2/targets")}
    assert codes(morphed(2, 0)) == {(unequal, "/meshes/0/primitives/1")}


def test_a_mesh_has_a_weight_for_each_target(codes: Codes) -> None:
    wrong = ("MESH_INVALID_WEIGHTS_COUNT", "/meshes/0/weights")
    assert codes(morphed(2, weights=2)) == set()
    assert codes(morphed(2, weights=1)) == {wrong}
    assert codes(morphed(0, weights=1)) == {wrong}
