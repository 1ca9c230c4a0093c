"""Embree: which triangle a ray may meet next. It thinks in float32, so its answers are only candidates."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.reference.triangles import Triangles

__all__ = ["INSTALL_COMMAND", "RESOLUTION", "Candidates"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]

INSTALL_COMMAND: Final = "pip install 'gltf-iri[reference]'"

# What float32 tells apart in a scene of radius 1, rays and corners rounded: a few times 6e-8.
RESOLUTION: Final = 5e-7


class Candidates:
    """The places of `Triangles` in Embree, the scene moved and scaled into the unit sphere.

    Raises MissingCapabilityError where embreex is not installed.
    """

    def __init__(self, triangles: Triangles) -> None:
        try:
            from embreex.mesh_construction import TriangleMesh
            from embreex.rtcore_scene import EmbreeScene
        except ImportError as error:
            raise MissingCapabilityError(
                f"Casting rays needs the package embreex; install it with: {INSTALL_COMMAND}"
            ) from error
        corners = triangles.corners[triangles.places]
        low, high = corners.min(axis=(0, 1)), corners.max(axis=(0, 1))
        self.centre = 0.5 * low + 0.5 * high
        # A scene that is one point has no size, and nothing to meet either.
        self.radius_m = float(0.5 * np.linalg.norm(high - low)) or 1.0
        self._scene = EmbreeScene(robust=True)
        scaled = (corners - self.centre) / self.radius_m
        TriangleMesh(
            self._scene,
            scaled.reshape(-1, 3).astype(np.float32),
            np.arange(3 * len(corners), dtype=np.int32).reshape(-1, 3),
        )

    def entry_m(self, origins: Float64, directions: Float64) -> Float64:
        """Return how far along each ray (n,) a little before the scene begins; negative inside of it."""
        middle = np.sum((self.centre - origins) * directions, axis=-1)
        return np.asarray(middle - 1.001 * self.radius_m)

    def ask(self, origins: Float64, directions: Float64) -> tuple[Int64, Float64]:
        """Return the place (n,) that each ray seems to meet first, −1 for none, and its distance in metres.

        origins, directions : (n, 3), unit directions; origins should lie near the scene.
        """
        scaled = ((origins - self.centre) / self.radius_m).astype(np.float32)
        answer = self._scene.run(scaled, directions.astype(np.float32), output=True)
        return answer["primID"].astype(np.int64), answer["tfar"].astype(np.float64) * self.radius_m
