"""Mip levels keep the moments of what they average, whatever the size."""

from __future__ import annotations

import re
from itertools import pairwise

import numpy as np
import pytest

from gltf_iri.asset.moments import MEAN, ROUNDING, SQUARE, moment_levels
from gltf_iri.material.interface import TextureBinding
from gltf_iri.rendering.textures import TextureStore
from gltf_iri.resources import shader_root

SIZES = [(64, 64), (48, 5), (1, 9), (7, 1), (3, 3), (1, 1), (33, 70)]


def noise(height: int, width: int) -> np.ndarray:
    return np.random.default_rng(height * width).integers(0, 256, (height, width), dtype=np.uint8)


def test_every_level_of_a_checkerboard_is_half_on_and_half_off():
    board = np.where(np.indices((64, 32)).sum(axis=0) % 2, 255, 0).astype(np.uint8)
    base, *smaller = moment_levels(board)
    np.testing.assert_array_equal(base[..., MEAN], board / 255)
    assert [level.shape[:2] for level in smaller] == [(32, 16), (16, 8), (8, 4), (4, 2), (2, 1), (1, 1)]
    for level in smaller:
        np.testing.assert_array_equal(level, 0.5)


@pytest.mark.parametrize("size", SIZES)
def test_every_level_has_the_moments_of_the_whole_texture(size):
    values = noise(*size) / 255.0
    for level in moment_levels(noise(*size)):
        whole = level.mean(axis=(0, 1), dtype=np.float64)
        assert whole[MEAN] == pytest.approx(values.mean(), abs=1e-7)
        assert whole[SQUARE] == pytest.approx((values * values).mean(), abs=1e-7)


@pytest.mark.parametrize("size", SIZES)
def test_a_texel_is_the_mean_over_its_own_area_of_the_level_before(size):
    for before, level in pairwise(moment_levels(noise(*size))):
        for axis in (0, 1):
            # Cut every texel into as many strips as there are texels in the smaller level.
            count = level.shape[axis]
            strips = np.repeat(before.astype(np.float64), count, axis=axis)
            shape = list(strips.shape)
            shape[axis : axis + 1] = [count, before.shape[axis]]
            before = strips.reshape(shape).mean(axis=axis + 1)
        np.testing.assert_allclose(level, before, atol=1e-7)


def test_opengl_holds_the_levels_as_they_were_made(gl_context, props):
    images = props.Images()
    texels = noise(11, 20)
    index = images.add(np.stack([np.zeros_like(texels), texels, texels, texels], axis=-1))
    store = TextureStore(gl_context, images)
    texture = store.get(TextureBinding(index, "linear", "g"))
    for number, level in enumerate(moment_levels(texels)):
        held = np.frombuffer(texture.read(level=number), np.float32).reshape(level.shape)
        np.testing.assert_array_equal(held, level)
    assert texture is not store.get(TextureBinding(index, "linear"))
    store.release()


def test_what_counts_as_rounding_is_the_same_in_glsl():
    source = (shader_root() / "material" / "thickness.glsl").read_text(encoding="utf-8")
    (value,) = re.findall(r"MOMENTS_ROUNDING = ([^;]+);", source)
    assert float(value) == ROUNDING
