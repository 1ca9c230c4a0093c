"""Prefiltering: sizes of light are kept, nothing shows where the map is cut or where its poles lie."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.rendering.environment_levels import environment_levels
from gltf_iri.rendering.environment_light import LAYERS_PER_LEVEL, ROUGHNESS_LAYERS, prepare_environment
from gltf_iri.rendering.lobe_rays import ggx_lobe
from gltf_iri.scene.model import Environment

AXIS = np.array([0.48, 0.6, -0.64])


def directions(height, width, *, pole_to_pole=False):
    rows = np.arange(height)
    polar = (rows / (height - 1) if pole_to_pole else (rows + 0.5) / height) * np.pi
    azimuth = ((np.arange(width) + 0.5) / width - 0.5) * 2 * np.pi
    sine = np.sin(polar)[:, None]
    cosine = np.broadcast_to(np.cos(polar)[:, None], (height, width))
    return np.stack([sine * np.cos(azimuth), cosine, sine * np.sin(azimuth)], axis=-1)


def slanted_sky():
    """L(ω) = 1 + a·ω: any lobe that is symmetrical about N turns it into 1 + k a·N with one k."""
    radiance = 1.0 + directions(128, 256) @ AXIS
    return Environment("slanted", np.repeat(radiance[..., None], 3, axis=-1).astype(np.float32))


@pytest.fixture(scope="module")
def slanted():
    """One object for all tests that draw under it: it is prefiltered once."""
    return slanted_sky()


@pytest.fixture(scope="module")
def layers(_session_context, slanted):
    """Every layer of roughness from the smoothest on; red alone."""
    prepared = prepare_environment(_session_context, slanted)
    width, height = prepared.layers.size
    found = []
    for number in range(ROUGHNESS_LAYERS):
        level, index = divmod(number, LAYERS_PER_LEVEL)
        stack = np.frombuffer(prepared.layers.read(level=level), np.float32)
        stack = stack.reshape(LAYERS_PER_LEVEL, (height >> level) // LAYERS_PER_LEVEL, width >> level, 4)
        found.append(stack[index, ..., 0].astype(np.float64))
    prepared.release()
    return found


@pytest.mark.usefixtures("gl_context")
def test_irradiance_of_a_slanted_sky_is_its_cosine_integral(layers):
    irradiance = layers[-1]
    expected = 1.0 + 2.0 / 3.0 * (directions(*irradiance.shape, pole_to_pole=True) @ AXIS)
    assert np.abs(irradiance - expected).max() <= 2e-3


@pytest.mark.usefixtures("gl_context")
def test_every_layer_blurs_alike_in_all_directions_seam_and_poles_included(layers):
    for layer in layers:
        slant = directions(*layer.shape, pole_to_pole=True) @ AXIS
        shrink = np.sum((layer - 1.0) * slant) / np.sum(slant * slant)
        assert np.abs(layer - 1.0 - shrink * slant).max() <= 0.01


@pytest.mark.usefixtures("gl_context")
def test_rougher_layers_blur_more(layers):
    assert np.all(np.diff([np.ptp(layer) for layer in layers]) < 0.0)


@pytest.mark.parametrize("up", [1.0, -1.0])
def test_a_surface_that_faces_a_pole_reads_its_own_layer_alone(stage, props, slanted, up):
    """Layers lie one below the other in one texture: the last row of one beside the first of the next."""
    view = np.array([[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, -up, 0.0], [0.0, up, 0.0, -4.0], [0.0, 0.0, 0.0, 1.0]])
    ball = Material(pbr=MetallicRoughness(metallic_factor=0.0))
    camera = replace(props.camera(half_height=1.0), view=view)
    inputs = stage.draw(props.sphere(), ball, environment=slanted, seen_from=camera, with_inputs=True).inputs
    assert np.abs(inputs.normal[32, 32] - [0.0, up, 0.0]).max() <= 0.04
    expected = 1.0 + 2.0 / 3.0 * (inputs.normal[32, 32] @ AXIS)
    assert np.abs(inputs.irradiance[32, 32] - expected).max() <= 5e-3


@pytest.mark.parametrize("number", [3, 4, 6, 7, 8])
def test_a_rough_lobe_sees_a_small_bright_window_as_its_integral_says(gl_context, number):
    """Σ L D (N·L) dω / Σ D (N·L) dω over all texels, also far from the window, where rays would miss it."""
    sky = np.full((128, 256, 3), 0.01, np.float32)
    sky[30:36, 40:52] = 300.0
    prepared = prepare_environment(gl_context, Environment("window", sky))
    level, index = divmod(number, LAYERS_PER_LEVEL)
    width, height = prepared.layers.size
    stack = np.frombuffer(prepared.layers.read(level=level), np.float32)
    layer = stack.reshape(LAYERS_PER_LEVEL, (height >> level) // LAYERS_PER_LEVEL, width >> level, 4)[
        index, ..., 0
    ]
    prepared.release()
    texels = directions(128, 256).reshape(-1, 3)
    steradians = np.repeat(-np.diff(np.cos(np.pi * np.arange(129) / 128)), 256)
    normals = directions(*layer.shape, pole_to_pole=True)[::9, ::13].reshape(-1, 3)
    half_sine_squared = np.minimum(0.25 * np.sum(np.square(normals[:, None] - texels), axis=-1), 0.5)
    lobe = ggx_lobe(2.0**number / 256.0)(half_sine_squared) * steradians
    expected = lobe @ sky[..., 0].reshape(-1) / lobe.sum(axis=1)
    error = np.abs(layer[::9, ::13].reshape(-1) - expected)
    assert np.all(error <= np.maximum(0.03 * expected, 1e-3 * layer.max()))


def test_halving_keeps_the_light_of_the_whole_sphere():
    rng = np.random.default_rng(7)
    sky = rng.uniform(0.0, 5.0, (33, 70, 3)).astype(np.float32)
    totals = []
    for level in environment_levels(sky):
        edges = np.cos(np.linspace(0.0, np.pi, level.shape[0] + 1))
        totals.append(-np.diff(edges) @ level.mean(axis=1))
    assert np.allclose(totals, totals[0], rtol=1e-5)


def test_halving_weighs_texels_by_solid_angle():
    sky = np.zeros((4, 1, 1), np.float32)
    sky[0] = 1.0
    polar_cap, band = 1.0 - np.cos(np.pi / 4), np.cos(np.pi / 4)
    assert environment_levels(sky)[1][0, 0, 0] == pytest.approx(polar_cap / (polar_cap + band), rel=1e-6)


@pytest.mark.parametrize("column", [0, 90, 200])
def test_a_mirror_shows_a_lamp_where_the_mirror_law_puts_it(stage, props, column):
    sky = np.zeros((128, 256, 3), np.float32)
    sky[44:48, [(column - 1) % 256, column, (column + 1) % 256]] = 1000.0
    lamp = directions(128, 256)[45, column]
    mirror = Material(pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=0.0))
    frame = stage.draw(
        props.sphere(),
        mirror,
        environment=Environment("lamp", sky),
        seen_from=props.camera(half_height=1.0),
        size=(192, 192),
        with_inputs=True,
    )
    weight = frame.inputs.reflected_radiance[..., 0].astype(np.float64)
    assert weight.max() > 0.0
    normal = np.sum(frame.inputs.normal * weight[..., None], axis=(0, 1))
    normal /= np.linalg.norm(normal)
    mirrored = 2.0 * normal[2] * normal - [0.0, 0.0, 1.0]
    assert np.degrees(np.arccos(mirrored @ lamp)) <= 3.0


def striped_sky():
    stripes = np.zeros((256, 512, 3), np.float32)
    stripes[:, ::2] = 2.0
    return Environment("stripes", stripes)


def test_a_mirror_does_not_sparkle_where_a_pixel_sees_many_texels(stage, props):
    mirror = Material(pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=0.0))
    inputs = stage.draw(
        props.sphere(),
        mirror,
        environment=striped_sky(),
        seen_from=props.camera(half_height=1.0),
        size=(24, 24),
        with_inputs=True,
    ).inputs
    seen = inputs.reflected_radiance[inputs.material == 0][:, 0]
    assert np.mean(seen) == pytest.approx(1.0, abs=0.05)
    assert np.abs(seen - 1.0).max() <= 0.2


@pytest.mark.parametrize("seen", ["mirrored", "by the coat", "through a ball"])
def test_light_through_pixel_centres_is_averaged_over_nothing(stage, props, seen):
    """Stripes of 0 and 2: pixels that span many of them see about 1, centres alone see one stripe or two."""
    black = MetallicRoughness(base_color_factor=(0.0, 0.0, 0.0, 1.0), roughness_factor=0.0)
    glass = MetallicRoughness(metallic_factor=0.0, roughness_factor=0.0)
    ball = {
        "mirrored": Material(pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=0.0)),
        "by the coat": Material(pbr=black, clearcoat=Clearcoat(factor=1.0)),
        "through a ball": Material(
            pbr=glass, transmission=Transmission(factor=1.0), volume=Volume(thickness_factor_m=2.0)
        ),
    }[seen]
    sky = striped_sky()

    def contrast(*, is_sharp):
        frame = stage.draw(
            props.sphere(),
            ball,
            environment=sky,
            seen_from=props.camera(half_height=1.0),
            size=(24, 24),
            samples=0,
            sharp_textures=is_sharp,
        )
        middle = frame.rgba[8:16, 8:16, 0]
        return middle.std() / middle.mean(), frame.rgba

    ordinary, before = contrast(is_sharp=False)
    sharp, _ = contrast(is_sharp=True)
    assert ordinary <= 0.15
    assert sharp >= 3.0 * ordinary
    assert np.array_equal(contrast(is_sharp=False)[1], before)
