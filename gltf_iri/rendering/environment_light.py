"""Image light: an environment prepared for surfaces of every roughness.

A rough mirror under an environment reflects prefiltered radiance × (F0·A + B), the split sum of Karis 2013,
"Real Shading in Unreal Engine 4". Every pass divides by what a white environment would give, so that white
stays exactly 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.rendering.environment_lamps import split_lamps
from gltf_iri.rendering.environment_levels import environment_levels
from gltf_iri.rendering.fullscreen import compute_texture
from gltf_iri.scene.model import Environment

if TYPE_CHECKING:
    import moderngl

__all__ = [
    "LAYERS_PER_LEVEL",
    "LAYER_ROUGHNESS_MIN",
    "ROUGHNESS_LAYERS",
    "SHEEN_LAYERS",
    "EnvironmentLight",
    "prepare_environment",
    "prepare_sheen",
]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]

# Layers of perceptual roughness 1/16, √2/16 … 1, from one to the next α doubles; the map itself stands for 0.
# Three of one size stand one below the other in a level of one texture, each level half as wide as the one
# before; the last holds irradiance alone.
LAYERS_PER_LEVEL: Final = 3
LAYER_ROUGHNESS_MIN: Final = 1.0 / 16.0
ROUGHNESS_LAYERS: Final = 9
_LEVEL_SIZES: Final = ((512, 256), (256, 128), (128, 64), (64, 32))
_LOBE_SAMPLES: Final = (48, 192, 600)
# Layers of sheen roughness 0, ¼ … 1: fibres send light to all sides, and their lobe changes slowly.
SHEEN_LAYERS: Final = 5
_SHEEN_SIZE: Final = (48, 24)

# Cosine lobes and fibres are wide: they are integrated texel by texel over a map of this height.
_WIDE_SOURCE_HEIGHT: Final = 32

# Each sample averages over more than its share: neighbours overlap, or a small bright lamp would show as a
# group of separate images of itself.
_SHARE_AVERAGED: Final = 1.4
_GOLDEN_SECTION: Final = (1.0 + 5.0**0.5) / 2.0


@dataclass(frozen=True, slots=True)
class EnvironmentLight:
    """The textures that shaders/lighting/{environment,lamps}.glsl read."""

    sharp: moderngl.Texture  # the map as it is
    rest: moderngl.Texture  # without its lamps; the same texture where it has none
    lamps: moderngl.Texture
    layers: moderngl.Texture  # `rest` prefiltered

    def release(self) -> None:
        """Give the textures back to OpenGL."""
        for texture in {self.sharp, self.rest, self.lamps, self.layers}:
            texture.release()


def prepare_environment(context: moderngl.Context, environment: Environment) -> EnvironmentLight:
    """Prefilter `environment`; the caller releases the result."""
    lamps, dim = split_lamps(environment.radiance)
    rest = _upload(context, environment_levels(dim))
    sharp = _upload(context, environment_levels(environment.radiance)) if len(lamps) else rest
    return EnvironmentLight(sharp, rest, _lamps(context, lamps), _layers(context, rest))


def prepare_sheen(context: moderngl.Context, light: EnvironmentLight) -> moderngl.Texture:
    """Prefilter the whole map as fibres see it, lamps included; the caller releases the result."""
    texture = compute_texture(
        context,
        "pass/prefilter_sheen.frag",
        (_SHEEN_SIZE[0], _SHEEN_SIZE[1] * SHEEN_LAYERS),
        4,
        {"u_level": _wide_source_level(light.sharp), "u_layer_size": _SHEEN_SIZE},
        {"u_environment": light.sharp},
    )
    _wrap(context, texture)
    return texture


def _wide_source_level(environment: moderngl.Texture) -> int:
    return next(level for level in range(32) if environment.height >> level <= _WIDE_SOURCE_HEIGHT)


def _lamps(context: moderngl.Context, lamps: Float32) -> moderngl.Texture:
    """Return a column a lamp; without any, one that gives no light."""
    table = lamps if len(lamps) else np.array([[[0, 1, 0, 0], [0, 0, 0, 0]]], np.float32)
    data = np.ascontiguousarray(table.swapaxes(0, 1)).tobytes()
    texture = context.texture((len(table), 2), 4, data, dtype="f4")
    texture.filter = (context.NEAREST, context.NEAREST)
    return texture


def _layers(context: moderngl.Context, rest: moderngl.Texture) -> moderngl.Texture:
    made = [_lobes(context, rest, level) for level in range(len(_LOBE_SAMPLES))]
    made.append(
        compute_texture(
            context,
            "pass/prefilter_diffuse.frag",
            _stack_size(len(_LOBE_SAMPLES)),
            4,
            {
                "u_level": _wide_source_level(rest),
                "u_layer_size": _LEVEL_SIZES[-1],
            },
            {"u_environment": rest},
        )
    )
    # OpenGL 3.3 as moderngl shows it cannot draw into a level, so they travel.
    texture = context.texture(_stack_size(0), 4, made[0].read(), dtype="f4")
    texture.build_mipmaps(0, len(made) - 1)  # makes room for the levels
    for level, stack in enumerate(made[1:], start=1):
        texture.write(stack.read(), level=level)
    for stack in made:
        stack.release()
    _wrap(context, texture)
    texture.filter = (context.LINEAR_MIPMAP_NEAREST, context.LINEAR)
    return texture


def _lobes(context: moderngl.Context, rest: moderngl.Texture, level: int) -> moderngl.Texture:
    """Return the layers of one level, one below the other."""
    numbers = LAYERS_PER_LEVEL * level + np.arange(LAYERS_PER_LEVEL)
    alphas = np.asarray(LAYER_ROUGHNESS_MIN**2 * 2.0**numbers, np.float64)
    rays = _lobe_samples(alphas, _LOBE_SAMPLES[level])
    samples = context.texture(rays.shape[1::-1], 4, rays.tobytes(), dtype="f4")
    samples.filter = (context.NEAREST, context.NEAREST)
    stack = compute_texture(
        context,
        "pass/prefilter.frag",
        _stack_size(level),
        4,
        {"u_layer_size": _LEVEL_SIZES[level]},
        {"u_environment": rest, "u_samples": samples},
    )
    samples.release()
    return stack


def _stack_size(level: int) -> tuple[int, int]:
    width, height = _LEVEL_SIZES[level]
    return width, height * LAYERS_PER_LEVEL


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


def _lobe_samples(alphas: Float64, count: int) -> Float32:
    """Return (layers, count, 4): directions of GGX lobes about +Z, seen from +Z, and solid angles.

    Facets follow D·cosθ_h; a facet at θ_h mirrors into 2θ_h with density D/4 (D of glTF 2.0 Appendix B.3), so
    that each of n samples stands for 4/(n·D) steradians. Directions below the horizon weigh nothing. Three
    at a time stand around the axis, so that few samples do not pull the lobe aside, and from three to three
    they turn by the golden section: the seeds of a sunflower leave no gaps.
    """
    rings = count // 3
    height = np.repeat((np.arange(rings) + 0.5) / rings, 3)
    turn = (np.repeat(np.arange(rings) / _GOLDEN_SECTION, 3) + np.tile(np.arange(3), rings)) * (
        2.0 * np.pi / 3.0
    )
    alpha = alphas[:, None]
    cos2 = (1.0 - height) / (1.0 + (alpha**2 - 1.0) * height)
    sin2 = 1.0 - cos2
    density = alpha**2 / (np.pi * (sin2 + alpha**2 * cos2) ** 2)
    cos_l, sin_l = 2.0 * cos2 - 1.0, 2.0 * np.sqrt(cos2 * sin2)
    solid_angle = _SHARE_AVERAGED * 4.0 / (count * density)
    rays = [sin_l * np.cos(turn), sin_l * np.sin(turn), np.maximum(cos_l, 0.0), solid_angle]
    return np.stack(rays, axis=-1).astype(np.float32)
