"""What glass sends is what lies behind it, less what it reflects and absorbs; nothing is gained or lost."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import TextureInfo, TextureTransform
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.unlit import Unlit
from gltf_iri.material.volume import Volume
from gltf_iri.scene.model import Environment

NO_REFLECTION = Specular(factor=0.0)


def glass(colour=(1.0, 1.0, 1.0), roughness=0.0, **more):
    pbr = MetallicRoughness((*colour, 1.0), metallic_factor=0.0, roughness_factor=roughness)
    return Material(**({"pbr": pbr, "transmission": Transmission(factor=1.0)} | more))


def paint(colour):
    return Material(pbr=MetallicRoughness((*colour, 1.0)), unlit=Unlit())


def placed(shape, z, material, size=1.0):
    world = np.diag([size, size, size, 1.0])
    world[2, 3] = z
    return shape(world=world, material=material)


@pytest.fixture(scope="module")
def slanted_sky():
    """Brighter upwards, redder to the right; one object, so that it is prefiltered once."""
    rows, columns = np.meshgrid(np.linspace(1, 0.2, 32), np.linspace(0.1, 1, 64), indexing="ij")
    return Environment("sky", np.stack([columns, rows, 0.5 + 0 * rows], axis=-1).astype(np.float32))


def checks(props, images):
    """A wall of checks that fills half of the picture."""
    texels = np.full((16, 16, 4), 255, np.uint8)
    texels[(np.arange(16)[:, None] + np.arange(16)) % 2 == 0, :2] = 40
    texture = TextureInfo(images.add(texels))
    wall = Material(pbr=MetallicRoughness(base_color_texture=texture), unlit=Unlit())
    return placed(props.quad, -2.0, 0, size=0.7), wall


@pytest.mark.parametrize("samples", [0, 4])
@pytest.mark.parametrize("volume", [None, Volume(thickness_factor_m=0.5)])
def test_glass_of_index_1_leaves_the_scene_behind_it_as_it_is(stage, props, slanted_sky, volume, samples):
    images = props.Images()
    back, wall = checks(props, images)
    clear = glass(ior=Ior(1.0), specular=NO_REFLECTION, volume=volume)
    options = {
        "images": images,
        "environment": slanted_sky,
        "seen_from": props.camera(),
        "samples": samples,
        "size": (96, 96),
    }
    without = stage.draw([back], [wall, clear], **options).rgba
    for pane in (placed(props.quad, 0.5, 1), placed(props.sphere, 0.0, 1)):
        seen = stage.draw([back, pane], [wall, clear], **options).rgba
        # The direction to the background is computed in another way, with its own float32 roundings.
        assert np.abs(seen[..., :3] - without[..., :3]).max() <= 2e-6
        assert seen[48, 48, 3] == 1.0


@pytest.mark.parametrize("roughness", [0.0, 0.1, 0.5, 1.0])
@pytest.mark.parametrize("film", [None, Iridescence(factor=1.0, film_ior=1.8, thickness_max_nm=400.0)])
@pytest.mark.parametrize("volume", [None, Volume(thickness_factor_m=0.5)])
def test_under_a_white_sky_what_is_reflected_and_what_passes_make_one(
    stage, props, furnace, roughness, film, volume
):
    material = glass(roughness=roughness, iridescence=film, volume=volume)
    frame = stage.draw(props.sphere(), material, environment=furnace, seen_from=props.camera())
    assert np.abs(frame.rgba[..., :3] - 1.0).max() <= 1e-5
    assert frame.rgba[32, 32, 3] == 1.0


@pytest.mark.parametrize("scale", [(1, 1, 1), (2, 2, 2), (3, 1, 2), (1, 1, -0.5), (1, 1, 0)])
def test_light_is_absorbed_by_beers_law_along_the_thickness_as_the_node_scales_it(
    stage, props, furnace, scale
):
    volume = Volume(thickness_factor_m=0.5, attenuation_distance_m=0.4, attenuation_color=(0.9, 0.5, 0.1))
    material = glass(specular=NO_REFLECTION, volume=volume, double_sided=True)
    pane = props.quad(world=np.diag([*scale, 1.0]))
    frame = stage.draw(pane, material, environment=furnace)
    expected = np.array([0.9, 0.5, 0.1]) ** (0.5 * abs(scale[2]) / 0.4)
    assert np.abs(frame.rgba[32, 32, :3] - expected).max() <= 1e-6


def test_the_transmission_share_is_that_of_the_factor_and_the_texture(stage, props, furnace):
    images = props.Images()
    half = TextureInfo(images.add([[(128, 255, 255, 255)]]))
    transmission = Transmission(factor=0.5, texture=half)
    material = glass(specular=NO_REFLECTION, transmission=transmission)
    frame = stage.draw(props.quad(), material, images=images, environment=furnace, with_inputs=True)
    assert frame.inputs.transmission[32, 32] == pytest.approx(0.5 * 128 / 255, rel=1e-6)


@pytest.mark.parametrize("slot", ["transmission", "thickness"])
def test_transmission_and_thickness_are_turned_and_may_read_the_second_uv_set(stage, props, furnace, slot):
    """A quarter turn, u′ = v and v′ = −u: the upper left corner reads the lower left texel, and so on."""
    images = props.Images()
    texels = [[[value, value, 0, 255] for value in row] for row in ((0, 51), (102, 204))]
    turned = TextureTransform(rotation_rad=np.pi / 2, tex_coord=1)
    texture = TextureInfo(images.add(texels), transform=turned)
    transmission = Transmission(factor=1.0, texture=texture if slot == "transmission" else None)
    volume = Volume(
        thickness_factor_m=1.0,
        thickness_texture=texture if slot == "thickness" else None,
        attenuation_distance_m=1.0,
        attenuation_color=(0.5, 0.5, 0.5),
    )
    material = glass(specular=NO_REFLECTION, transmission=transmission, volume=volume)
    quad = props.quad()
    quad = replace(quad, uvs=(quad.uvs[0] * 0.0, quad.uvs[0]))
    frame = stage.draw(quad, material, images=images, environment=furnace, with_inputs=True)
    corners = [(8, 8), (8, 56), (56, 8), (56, 56)]
    if slot == "transmission":
        found = [frame.inputs.transmission[place] for place in corners]
    else:
        found = [-np.log2(frame.inputs.transmitted_radiance[place][0]) for place in corners]
    assert found == pytest.approx([102 / 255, 0.0, 204 / 255, 51 / 255], abs=1e-6)


def test_thickness_is_in_green(stage, props, furnace):
    images = props.Images()
    texture = TextureInfo(images.add([[(255, 51, 255, 255)]]))
    volume = Volume(
        thickness_factor_m=1.0,
        thickness_texture=texture,
        attenuation_distance_m=0.2,
        attenuation_color=(0.5, 1.0, 0.25),
    )
    material = glass(specular=NO_REFLECTION, volume=volume)
    frame = stage.draw(props.quad(), material, images=images, environment=furnace)
    assert np.abs(frame.rgba[32, 32, :3] - [0.5, 1.0, 0.25]).max() <= 1e-6


@pytest.mark.parametrize("order", [(0, 1, 2, 3), (3, 2, 1, 0), (2, 0, 3, 1)])
@pytest.mark.parametrize("is_double", [False, True])
def test_a_wall_is_seen_through_nested_spheres_and_a_blend_whatever_the_files_order(
    stage, props, order, is_double
):
    materials = [
        paint((1.0, 1.0, 1.0)),
        Material(pbr=MetallicRoughness((0.0, 0.0, 1.0, 0.5)), alpha_mode="BLEND", unlit=Unlit()),
        glass((0.5, 1.0, 1.0), specular=NO_REFLECTION, double_sided=is_double),
        glass((1.0, 0.25, 1.0), specular=NO_REFLECTION, double_sided=is_double),
    ]
    things = [
        placed(props.quad, -3.0, 0, size=2.0),
        placed(props.quad, -2.0, 1, size=2.0),
        placed(props.sphere, 0.0, 2, size=0.4),
        placed(props.sphere, 0.0, 3, size=0.9),
    ]
    frame = stage.draw([things[i] for i in order], materials, seen_from=props.camera())
    passes = 2 if is_double else 1
    behind = np.array([0.5, 0.5, 1.0])
    assert frame.rgba[32, 32, :3] == pytest.approx(behind * [0.5**passes, 0.25**passes, 1.0], abs=1e-6)
    beside = frame.rgba[32, 47, :3]  # through the outer sphere alone
    assert beside == pytest.approx(behind * [1.0, 0.25**passes, 1.0], abs=1e-6)


def test_far_and_near_walls_of_a_blend_take_their_places_around_what_is_inside(stage, props):
    outer = Material(
        pbr=MetallicRoughness((1.0, 0.0, 0.0, 0.5)), alpha_mode="BLEND", unlit=Unlit(), double_sided=True
    )
    things = [placed(props.sphere, 0.0, 0, size=0.9), placed(props.sphere, 0.0, 1, size=0.4)]
    inner = glass((0.0, 1.0, 0.0), specular=NO_REFLECTION)
    frame = stage.draw(things, [outer, inner], seen_from=props.camera())
    # Red · ½ behind, of which green glass lets nothing through; the near wall covers half of that.
    assert frame.rgba[32, 32].tolist() == pytest.approx([0.5, 0.0, 0.0, 1.0], abs=1e-6)


def test_something_before_the_glass_is_not_seen_through_it(stage, props):
    ball = glass(volume=Volume(thickness_factor_m=2.0), ior=Ior(1.5), specular=NO_REFLECTION)
    things = [
        placed(props.quad, -3.0, 0, size=4.0),
        placed(props.sphere, 0.0, 1),
        placed(props.quad, 1.5, 2, size=0.2),
    ]
    frame = stage.draw(
        things,
        [paint((0, 1, 0)), ball, paint((1, 0, 0))],
        seen_from=props.camera(),
        size=(128, 128),
        samples=0,
    )
    is_red = frame.rgba[..., 0] > 0.05
    assert is_red.any()
    edges = np.argwhere(is_red)
    assert is_red[edges[0, 0] : edges[-1, 0] + 1, edges[:, 1].min() : edges[:, 1].max() + 1].all()


def test_rough_glass_blurs_what_is_far_and_not_what_touches_it(stage, props):
    def contrast(distance, roughness):
        images = props.Images()
        _, wall = checks(props, images)
        back = placed(props.quad, -distance, 0, size=2.0)
        pane = placed(props.quad, 0.0, 1, size=2.0)
        frost = glass(roughness=roughness, specular=NO_REFLECTION)
        rgba = stage.draw([back, pane], [wall, frost], images=images, samples=0, size=(96, 96)).rgba
        return float(rgba[24:72, 24:72, 0].std())

    clear = contrast(1.0, 0.0)
    assert contrast(1e-3, 0.5) == pytest.approx(clear, rel=0.05)
    assert contrast(0.05, 0.5) < clear
    assert contrast(1.0, 0.5) < 0.1 * clear
    assert contrast(1.0, 0.2) < contrast(0.3, 0.2) < contrast(0.3, 0.1) < clear


def test_dispersion_bends_blue_more_than_red(stage, props):
    """Left of its middle a ball shows the wall on the right, as far as light is not bent past its end."""
    wall = placed(props.quad, -3.0, 0)
    wall.world[0, 3] = 1.0
    ball = glass(
        volume=Volume(thickness_factor_m=2.0),
        ior=Ior(1.5),
        specular=NO_REFLECTION,
        dispersion=Dispersion(4.0),
    )
    things = [wall, placed(props.sphere, 0.0, 1)]
    frame = stage.draw(things, [paint((1, 1, 1)), ball], size=(128, 128), samples=0)
    red, green, blue = frame.rgba[64, :63, :3].sum(axis=0)
    assert red > green > blue > 0


def test_the_inputs_hold_what_arrives_and_their_colour_is_the_pictures(stage, props, slanted_sky):
    images = props.Images()
    back, wall = checks(props, images)
    things = [back, placed(props.sphere, 0.0, 1, size=0.8)]
    material = glass(roughness=0.4, volume=Volume(thickness_factor_m=1.0))
    frame = stage.draw(
        things,
        [wall, material],
        images=images,
        environment=slanted_sky,
        seen_from=props.camera(),
        with_inputs=True,
    )
    drawn = frame.inputs.material >= 0
    assert np.array_equal(frame.inputs.colour[drawn], frame.rgba[drawn][:, :3])
    is_glass = frame.inputs.material == 1
    assert is_glass.any() and frame.inputs.transmitted_radiance[is_glass].min() > 0.0
    assert (frame.inputs.transmission[is_glass] == 1.0).all()


def test_a_picture_without_transmission_is_never_captured(stage, props, furnace):
    veil = Material(pbr=MetallicRoughness((1, 0, 0, 0.5)), alpha_mode="BLEND")
    frame = stage.draw(props.sphere(), veil, environment=furnace)
    assert "captures" not in frame.passes
    assert {"opaque", "see-through", "background", "read"} <= set(frame.passes)
    assert frame.milliseconds == pytest.approx(
        sum(frame.passes[name] for name in ("opaque", "see-through", "background"))
    )


def test_glass_without_any_light_shows_what_shines_behind_it(stage, props):
    frame = stage.draw(
        [placed(props.quad, -1.0, 0), props.quad(material=1)],
        [paint((0.25, 0.5, 1.0)), glass(specular=NO_REFLECTION)],
    )
    assert frame.rgba[32, 32].tolist() == pytest.approx([0.25, 0.5, 1.0, 1.0], abs=1e-6)
