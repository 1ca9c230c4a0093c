"""Nodes with skinned meshes: the skin moves them, and nothing else does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gltf_iri.validation.codes import issue
from gltf_iri.validation.rules.skins import joints_of
from gltf_iri.validation.rules.transforms import has_transform

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]


def skins_and_meshes_fit(root: Entry, asset: Asset) -> Iterator[Issue]:
    """A mesh with joints has a skin on its node, one without has none."""
    # Index of a mesh to whether it has joints; None where its primitives cannot be read.
    known: dict[int, bool | None] = {}
    for node in asset.array("nodes"):
        mesh = asset.get("meshes", node.get("mesh")) if node is not None else None
        if node is None or mesh is None:
            continue
        if node["mesh"] not in known:
            known[node["mesh"]] = _is_skinned(mesh)
        is_skinned = known[node["mesh"]]
        if is_skinned and "skin" not in node:
            yield issue("NODE_SKINNED_MESH_WITHOUT_SKIN", node.pointer)
        elif is_skinned is False and "skin" in node:
            yield issue("NODE_SKIN_WITH_NON_SKINNED_MESH", node.pointer)


def transforms_have_an_effect(root: Entry, asset: Asset) -> Iterator[Issue]:
    """A skinned mesh stands where its joints do, whatever its node and the nodes above it say."""
    nodes, trees = asset.array("nodes"), asset.trees
    moved = _Moved(nodes, trees.parents)
    for index, node in enumerate(nodes):
        if node is None or "skin" not in node:
            continue
        parent = trees.parents[index]
        if parent is not None:
            yield issue("NODE_SKINNED_MESH_NON_ROOT", node.pointer)
            if moved.is_moved(parent):
                yield issue("NODE_SKINNED_MESH_PARENT_TRANSFORMS", node.pointer)
        if has_transform(node):
            yield issue("NODE_SKINNED_MESH_LOCAL_TRANSFORMS", node.pointer)


def scenes_hold_joints(root: Entry, asset: Asset) -> Iterator[Issue]:
    """Every scene that shows a skinned mesh also holds its joints."""
    trees = asset.trees
    shown: dict[int, set[int]] = {}
    for number, scene in enumerate(asset.array("scenes")):
        for index in scene.get("nodes", ()) if scene is not None else ():
            if index is not None:
                shown.setdefault(index, set()).add(number)
    whole = {top: scenes for top, scenes in shown.items() if trees.parents[top] is None}
    nearest = _nearest_shown(trees.parents, shown)
    # A node that scenes name, and the top of the joints' tree, to whether all those scenes have both.
    known: dict[tuple[int, int], bool] = {}
    tops_of_skins = [_top_of_joints(skin, asset) for skin in asset.array("skins")]
    for index, node in enumerate(asset.array("nodes")):
        top = tops_of_skins[node["skin"]] if node is not None and "skin" in node else None
        if node is None or top is None:
            continue
        for place in {nearest[index], trees.tops[index]}:
            pair = place, top
            if pair not in known:
                known[pair] = shown.get(place, set()) <= whole.get(top, set())
            if not known[pair]:
                yield issue("NODE_SKIN_NO_SCENE", node.pointer)
                break


def _nearest_shown(parents: list[int | None], shown: dict[int, set[int]]) -> list[int]:
    """Return for each node the first that scenes name, from itself up; where they name none, the last."""
    nearest = list(range(len(parents)))
    is_known = [False] * len(parents)
    for start in nearest.copy():
        way: list[int] = []
        node: int | None = start
        while node is not None and not is_known[node]:
            is_known[node] = True
            way.append(node)
            node = None if node in shown else parents[node]
        for member in way:
            nearest[member] = way[-1] if node is None else nearest[node]
    return nearest


class _Moved:
    """Which nodes are moved by their own transform or by one above, each asked once."""

    __slots__ = ("_known", "_nodes", "_parents")

    def __init__(self, nodes: list[Entry | None], parents: list[int | None]) -> None:
        self._nodes = nodes
        self._parents = parents
        self._known: dict[int, bool] = {}

    def is_moved(self, start: int) -> bool:
        way: list[int] = []
        node: int | None = start
        while node is not None and node not in self._known:
            # Unmoved until something above says otherwise; this also ends the way through a loop.
            self._known[node] = False
            way.append(node)
            entry = self._nodes[node]
            if entry is not None and has_transform(entry):
                self._known[node] = True
                break
            node = self._parents[node]
        found = node is not None and self._known[node]
        for passed in way:
            self._known[passed] = found
        return found


def _top_of_joints(skin: Entry | None, asset: Asset) -> int | None:
    """Return the top of the tree that holds all joints, or None where there is no such tree."""
    tops = {asset.trees.tops[joint] for joint in joints_of(skin)} if skin is not None else set()
    if len(tops) != 1:
        return None
    top = tops.pop()
    return None if asset.trees.is_in_loop[top] else top


def _is_skinned(mesh: Entry) -> bool | None:
    """Tell whether a primitive names as many sets of joints as of weights, without gaps."""
    if "primitives" not in mesh:
        return None
    return any(_has_joints(primitive.raw.get("attributes")) for primitive in mesh["primitives"])


def _has_joints(attributes: Any) -> bool:
    if not isinstance(attributes, dict):
        return False
    joints = sum(name.startswith("JOINTS_") for name in attributes)
    weights = sum(name.startswith("WEIGHTS_") for name in attributes)
    sets = range(joints)
    has_gaps = any(f"JOINTS_{n}" not in attributes or f"WEIGHTS_{n}" not in attributes for n in sets)
    return joints > 0 and joints == weights and not has_gaps


RULES: Rules = {"glTF": (skins_and_meshes_fit, transforms_have_an_effect, scenes_hold_joints)}
