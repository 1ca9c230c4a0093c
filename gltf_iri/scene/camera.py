"""Cameras of a file, and the projection of every camera (glTF 2.0 §3.10)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.limits import MAX_NUMBER
from gltf_iri.errors import AssetError, UsageError
from gltf_iri.scene.model import Camera

__all__ = ["projection_matrix", "read_camera"]

Float64 = NDArray[np.float64]


def read_camera(description: Mapping[str, Any], world: Float64, name: str, pointer: str) -> Camera:
    """Return the camera of a node whose world transform is `world` (4, 4).

    `description` has passed the asset's structural check. The node's scale does not reach the view
    (§3.10.2). Raises AssetError where the numbers make no frustum.
    """
    kind = description["type"]
    lens: Mapping[str, float] = description[kind]
    where = f"{pointer}/{kind}"
    near, far = lens["znear"], lens.get("zfar")
    if far is not None and not far > near:
        raise AssetError(f"zfar {far:g} must lie beyond znear {near:g}", pointer=where)
    view = _view_of(world, pointer)
    if kind == "perspective":
        if not lens["yfov"] < math.pi:
            raise AssetError("yfov must be less than π radians", pointer=where)
        aspect = lens.get("aspectRatio")
        camera = Camera(name, "perspective", view, near, far, yfov_rad=lens["yfov"], aspect=aspect)
        return _usable(camera, where)
    xmag, ymag = abs(lens["xmag"]), abs(lens["ymag"])
    if not (xmag > 0.0 and ymag > 0.0):
        raise AssetError("xmag and ymag must not be 0", pointer=where)
    camera = Camera(name, "orthographic", view, near, far, xmag_m=xmag, ymag_m=ymag, aspect=xmag / ymag)
    return _usable(camera, where)


def _usable(camera: Camera, pointer: str) -> Camera:
    """Refuse a frustum whose matrix overflows, such as a field of view of 1e-320."""
    with np.errstate(all="ignore"):
        matrix = projection_matrix(camera, camera.aspect or 1.0) @ camera.view
    if not np.all(np.abs(matrix) <= MAX_NUMBER):
        raise AssetError("the camera's numbers are beyond single precision together", pointer=pointer)
    return camera


def projection_matrix(camera: Camera, aspect: float) -> Float64:
    """Return (4, 4) from eye space to OpenGL's clip space, for a picture `aspect` times as wide as high.

    Everything that the camera's own aspect frames stays in the picture and nothing is stretched: a picture
    wider than that shows more at the sides, a narrower one more above and below.
    glTF 2.0 §3.10.3.1: finite and infinite perspective, orthographic.
    """
    near, far = camera.znear_m, camera.zfar_m
    widen = max(camera.aspect / aspect, 1.0) if camera.aspect is not None else 1.0
    matrix = np.zeros((4, 4))
    if camera.kind == "perspective":
        slope = math.tan(0.5 * camera.yfov_rad) * widen
        matrix[0, 0] = 1.0 / (aspect * slope)
        matrix[1, 1] = 1.0 / slope
        matrix[3, 2] = -1.0
        if far is None:
            matrix[2, 2], matrix[2, 3] = -1.0, -2.0 * near
        else:
            matrix[2, 2] = (far + near) / (near - far)
            matrix[2, 3] = 2.0 * far * near / (near - far)
        return matrix
    ymag = camera.ymag_m * widen
    if far is None:
        raise UsageError("An orthographic camera needs a far plane.")
    matrix[0, 0] = 1.0 / (aspect * ymag)
    matrix[1, 1] = 1.0 / ymag
    matrix[2, 2] = 2.0 / (near - far)
    matrix[2, 3] = (far + near) / (near - far)
    matrix[3, 3] = 1.0
    return matrix


def _view_of(world: Float64, pointer: str) -> Float64:
    """Return the (4, 4) view of an orthonormal frame that looks along the node's −Z with its +Y upwards."""
    backward = world[:3, 2]
    right = np.cross(world[:3, 1], backward)
    if not (np.linalg.norm(backward) > 0.0 and np.linalg.norm(right) > 0.0):
        raise AssetError("the camera's node is scaled to 0, so it looks nowhere", pointer=pointer)
    backward = backward / np.linalg.norm(backward)
    right = right / np.linalg.norm(right)
    axes = np.stack([right, np.cross(backward, right), backward])
    view = np.eye(4)
    view[:3, :3] = axes
    view[:3, 3] = -axes @ world[:3, 3]
    return view
