"""Punctual lights as a texture, because a scene may hold any number of them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.scene.light import CONE_COSINE_MIN
from gltf_iri.scene.model import Light

if TYPE_CHECKING:
    import moderngl

__all__ = ["lights_texture", "pack_lights"]


def pack_lights(lights: Sequence[Light]) -> NDArray[np.float32]:
    """Return (n, 4, 4), a row a light, as shaders/lighting/punctual.glsl reads it.

    Texels: position and 1, or 0 for a directional light; direction and range, 0 for none; colour times
    intensity; scale and offset of the cone's ramp in cosθ, constant 1 for anything but a spot.
    """
    packed = np.zeros((len(lights), 4, 4))
    for texels, light in zip(packed, lights, strict=True):
        texels[0, :3], texels[0, 3] = light.position, light.kind != "directional"
        texels[1, :3], texels[1, 3] = light.direction, light.range_m or 0.0
        texels[2, :3] = np.multiply(light.colour, light.intensity)
        texels[3, :2] = _cone_ramp(light) if light.kind == "spot" else (0.0, 1.0)
    return packed.astype(np.float32)


def lights_texture(context: moderngl.Context, lights: Sequence[Light]) -> moderngl.Texture:
    """Upload `lights`, or one row of nothing; the caller releases the texture.

    Raises MissingCapabilityError for more lights than a texture has rows: OpenGL would leave all dark.
    """
    limit = context.info["GL_MAX_TEXTURE_SIZE"]
    if len(lights) > limit:
        raise MissingCapabilityError(
            f"The scene holds {len(lights)} lights; this OpenGL takes up to {limit}."
        )
    rows = pack_lights(lights) if lights else np.zeros((1, 4, 4), np.float32)
    texture = context.texture((4, len(rows)), 4, rows.tobytes(), dtype="f4")
    texture.filter = (context.NEAREST, context.NEAREST)
    return texture


def _cone_ramp(light: Light) -> tuple[float, float]:
    """Return scale and offset of the ramp from 0 at the outer cone to 1 at the inner one."""
    outer = math.cos(light.outer_cone_rad)
    scale = 1.0 / max(math.cos(light.inner_cone_rad) - outer, CONE_COSINE_MIN)
    return scale, -outer * scale
