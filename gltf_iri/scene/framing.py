"""Cameras for a scene that brings none: framed around what there is to see, still or on a circle."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import UsageError
from gltf_iri.scene.model import Camera, Scene

__all__ = ["ORBIT_COUNT_MAX", "fit_distance", "fit_eye", "frame_scene", "orbit_scene", "view_angles"]

Float64 = NDArray[np.float64]

# How a cube is seen: three of its sides, the front most, through a mildly long lens.
AZIMUTH_RAD: Final = math.radians(25.0)
ELEVATION_RAD: Final = math.radians(15.0)
YFOV_RAD: Final = math.radians(35.0)

# A flat thing that lies on the ground is looked down upon, but not from the top: it would seem to stand.
ELEVATION_MAX_RAD: Final = math.radians(45.0)

# Share of the picture left free around the subject.
MARGIN: Final = 0.06

# Near and far planes stand off by this much of the subject's depth, so that rounding clips nothing.
DEPTH_SLACK: Final = 0.05

# A picture for every degree; more would only fill the disk.
ORBIT_COUNT_MAX: Final = 360


def frame_scene(
    scene: Scene,
    *,
    aspect: float,
    azimuth_rad: float | None = None,
    elevation_rad: float | None = None,
    yfov_rad: float = YFOV_RAD,
) -> Camera:
    """Return the perspective camera that fits every vertex into the picture as tightly as `MARGIN` lets.

    The azimuth turns from +Z towards +X, the elevation up from the horizon; where they are left out, they
    follow the subject's proportions (`view_angles`). AssetError for an empty scene.
    """
    points = scene.vertices()
    azimuth, elevation = view_angles(points)
    axes = _axes(
        azimuth if azimuth_rad is None else azimuth_rad,
        elevation if elevation_rad is None else elevation_rad,
    )
    eye = fit_eye(points @ axes.T, *_slopes(yfov_rad, aspect))
    return _camera_at(points, axes, axes.T @ eye, yfov_rad)


def orbit_scene(scene: Scene, *, aspect: float, count: int, yfov_rad: float = YFOV_RAD) -> tuple[Camera, ...]:
    """Return `count` cameras on one circle around the middle of the scene, all equally far from it.

    All look at the middle of the bounds, so that nothing wobbles; the first stands where `frame_scene` looks
    from, at least `ELEVATION_RAD` high, and the others follow from +Z towards +X. Raises UsageError for a
    count outside [1, ORBIT_COUNT_MAX], AssetError for an empty scene.
    """
    if not 1 <= count <= ORBIT_COUNT_MAX:
        raise UsageError(f"An orbit has 1 to {ORBIT_COUNT_MAX} pictures, not {count}.")
    points = scene.vertices()
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    azimuth, elevation = view_angles(points)
    elevation = max(elevation, ELEVATION_RAD)
    turns = [_axes(azimuth + 2.0 * math.pi * i / count, elevation) for i in range(count)]
    slopes = _slopes(yfov_rad, aspect)
    distance = max(fit_distance((points - middle) @ axes.T, *slopes) for axes in turns)
    return tuple(_camera_at(points, axes, middle + distance * axes[2], yfov_rad) for axes in turns)


def view_angles(points: Float64) -> tuple[float, float]:
    """Return the azimuth and elevation, in radians, from which `points` (n, 3) show most of themselves.

    With the width w, height h and depth d of their box: tan(azimuth) = tan(AZIMUTH_RAD)·d/w and
    tan(elevation) = tan(ELEVATION_RAD)·min(w, d)/h, the view of a cube stretched with the box. So a board is
    seen from its front, a long thing from its broad side, a column from low, a plate from above.
    """
    width, height, depth = points.max(axis=0) - points.min(axis=0)
    azimuth = math.atan2(math.tan(AZIMUTH_RAD) * depth, width)
    elevation = math.atan2(math.tan(ELEVATION_RAD) * min(width, depth), height)
    return azimuth, min(elevation, ELEVATION_MAX_RAD)


def fit_eye(points: Float64, slope_x: float, slope_y: float) -> Float64:
    """Return the eye (3,) closest to `points` (n, 3) that still sees all of them.

    Points and eye share the view's axes: x right, y up, z backward. A point is seen where
    |x − eₓ| ≤ slope_x (e_z − z), so with a = max(x + slope_x z) and b = max(−x + slope_x z) the width wants
    e_z ≥ (a + b) / 2 slope_x at eₓ = (a − b) / 2; the height likewise, and the larger e_z holds for both.
    """
    eye = np.zeros(3)
    for axis, slope in enumerate((slope_x, slope_y)):
        a = float(np.max(points[:, axis] + slope * points[:, 2]))
        b = float(np.max(-points[:, axis] + slope * points[:, 2]))
        eye[axis] = 0.5 * (a - b)
        needed = 0.5 * (a + b) / slope
        eye[2] = needed if axis == 0 else max(eye[2], needed)
    eye[2] = max(eye[2], float(points[:, 2].max()) + _least_distance(points))
    return eye


def fit_distance(points: Float64, slope_x: float, slope_y: float) -> float:
    """Return the distance at which an eye on the z axis, looking at the origin, sees all `points` (n, 3)."""
    beside = np.maximum(np.abs(points[:, 0]) / slope_x, np.abs(points[:, 1]) / slope_y)
    return float(max(np.max(points[:, 2] + beside), points[:, 2].max() + _least_distance(points)))


def _least_distance(points: Float64) -> float:
    """Return how far the eye keeps from the nearest point, so that neither a speck nor an edge is at 0."""
    size = float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))
    return 0.1 * size if size > 0.0 else 1.0


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
