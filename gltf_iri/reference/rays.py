"""Rays through the centres of a picture's pixels."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gltf_iri.scene.camera import projection_matrix
from gltf_iri.scene.model import Camera

__all__ = ["camera_rays"]

Float64 = NDArray[np.float64]


def camera_rays(
    camera: Camera, size: tuple[int, int], rows: tuple[int, int] | None = None
) -> tuple[Float64, Float64, Float64]:
    """Return origins (n, 3) in metres, unit directions (n, 3), and lengths (n,) in metres.

    A ray starts on the near plane and ends on the far one (infinite where there is none), as OpenGL clips.

    Parameters
    ----------
    size : width and height in pixels; row 0 is on top, and n counts row by row.
    rows : first row and the one past the last; None for all.
    """
    width, height = size
    first, past = (0, height) if rows is None else rows
    # OpenGL samples pixel (i, j) at ((i + ½) / width, (j + ½) / height) of the viewport (OpenGL 3.3 §3.4).
    x = (2.0 * np.arange(width) + 1.0) / width - 1.0
    y = 1.0 - (2.0 * np.arange(first, past) + 1.0) / height
    across, up = (a.ravel() for a in np.meshgrid(x, y))
    projection = projection_matrix(camera, width / height)
    place = np.column_stack([across / projection[0, 0], up / projection[1, 1]])
    backwards = -np.ones((len(place), 1))
    if camera.kind == "orthographic":
        near = np.hstack([place, camera.znear_m * backwards])
        forward = np.hstack([np.zeros_like(place), backwards])
    else:
        forward = np.hstack([place, backwards])
        near = camera.znear_m * forward
    depth = math.inf if camera.zfar_m is None else camera.zfar_m - camera.znear_m
    to_world = np.linalg.inv(camera.view)
    origins = near @ to_world[:3, :3].T + to_world[:3, 3]
    directions = forward @ to_world[:3, :3].T
    lengths = np.linalg.norm(directions, axis=1)
    return origins, directions / lengths[:, None], depth * lengths
