"""Nodes: what they are for, the trees they form, the scenes that show them, their morph weights."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.tables import EXTENSIONS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]

# What gives a node a meaning by itself; a joint has one without.
_PURPOSES = ("children", "mesh", "camera")


def nodes_serve_a_purpose(root: Entry, asset: Asset) -> Iterator[Issue]:
    """A node holds something, is a joint, or carries what an extension or application put there."""
    joints = {joint for skin in asset.array("skins") if skin is not None for joint in skin.get("joints", ())}
    for index, node in enumerate(asset.array("nodes")):
        if node is None or index in joints or any(key in node for key in _PURPOSES):
            continue
        if node.raw.get("extras") is None and not _has_extension(node, asset):
            yield issue("NODE_EMPTY", node.pointer)


def _has_extension(node: Entry, asset: Asset) -> bool:
    """Tell whether the node carries an extension; one that is known not to belong on nodes is none."""
    stated = node.raw.get("extensions")
    return isinstance(stated, dict) and any(
        name in node.extensions or name not in EXTENSIONS or name not in asset.declared for name in stated
    )


def nodes_form_trees(root: Entry, asset: Asset) -> Iterator[Issue]:
    """Every node has one parent at most, and none is its own ancestor."""
    nodes, trees = asset.array("nodes"), asset.trees
    for index, position, child in trees.overrides:
        node = nodes[index]
        if node is not None:
            yield issue("NODE_PARENT_OVERRIDE", node.at("children", position), node=child)
    for node, is_in_loop in zip(nodes, trees.is_in_loop, strict=True):
        if is_in_loop and node is not None:
            yield issue("NODE_LOOP", node.pointer)


def scenes_list_roots(root: Entry, asset: Asset) -> Iterator[Issue]:
    """A scene lists nodes without a parent: what hangs on them is shown with them."""
    parents = asset.trees.parents
    for scene in asset.array("scenes"):
        for position, index in enumerate(scene.get("nodes", ()) if scene is not None else ()):
            if scene is not None and index is not None and parents[index] is not None:
                yield issue("SCENE_NON_ROOT_NODE", scene.at("nodes", position), node=index)


def weights_fit_morph_targets(root: Entry, asset: Asset) -> Iterator[Issue]:
    """A node has a weight for each morph target of its mesh; the mesh's own are then never read."""
    # Index of a mesh to whether some node reads its weights.
    is_read: dict[int, bool] = {}
    for node in asset.array("nodes"):
        mesh = asset.get("meshes", node.get("mesh")) if node is not None else None
        if node is None or mesh is None:
            continue
        # Of a mesh without primitives nothing is read.
        reads = "weights" not in node and "primitives" in mesh
        is_read[node["mesh"]] = is_read.get(node["mesh"], False) or reads
        if "weights" in node and "primitives" in mesh:
            given, wanted = len(node["weights"]), len(mesh["primitives"][0].get("targets", ()))
            if given != wanted:
                yield issue("NODE_WEIGHTS_INVALID", node.at("weights"), count=given, targets=wanted)
    for index, read in is_read.items():
        mesh = asset.get("meshes", index)
        if mesh is not None and "weights" in mesh and not read:
            yield issue("UNUSED_MESH_WEIGHTS", mesh.at("weights"))


RULES: Rules = {
    "glTF": (nodes_serve_a_purpose, nodes_form_trees, scenes_list_roots, weights_fit_morph_targets)
}
