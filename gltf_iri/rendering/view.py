"""The camera as uniforms."""

from __future__ import annotations

from typing import Any

import numpy as np

from gltf_iri.rendering.geometry import column_major
from gltf_iri.scene.camera import projection_matrix
from gltf_iri.scene.model import Camera

__all__ = ["background_uniforms", "view_uniforms"]


def view_uniforms(camera: Camera, size: tuple[int, int]) -> dict[str, Any]:
    """Return the projection, the eye's place (for parallel rays its direction), and depths along the view.

    For surfaces that light passes through: the depth of positions, and how many pixels a metre covers.
    """
    projection = projection_matrix(camera, size[0] / size[1])
    if camera.kind == "orthographic":
        backward = camera.view[2, :3] / np.linalg.norm(camera.view[2, :3])
        eye = (*map(float, backward), 0.0)
    else:
        eye = (*map(float, camera.position), 1.0)
    return {
        "u_view_projection": column_major(projection @ camera.view),
        "u_eye": eye,
        "u_view_axis": tuple(float(entry) for entry in -camera.view[2]),
        "u_pixel_scale": 0.5 * size[1] * float(projection[1, 1]),
    }


def background_uniforms(camera: Camera, size: tuple[int, int]) -> dict[str, Any]:
    """Return how pixels of the background look into the world."""
    projection = projection_matrix(camera, size[0] / size[1])
    half_view = (0.0, 0.0)
    if camera.kind == "perspective":
        half_view = (float(1.0 / projection[0, 0]), float(1.0 / projection[1, 1]))
    return {"u_eye_to_world": column_major(camera.view[:3, :3].T), "u_half_view": half_view}
