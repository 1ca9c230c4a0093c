"""Texture sampling: the texel that the definition names, and its neighbours' weights, by another road."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.reference.texture import Texels, sample

NEAREST, LINEAR = 9728, 9729
REPEAT, CLAMP, MIRROR = 10497, 33071, 33648


def srgb(value):
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def wrapped(i, count, mode):
    """Walk from texel to texel until inside."""
    if mode == CLAMP:
        return min(max(i, 0), count - 1)
    while not 0 <= i < count:
        if mode == REPEAT:
            i += count if i < 0 else -count
        else:
            i = -1 - i if i < 0 else 2 * count - 1 - i
    return i


def by_definition(texels, u, v, is_srgb):
    """Sum over all texels in reach, each weighed by its tent (LINEAR) or box (NEAREST) about its centre."""
    height, width = texels.pixels.shape[:2]
    total = np.zeros(4)
    for row in range(int(np.floor(v * height)) - 2, int(np.floor(v * height)) + 3):
        for column in range(int(np.floor(u * width)) - 2, int(np.floor(u * width)) + 3):
            dx, dy = u * width - (column + 0.5), v * height - (row + 0.5)
            if texels.mag_filter == LINEAR:
                weight = max(0.0, 1.0 - abs(dx)) * max(0.0, 1.0 - abs(dy))
            else:
                weight = float(-0.5 <= dx < 0.5 and -0.5 <= dy < 0.5)
            stored = texels.pixels[wrapped(row, height, texels.wrap_t), wrapped(column, width, texels.wrap_s)]
            values = [stored[k] / 255 for k in range(4)]
            if is_srgb:
                values[:3] = [srgb(value) for value in values[:3]]
            total += weight * np.array(values)
    return total


@pytest.mark.parametrize("is_srgb", [False, True])
@pytest.mark.parametrize("wraps", [(REPEAT, REPEAT), (CLAMP, MIRROR), (MIRROR, CLAMP), (MIRROR, REPEAT)])
@pytest.mark.parametrize("mag_filter", [NEAREST, LINEAR])
def test_samples_are_what_the_definition_sums(mag_filter, wraps, is_srgb):
    rng = np.random.default_rng(1)
    texels = Texels(rng.integers(0, 256, (3, 5, 4), dtype=np.uint8), *wraps, mag_filter)
    uv = rng.uniform(-2.5, 3.5, (60, 2))
    expected = [by_definition(texels, u, v, is_srgb) for u, v in uv]
    assert np.abs(sample(texels, uv, is_srgb=is_srgb) - expected).max() < 1e-12


def test_coordinates_of_any_size_find_a_texel():
    texels = Texels(np.full((2, 2, 4), 255, np.uint8), REPEAT, MIRROR, LINEAR)
    uv = np.array([[1e30, -1e30], [3.4e38, 3.4e38], [-1e18, 1e-30]])
    assert np.array_equal(sample(texels, uv, is_srgb=True), np.ones((3, 4)))
