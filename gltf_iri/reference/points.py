"""The vertices' attributes at the points that rays meet, interpolated in float64."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.scene.model import Primitive, Scene

__all__ = ["Points", "gather_points", "interpolated", "unit"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Points:
    """n points on triangles; vectors are in world space, and none is turned towards the viewer."""

    position: Float64  # (n, 3), metres
    normal: Float64  # (n, 3), unit, interpolated from the vertices
    geometric_normal: Float64  # (n, 3), unit, of the triangle's front side
    is_front: Mask  # (n,), the ray met the front side
    uv: Float64  # (n, 2, 2): the two sets, 0 where the mesh has none
    colour: Float64  # (n, 4), linear; 1 where the mesh has none
    tangent: Float64  # (n, 4), unit and handedness; 0 where the mesh has none
    edges: Float64  # (n, 2, 3), from the triangle's first corner to the two others
    uv_edges: Float64  # (n, 2, 2, 2): set, edge, (u, v)
    world: Float64  # (n, 3, 3), linear part of the node's world matrix


def gather_points(
    scene: Scene, primitive: Int64, triangle: Int64, barycentric: Float64, is_front: Mask
) -> Points:
    """Return the attributes at points given as in `Hits`; all of them must be hits."""
    count = len(primitive)
    points = Points(
        position=np.zeros((count, 3)),
        normal=np.zeros((count, 3)),
        geometric_normal=np.zeros((count, 3)),
        is_front=is_front,
        uv=np.zeros((count, 2, 2)),
        colour=np.ones((count, 4)),
        tangent=np.zeros((count, 4)),
        edges=np.zeros((count, 2, 3)),
        uv_edges=np.zeros((count, 2, 2, 2)),
        world=np.zeros((count, 3, 3)),
    )
    for index in np.unique(primitive):
        rows = np.flatnonzero(primitive == index)
        _fill(points, rows, scene.primitives[index], triangle[rows], barycentric[rows])
    return points


def interpolated(values: NDArray[np.float32], corners: NDArray[np.uint32], barycentric: Float64) -> Float64:
    """Return vertex `values` (v, k) at points (n, k) of the triangles `corners` (n, 3)."""
    return np.asarray(np.einsum("nc,nck->nk", barycentric, values[corners].astype(np.float64)))


def _fill(points: Points, rows: Int64, p: Primitive, triangle: Int64, barycentric: Float64) -> None:
    corners = p.triangles[triangle]
    linear = p.world[:3, :3]
    position = interpolated(p.positions, corners, barycentric)
    points.position[rows] = position @ linear.T + p.world[:3, 3]
    points.normal[rows] = unit(interpolated(p.normals, corners, barycentric) @ _normal_matrix(linear).T)
    placed = p.positions[corners].astype(np.float64) @ linear.T
    edges = placed[:, 1:] - placed[:, :1]
    points.edges[rows] = edges
    side = -1.0 if p.is_mirrored else 1.0
    points.geometric_normal[rows] = side * unit(np.cross(edges[:, 0], edges[:, 1]))
    points.world[rows] = linear
    for number, uvs in enumerate(p.uvs):
        points.uv[rows, number] = interpolated(uvs, corners, barycentric)
        at_corners = uvs[corners].astype(np.float64)
        points.uv_edges[rows, number] = at_corners[:, 1:] - at_corners[:, :1]
    if p.colours is not None:
        points.colour[rows] = interpolated(p.colours, corners, barycentric)
    if p.tangents is not None:
        tangent = interpolated(p.tangents, corners, barycentric)
        points.tangent[rows] = np.column_stack([unit(tangent[:, :3] @ linear.T), side * tangent[:, 3]])


def _normal_matrix(linear: Float64) -> Float64:
    """Return the cofactors of `linear` with the sign that keeps normals outside under mirroring.

    The inverse transpose up to a positive factor, and defined where a scale of 0 leaves no inverse.
    """
    x, y, z = (linear / (np.abs(linear).max() or 1.0)).T
    side = -1.0 if np.linalg.det(linear) < 0.0 else 1.0
    return side * np.column_stack([np.cross(y, z), np.cross(z, x), np.cross(x, y)])


def unit(vectors: Float64) -> Float64:
    """Return `vectors` (n, 3) at length 1; those without a direction stay 0."""
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.where(length > 0.0, length, 1.0))
