"""Coat, fibres and stretched facets in pictures: what each does, and that without cause it does nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.texture import NormalTextureInfo, TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.layering import CLEARCOAT_F0
from gltf_iri.scene.model import Light

METAL = MetallicRoughness((0.9, 0.7, 0.4, 1.0), metallic_factor=1.0, roughness_factor=0.4)
PAINT = MetallicRoughness((0.6, 0.1, 0.1, 1.0), metallic_factor=0.0, roughness_factor=0.5)


def sun(x, y, z):
    direction = -np.array([x, y, z]) / np.linalg.norm([x, y, z])
    return Light("sun", "directional", (1.0, 1.0, 1.0), 3.0, np.zeros(3), direction)


def one_texel(props, *rgba):
    images = props.Images()
    return images, TextureInfo(images.add([[rgba]]))


@pytest.mark.parametrize("pbr", [METAL, PAINT])
@pytest.mark.parametrize("kind", ["coat", "sheen"])
def test_a_layer_that_a_texture_takes_away_changes_no_bit(stage, props, furnace, pbr, kind):
    images, black = one_texel(props, 0, 0, 0, 255)
    layer = {
        "coat": {"clearcoat": Clearcoat(factor=1.0, texture=black, roughness_factor=0.3)},
        "sheen": {"sheen": Sheen((1.0, 0.5, 0.2), black, 0.5)},
    }[kind]
    options = {"images": images, "lights": [sun(1, 1, 2)], "environment": furnace}
    bare = stage.draw(props.sphere(), Material(pbr=pbr), **options)
    layered = stage.draw(props.sphere(), Material(pbr=pbr, **layer), **options)
    np.testing.assert_array_equal(layered.rgba, bare.rgba)


def test_a_coat_dims_the_emission_below_it_by_what_it_reflects(stage, props):
    glowing = Material(pbr=METAL, emissive_factor=(0.8, 0.4, 0.2), clearcoat=Clearcoat(0.75, None, 0.3))
    seen = stage.draw(props.quad(), glowing).rgba[32, 32, :3]
    a, b = dfg_terms(1.0, 0.3)
    # The renderer's table of 128 × 128 is off by up to 1e-3, of which the coat's F0 leaves little.
    expected = (1.0 - 0.75 * (CLEARCOAT_F0 * a + b)) * np.array([0.8, 0.4, 0.2])
    assert seen == pytest.approx(expected, abs=1e-4)


def test_coat_and_base_bend_by_their_own_normal_maps(stage, props, furnace):
    leaning = np.array([0.48, 0.36, 0.8])
    images = props.Images()
    bumps = images.add([[[*(round((c + 1) / 2 * 255) for c in leaning), 255]]])
    of_base = Material(pbr=PAINT, clearcoat=Clearcoat(1.0), normal_texture=NormalTextureInfo(bumps))
    of_coat = Material(pbr=PAINT, clearcoat=Clearcoat(1.0, normal_texture=NormalTextureInfo(bumps)))
    for material, base, coat in ((of_base, leaning, [0, 0, 1]), (of_coat, [0, 0, 1], leaning)):
        drawn = stage.draw(props.quad(), material, images=images, environment=furnace, with_inputs=True)
        assert drawn.inputs.normal[32, 32] == pytest.approx(base, abs=0.01)
        assert drawn.inputs.clearcoat_normal[32, 32] == pytest.approx(coat, abs=0.01)


def test_a_film_below_a_coat_keeps_air_as_its_outside(stage, props, furnace):
    """What lies below the coat is the filmed surface without it, times what the coat lets through."""
    filmed = Material(pbr=METAL, iridescence=Iridescence(factor=1.0, film_ior=1.6, thickness_max_nm=400.0))
    coated = replace(filmed, clearcoat=Clearcoat(1.0, None, 0.2))
    bare = stage.draw(props.sphere(), filmed, environment=furnace, with_inputs=True).inputs
    found = stage.draw(props.sphere(), coated, environment=furnace, with_inputs=True).inputs
    a, b = found.layer_albedos[..., 0], found.layer_albedos[..., 1]
    share = (CLEARCOAT_F0 * a + b)[..., None] * (found.clearcoat[..., None] > 0.0)
    expected = (1.0 - share) * bare.colour + share * found.clearcoat_radiance
    np.testing.assert_allclose(found.colour, expected, rtol=0, atol=1e-6)


def lit_from_behind(stage, props, material):
    quad = props.quad()
    return stage.draw(quad, material, lights=[sun(0.2, 0.1, -1)]).rgba[32, 32, :3]


def test_light_from_behind_shines_through_thin_walls_in_their_colour(stage, props):
    window = Material(
        pbr=MetallicRoughness((0.9, 0.5, 0.2, 1.0), metallic_factor=0.0, roughness_factor=0.6),
        transmission=Transmission(factor=1.0),
    )
    seen = lit_from_behind(stage, props, window)
    assert seen.min() > 0.0
    assert seen / seen[0] == pytest.approx(np.array([0.9, 0.5, 0.2]) / 0.9, rel=1e-3)
    opaque = lit_from_behind(stage, props, replace(window, transmission=None))
    assert opaque.tolist() == [0.0, 0.0, 0.0]


def tangents(x, y):
    return np.tile(np.float32([x, y, 0, 1]), (4, 1))


def spread(picture):
    """Standard deviations across columns and across rows of the light of a highlight."""
    light = picture[..., 0].astype(np.float64)
    y, x = np.indices(light.shape)
    middle_x, middle_y = np.average(x, weights=light), np.average(y, weights=light)
    return (
        np.sqrt(np.average((x - middle_x) ** 2, weights=light)),
        np.sqrt(np.average((y - middle_y) ** 2, weights=light)),
    )


BRUSHED = MetallicRoughness((1.0, 1.0, 1.0, 1.0), metallic_factor=1.0, roughness_factor=0.35)


@pytest.mark.parametrize(
    ("tangent", "rotation", "wide"),
    [((1, 0), 0.0, "x"), ((0, 1), 0.0, "y"), ((1, 0), np.pi / 2, "y"), ((1, 0), np.pi, "x")],
)
def test_a_highlight_is_drawn_out_along_the_turned_tangent(stage, props, tangent, rotation, wide):
    quad = props.quad(tangents=tangents(*tangent))
    brushed = Material(pbr=BRUSHED, anisotropy=Anisotropy(0.7, rotation))
    view = {"lights": [sun(0, 0, 1)], "seen_from": props.camera(distance=2.0)}
    across, upright = spread(stage.draw(quad, brushed, **view).rgba)
    assert (across > 1.2 * upright) if wide == "x" else (upright > 1.2 * across)
    even = spread(stage.draw(quad, Material(pbr=BRUSHED), **view).rgba)
    assert even[0] == pytest.approx(even[1], rel=1e-3)


def test_a_painted_direction_turns_counter_clockwise_with_the_rotation(stage, props):
    """(R, G) = 30° and a rotation of 20° give 50° from the tangent, towards the bitangent (glTF: +Y here)."""
    painted = np.radians(30.0)
    colour = [round(127.5 + 127.5 * c) for c in (np.cos(painted), np.sin(painted))]
    images, texture = one_texel(props, *colour, 128, 255)
    material = Material(pbr=BRUSHED, anisotropy=Anisotropy(0.8, np.radians(20.0), texture))
    quad = props.quad(tangents=tangents(1, 0))
    found = stage.draw(quad, material, images=images, with_inputs=True).inputs
    expected = [np.cos(np.radians(50.0)), np.sin(np.radians(50.0)), 0.0]
    assert found.anisotropy_tangent[32, 32] == pytest.approx(expected, abs=0.01)
    assert found.anisotropy_strength[32, 32] == pytest.approx(0.8 * 128 / 255, rel=1e-6)


@pytest.mark.parametrize("environment", [False, True])
def test_without_tangents_and_coordinates_nothing_is_drawn_out(stage, props, furnace, environment):
    quad = props.quad(uvs=())
    light = {"lights": [sun(0.3, 0.2, 1)], "environment": furnace if environment else None}
    brushed = stage.draw(quad, Material(pbr=BRUSHED, anisotropy=Anisotropy(1.0)), **light)
    np.testing.assert_array_equal(brushed.rgba, stage.draw(quad, Material(pbr=BRUSHED), **light).rgba)


def test_coordinates_give_the_direction_that_tangents_would(stage, props):
    material = Material(pbr=BRUSHED, anisotropy=Anisotropy(0.7, 0.4))
    without = stage.draw(props.quad(), material, with_inputs=True).inputs
    given = stage.draw(props.quad(tangents=tangents(1, 0)), material, with_inputs=True).inputs
    np.testing.assert_allclose(without.anisotropy_tangent, given.anisotropy_tangent, rtol=0, atol=1e-5)


@pytest.mark.parametrize("roughness", [0.1, 0.4, 0.8])
@pytest.mark.parametrize("strength", [0.4, 1.0])
def test_brushed_metal_sends_no_more_than_arrives(stage, props, furnace, roughness, strength):
    brushed = Material(
        pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=roughness),
        anisotropy=Anisotropy(strength),
    )
    inputs = stage.draw(props.sphere(), brushed, environment=furnace, with_inputs=True).inputs
    seen = inputs.anisotropy_strength > 0.0
    assert seen.sum() > 1000
    assert np.abs(inputs.reflected_radiance[seen] - 1.0).max() <= 1e-6
    assert inputs.colour[seen].max() <= 1.0 + 1e-6


def test_stretched_facets_send_what_their_integral_says_of_a_white_sky(stage, props, furnace):
    """Seen from straight above, α_t = 1 and α_b = 0.16: ∫ D·V·(N·L) dω by quadrature over facets."""
    brushed = Material(
        pbr=MetallicRoughness(metallic_factor=1.0, roughness_factor=0.4), anisotropy=Anisotropy(1.0)
    )
    found = stage.draw(props.quad(), brushed, environment=furnace, with_inputs=True).inputs.colour[32, 32]
    share = (np.arange(2000) + 0.5)[:, None] / 2000
    turn = 2.0 * np.pi * (np.arange(500) + 0.5) / 500
    slope = np.sqrt(share / (1.0 - share))
    x, y = 1.0 * slope * np.cos(turn), 0.16 * slope * np.sin(turn)
    n_dot_h = 1.0 / np.sqrt(1.0 + x * x + y * y)
    light = np.stack([2.0 * n_dot_h * n_dot_h * x, 2.0 * n_dot_h * n_dot_h * y, 2.0 * n_dot_h**2 - 1.0])
    lit = light[2] > 0.0
    view_term = np.sqrt(light[0] ** 2 + (0.16 * light[1]) ** 2 + light[2] ** 2)
    # 4 V (N·L)(V·H)/(N·H) with N·V = V·H/N·H = 1
    sent = np.where(lit, 2.0 * light[2] / (np.abs(light[2]) + view_term), 0.0)
    assert found == pytest.approx(np.full(3, sent.mean()), abs=0.05)
