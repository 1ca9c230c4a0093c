"""The reach of a material holds every value that its textures can be sampled as, and no greater span."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from gltf_iri.colour.transfer import srgb_decode
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import TextureInfo, TextureTransform
from gltf_iri.planning.decide import plan_materials
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_reach import material_reach, vertex_colour_spans
from gltf_iri.planning.reach import Span
from gltf_iri.planning.texels import unread_images
from gltf_iri.reference.texture import Texels, sample
from gltf_iri.scene.load import load

FILM = Iridescence(factor=0.5, thickness_min_nm=600.0, thickness_max_nm=100.0)
PIXELS = arrays(np.uint8, st.tuples(st.integers(1, 4), st.integers(1, 4), st.just(4)))
FACTORS = st.floats(0.0, 1.0)
WRAPS = st.sampled_from([10497, 33071, 33648])

FULL = Span(0.0, 1.0)


def with_everything(texture, factor, tint):
    """Return a material whose every slot that a film meets reads `texture`."""
    return Material(
        pbr=MetallicRoughness((*tint, 1.0), texture, factor, factor, texture),
        specular=Specular(factor, texture, tuple(3.0 * channel for channel in tint), texture),
        ior=Ior(1.8),
        iridescence=Iridescence(factor, texture, 1.4, 600.0 * factor, 100.0, texture),
    )


def met(material, texels, uv, colour):
    """Return what a film meets at `uv`, as surface.glsl combines it; each (n,) or (n, 3)."""
    linear, srgb = sample(texels, uv, is_srgb=False), sample(texels, uv, is_srgb=True)
    pbr, film, specular = material.pbr, material.iridescence, material.specular
    share = linear[:, 1]
    tint = np.array(specular.color_factor) * srgb[:, :3]
    weight = (specular.factor * linear[:, 3])[:, None]
    return {
        "factor": film.factor * linear[:, 0],
        "thickness_nm": (1 - share) * film.thickness_min_nm + share * film.thickness_max_nm,
        "metallic": pbr.metallic_factor * linear[:, 2],
        "roughness": pbr.roughness_factor * linear[:, 1],
        "base_color": np.clip(np.array(pbr.base_color_factor[:3]) * colour * srgb[:, :3], 0.0, 1.0),
        "dielectric_f0": weight * np.minimum(Ior(1.8).f0 * tint, 1.0),
    }


@given(
    pixels=PIXELS,
    factor=FACTORS,
    tint=st.tuples(FACTORS, FACTORS, FACTORS),
    wraps=st.tuples(WRAPS, WRAPS),
    colour=st.tuples(*[st.floats(-0.5, 2.0)] * 3),
    seed=st.integers(0, 9),
)
def test_whatever_the_sampler_returns_lies_within(make_images, pixels, factor, tint, wraps, colour, seed):
    images = make_images()
    material = with_everything(images.add(pixels), factor, tint)
    reach = material_reach(material, images, tuple(Span.at(channel) for channel in colour))
    uv = np.random.default_rng(seed).uniform(-2.0, 2.0, (64, 2))
    for name, values in met(material, Texels(pixels, *wraps, 9729), uv, np.array(colour)).items():
        spans = getattr(reach, name)
        spans = (spans,) if isinstance(spans, Span) else spans
        for channel, span in zip(values.reshape(64, -1).T, spans, strict=True):
            # Interpolation between equal texels rounds.
            assert span.low - 1e-12 * (1 + span.high) <= channel.min(), name
            assert channel.max() <= span.high + 1e-12 * (1 + span.high), name


@given(pixels=PIXELS)
def test_both_ends_are_texels(make_images, pixels):
    images = make_images()
    reach = material_reach(Material(iridescence=Iridescence(1.0, images.add(pixels))), images)
    assert (reach.factor.low, reach.factor.high) == (pixels[..., 0].min() / 255, pixels[..., 0].max() / 255)


def test_an_image_larger_than_a_strip_is_looked_at_whole(images):
    pixels = np.full((1030, 1024, 4), 100, np.uint8)
    pixels[0, 0], pixels[-1, -1] = 7, (90, 101, 200, 255)
    texture = images.add(pixels)
    material = Material(
        iridescence=Iridescence(1.0, texture), pbr=MetallicRoughness(metallic_roughness_texture=texture)
    )
    reach = material_reach(material, images)
    assert reach.factor == Span(7 / 255, 100 / 255)
    assert reach.metallic == Span(7 / 255, 200 / 255)
    assert images.asked == [1]


def test_a_tint_is_cut_at_1_before_the_specular_weight_counts() -> None:
    specular = Specular(0.5, None, (40.0, 10.0, 1.0), None)
    reach = material_reach(Material(iridescence=FILM, specular=specular), None)
    assert [span.high for span in reach.dielectric_f0] == pytest.approx([0.5, 0.2, 0.02])


def test_colours_are_decoded_and_numbers_are_not(images):
    texture = images.add([[(51, 102, 153, 204)]])
    reach = material_reach(
        Material(
            iridescence=FILM,
            pbr=MetallicRoughness((1.0, 1.0, 0.5, 1.0), texture, metallic_roughness_texture=texture),
        ),
        images,
    )
    red, green, blue = srgb_decode(np.array([0.2, 0.4, 0.6]))
    assert [span.low for span in reach.base_color] == pytest.approx([red, green, 0.5 * blue], rel=1e-15)
    assert (reach.roughness, reach.metallic) == (Span.at(0.4), Span.at(0.6))


def test_a_minimum_above_the_maximum_is_no_error(images):
    pixels = [[(0, 51, 0, 0), (0, 204, 0, 0)]]
    reach = material_reach(
        Material(iridescence=Iridescence(1.0, None, 1.3, 600.0, 100.0, images.add(pixels))), images
    )
    assert (reach.thickness_nm.low, reach.thickness_nm.high) == pytest.approx((200.0, 500.0))


def test_without_textures_the_factors_hold_and_the_thickness_is_the_maximum(images):
    reach = material_reach(Material(iridescence=FILM), images)
    assert reach.thickness_nm == Span.at(100.0)
    assert reach.factor == Span.at(0.5)
    assert reach.base_color == (Span.at(1.0),) * 3
    assert [span.low for span in reach.dielectric_f0] == pytest.approx([0.04] * 3)


@pytest.mark.parametrize("place", [{"tex_coord": 2}, {"transform": TextureTransform(tex_coord=3)}])
def test_a_texture_that_the_shader_cannot_read_counts_as_none(images, place):
    texture = images.add(np.zeros((2, 2, 4)), **place)
    reach = material_reach(
        Material(iridescence=Iridescence(0.5, texture, 1.3, 600.0, 100.0, texture)), images
    )
    assert (reach.factor, reach.thickness_nm) == (Span.at(0.5), Span.at(100.0))
    assert images.asked == [0]


def test_a_material_without_film_has_no_reach(images):
    assert material_reach(Material(), images) is None


@pytest.mark.parametrize("is_there", [False, True])
def test_what_cannot_be_read_may_hold_anything(images, is_there):
    texture = images.add(None) if is_there else TextureInfo(0)
    material = Material(
        iridescence=Iridescence(1.0, texture), pbr=MetallicRoughness(base_color_texture=texture)
    )
    for _ in range(2):
        reach = material_reach(material, images if is_there else None)
        assert reach.factor == FULL
        assert reach.base_color == (FULL,) * 3
        assert not reach.is_metal_grey
    assert images.asked == ([1] if is_there else [])
    if is_there:
        (sentence,) = unread_images(images)
        assert "/images/0" in sentence


@pytest.mark.parametrize(
    ("factor", "texel", "vertices", "is_grey"),
    [
        ((0.5, 0.5, 0.5), (9, 9, 9), None, True),
        ((0.5, 0.5, 0.5), (9, 9, 8), None, False),
        ((0.5, 0.5, 0.4), (9, 9, 9), None, False),
        ((0.5, 0.5, 0.5), (9, 9, 9), (Span.at(0.5),) * 3, True),
        ((0.5, 0.5, 0.5), (9, 9, 9), (Span(0.5, 0.6),) * 3, False),
        ((0.5, 0.5, 0.5), (9, 9, 9), (Span.at(0.5), Span.at(0.5), Span.at(0.4)), False),
    ],
)
def test_a_metal_is_grey_only_where_all_that_paints_it_is(images, factor, texel, vertices, is_grey):
    texture = images.add([[(*texel, 7), (200, 200, 200, 0)]])
    material = Material(iridescence=FILM, pbr=MetallicRoughness((*factor, 1.0), texture))
    assert material_reach(material, images, vertices).is_metal_grey == is_grey


@pytest.mark.parametrize(
    ("tint", "texel", "is_grey"),
    [((2.0, 2.0, 2.0), (9, 9, 9), True), ((1.0, 1.0, 0.9), (9, 9, 9), False), ((1.0,) * 3, (9, 8, 9), False)],
)
def test_a_dielectric_is_grey_only_where_its_tint_is(images, tint, texel, is_grey):
    specular = Specular(0.5, images.add([[(1, 2, 3, 4)]]), tint, images.add([[(*texel, 7)]]))
    assert material_reach(Material(iridescence=FILM, specular=specular), images).is_dielectric_grey == is_grey


def test_colours_of_vertices_are_gathered_over_all_primitives_of_a_material():
    def primitive(material, colours):
        given = None if colours is None else np.array(colours, np.float32)
        return SimpleNamespace(material=material, colours=given)

    scene = SimpleNamespace(
        primitives=[
            primitive(0, [(0.25, 0.5, 1.0, 1.0), (0.5, 0.5, 2.0, 0.0)]),
            primitive(1, None),
            primitive(0, [(0.125, 0.75, 1.0, 1.0)]),
            primitive(2, [(0.5, 0.5, 0.5, 1.0)]),
            primitive(2, None),
        ]
    )
    assert vertex_colour_spans(scene) == {
        0: (Span(0.125, 0.5), Span(0.5, 0.75), Span(1.0, 2.0)),
        1: (Span.at(1.0),) * 3,
        2: (Span(0.5, 1.0),) * 3,
    }


LAMP_NM = {
    "IridescenceLampTransmissionIridescence": (395.0, 404.7),
    "IridescenceLampIridescence": (485.0, 514.1),
}


def test_real_films_meet_less_than_the_schema_allows(shared_dir):
    folder = shared_dir / "assets" / "iridescence"
    lamp = load(folder / "IridescenceLamp" / "glTF" / "IridescenceLamp.gltf")
    met = {m.name: material_reach(m, lamp.document) for m in lamp.materials if m.iridescence}
    for name, (low_nm, high_nm) in LAMP_NM.items():
        assert (met[name].thickness_nm.low, met[name].thickness_nm.high) == pytest.approx(
            (low_nm, high_nm), abs=0.1
        )
        assert met[name].roughness.high < 1.0
        assert met[name].is_dielectric_grey and not met[name].is_metal_grey
    suzanne = load(folder / "IridescenceSuzanne" / "glTF" / "IridescenceSuzanne.gltf")
    reaches = [material_reach(m, suzanne.document) for m in suzanne.materials]
    assert [reach.metallic for reach in reaches] == [Span.at(0.0), Span.at(1.0), Span.at(0.0)]
    assert (reaches[2].thickness_nm.low, reaches[2].thickness_nm.high) == pytest.approx(
        (242.4, 568.6), abs=0.1
    )


def test_metallic_spheres_of_index_1_have_no_film(shared_dir):
    path = shared_dir / "assets" / "iridescence" / "IridescenceMetallicSpheres" / "glTF"
    model = load(path / "IridescenceMetallicSpheres.gltf")
    plans = plan_materials(model.materials, document=model.document)
    films = [(plan, m.iridescence) for plan, m in zip(plans, model.materials, strict=True) if m.iridescence]
    assert len(films) == 343
    for plan, film in films:
        assert (plan.method is None) == (film.film_ior == 1.0)
        assert not plan.calls_for(Effect.DIELECTRIC)
        assert plan.grey <= {"metal"}


def test_a_thickness_texture_spreads_by_its_share_of_the_range(images):
    texture = images.add([[(0, 0, 0, 0), (0, 255, 0, 0)], [(0, 255, 0, 0), (0, 0, 0, 0)]])
    film = Iridescence(factor=1.0, thickness_min_nm=100.0, thickness_max_nm=500.0, thickness_texture=texture)
    reach = material_reach(Material(iridescence=film), images)
    assert reach.spread_nm.high == pytest.approx(200.0)
    assert material_reach(Material(iridescence=film), None).spread_nm == Span(200.0, 200.0)
    flat = replace(film, thickness_texture=images.add([[(0, 90, 0, 0)]]))
    assert material_reach(Material(iridescence=flat), images).spread_nm == Span(0.0, 0.0)
