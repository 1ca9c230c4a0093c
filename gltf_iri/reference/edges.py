"""How far from a triangle's edges a pixel's centre lies on the picture.

OpenGL rounds projected corners to a grid of 1/256 pixel or so (OpenGL 3.3, SUBPIXEL_BITS) before it asks
which pixels a triangle covers; nearer to an edge than that it may see the neighbour.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.scene.camera import projection_matrix
from gltf_iri.scene.model import Camera

__all__ = ["edge_distance_px"]

Float64 = NDArray[np.float64]


def edge_distance_px(camera: Camera, size: tuple[int, int], corners: Float64, centres_px: Float64) -> Float64:
    """Return the distance in pixels (n,) from each centre to the nearest line through two corners.

    Parameters
    ----------
    size : width and height in pixels.
    corners : (n, 3, 3), a triangle for each pixel, world space.
    centres_px : (n, 2), from the picture's upper left corner.
    """
    width, height = size
    matrix = projection_matrix(camera, width / height) @ camera.view
    clip = corners @ matrix[:, :3].T + matrix[:, 3]
    x, y, w = clip[..., 0], clip[..., 1], clip[..., 3]
    # Homogeneous pixels: lines through them exist also for corners behind the eye.
    pixels = np.stack([0.5 * width * (w + x), 0.5 * height * (w - y), w], axis=-1)
    lines = np.cross(pixels, np.roll(pixels, -1, axis=1))
    centres = np.column_stack([centres_px, np.ones(len(centres_px))])
    aside = np.abs(np.einsum("nec,nc->ne", lines, centres))
    length = np.hypot(lines[..., 0], lines[..., 1])
    # An edge that is seen end on is a point, and the other two run through it.
    return np.asarray(np.where(length > 0.0, aside / np.where(length > 0.0, length, 1.0), np.inf).min(axis=1))
