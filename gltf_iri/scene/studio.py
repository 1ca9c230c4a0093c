"""Light for a photograph of something glossy: soft boxes in a dim dome, all neutral white."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["STUDIO_BOXES", "SoftBox", "directions", "studio_radiance"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]

_HEIGHT: Final = 256


@dataclass(frozen=True, slots=True)
class SoftBox:
    """A rectangle of light at distance 1; the azimuth turns from +Z (the viewer's side) towards +X."""

    azimuth_rad: float
    elevation_rad: float
    half_width: float
    half_height: float
    radiance: float  # relative to the others and to the dome
    softness: float  # width of the edge, as a share of the half size


# The key shows the film's colour in one broad highlight; the fill opens the other side; the strip draws a
# line near the edge, where films change their colour most; the overhead keeps upward faces from falling
# black. Straight behind the model there is no box: every silhouette mirrors that direction, and a bright one
# would draw a white, ragged outline around everything.
STUDIO_BOXES: Final = (
    SoftBox(math.radians(62.0), math.radians(28.0), 0.34, 0.30, 12.0, 0.15),
    SoftBox(math.radians(-68.0), math.radians(8.0), 0.50, 0.60, 2.8, 0.45),
    SoftBox(math.radians(-112.0), math.radians(18.0), 0.10, 0.75, 8.0, 0.20),
    SoftBox(math.radians(0.0), math.radians(84.0), 0.55, 0.40, 2.6, 0.45),
)

# Radiance of the dome straight down, at the horizon and straight up: a dark floor under a soft sky.
_FLOOR, _HORIZON, _ZENITH = 0.14, 0.45, 0.70


def directions(height: int) -> Float64:
    """Return the unit directions (height, 2·height, 3) of an equirectangular map's pixel centres.

    The inverse of (u, v) = (½ + atan2(z, x) / 2π, acos(y) / π).
    """
    phi = (np.arange(2 * height) + 0.5) / height * math.pi - math.pi
    theta = (np.arange(height) + 0.5)[:, None] / height * math.pi
    y = np.broadcast_to(np.cos(theta), (height, 2 * height))
    return np.stack([np.sin(theta) * np.cos(phi), y, np.sin(theta) * np.sin(phi)], axis=2)


def studio_radiance() -> Float32:
    """Return the map (256, 512, 3), scaled so that its mean over all directions is 1.

    The mean irradiance over all normals, as a share of π, is then 1 too: as bright as a white environment.
    """
    direction = directions(_HEIGHT)
    up = direction[:, :, 1]
    above = _smooth(up)
    radiance = np.where(
        up < 0.0, _HORIZON + (_FLOOR - _HORIZON) * _smooth(-up * 1.8), _HORIZON + (_ZENITH - _HORIZON) * above
    )
    for box in STUDIO_BOXES:
        radiance = radiance + box.radiance * _box_mask(box, direction)
    solid_angle = np.sqrt(1.0 - up**2)
    radiance = radiance / np.average(radiance, weights=solid_angle)
    return np.repeat(radiance[:, :, None], 3, axis=2).astype(np.float32)


def _box_mask(box: SoftBox, direction: Float64) -> Float64:
    """Return the share (h, w) of the box that each direction sees: its gnomonic image with soft edges."""
    sin_a, cos_a = math.sin(box.azimuth_rad), math.cos(box.azimuth_rad)
    sin_e, cos_e = math.sin(box.elevation_rad), math.cos(box.elevation_rad)
    centre = np.array([sin_a * cos_e, sin_e, cos_a * cos_e])
    right = np.array([cos_a, 0.0, -sin_a])
    ahead = direction @ centre
    depth = np.maximum(ahead, 1e-6)  # directions behind the box would divide by 0; the last factor drops them
    across = np.abs(direction @ right) / depth / box.half_width
    along = np.abs(direction @ np.cross(centre, right)) / depth / box.half_height
    edges = [_smooth((1.0 - distance) / box.softness + 0.5) for distance in (across, along)]
    return np.asarray(edges[0] * edges[1] * (ahead > 0.0), dtype=np.float64)


def _smooth(t: Float64) -> Float64:
    """Hermite step: 0 below 0, 1 above 1, 3t² − 2t³ between."""
    t = np.clip(t, 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t), dtype=np.float64)
