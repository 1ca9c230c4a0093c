"""Masks cut, blends lie over what is behind them, and alpha is how much of a pixel is covered."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.texture import TextureInfo
from gltf_iri.material.unlit import Unlit


def glass(rgb, alpha, **more):
    return Material(pbr=MetallicRoughness((*rgb, alpha)), alpha_mode="BLEND", unlit=Unlit(), **more)


def at(props, z, material):
    world = np.eye(4)
    world[2, 3] = z
    return props.quad(world=world, material=material)


@pytest.mark.parametrize("order", [(0, 1, 2), (2, 1, 0), (1, 0, 2)])
def test_blends_lie_over_each_other_from_back_to_front(stage, props, order):
    wall = Material(pbr=MetallicRoughness((0.0, 0.0, 1.0, 1.0)), unlit=Unlit())
    materials = (glass((1, 0, 0), 0.5), glass((0, 1, 0), 0.25), wall)
    things = [at(props, 0.5, 0), at(props, 0.0, 1), at(props, -0.5, 2)]
    frame = stage.draw([things[i] for i in order], materials)
    assert frame.rgba[32, 32] == pytest.approx([0.5, 0.5 * 0.25, 0.5 * 0.75, 1.0], abs=1e-6)


def test_what_is_behind_something_opaque_is_not_blended_in(stage, props):
    wall = Material(pbr=MetallicRoughness((0.0, 0.0, 1.0, 1.0)), unlit=Unlit())
    frame = stage.draw([at(props, 0.5, 0), at(props, 0.0, 1)], [wall, glass((1, 0, 0), 0.5)])
    assert frame.rgba[32, 32].tolist() == [0, 0, 1, 1]


def test_alpha_is_coverage_and_colour_is_premultiplied_light(stage, props):
    frame = stage.draw(props.quad(), glass((1.0, 0.5, 0.0), 0.25))
    assert frame.rgba[32, 32] == pytest.approx([0.25, 0.125, 0.0, 0.25], abs=1e-6)


def test_a_double_sided_blend_shows_its_far_side_through_its_near_one(stage, props):
    ball = glass((1, 1, 1), 0.5, double_sided=True)
    frame = stage.draw(props.sphere(), ball)
    assert frame.rgba[32, 32, 3] == pytest.approx(0.75, abs=1e-6)


def test_a_mask_keeps_what_reaches_the_cutoff_and_drops_the_rest(stage, props):
    images = props.Images()
    texture = images.add([[(255, 255, 255, 100), (255, 255, 255, 102)]])
    material = Material(
        pbr=MetallicRoughness((1.0, 0.0, 0.0, 1.0), base_color_texture=TextureInfo(texture)),
        alpha_mode="MASK",
        alpha_cutoff=0.396,
        unlit=Unlit(),
    )
    frame = stage.draw(props.quad(), material, images=images)
    assert frame.rgba[32, 8].tolist() == [0, 0, 0, 0]
    assert frame.rgba[32, 56].tolist() == [1, 0, 0, 1]


def test_opaque_materials_ignore_alpha(stage, props):
    material = Material(pbr=MetallicRoughness((1.0, 1.0, 1.0, 0.1)), unlit=Unlit())
    assert stage.draw(props.quad(), material).rgba[32, 32].tolist() == [1, 1, 1, 1]


def test_vertex_colours_multiply_the_base_colour(stage, props):
    colours = np.tile(np.float32([0.5, 1.0, 0.25, 1.0]), (4, 1))
    material = Material(pbr=MetallicRoughness((1.0, 0.5, 1.0, 1.0)), unlit=Unlit())
    frame = stage.draw(props.quad(colours=colours), material)
    assert frame.rgba[32, 32] == pytest.approx([0.5, 0.5, 0.25, 1.0], abs=1e-6)


def test_edges_are_antialiased_in_linear_light(stage, props):
    material = Material(unlit=Unlit())
    half = props.quad(world=np.diag([0.501, 2.0, 1.0, 1.0]))
    frame = stage.draw(half, material, size=(9, 9), samples=4)
    edge = frame.rgba[4, 2]
    assert 0.0 < edge[3] < 1.0
    assert np.ptp(edge) == 0.0  # white light as far as it covers


def test_shading_inputs_say_that_blends_were_drawn_opaque(stage, props):
    frame = stage.draw(props.quad(), glass((1, 0, 0), 0.5), with_inputs=True)
    assert frame.inputs.colour[32, 32].tolist() == [1, 0, 0]
    assert any("opaque" in note for note in frame.notes)


def test_alpha_equal_to_the_cutoff_is_kept(stage, props):
    material = Material(
        pbr=MetallicRoughness((1.0, 0.0, 0.0, 0.5)), alpha_mode="MASK", alpha_cutoff=0.5, unlit=Unlit()
    )
    assert stage.draw(props.quad(), material).rgba[32, 32].tolist() == [1, 0, 0, 1]
