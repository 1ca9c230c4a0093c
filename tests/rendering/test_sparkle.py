"""Sparkles: a pixel is no brighter than what it and its neighbours would be if they were drawn much finer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.texture import NormalTextureInfo
from gltf_iri.scene.model import Environment

SIZE, FINER = 96, 6

# What a pixel spans is known from two of its neighbours, and where bumps bend light back they tell too little
# of it. Lamps that were not spread over the pixel by formula broke this bound in 50 pixels of the smoothest
# ball, in one of them sixtyfold.
BRIGHTER_MAX = 5.0


@pytest.fixture(scope="module")
def sun():
    """10⁵ in a texel of half a degree, under a sky of 1."""
    sky = np.ones((256, 512, 3), np.float32)
    sky[64, 358] = 1e5
    return Environment("sun", sky)


def ball_with_uv(props):
    v, u = np.meshgrid(np.linspace(0, 1, 65), np.linspace(0, 2, 129), indexing="ij")
    return props.sphere(uvs=(np.stack([u, v], axis=-1).reshape(-1, 2).astype(np.float32),))


def dimples(count):
    turn = (np.arange(512) + 0.5) / 512 * 2.0 * np.pi * count
    x, y = np.meshgrid(0.35 * np.cos(turn), 0.35 * np.cos(turn))
    normal = np.stack([x, y, np.ones_like(x)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1)[..., None]
    return np.concatenate([np.round((normal * 0.5 + 0.5) * 255), np.full((512, 512, 1), 255)], axis=-1)


def highest_around(image):
    return np.max([np.roll(image, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)], axis=0)


@pytest.mark.parametrize(("dimple_count", "roughness"), [(0, 0.0), (6, 0.0), (6, 0.05), (6, 0.1)])
def test_no_pixel_outshines_a_finer_picture(stage, props, sun, record_property, dimple_count, roughness):
    images = props.Images()
    metal = Material(pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=roughness))
    if dimple_count:
        linear, trilinear = 9729, 9987
        bumps = images.add(dimples(dimple_count), mag_filter=linear, min_filter=trilinear)
        metal = replace(metal, normal_texture=NormalTextureInfo(bumps))
    coarse, fine = (
        stage.draw(
            ball_with_uv(props),
            metal,
            images=images,
            environment=sun,
            seen_from=props.camera(),
            size=(size, size),
        ).rgba.astype(np.float64)
        for size in (SIZE, FINER * SIZE)
    )
    averaged = fine[..., 0].reshape(SIZE, FINER, SIZE, FINER).mean(axis=(1, 3))
    seen = coarse[..., 3] == 1.0
    brighter = (coarse[..., 0] / np.maximum(highest_around(averaged), 0.5))[seen]
    record_property(
        "measured",
        f"{dimple_count} dimples round a ball of roughness {roughness}: brightest pixel {brighter.max():.1f} "
        "times what a finer picture has",
    )
    assert seen.sum() > 3000
    assert brighter.max() <= BRIGHTER_MAX
