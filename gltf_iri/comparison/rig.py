"""Three lights for a scene that brings none, so that punctual light has something to be compared on."""

from __future__ import annotations

from typing import Final

import numpy as np

from gltf_iri.scene.model import Camera, Light, Scene

__all__ = ["RIG", "rig"]

RIG: Final = (
    "a rig of three: a sun of 2 lx from above the viewer's left shoulder, and, as they arrive at the middle "
    "of the scene, a point light of 2 lx from the right and a spot light of 3 lx from behind"
)

# Each in the camera's axes (right, up, back), in radii of the scene from its middle. No colours are equal,
# so that a swapped channel shows.
_SUN: Final = ((-0.6, 0.7, 0.9), (1.0, 0.95, 0.85), 2.0)
_POINT: Final = ((1.6, 0.6, 1.4), (0.7, 0.85, 1.0), 2.0)
_SPOT: Final = ((-0.8, 1.2, -2.0), (1.0, 0.8, 0.9), 3.0)

# Wide enough that its edge runs through the scene: atan(1 / 2.5) would just hold all of it.
_CONE_RAD: Final = (0.1, 0.35)


def rig(scene: Scene, camera: Camera) -> tuple[Light, ...]:
    """Return the lights of `RIG`, placed by the scene's bounds and turned with the camera.

    The picture is then lit the same way whichever side of a model it shows. AssetError for an empty scene.
    """
    low, high = scene.bounds()
    middle = 0.5 * (low + high)
    # A scene that is one point has no radius, and its lights must not stand on it.
    radius_m = 0.5 * float(np.linalg.norm(high - low)) or 1.0
    axes = camera.view[:3, :3] / np.linalg.norm(camera.view[:3, :3], axis=1, keepdims=True)
    lights = []
    for kind, (place, colour, illuminance) in (("directional", _SUN), ("point", _POINT), ("spot", _SPOT)):
        offset = radius_m * (np.array(place) @ axes)
        distance_m = float(np.linalg.norm(offset))
        lights.append(
            Light(
                f"rig, {kind}",
                kind,  # type: ignore[arg-type]
                colour,
                illuminance * (1.0 if kind == "directional" else distance_m**2),
                middle + offset,
                -offset / distance_m,
                inner_cone_rad=_CONE_RAD[0],
                outer_cone_rad=_CONE_RAD[1],
            )
        )
    return tuple(lights)
