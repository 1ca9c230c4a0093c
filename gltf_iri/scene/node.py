"""The node graph: from each node's matrix or TRS to its place in the world (glTF 2.0 §3.5)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import AssetError

__all__ = ["choose_scene", "local_matrix", "nodes_of_scene", "rotation_matrix", "world_matrices"]

Float64 = NDArray[np.float64]
Json = Mapping[str, Any]

# Exporters write float32 quaternions; a norm further from 1 than this is worth a word in the notes.
_UNIT_QUATERNION_SLACK = 1e-3


def rotation_matrix(quaternion: Sequence[float] | Float64) -> Float64:
    """Return the (3, 3) rotation of a unit quaternion (x, y, z, w).

    R = I + 2w[v]× + 2[v]×², v = (x, y, z).
    """
    x, y, z, w = (float(q) for q in quaternion)
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + 2.0 * w * cross + 2.0 * cross @ cross, dtype=np.float64)


def local_matrix(node: Json, pointer: str, notes: list[str]) -> Float64:
    """Return the node's own (4, 4) transform, M = T R S or its column-major `matrix`.

    Raises AssetError where the numbers do not make an affine transform.
    """
    if "matrix" in node:
        matrix = np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
        if not np.array_equal(matrix[3], (0.0, 0.0, 0.0, 1.0)):
            raise AssetError(
                "the matrix's fourth row must be 0, 0, 0, 1; a node cannot project",
                pointer=f"{pointer}/matrix",
            )
    else:
        quaternion = np.array(node.get("rotation", (0.0, 0.0, 0.0, 1.0)), dtype=np.float64)
        length = float(np.linalg.norm(quaternion))
        if not length > 0.0:
            raise AssetError(
                "the rotation has length 0; write a unit quaternion", pointer=f"{pointer}/rotation"
            )
        if abs(length - 1.0) > _UNIT_QUATERNION_SLACK:
            notes.append(f"{pointer}/rotation is not a unit quaternion (length {length:.4g}): normalised.")
        matrix = np.eye(4)
        matrix[:3, :3] = rotation_matrix(quaternion / length) * np.array(node.get("scale", (1.0, 1.0, 1.0)))
        matrix[:3, 3] = node.get("translation", (0.0, 0.0, 0.0))
    if not np.all(np.isfinite(matrix)):
        raise AssetError("the transform holds a number that is not finite", pointer=pointer)
    return matrix


def world_matrices(document: Json, notes: list[str]) -> tuple[Float64, ...]:
    """Return every node's world transform, (4, 4) each, in the order of the file.

    Nodes outside the scene are placed too: a skin may name them. Raises AssetError where the graph is not a
    set of trees: a node with two parents, or a circle.
    """
    nodes: Sequence[Json] = document.get("nodes", ())
    parents = _parents(nodes)
    worlds: list[Float64 | None] = [None] * len(nodes)
    waiting = [i for i, parent in enumerate(parents) if parent is None]
    while waiting:
        index = waiting.pop()
        world = local_matrix(nodes[index], f"/nodes/{index}", notes)
        parent = parents[index]
        above = None if parent is None else worlds[parent]
        worlds[index] = world if above is None else above @ world
        waiting.extend(nodes[index].get("children", ()))
    for index, placed in enumerate(worlds):
        if placed is None:
            raise AssetError(
                "the node is its own ancestor; the node graph must be trees", pointer=f"/nodes/{index}"
            )
    return tuple(world for world in worlds if world is not None)


def nodes_of_scene(document: Json, roots: Sequence[int]) -> Iterator[int]:
    """Yield the indices of the nodes under `roots`, parents first, in the order of the file.

    Call after `world_matrices`, which has established that the graph is made of trees.
    """
    nodes: Sequence[Json] = document.get("nodes", ())
    waiting = list(reversed(roots))
    while waiting:
        index = waiting.pop()
        yield index
        waiting.extend(reversed(nodes[index].get("children", ())))


def choose_scene(document: Json, index: int | None, notes: list[str]) -> tuple[str, tuple[int, ...]]:
    """Return (name, root nodes) of scene `index`, or of the file's default scene.

    Without a default scene the first stands in, without scenes every root node does; the notes say so.
    Raises AssetError where `index` does not exist or a listed node is not a root.
    """
    scenes: Sequence[Json] = document.get("scenes", ())
    parents = _parents(document.get("nodes", ()))
    if not scenes and index is None:
        notes.append("The file has no scene: every root node is drawn.")
        return "", tuple(i for i, parent in enumerate(parents) if parent is None)
    if index is None:
        index = document.get("scene")
        if index is None:
            index = 0
            if len(scenes) > 1:
                notes.append(f"The file names no default scene: the first of {len(scenes)} is drawn.")
    if not 0 <= index < len(scenes):
        raise AssetError(f"there is no scene {index}; the file has {len(scenes)}", pointer="/scenes")
    roots = tuple(scenes[index].get("nodes", ()))
    seen: set[int] = set()
    for place, node in enumerate(roots):
        pointer = f"/scenes/{index}/nodes/{place}"
        if parents[node] is not None:
            raise AssetError(
                f"node {node} has a parent, so it cannot be a root of the scene", pointer=pointer
            )
        if node in seen:
            raise AssetError(f"node {node} is listed twice", pointer=pointer)
        seen.add(node)
    return str(scenes[index].get("name", "")), roots


def _parents(nodes: Sequence[Json]) -> list[int | None]:
    parents: list[int | None] = [None] * len(nodes)
    for index, node in enumerate(nodes):
        for place, child in enumerate(node.get("children", ())):
            if parents[child] is not None:
                raise AssetError(
                    f"node {child} has two parents, {parents[child]} and {index}; nodes must form trees",
                    pointer=f"/nodes/{index}/children/{place}",
                )
            parents[child] = index
    return parents
