"""Image light: an environment prepared for surfaces of every roughness, and the table that goes with it.

A rough mirror under an environment reflects prefiltered radiance × (F0·A + B), the split sum of Karis 2013,
"Real Shading in Unreal Engine 4". Every pass divides by what a white environment would give, so that white
stays exactly 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.rendering.environment_levels import environment_levels
from gltf_iri.rendering.fullscreen import compute_texture
from gltf_iri.scene.model import Environment

if TYPE_CHECKING:
    import moderngl

__all__ = [
    "LAYER_COUNT",
    "SMOOTH_LAYER_COUNT",
    "EnvironmentLight",
    "compute_dfg_table",
    "prepare_environment",
]

Float32 = NDArray[np.float32]

LAYER_COUNT: Final = 8  # perceptual roughness ⅛, ¼ … 1; the map itself stands for 0

# Narrow lobes are sampled and want many texels; wide ones are integrated over a small level, without noise.
SMOOTH_LAYER_COUNT: Final = 3
_SMOOTH_SIZE: Final = (192, 96)
_ROUGH_SIZE: Final = (64, 32)
_ROUGH_SOURCE_HEIGHT: Final = 32

_SAMPLES: Final = 512
# Each sample averages over twice its share: neighbours overlap, or a small bright lamp would show as a ring
# of separate images of itself. The blur that this adds is less than the step between two layers.
_SHARE_AVERAGED: Final = 2.0

_DFG_SIZE: Final = (128, 128)


@dataclass(frozen=True, slots=True)
class EnvironmentLight:
    """The textures that shaders/lighting/environment.glsl reads, apart from the DFG table."""

    sharp: moderngl.Texture
    smooth: moderngl.Texture
    rough: moderngl.Texture

    def release(self) -> None:
        """Give the textures back to OpenGL."""
        for texture in (self.sharp, self.smooth, self.rough):
            texture.release()


def prepare_environment(context: moderngl.Context, environment: Environment) -> EnvironmentLight:
    """Prefilter `environment`; the caller releases the result."""
    levels = environment_levels(environment.radiance)
    sharp = _upload(context, levels)
    samples = context.texture((_SAMPLES, SMOOTH_LAYER_COUNT), 4, _lobe_samples().tobytes(), dtype="f4")
    samples.filter = (context.NEAREST, context.NEAREST)
    smooth = compute_texture(
        context,
        "pass/prefilter.frag",
        (_SMOOTH_SIZE[0], _SMOOTH_SIZE[1] * SMOOTH_LAYER_COUNT),
        4,
        {"u_layer_size": _SMOOTH_SIZE},
        {"u_environment": sharp, "u_samples": samples},
    )
    samples.release()
    rough = compute_texture(
        context,
        "pass/prefilter_rough.frag",
        # One more for irradiance.
        (_ROUGH_SIZE[0], _ROUGH_SIZE[1] * (LAYER_COUNT - SMOOTH_LAYER_COUNT + 1)),
        4,
        {
            "u_level": next(i for i, texels in enumerate(levels) if len(texels) <= _ROUGH_SOURCE_HEIGHT),
            "u_layer_size": _ROUGH_SIZE,
            "u_first_layer": SMOOTH_LAYER_COUNT,
            "u_layer_count": LAYER_COUNT,
        },
        {"u_environment": sharp},
    )
    for texture in (smooth, rough):
        _wrap(context, texture)
    return EnvironmentLight(sharp, smooth, rough)


def compute_dfg_table(context: moderngl.Context) -> moderngl.Texture:
    """Return the table of (A, B) over √(N·V) and perceptual roughness; the caller releases it."""
    table = compute_texture(context, "pass/dfg.frag", _DFG_SIZE, 2, {"u_size": _DFG_SIZE}, {})
    table.repeat_x = table.repeat_y = False
    table.filter = (context.LINEAR, context.LINEAR)
    return table


def _upload(context: moderngl.Context, levels: list[Float32]) -> moderngl.Texture:
    height, width = levels[0].shape[:2]
    texture = context.texture((width, height), 3, np.ascontiguousarray(levels[0]).tobytes(), dtype="f4")
    texture.build_mipmaps()  # makes room for the levels, whose texels follow
    for level, texels in enumerate(levels[1:], start=1):
        texture.write(np.ascontiguousarray(texels).tobytes(), level=level)
    _wrap(context, texture)
    texture.filter = (context.LINEAR_MIPMAP_LINEAR, context.LINEAR)
    return texture


def _wrap(context: moderngl.Context, texture: moderngl.Texture) -> None:
    """Close the map around the horizon and stop it at the poles."""
    texture.repeat_x, texture.repeat_y = True, False
    texture.filter = (context.LINEAR, context.LINEAR)


def _lobe_samples() -> Float32:
    """Return (layers, _SAMPLES, 4): directions of a GGX lobe about +Z, seen from +Z, and solid angles.

    Facets follow D·cosθ_h; a facet at θ_h mirrors into 2θ_h with density D/4 (D of glTF 2.0 Appendix B.3), so
    that each of n samples stands for 4/(n·D) steradians. Directions below the horizon weigh nothing.
    """
    height = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    turn = 2.0 * np.pi * np.array([_radical_inverse(n) for n in range(_SAMPLES)])
    alpha = ((np.arange(1, SMOOTH_LAYER_COUNT + 1) / LAYER_COUNT) ** 2)[:, None]
    cos2 = (1.0 - height) / (1.0 + (alpha**2 - 1.0) * height)
    sin2 = 1.0 - cos2
    density = alpha**2 / (np.pi * (sin2 + alpha**2 * cos2) ** 2)
    cos_l, sin_l = 2.0 * cos2 - 1.0, 2.0 * np.sqrt(cos2 * sin2)
    solid_angle = _SHARE_AVERAGED * 4.0 / (_SAMPLES * density)
    rays = [sin_l * np.cos(turn), sin_l * np.sin(turn), np.maximum(cos_l, 0.0), solid_angle]
    return np.stack(rays, axis=-1).astype(np.float32)


def _radical_inverse(number: int) -> float:
    """Return `number`'s binary digits mirrored behind the point: van der Corput's sequence."""
    result, place = 0.0, 0.5
    while number:
        result += place * (number & 1)
        number, place = number >> 1, place / 2.0
    return result
