"""The few shapes that the samples need, as triangles with normals and texture coordinates.

Lengths are metres, +Y is up, texture coordinates have v downwards (glTF 2.0 §3.4, §3.8). Winding is
counter-clockwise seen from outside.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Shape", "grid", "merge", "sheet", "solid_of_revolution", "tile"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Shape:
    """Vertices and triangles. cross(normal, tangent) · w points up in the texture, where v falls."""

    positions: Float64  # (n, 3)
    normals: Float64  # (n, 3), unit
    uvs: Float64  # (n, 2)
    triangles: NDArray[np.uint16]  # (m, 3)
    tangents: Float64  # (n, 4), w is the handedness


def _grid_triangles(rows: int, columns: int) -> NDArray[np.uint16]:
    """Return the triangles of a (rows + 1) × (columns + 1) grid of vertices, row 0 on top."""
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    below = first + columns + 1
    upper = np.stack([first, below, first + 1], axis=-1)
    lower = np.stack([first + 1, below, below + 1], axis=-1)
    return np.concatenate([upper, lower]).astype(np.uint16)


def _unit(vectors: Float64) -> Float64:
    return np.asarray(vectors / np.linalg.norm(vectors, axis=-1, keepdims=True))


def _right_handed(along: Float64) -> Float64:
    return np.concatenate([along, np.ones((len(along), 1))], axis=-1)


def grid(positions: Float64, normals: Float64, along_u: Float64, uvs: Float64) -> Shape:
    """Return the surface over a grid of vertices, row 0 on top, columns to the right as seen from outside.

    positions, normals, along_u : (rows, columns, 3), in m and any length; along_u lies in the surface.
    uvs : (rows, columns, 2).

    Triangles without area, as around a pole, are left out.
    """
    rows, columns = positions.shape[:2]
    flat = positions.reshape(-1, 3)
    triangles = _grid_triangles(rows - 1, columns - 1)
    corners = flat[triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=-1)
    tangents = _right_handed(_unit(along_u).reshape(-1, 3))
    return Shape(flat, _unit(normals).reshape(-1, 3), uvs.reshape(-1, 2), triangles[area > 1e-12], tangents)


def solid_of_revolution(
    radius: ArrayLike, height: ArrayLike, slope: ArrayLike, v: ArrayLike, *, segments: int
) -> Shape:
    """Turn a profile about +Y; u runs once around, to the right as seen from outside.

    radius, height : (rows,) in m, from top to bottom.
    slope : (rows, 2) normals of the profile, (outward, up), any length.
    v : (rows,) second texture coordinate.
    """
    r, h = np.asarray(radius, dtype=np.float64), np.asarray(height, dtype=np.float64)
    profile = _unit(np.asarray(slope, dtype=np.float64))
    u = np.linspace(0.0, 1.0, segments + 1)
    azimuth = (2.0 * np.pi * u)[None, :]
    sine, cosine = np.sin(azimuth), np.cos(azimuth)
    ones = np.ones((len(r), segments + 1))
    positions = np.stack([r[:, None] * sine, h[:, None] * ones, r[:, None] * cosine], axis=-1)
    outward, up = profile[:, :1], profile[:, 1:]
    normals = np.stack([outward * sine, up * ones, outward * cosine], axis=-1)
    tangents = np.stack([ones * cosine, 0.0 * ones, -ones * sine], axis=-1)
    uvs = np.stack([ones * u, np.asarray(v, dtype=np.float64)[:, None] * ones], axis=-1)
    return grid(positions, normals, tangents, uvs)


def sheet(
    width_m: float, depth_m: float, cells: int, height: Callable[[Float64, Float64], tuple[Float64, ...]]
) -> Shape:
    """Return a horizontal sheet, seen from above, with u along +X and v along +Z.

    height(x, z) gives (y, ∂y/∂x, ∂y/∂z) in m and m/m.
    """
    line = np.linspace(0.0, 1.0, cells + 1)
    u, v = np.meshgrid(line, line)
    x, z = (u - 0.5) * width_m, (v - 0.5) * depth_m
    y, slope_x, slope_z = height(x, z)
    normals = np.stack([-slope_x, np.ones_like(x), -slope_z], axis=-1)
    along = np.stack([np.ones_like(x), slope_x, np.zeros_like(x)], axis=-1)
    return grid(np.stack([x, y, z], axis=-1), normals, along, np.stack([u, v], axis=-1))


def tile(centre: ArrayLike, across: ArrayLike, up: ArrayLike, uv: tuple[float, float]) -> Shape:
    """Return a flat parallelogram with the edges `across` and `up` and one texture coordinate all over."""
    middle, right, top = (np.asarray(a, dtype=np.float64) for a in (centre, across, up))
    signs = ((-0.5, 0.5), (0.5, 0.5), (-0.5, -0.5), (0.5, -0.5))  # row by row from the top
    positions = np.stack([middle + a * right + b * top for a, b in signs])
    normal = _unit(np.cross(right, top))
    tangents = _right_handed(np.tile(_unit(right), (4, 1)))
    return Shape(positions, np.tile(normal, (4, 1)), np.tile(uv, (4, 1)), _grid_triangles(1, 1), tangents)


def merge(shapes: Sequence[Shape]) -> Shape:
    """Return one shape with the vertices of all."""
    offsets = np.cumsum([0, *(len(shape.positions) for shape in shapes)])[:-1]
    triangles = [s.triangles + np.uint16(offset) for s, offset in zip(shapes, offsets, strict=True)]
    return Shape(
        np.concatenate([shape.positions for shape in shapes]),
        np.concatenate([shape.normals for shape in shapes]),
        np.concatenate([shape.uvs for shape in shapes]),
        np.concatenate(triangles),
        np.concatenate([shape.tangents for shape in shapes]),
    )
