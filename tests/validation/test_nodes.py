"""Nodes: purpose, trees, scenes and morph weights."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from small_meshes import POSITIONS

Codes = Callable[..., set[tuple[str, str | int | None]]]

MORPHED = {"primitives": [{"attributes": {"POSITION": 0}, "targets": [{"POSITION": 0}]}]}


def nodes(*children: list[int], **more: Any) -> dict[str, Any]:
    """Return nodes with these children; none of them is empty."""
    return {"nodes": [{"extras": {}, **({"children": c} if c else {})} for c in children], **more}


def pointers(told: set[tuple[str, str | int | None]], code: str) -> set[str | int | None]:
    return {pointer for told_code, pointer in told if told_code == code}


@pytest.mark.parametrize(
    "node", [{}, {"name": "a"}, {"translation": [1, 1, 1]}, {"extensions": {}}, {"mesh": 7}, {"extras": None}]
)
def test_a_node_without_a_purpose_is_told(node: dict[str, Any], codes: Codes) -> None:
    assert ("NODE_EMPTY", "/nodes/0") in codes({"nodes": [node]})


@pytest.mark.parametrize(
    "more",
    [
        {"nodes": [{"extras": {}}]},
        {"nodes": [{"extras": 5}]},
        {"nodes": [{"children": [1]}, {"extras": {}}]},
        {"nodes": [{}], "skins": [{"joints": [0]}]},
        {"nodes": [{"extensions": {"XX_own": {}}}], "extensionsUsed": ["XX_own"]},
        {"nodes": [{"extensions": {"KHR_node_visibility": {}}}], "extensionsUsed": ["KHR_node_visibility"]},
    ],
)
def test_a_node_with_a_purpose_is_not(more: dict[str, Any], codes: Codes) -> None:
    assert not pointers(codes(more), "NODE_EMPTY")


def test_an_extension_that_does_not_belong_on_nodes_is_no_purpose(codes: Codes) -> None:
    name = "KHR_materials_unlit"
    asset = {"nodes": [{"extensions": {name: {}}}], "extensionsUsed": [name]}
    assert codes(asset) == {
        ("NODE_EMPTY", "/nodes/0"),
        ("UNEXPECTED_EXTENSION_OBJECT", f"/nodes/0/extensions/{name}"),
    }


@pytest.mark.parametrize(
    ("children", "loop"),
    [
        ([[1], [2], []], []),
        ([[0]], [0]),
        ([[1], [0]], [0, 1]),
        # What hangs on a loop is not in it.
        ([[1], [0, 2], [3], []], [0, 1]),
    ],
)
def test_loops(children: list[list[int]], loop: list[int], codes: Codes) -> None:
    assert codes(nodes(*children)) == {("NODE_LOOP", f"/nodes/{n}") for n in loop}


def test_of_several_parents_the_last_counts(codes: Codes) -> None:
    assert codes(nodes([1], [2], [1])) == {
        ("NODE_PARENT_OVERRIDE", "/nodes/2/children/0"),
        ("NODE_LOOP", "/nodes/1"),
        ("NODE_LOOP", "/nodes/2"),
    }
    assert codes(nodes([1], [0], [0])) == {("NODE_PARENT_OVERRIDE", "/nodes/2/children/0")}


def test_a_scene_lists_roots(codes: Codes) -> None:
    assert codes(nodes([1], [], scenes=[{"nodes": [0]}])) == set()
    told = codes(nodes([1], [], scenes=[{"nodes": [0, 1]}]))
    assert told == {("SCENE_NON_ROOT_NODE", "/scenes/0/nodes/1")}


def morphed(mesh: dict[str, Any], *weights: list[Any] | None) -> dict[str, Any]:
    """Return a mesh and nodes that show it, with these weights each."""
    shown = [{"mesh": 0, **({} if w is None else {"weights": w})} for w in weights]
    return {"accessors": [POSITIONS], "meshes": [mesh], "nodes": shown}


@pytest.mark.parametrize(("weights", "is_told"), [([1], False), ([1, 1], True), ([0.5], False)])
def test_a_node_has_a_weight_for_each_target(weights: list[float], is_told: bool, codes: Codes) -> None:
    told = codes(morphed(MORPHED, weights))
    assert told == ({("NODE_WEIGHTS_INVALID", "/nodes/0/weights")} if is_told else set())


def test_weights_without_targets_are_too_many(codes: Codes) -> None:
    told = codes(morphed({"primitives": [{"attributes": {"POSITION": 0}}]}, [1]))
    assert told == {("NODE_WEIGHTS_INVALID", "/nodes/0/weights")}


@pytest.mark.parametrize(
    ("weights", "is_told"),
    [([[1]], True), ([[1], [0]], True), ([[1], None], False), ([None], False), ([], False)],
)
def test_weights_of_a_mesh_that_every_node_overrides(
    weights: list[list[float] | None], is_told: bool, codes: Codes
) -> None:
    told = codes({**morphed(MORPHED | {"weights": [0]}, *weights), "extras": {}})
    assert pointers(told, "UNUSED_MESH_WEIGHTS") == ({"/meshes/0/weights"} if is_told else set())


def test_a_long_chain_and_a_long_loop_are_judged(codes: Codes) -> None:
    count = 5000
    chain = [[n + 1] for n in range(count - 1)]
    assert codes(nodes(*chain, [])) == set()
    assert len(codes(nodes(*chain, [0]), max_issues=0)) == count
