"""Round shapes that several samples share."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gltf_iri.samples.shapes import Shape, solid_of_revolution

__all__ = ["ellipsoid", "sphere"]


def sphere(radius_m: float, *, rings: int, segments: int) -> Shape:
    """Return a sphere about the origin; v runs from the north pole (0) to the south pole (1)."""
    return ellipsoid((radius_m, radius_m, radius_m), rings=rings, segments=segments)


def ellipsoid(radii_m: ArrayLike, *, rings: int, segments: int) -> Shape:
    """Return an ellipsoid about the origin with half axes along X, Y and Z, (3,) in m.

    The normal of x²/a² + y²/b² + z²/c² = 1 is (x/a², y/b², z/c²): a unit sphere's divided by the half axes.
    """
    axes = np.asarray(radii_m, dtype=np.float64)
    v = np.linspace(0.0, 1.0, rings + 1)
    polar = np.pi * v
    profile = np.stack([np.sin(polar), np.cos(polar)], axis=-1)
    ball = solid_of_revolution(profile[:, 0], profile[:, 1], profile, v, segments=segments)
    normals = ball.normals / axes
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    along = ball.tangents[:, :3] * axes
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    tangents = np.concatenate([along, ball.tangents[:, 3:]], axis=-1)
    return Shape(ball.positions * axes, normals, ball.uvs, ball.triangles, tangents)
