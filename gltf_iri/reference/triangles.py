"""All triangles of a scene in the world, each once, and where a ray meets one of them, in float64."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.scene.model import Scene

__all__ = ["Triangles", "intersect", "nearest_point", "world_triangles"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Triangles:
    """m triangles in the order in which OpenGL draws them, and the u different places they take.

    Faces are often there twice, front to back; a ray then meets both at the same distance. `places` holds
    each set of three corners once, `members[first[i]:first[i + 1]]` the triangles there, in order.
    """

    corners: Float64  # (m, 3, 3), world, metres
    primitive: Int64  # (m,), index into the scene's primitives
    triangle: Int64  # (m,), index into the primitive's triangles
    mirrored: NDArray[np.bool_]  # (m,), the world matrix turns the winding around
    places: Int64  # (u,), a triangle that stands there
    members: Int64  # (m,)
    first: Int64  # (u + 1,)


def world_triangles(scene: Scene) -> Triangles:
    """Gather the triangles of every primitive."""
    positions, indices, primitive, triangle, mirrored = [], [], [], [], []
    placed = 0
    for index, p in enumerate(scene.primitives):
        positions.append(p.positions.astype(np.float64) @ p.world[:3, :3].T + p.world[:3, 3])
        indices.append(p.triangles.astype(np.int64) + placed)
        placed += len(p.positions)
        count = len(p.triangles)
        primitive.append(np.full(count, index))
        triangle.append(np.arange(count))
        mirrored.append(np.full(count, p.is_mirrored))
    vertices, corners = np.concatenate(positions), np.concatenate(indices)
    _, place_of_vertex = np.unique(vertices, axis=0, return_inverse=True)
    sets = np.sort(place_of_vertex.ravel()[corners], axis=1)
    _, places, place_of, counts = np.unique(
        sets, axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    return Triangles(
        vertices[corners],
        np.concatenate(primitive),
        np.concatenate(triangle),
        np.concatenate(mirrored),
        places,
        np.argsort(place_of.ravel(), kind="stable"),
        np.concatenate([[0], np.cumsum(counts)]),
    )


def intersect(
    corners: Float64, origins: Float64, directions: Float64
) -> tuple[Float64, Float64, NDArray[np.bool_]]:
    """Return distances (n,), NaN where a ray passes by, barycentrics (n, 3), and who turns left.

    Barycentrics are those of the triangle's plane, also where a ray passes by; 0 where it runs in the plane.
    Corners that turn left run counter-clockwise as the ray sees them.

    The signed volumes that ray and edges span, d·(c × b) and so on (Woop, Benthin & Wald 2013, "Watertight
    Ray/Triangle Intersection", without its shear). Two triangles with a common edge compute the same number
    for it with opposite signs, so no ray slips between them; it may meet both.

    Parameters
    ----------
    corners : (n, 3, 3), one triangle a ray.
    origins, directions : (n, 3); directions of length 1, origins near the triangles for the volumes' digits.
    """
    a, b, c = (corners[:, i] - origins for i in range(3))
    volumes = np.column_stack(
        [_dot(directions, _cross(c, b)), _dot(directions, _cross(a, c)), _dot(directions, _cross(b, a))]
    )
    total = volumes.sum(axis=1)
    crosses = total != 0.0
    is_met = (np.all(volumes >= 0.0, axis=1) | np.all(volumes <= 0.0, axis=1)) & crosses
    weights = np.where(crosses[:, None], volumes, 0.0) / np.where(crosses, total, 1.0)[:, None]
    reached = weights[:, :1] * a + weights[:, 1:2] * b + weights[:, 2:] * c
    return np.where(is_met, _dot(reached, directions), np.nan), weights, total > 0.0


def nearest_point(
    corners: Float64, origins: Float64, directions: Float64, weights: Float64
) -> tuple[Float64, Float64, Float64]:
    """Return a point of each triangle close to a ray that passes by, and how close it is.

    weights : (n, 3), as `intersect` returned them; cut off at the edges, they are the point's.

    Returns distances along the rays (n,), barycentrics (n, 3), and distances off them (n,), ∞ for none.
    """
    inside = np.clip(weights, 0.0, None)
    total = inside.sum(axis=1, keepdims=True)
    inside = inside / np.where(total > 0.0, total, 1.0)
    offset = np.einsum("nc,nck->nk", inside, corners) - origins
    along = _dot(offset, directions)
    beside = np.linalg.norm(offset - along[:, None] * directions, axis=1)
    return along, inside, np.where(total[:, 0] > 0.0, beside, np.inf)


def _dot(a: Float64, b: Float64) -> Float64:
    return np.asarray(np.sum(a * b, axis=-1))


def _cross(a: Float64, b: Float64) -> Float64:
    """Return a × b; b × a is its exact negative, which a fused multiply-add would spoil."""
    x, y, z = a.T
    u, v, w = b.T
    return np.column_stack([y * w - z * v, z * u - x * w, x * v - y * u])
