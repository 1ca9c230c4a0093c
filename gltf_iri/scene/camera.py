"""Cameras: from the file, or framed around what there is to see (glTF 2.0 §3.10)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.limits import MAX_NUMBER
from gltf_iri.errors import AssetError, UsageError
from gltf_iri.scene.framing import fit_eye
from gltf_iri.scene.model import Camera, Scene

__all__ = ["frame_scene", "projection_matrix", "read_camera"]

Float64 = NDArray[np.float64]

# A view that shows three sides of a box without hiding its front, through a mildly long lens.
AZIMUTH_RAD: Final = math.radians(25.0)
ELEVATION_RAD: Final = math.radians(15.0)
YFOV_RAD: Final = math.radians(35.0)

# Share of the picture left free around the subject.
MARGIN: Final = 0.06

# Near and far planes stand off by this much of the subject's depth, so that rounding clips nothing.
DEPTH_SLACK: Final = 0.05


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


def frame_scene(
    scene: Scene,
    *,
    aspect: float,
    azimuth_rad: float = AZIMUTH_RAD,
    elevation_rad: float = ELEVATION_RAD,
    yfov_rad: float = YFOV_RAD,
) -> Camera:
    """Return the perspective camera that fits every vertex into the picture as tightly as `MARGIN` lets.

    The azimuth turns from +Z towards +X, the elevation up from the horizon; AssetError for an empty scene.
    """
    points = scene.vertices()
    axes = _axes(azimuth_rad, elevation_rad)
    eye = fit_eye(points @ axes.T, *_slopes(yfov_rad, aspect))
    return _camera_at(points, axes, axes.T @ eye, yfov_rad)


def _slopes(yfov_rad: float, aspect: float) -> tuple[float, float]:
    vertical = math.tan(0.5 * yfov_rad) * (1.0 - MARGIN)
    return vertical * aspect, vertical


def _axes(azimuth_rad: float, elevation_rad: float) -> Float64:
    """Return the eye's right, up and backward as rows, (3, 3)."""
    sin_a, cos_a = math.sin(azimuth_rad), math.cos(azimuth_rad)
    sin_e, cos_e = math.sin(elevation_rad), math.cos(elevation_rad)
    return np.array(
        [[cos_a, 0.0, -sin_a], [-sin_a * sin_e, cos_e, -cos_a * sin_e], [sin_a * cos_e, sin_e, cos_a * cos_e]]
    )


def _camera_at(points: Float64, axes: Float64, eye: Float64, yfov_rad: float) -> Camera:
    depth = (eye - points) @ axes[2]
    nearest, farthest = float(depth.min()), float(depth.max())
    slack = DEPTH_SLACK * max(farthest - nearest, 1e-3 * farthest)
    view = np.eye(4)
    view[:3, :3] = axes
    view[:3, 3] = -axes @ eye
    # The near plane stays off 0 by 1/1000 of the far one: a depth buffer resolves no more.
    near = max(nearest - slack, 1e-3 * farthest)
    return Camera("automatic", "perspective", view, near, farthest + slack, yfov_rad=yfov_rad)


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
