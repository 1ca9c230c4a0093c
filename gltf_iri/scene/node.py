"""The node graph: from each node's matrix or TRS to its place in the world (glTF 2.0 §3.5)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.limits import MAX_NUMBER
from gltf_iri.errors import AssetError, UsageError

__all__ = ["choose_scene", "local_matrix", "nodes_of_scene", "rotation_matrix", "world_matrices"]

Float64 = NDArray[np.float64]
Json = Mapping[str, Any]

# Exporters write float32 quaternions; a norm further from 1 than this is reported in the notes.
_UNIT_QUATERNION_SLACK = 1e-3

_TRANSFORM = frozenset({"matrix", "translation", "rotation", "scale"})


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

    Nodes outside the scene are placed too: a skin may name them. That the nodes form trees, the asset's door
    has checked. Raises AssetError where their transforms overflow.
    """
    nodes: Sequence[Json] = document.get("nodes", ())
    worlds: list[Float64] = [np.eye(4)] * len(nodes)
    waiting = [(root, np.eye(4)) for root in _roots(nodes)]
    with np.errstate(over="ignore", invalid="ignore"):  # refused below instead of warned about here
        while waiting:
            index, above = waiting.pop()
            node = nodes[index]
            # Most nodes of a large file only group others, and a few bytes of JSON make one.
            is_placed = not _TRANSFORM.isdisjoint(node)
            worlds[index] = above @ local_matrix(node, f"/nodes/{index}", notes) if is_placed else above
            waiting.extend((child, worlds[index]) for child in node.get("children", ()))
    _refuse_overflow(worlds)
    return tuple(worlds)


def _refuse_overflow(worlds: Sequence[Float64]) -> None:
    if not worlds:
        return
    fits = (np.abs(np.stack(worlds)) <= MAX_NUMBER).all(axis=(1, 2))
    if not fits.all():
        raise AssetError(
            "its transform and those above it multiply to numbers beyond single precision",
            pointer=f"/nodes/{int(np.argmin(fits))}",
        )


def nodes_of_scene(document: Json, roots: Sequence[int]) -> Iterator[int]:
    """Yield the indices of the nodes under `roots`, parents first, in the order of the file."""
    nodes: Sequence[Json] = document.get("nodes", ())
    waiting = list(reversed(roots))
    while waiting:
        index = waiting.pop()
        yield index
        waiting.extend(reversed(nodes[index].get("children", ())))


def choose_scene(document: Json, index: int | None, notes: list[str]) -> tuple[str, tuple[int, ...]]:
    """Return (name, root nodes) of scene `index`, or of the file's default scene.

    Without a default scene the first stands in, without scenes every root node does; the notes say so.
    Raises UsageError where the caller's `index` does not exist.
    """
    scenes: Sequence[Json] = document.get("scenes", ())
    if index is None:
        if not scenes:
            notes.append("The file has no scene: every root node is drawn.")
            return "", _roots(document.get("nodes", ()))
        index = document.get("scene", 0)
        if "scene" not in document and len(scenes) > 1:
            notes.append(f"The file names no default scene: the first of {len(scenes)} is drawn.")
    if not 0 <= index < len(scenes):
        raise UsageError(f"There is no scene {index}; the file has {len(scenes)}, counted from 0.")
    return str(scenes[index].get("name", "")), tuple(scenes[index].get("nodes", ()))


def _roots(nodes: Sequence[Json]) -> tuple[int, ...]:
    children = {child for node in nodes for child in node.get("children", ())}
    return tuple(index for index in range(len(nodes)) if index not in children)
