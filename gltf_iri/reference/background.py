"""What lies behind the scene, for pictures of the reference that people look at."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.rays import camera_rays
from gltf_iri.scene.model import Camera, Environment

__all__ = ["over_background"]

Float64 = NDArray[np.float64]


def over_background(rgba: Float64, camera: Camera, environment: Environment | None) -> Float64:
    """Return `rgba` (height, width, 4), premultiplied, over what each pixel's ray sees behind the scene.

    That is the environment's backdrop, or else its map, in focus (the rasteriser blurs it). Alpha stays what
    it is; None leaves the picture as it is, over black.
    """
    if environment is None:
        return rgba
    if environment.backdrop is not None:
        behind = np.array(environment.backdrop)
    else:
        height, width = rgba.shape[:2]
        _, directions, _ = camera_rays(camera, (width, height))
        behind = EnvironmentMap(environment).radiance(directions).reshape(height, width, 3)
    shown = rgba.copy()
    shown[..., :3] += (1.0 - rgba[..., 3:]) * behind
    return shown
