"""Lamps taken out of a map: none of their light is lost, and a lobe sees them as its integral says."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.optics.microfacet import d_ggx
from gltf_iri.rendering.environment_lamps import LAMPS_MAX, split_lamps
from gltf_iri.scene.model import Environment
from gltf_iri.scene.studio import directions

HEIGHT = 128


def solid_angles(height):
    return np.diff(-np.cos(np.pi * np.arange(height + 1) / height))[:, None] * np.pi / height


def sky_with_sun(row, column, radiance=1e5, reach=0):
    sky = np.ones((HEIGHT, 2 * HEIGHT, 3), np.float32)
    for i in range(-reach, reach + 1):
        for j in range(-reach, reach + 1):
            sky[row + i, (column + j) % (2 * HEIGHT)] = (radiance, 0.5 * radiance, 0.0)
    return sky


@pytest.mark.parametrize(
    ("row", "column", "reach"),
    [(50, 100, 0), (64, 0, 0), (1, 17, 0), (127, 200, 0), (50, 100, 1), (70, 255, 1), (126, 200, 1)],
)
def test_lamps_and_the_rest_hold_the_light_of_the_map(row, column, reach):
    sky = sky_with_sun(row, column, reach=reach)
    lamps, rest = split_lamps(sky)
    weight = solid_angles(HEIGHT)[..., None]
    total = np.sum(sky * weight, axis=(0, 1))
    assert np.allclose(np.sum(rest * weight, axis=(0, 1)) + lamps[:, 1, :3].sum(axis=0), total, rtol=1e-5)
    assert 1 <= len(lamps) <= 2
    assert rest.max() <= 1.0
    mean = np.sum(lamps[:, 0, :3] * lamps[:, 1, :1], axis=0)
    middle = np.sum(directions(HEIGHT) * ((sky[..., :1] - 1.0) * weight), axis=(0, 1))
    assert np.allclose(mean / np.linalg.norm(mean), middle / np.linalg.norm(middle), atol=1e-4)


def test_a_map_without_lamps_is_left_as_it_is():
    window = np.ones((HEIGHT, 2 * HEIGHT, 3), np.float32)
    window[40:60, 80:120] = 300.0  # bright, and wide enough to be filtered
    for sky in (np.ones_like(window), window, np.zeros_like(window)):
        lamps, rest = split_lamps(sky)
        assert len(lamps) == 0
        assert rest is sky


def test_of_too_many_lamps_the_brightest_are_taken():
    rng = np.random.default_rng(3)
    sky = np.ones((HEIGHT, 2 * HEIGHT, 3), np.float32)
    for row in range(20, 110, 12):
        for column in range(0, 256, 16):
            sky[row, column] = rng.uniform(2e3, 9e3)
    lamps, rest = split_lamps(sky)
    assert len(lamps) == LAMPS_MAX
    assert rest.max() <= np.sort(sky.max(axis=2).ravel())[-LAMPS_MAX - 1]


@pytest.mark.parametrize("roughness", [0.3, 0.354, 0.42, 0.6, 0.85, 1.0])
def test_a_lobe_sees_a_sun_as_its_integral_says(stage, props, roughness):
    """At and between the layers; 2 % of the peak, and of 1 where the sun is far off."""
    row, column = 64, 192  # towards +Z
    sky = sky_with_sun(row, column)
    metal = Material(pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=roughness))
    view = replace(props.camera(), yfov_rad=0.2)
    inputs = stage.draw(
        props.quad(), metal, environment=Environment("sun", sky), seen_from=view, with_inputs=True
    ).inputs
    outgoing = np.array([0.0, 0.0, 4.0]) - inputs.position.astype(float)
    outgoing /= np.linalg.norm(outgoing, axis=-1)[..., None]
    mirrored = outgoing * [-1.0, -1.0, 1.0]
    n_dot_l = (np.arange(400000) + 0.5) / 400000
    alpha = roughness**2
    norm = 2.0 * np.pi * np.mean(d_ggx((1.0 - n_dot_l) / 2.0, alpha) * n_dot_l)
    expected = np.ones_like(mirrored)
    for i, j in np.argwhere(sky[..., 0] > 1.0):
        cosine = mirrored @ directions(HEIGHT)[i, j]
        share = (
            d_ggx((1.0 - cosine) / 2.0, alpha) * np.maximum(cosine, 0.0) * solid_angles(HEIGHT)[i, 0] / norm
        )
        expected += share[..., None] * (sky[i, j].astype(float) - 1.0)
    error = np.abs(inputs.reflected_radiance - expected)
    assert error.max() <= 0.02 * max(expected.max(), 1.0)


def test_no_pixel_of_a_rough_ball_sparkles_under_a_sun(stage, props):
    """Every pixel lies between its neighbours' extremes, but for the highlight's own top."""
    sky = Environment("sun", sky_with_sun(40, 150))
    for roughness in (0.1, 0.3, 0.6):
        metal = Material(pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=roughness))
        inputs = stage.draw(
            props.sphere(), metal, environment=sky, seen_from=props.camera(), size=(72, 72), with_inputs=True
        ).inputs
        seen = inputs.material == 0
        shining = np.where(seen, inputs.reflected_radiance[..., 0], np.inf).astype(float)
        around = [np.roll(shining, shift, (0, 1)) for shift in ((1, 0), (-1, 0), (0, 1), (0, -1))]
        highest = np.where(np.isfinite(around), around, 0.0).max(axis=0)
        peaks = np.isfinite(shining) & np.isfinite(around).all(axis=0) & (shining > 1.02 * highest)
        assert peaks.sum() <= 1
