"""Image light: an environment prepared for surfaces of every roughness.

A rough mirror under an environment reflects prefiltered radiance × (F0·A + B), the split sum of Karis 2013,
"Real Shading in Unreal Engine 4". All blurring divides by what a white environment would give, so that white
stays exactly 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.sheen import sheen_alpha
from gltf_iri.rendering.environment_lamps import split_lamps
from gltf_iri.rendering.environment_levels import environment_levels, resampled
from gltf_iri.rendering.environment_lobes import blurred
from gltf_iri.rendering.fullscreen import compute_texture
from gltf_iri.rendering.lobe_rays import ggx_lobe, lobe_rays, sheen_lobe, softened
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

# Layers of perceptual roughness 1/16, √2/16 … 1, from one to the next α doubles; the map itself stands for 0.
# Three of one size stand one below the other in a level of one texture, each level half as wide as the one
# before. The roughest is irradiance: at α = 1, D (N·L) of N = V is (N·L)/π.
LAYERS_PER_LEVEL: Final = 3
LAYER_ROUGHNESS_MIN: Final = 1.0 / 16.0
ROUGHNESS_LAYERS: Final = 9
_LEVEL_SIZES: Final = ((512, 256), (256, 128), (128, 64))
# Lobes of the first level span few texels of the map: they are sampled. Those of the others are integrated.
_LOBE_RAYS: Final = 39
# Layers of sheen roughness 0, ¼ … 1: fibres send light to all sides, and their lobe changes slowly.
SHEEN_LAYERS: Final = 5
_SHEEN_SIZE: Final = (64, 32)


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
    levels = environment_levels(dim)
    rest = _upload(context, levels)
    sharp = _upload(context, environment_levels(environment.radiance)) if len(lamps) else rest
    return EnvironmentLight(sharp, rest, _lamps(context, lamps), _layers(context, rest, levels))


def prepare_sheen(context: moderngl.Context, environment: Environment) -> moderngl.Texture:
    """Prefilter the whole map as fibres see it, lamps included; the caller releases the result."""
    alphas = [float(sheen_alpha(layer / (SHEEN_LAYERS - 1))) for layer in range(SHEEN_LAYERS)]
    width, height = _SHEEN_SIZE
    source = resampled(environment.radiance, height, width)
    # Smooth fibres see a ring at the horizon that is narrower than a row of texels.
    lobes = [softened(sheen_lobe(alpha), np.pi / height) for alpha in alphas]
    stack = np.concatenate([blurred(source, lobe) for lobe in lobes])
    texture = context.texture((width, height * SHEEN_LAYERS), 3, stack.tobytes(), dtype="f4")
    _wrap(context, texture)
    return texture


def _lamps(context: moderngl.Context, lamps: Float32) -> moderngl.Texture:
    """Return a column a lamp; without any, one that gives no light."""
    table = lamps if len(lamps) else np.array([[[0, 1, 0, 0], [0, 0, 0, 0]]], np.float32)
    data = np.ascontiguousarray(table.swapaxes(0, 1)).tobytes()
    texture = context.texture((len(table), 2), 4, data, dtype="f4")
    texture.filter = (context.NEAREST, context.NEAREST)
    return texture


def _layers(context: moderngl.Context, rest: moderngl.Texture, levels: list[Float32]) -> moderngl.Texture:
    sampled = _sampled_lobes(context, rest)
    # OpenGL 3.3 as moderngl shows it cannot draw into a level, so it travels.
    texture = context.texture(_stack_size(0), 4, sampled.read(), dtype="f4")
    sampled.release()
    texture.build_mipmaps(0, len(_LEVEL_SIZES) - 1)  # makes room for the levels
    for level, (width, height) in enumerate(_LEVEL_SIZES[1:], start=1):
        source = next((found for found in reversed(levels) if len(found) >= height), levels[0])
        seen = resampled(source, height, width)
        stack = np.concatenate([blurred(seen, ggx_lobe(alpha)) for alpha in _alphas(level)])
        opaque = np.concatenate([stack, np.ones_like(stack[..., :1])], axis=-1)
        texture.write(np.ascontiguousarray(opaque).tobytes(), level=level)
    _wrap(context, texture)
    texture.filter = (context.LINEAR_MIPMAP_NEAREST, context.LINEAR)
    return texture


def _alphas(level: int) -> list[float]:
    first = LAYERS_PER_LEVEL * level
    return [LAYER_ROUGHNESS_MIN**2 * 2.0**number for number in range(first, first + LAYERS_PER_LEVEL)]


def _sampled_lobes(context: moderngl.Context, rest: moderngl.Texture) -> moderngl.Texture:
    """Return the layers of the first level, one below the other."""
    rays = np.stack([lobe_rays(ggx_lobe(alpha), _LOBE_RAYS) for alpha in _alphas(0)])
    samples = context.texture((rays.shape[1], len(rays)), 4, rays.tobytes(), dtype="f4")
    samples.filter = (context.NEAREST, context.NEAREST)
    stack = compute_texture(
        context,
        "pass/prefilter.frag",
        _stack_size(0),
        4,
        {"u_layer_size": _LEVEL_SIZES[0]},
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
