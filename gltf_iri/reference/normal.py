"""The shading normal and the directions in the surface (glTF 2.0 §3.7.2.1, §3.9.3).

Twin: shaders/material/normal.glsl, which takes ∂P/∂u from neighbouring pixels instead of a triangle's edges.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.material.texture import NormalTextureInfo, TextureInfo
from gltf_iri.reference.points import Points, unit
from gltf_iri.reference.slots import sample_slot, texture_of, uv_set_of
from gltf_iri.reference.stage import Stage

__all__ = ["mapped_normal", "tangent_frame"]

Float64 = NDArray[np.float64]


def mapped_normal(stage: Stage, slot: int, name: str, points: Points) -> Float64:
    """Return the unit normals (n, 3) of the front side under the normal map `name`, if the plan has one."""
    info, bump = texture_of(stage, slot, name), sample_slot(stage, slot, name, points.uv)
    if not isinstance(info, NormalTextureInfo) or bump is None:
        return points.normal
    scaled = (2.0 * bump - 1.0) * np.array([info.scale, info.scale, 1.0])
    return unit(np.einsum("nk,nkc->nc", scaled, tangent_frame(points, info)))


def tangent_frame(points: Points, info: TextureInfo) -> Float64:
    """Return (n, 3, 3), rows tangent, bitangent and normal of the front side.

    The mesh's own tangents where it has them; else from how position changes with the coordinates that
    `info` is read with: ∂P/∂u made upright on the normal, and −∂P/∂v, for v points down and a map's green up.
    Without coordinates both are 0.
    """
    given = points.tangent[:, :3]
    bitangent = np.cross(points.normal, given) * points.tangent[:, 3:]
    frame = np.stack([given, bitangent, points.normal], axis=1)
    bare = points.tangent[:, 3] == 0.0
    if bare.any():
        frame[bare, :2] = _from_coordinates(points, info)[bare]
    return frame


def _from_coordinates(points: Points, info: TextureInfo) -> Float64:
    """Return tangents and bitangents, (n, 2, 3)."""
    matrix = np.asarray(info.uv_matrix)[:2, :2]
    change = points.uv_edges[:, uv_set_of(info)] @ matrix.T  # (n, edge, (u, v))
    (du1, dv1), (du2, dv2) = change[:, 0].T, change[:, 1].T
    first, second = points.edges[:, 0], points.edges[:, 1]
    side = np.sign(du1 * dv2 - du2 * dv1)[:, None]
    along_u = (first * dv2[:, None] - second * dv1[:, None]) * side
    along_v = (second * du1[:, None] - first * du2[:, None]) * side
    normal = points.normal
    tangent = unit(along_u - normal * np.sum(normal * along_u, axis=1, keepdims=True))
    bitangent = np.cross(normal, tangent)
    points_down = np.sum(bitangent * along_v, axis=1, keepdims=True) > 0.0
    return np.stack([tangent, np.where(points_down, -bitangent, bitangent)], axis=1)
