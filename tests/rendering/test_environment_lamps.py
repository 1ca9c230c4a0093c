"""Lamps taken out of a map: none of their light is lost, and a lobe sees them as its integral says."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.optics.microfacet import (
    anisotropic_alphas,
    d_ggx,
    d_ggx_anisotropic,
    v_smith_ggx_anisotropic,
    v_smith_ggx_correlated,
)
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


@pytest.fixture(scope="module")
def sun_ahead():
    return Environment("sun", sky_with_sun(64, 192))  # towards +Z


@pytest.mark.parametrize("tilt_rad", [0.0, 0.9])
@pytest.mark.parametrize("roughness", [0.3, 0.42, 0.85, 1.0])
def test_facets_send_a_sun_s_light_as_their_integral_says(stage, props, sun_ahead, roughness, tilt_rad):
    """Σ L D V (N·L) dω over the sun's texels, seen from above and aslant; 2 % of the peak and of 1."""
    metal = Material(pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=roughness))
    cosine, sine = np.cos(tilt_rad), np.sin(tilt_rad)
    world = np.eye(4)
    world[:3, :3] = [[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]]
    inputs = stage.draw(
        props.quad(world=world), metal, environment=sun_ahead, seen_from=props.camera(), with_inputs=True
    ).inputs
    seen = inputs.material == 0
    normal = inputs.normal[seen].astype(float)
    outgoing = np.array([0.0, 0.0, 4.0]) - inputs.position[seen].astype(float)
    outgoing /= np.linalg.norm(outgoing, axis=-1)[:, None]
    n_dot_v = np.sum(normal * outgoing, axis=-1)
    sent = inputs.dfg_a[seen].astype(float) + inputs.dfg_b[seen]
    expected = np.repeat(sent[:, None], 3, axis=1)  # of the sky of 1
    sky = sun_ahead.radiance
    for i, j in np.argwhere(sky[..., 0] > 1.0):
        light = directions(HEIGHT)[i, j]
        half = outgoing + light
        half /= np.linalg.norm(half, axis=-1)[:, None]
        n_cross_h = np.cross(normal, half)
        n_dot_l = normal @ light
        facets = d_ggx(np.sum(n_cross_h**2, axis=-1), roughness**2)
        facets *= v_smith_ggx_correlated(n_dot_l, n_dot_v, roughness**2)
        power = (sky[i, j].astype(float) - 1.0) * solid_angles(HEIGHT)[i, 0]
        expected += (facets * n_dot_l)[:, None] * power
    error = np.abs(inputs.reflected_radiance[seen] * sent[:, None] - expected)
    assert seen.sum() > 500
    assert error.max() <= 0.02 * max(expected.max(), 1.0)


@pytest.mark.parametrize("strength", [0.4, 0.8])
@pytest.mark.parametrize("rotation_rad", [0.0, 1.1])
def test_stretched_facets_send_a_sun_s_light_as_their_integral_says(
    stage, props, sun_ahead, strength, rotation_rad
):
    """Σ L D V (N·L) dω of the stretched lobe over the sun's texels, seen aslant; 2 % of the peak and of 1."""
    metal = Material(
        pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=0.42),
        anisotropy=Anisotropy(strength=strength, rotation_rad=rotation_rad),
    )
    cosine, sine = np.cos(0.5), np.sin(0.5)
    world = np.eye(4)
    world[:3, :3] = [[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]]
    inputs = stage.draw(
        props.quad(world=world), metal, environment=sun_ahead, seen_from=props.camera(), with_inputs=True
    ).inputs
    seen = inputs.material == 0
    normal = inputs.normal[seen].astype(float)
    tangent = inputs.anisotropy_tangent[seen].astype(float)
    across = np.cross(normal, tangent)
    outgoing = np.array([0.0, 0.0, 4.0]) - inputs.position[seen].astype(float)
    outgoing /= np.linalg.norm(outgoing, axis=-1)[:, None]
    n_dot_v = np.sum(normal * outgoing, axis=-1)
    sent = inputs.dfg_a[seen].astype(float) + inputs.dfg_b[seen]
    expected = np.repeat(sent[:, None], 3, axis=1)  # of the sky of 1
    alphas = anisotropic_alphas(0.42**2, strength)
    sky = sun_ahead.radiance
    for i, j in np.argwhere(sky[..., 0] > 1.0):
        light = directions(HEIGHT)[i, j]
        half = outgoing + light
        half /= np.linalg.norm(half, axis=-1)[:, None]
        n_dot_l = normal @ light
        facets = d_ggx_anisotropic(np.sum(tangent * half, -1), np.sum(across * half, -1), *alphas)
        facets = facets * v_smith_ggx_anisotropic(
            n_dot_l,
            n_dot_v,
            tangent @ light,
            across @ light,
            np.sum(tangent * outgoing, -1),
            np.sum(across * outgoing, -1),
            *alphas,
        )
        power = (sky[i, j].astype(float) - 1.0) * solid_angles(HEIGHT)[i, 0]
        expected += (facets * n_dot_l)[:, None] * power
    error = np.abs(inputs.reflected_radiance[seen] * sent[:, None] - expected)
    assert seen.sum() > 500
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
