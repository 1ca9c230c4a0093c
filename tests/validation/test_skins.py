"""Skins and skinned meshes: joints of one tree, shown with the mesh, and transforms without effect."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from small_meshes import POSITIONS, UNSIGNED_BYTE, accessor

Codes = Callable[..., set[tuple[str, str | int | None]]]

SKINNED = {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}
MOVED = {"translation": [1, 0, 0]}
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]

NO_ROOT = ("SKIN_NO_COMMON_ROOT", "/skins/0/joints")
NO_SCENE = ("NODE_SKIN_NO_SCENE", "/nodes/0")
BAD_SKELETON = ("SKIN_SKELETON_INVALID", "/skins/0/skeleton")


def skinned(
    *nodes: dict[str, Any],
    joints: list[int] | None = None,
    scenes: list[list[int]] | None = None,
    attributes: dict[str, int] | None = None,
    **skin: Any,
) -> dict[str, Any]:
    """Return a skinned mesh with its nodes, the first of which shows it unless it says otherwise."""
    asset = {
        "accessors": [POSITIONS, accessor("VEC4", UNSIGNED_BYTE), accessor("VEC4")],
        "meshes": [{"primitives": [{"attributes": SKINNED if attributes is None else attributes}]}],
        "nodes": list(nodes),
        "skins": [{"joints": [1] if joints is None else joints, **skin}],
    }
    return asset if scenes is None else {**asset, "scenes": [{"nodes": listed} for listed in scenes]}


SHOWN = {"mesh": 0, "skin": 0}


def over(*children: int, **more: Any) -> dict[str, Any]:
    return {"children": list(children), **more}


def test_a_sound_skin(codes: Codes) -> None:
    assert codes(skinned(SHOWN, {}, scenes=[[0, 1]])) == set()


@pytest.mark.parametrize(
    ("nodes", "joints", "told"),
    [
        ([{}, {}], [1, 2], {NO_ROOT}),
        ([{}, {}, over(1, 2)], [1, 2], set()),
        ([over(2), {}], [1, 2], set()),
        ([{}], [9], {NO_ROOT, ("UNRESOLVED_REFERENCE", "/skins/0/joints/0"), ("NODE_EMPTY", "/nodes/1")}),
        ([{}], [1, 9], {("UNRESOLVED_REFERENCE", "/skins/0/joints/1")}),
        # Three trees are no more one than two are.
        ([{}, {}, {}], [1, 2, 3], {NO_ROOT}),
        (
            [over(2), over(1)],
            [1, 2],
            {("NODE_LOOP", "/nodes/1"), ("NODE_LOOP", "/nodes/2")},
        ),
    ],
)
def test_joints_have_an_ancestor_in_common(
    nodes: list[dict[str, Any]], joints: list[int], told: set[tuple[str, str]], codes: Codes
) -> None:
    assert codes(skinned(SHOWN, *nodes, joints=joints)) == told


@pytest.mark.parametrize(("skeleton", "is_told"), [(4, False), (3, False), (1, True), (5, True)])
def test_the_skeleton_is_an_ancestor_of_all_joints(skeleton: int, is_told: bool, codes: Codes) -> None:
    nodes = [{}, {}, over(1, 2), over(3, 5), {"extras": {}}]
    told = codes(skinned(SHOWN, *nodes, joints=[1, 2], skeleton=skeleton))
    assert told == ({BAD_SKELETON} if is_told else set())


def test_the_skeleton_may_be_the_joint_above_the_others(codes: Codes) -> None:
    assert codes(skinned(SHOWN, over(2), {}, joints=[1, 2], skeleton=1)) == set()
    assert codes(skinned(SHOWN, over(2), {}, joints=[1, 2], skeleton=2)) == {BAD_SKELETON}


@pytest.mark.parametrize(
    ("scenes", "is_told"),
    [([[0, 2]], False), ([[0]], True), ([[0, 2], [0]], True), ([[2]], False), (None, False)],
)
def test_a_scene_with_the_mesh_holds_the_joints(
    scenes: list[list[int]] | None, is_told: bool, codes: Codes
) -> None:
    told = codes(skinned(SHOWN, {}, over(1), scenes=scenes))
    assert told == ({NO_SCENE} if is_told else set())


@pytest.mark.parametrize(("scene", "is_told"), [([0], True), ([1], False), ([0, 1], True), ([2], False)])
def test_a_scene_that_names_a_part_of_a_tree_shows_what_is_below(
    scene: list[int], is_told: bool, codes: Codes
) -> None:
    told = codes(skinned(SHOWN | over(1), {}, {}, joints=[2], scenes=[scene]))
    assert (NO_SCENE in told) == is_told


@pytest.mark.parametrize(
    ("own", "is_told"),
    [
        (MOVED, True),
        ({"rotation": [0, 0, 0, -1]}, True),
        ({"matrix": [2, *IDENTITY[1:]]}, True),
        ({"translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1 + 1e-9]}, False),
    ],
)
def test_the_transform_of_a_skinned_mesh_has_no_effect(
    own: dict[str, Any], is_told: bool, codes: Codes
) -> None:
    told = codes(skinned({**SHOWN, **own}, {}))
    assert told == ({("NODE_SKINNED_MESH_LOCAL_TRANSFORMS", "/nodes/0")} if is_told else set())


@pytest.mark.parametrize(
    ("above", "is_moved"),
    [
        ([over(0)], False),
        ([over(0, **MOVED)], True),
        ([over(0), over(2, **MOVED)], True),
        ([over(0, translation=[0, 0, 0])], False),
    ],
)
def test_nor_have_those_above_it(above: list[dict[str, Any]], is_moved: bool, codes: Codes) -> None:
    told = {("NODE_SKINNED_MESH_NON_ROOT", "/nodes/0")}
    if is_moved:
        told.add(("NODE_SKINNED_MESH_PARENT_TRANSFORMS", "/nodes/0"))
    assert codes(skinned(SHOWN, {}, *above)) == told


def test_a_mesh_with_joints_needs_a_skin(codes: Codes) -> None:
    told = codes(skinned({"mesh": 0}, {}))
    assert told == {("NODE_SKINNED_MESH_WITHOUT_SKIN", "/nodes/0")}


@pytest.mark.parametrize("attributes", [{"POSITION": 0}, {"POSITION": 0, "JOINTS_0": 1}])
def test_a_skin_needs_a_mesh_with_joints(attributes: dict[str, int], codes: Codes) -> None:
    told = codes(skinned(SHOWN, {}, attributes=attributes))
    assert ("NODE_SKIN_WITH_NON_SKINNED_MESH", "/nodes/0") in told
