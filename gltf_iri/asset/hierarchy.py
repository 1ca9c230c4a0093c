"""The node hierarchy is a set of trees (glTF 2.0 §3.5.2): one parent, no cycles, scenes list only roots."""

from __future__ import annotations

from typing import Any

from gltf_iri.asset.limits import MAX_NODE_DEPTH
from gltf_iri.errors import AssetError

__all__ = ["check_hierarchy"]


def check_hierarchy(root: dict[str, Any]) -> None:
    """Raise AssetError for a second parent, a cycle, a chain too deep to walk, a scene that lists a child."""
    nodes = root.get("nodes", [])
    parents: dict[int, int] = {}
    for number, node in enumerate(nodes):
        for position, child in enumerate(node.get("children", [])):
            if child in parents:
                raise AssetError(
                    f"node {child} already is a child of node {parents[child]}; a node has one parent",
                    pointer=f"/nodes/{number}/children/{position}",
                )
            parents[child] = number
    _check_depth(len(nodes), parents)
    for number, scene in enumerate(root.get("scenes", [])):
        for position, node in enumerate(scene.get("nodes", [])):
            if node in parents:
                raise AssetError(
                    f"node {node} is a child of node {parents[node]}; a scene lists root nodes only",
                    pointer=f"/scenes/{number}/nodes/{position}",
                )


def _check_depth(count: int, parents: dict[int, int]) -> None:
    """Walk up from every node, stopping where the depth is known, so that the whole stays linear."""
    depths: dict[int, int] = {}
    for number in range(count):
        path: list[int] = []
        on_path: set[int] = set()
        node = number
        while node not in depths:
            if node in on_path:
                raise AssetError(f"node {node} is its own ancestor", pointer=f"/nodes/{node}/children")
            path.append(node)
            on_path.add(node)
            if node not in parents:
                depths[node] = 1
                break
            node = parents[node]
        for member in reversed(path):
            depths[member] = 1 if member not in parents else depths[parents[member]] + 1
        if depths[number] > MAX_NODE_DEPTH:
            raise AssetError(
                f"the node lies deeper than {MAX_NODE_DEPTH} levels, the most that are walked",
                pointer=f"/nodes/{number}",
            )
