"""Light that punctual sources send to points of the scene (KHR_lights_punctual)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.scene.light import CONE_COSINE_MIN, LIGHT_DISTANCE_MIN_M
from gltf_iri.scene.model import Light

__all__ = ["arriving"]

Float64 = NDArray[np.float64]


def arriving(light: Light, position: Float64) -> tuple[Float64, Float64]:
    """Return the unit direction towards the light, (n, 3), and its illuminance face on, (n, 3).

    Directional: E = c·I, in lux. Point and spot: E = c·I/d² · clamp(1 − (d/range)⁴, 0, 1), in candela and
    metres; a spot multiplies by the square of its cone's clamped ramp.
    """
    emitted = np.asarray(light.colour, np.float64) * light.intensity
    if light.kind == "directional":
        shape = position.shape
        return np.broadcast_to(-light.direction, shape), np.broadcast_to(emitted, shape)
    offset = light.position - position
    distance = np.maximum(np.linalg.norm(offset, axis=-1), LIGHT_DISTANCE_MIN_M)
    direction = offset / distance[:, None]
    share = 1.0 / distance**2
    if light.range_m is not None:
        share = share * np.clip(1.0 - (distance / light.range_m) ** 4, 0.0, 1.0)
    if light.kind == "spot":
        share = share * _cone(light, direction)
    return direction, share[:, None] * emitted


def _cone(light: Light, direction: Float64) -> Float64:
    """Return 1 inside the inner cone, 0 outside the outer one, the square of a ramp in cosθ between them."""
    inner, outer = np.cos(light.inner_cone_rad), np.cos(light.outer_cone_rad)
    ramp = (-(direction @ light.direction) - outer) / max(inner - outer, CONE_COSINE_MIN)
    return np.asarray(np.clip(ramp, 0.0, 1.0) ** 2)
