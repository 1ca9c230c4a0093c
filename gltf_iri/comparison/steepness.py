"""How much of a pixel's value hangs on where exactly in the pixel one looks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from gltf_iri.comparison.metric import relative_deviation
from gltf_iri.scene.camera import projection_matrix
from gltf_iri.scene.model import Camera
from gltf_iri.tolerances import REFERENCE_STEP_PX

__all__ = ["moved", "steepness"]

Float64 = NDArray[np.float64]


def steepness(
    draw: Callable[[Camera], Float64], camera: Camera, size: tuple[int, int], colour: Float64
) -> Float64:
    """Return how much (height, width) a step of REFERENCE_STEP_PX changes `colour`, as `relative_deviation`.

    Parameters
    ----------
    draw : draws the picture (height, width, 3) again as another camera sees it.
    colour : what `camera` sees.
    """
    across = draw(moved(camera, size, (REFERENCE_STEP_PX, 0.0)))
    down = draw(moved(camera, size, (0.0, REFERENCE_STEP_PX)))
    return np.maximum(relative_deviation(across, colour), relative_deviation(down, colour))


def moved(camera: Camera, size: tuple[int, int], step_px: tuple[float, float]) -> Camera:
    """Return `camera` looking so much farther to the right and down at the picture's middle.

    It turns about its eye, or where its rays are parallel moves sideways.
    """
    projection = projection_matrix(camera, size[0] / size[1])
    right = 2.0 * step_px[0] / (size[0] * projection[0, 0])
    up = -2.0 * step_px[1] / (size[1] * projection[1, 1])
    step = np.eye(4)
    if camera.kind == "orthographic":
        step[:2, 3] = -right, -up
    else:
        # The ray (right, up, −1) becomes the camera's axis: first level, then down.
        level, turn = np.hypot(1.0, right), np.hypot(np.hypot(1.0, right), up)
        forward = np.array([right, up, -1.0]) / turn
        across = np.array([1.0, 0.0, right]) / level
        step[:3, :3] = np.stack([across, np.cross(-forward, across), -forward])
    return replace(camera, view=step @ camera.view)
