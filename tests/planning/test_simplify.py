"""What is the same in every texel is in the factor: with its reason, and with the number that is sampled."""

from __future__ import annotations

from dataclasses import fields, is_dataclass, replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.colour.transfer import srgb_decode
from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.interface import SAMPLERS
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import NormalTextureInfo, OcclusionTextureInfo, TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.unlit import Unlit
from gltf_iri.material.volume import Volume
from gltf_iri.planning.decide import plan_material, plan_materials
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_reach import material_reach
from gltf_iri.planning.reach import Span
from gltf_iri.planning.simplify import simplified

RGBA = (51, 102, 153, 204)
R, G, B, A = (value / 255 for value in RGBA)
SRGB = tuple(srgb_decode(np.array([R, G, B])).tolist())
DIELECTRIC = MetallicRoughness(metallic_factor=0.0)
FILM = Iridescence(factor=0.5, thickness_min_nm=100.0, thickness_max_nm=600.0)


def textured(texture):
    """Return a material with every slot of every part filled but the layers', which a film excludes."""
    return Material(
        pbr=MetallicRoughness((0.5, 0.5, 1.0, 0.5), texture, 0.5, 0.5, texture),
        normal_texture=NormalTextureInfo(texture.texture),
        occlusion_texture=OcclusionTextureInfo(texture.texture),
        emissive_texture=texture,
        emissive_factor=(0.5, 0.5, 0.5),
        alpha_mode="BLEND",
        specular=Specular(0.5, texture, (2.0, 1.0, 0.5), texture),
        iridescence=replace(FILM, texture=texture, thickness_texture=texture),
        transmission=Transmission(0.5, texture),
        volume=Volume(2.0, texture),
        clearcoat=Clearcoat(0.5, texture, 0.5, texture, NormalTextureInfo(texture.texture)),
        sheen=Sheen((0.5, 0.5, 0.5), texture, 0.5, texture),
        anisotropy=Anisotropy(0.5, 0.25, texture),
    )


def slots_of(material):
    return {sampler.slot for sampler in SAMPLERS if sampler.read(material) is not None}


def test_every_texture_of_one_value_goes_but_normals_and_occlusion(images):
    drawn, folded = simplified(textured(images.add([[RGBA] * 3] * 2)), images)
    assert slots_of(drawn) == {"normal", "occlusion", "clearcoat_normal"}
    assert len(folded) == sum(not sampler.slot.startswith("bragg") for sampler in SAMPLERS) - 3
    assert folded[Effect.TRANSMISSION_TEXTURE] == "every texel is 0.2, which is in the factor now"
    assert images.asked == [1]


def test_factors_hold_what_the_shader_would_have_sampled(images):
    drawn, _ = simplified(textured(images.add([[RGBA]])), images)
    assert drawn.pbr.base_color_factor == (0.5 * SRGB[0], 0.5 * SRGB[1], SRGB[2], 0.5 * A)
    assert (drawn.pbr.roughness_factor, drawn.pbr.metallic_factor) == (0.5 * G, 0.5 * B)
    assert drawn.emissive_factor == tuple(0.5 * channel for channel in SRGB)
    assert drawn.specular == Specular(0.5 * A, None, (2.0 * SRGB[0], SRGB[1], 0.5 * SRGB[2]))
    assert (drawn.iridescence.factor, drawn.transmission.factor) == (0.5 * R, 0.5 * R)
    assert drawn.iridescence.thickness_min_nm == drawn.iridescence.thickness_max_nm == pytest.approx(300.0)
    assert drawn.volume.thickness_factor_m == 2.0 * G
    assert (drawn.clearcoat.factor, drawn.clearcoat.roughness_factor) == (0.5 * R, 0.5 * G)
    assert drawn.sheen == Sheen(tuple(0.5 * channel for channel in SRGB), None, 0.5 * A)
    assert drawn.anisotropy.strength == 0.5 * B
    turn_rad = np.arctan2(2 * G - 1, 2 * R - 1)
    assert drawn.anisotropy.rotation_rad == pytest.approx(0.25 + turn_rad)


@given(texels=st.lists(st.tuples(*[st.integers(0, 255)] * 4), min_size=1, max_size=4))
def test_folding_changes_no_reach(make_images, texels):
    images = make_images()
    material = replace(textured(images.add([texels])), alpha_mode="OPAQUE")
    drawn, folded = simplified(material, images)
    before, after = material_reach(material, images), material_reach(drawn, images)
    for field in fields(before):
        found, expected = getattr(after, field.name), getattr(before, field.name)
        if isinstance(found, bool):
            assert found >= expected  # black is grey, whatever tints it
            continue
        for one, other in zip(spans_of(found), spans_of(expected), strict=True):
            assert (one.low, one.high) == pytest.approx((other.low, other.high), rel=1e-14)
    assert set(folded).isdisjoint(plan_material(drawn, 0, folded=folded).effects)


def spans_of(value):
    if isinstance(value, Span):
        return [value]
    return list(value) if isinstance(value, tuple) else [Span.at(value)]


def test_textures_that_vary_stay(images):
    material = textured(images.add([[(0, 1, 2, 3), (255, 254, 253, 252)]]))
    assert simplified(material, images) == (material, {})


def test_only_the_channels_that_are_read_have_to_be_one_value(images):
    texture = images.add([[(51, 7, 8, 9), (51, 200, 201, 202)]])
    material = Material(
        pbr=DIELECTRIC,
        iridescence=replace(FILM, texture=texture),
        transmission=Transmission(1.0, texture),
        clearcoat=Clearcoat(1.0, None, 1.0, texture),
    )
    assert slots_of(simplified(material, images)[0]) == {"clearcoat_roughness"}


@pytest.mark.parametrize(("mode", "stays"), [("OPAQUE", False), ("MASK", True), ("BLEND", True)])
def test_alpha_counts_only_where_it_is_read(images, mode, stays):
    texture = images.add([[(51, 102, 153, 0), (51, 102, 153, 255)]])
    material = Material(pbr=MetallicRoughness(base_color_texture=texture), alpha_mode=mode)
    drawn, _ = simplified(material, images)
    assert (drawn.pbr.base_color_texture is not None) == stays
    if not stays:
        assert drawn.pbr.base_color_factor == (*SRGB, 1.0)


def test_occlusion_that_occludes_nothing_goes(images):
    white = OcclusionTextureInfo(images.add([[(255, 1, 2, 3)]]).texture)
    drawn, folded = simplified(Material(occlusion_texture=white), images)
    assert drawn.occlusion_texture is None
    assert folded == {Effect.OCCLUSION_TEXTURE: "every texel is 1, which changes nothing"}


def test_textures_that_nothing_reads_are_not_decoded(images):
    texture = images.add([[RGBA]])
    metal = Material(specular=Specular(0.5, texture), iridescence=Iridescence(0.0, texture))
    unlit = replace(textured(images.add([[RGBA]])), unlit=Unlit())
    assert simplified(metal, images) == (metal, {})
    assert images.asked == [0, 0]
    assert set(simplified(unlit, images)[1]) == {Effect.BASE_COLOR_TEXTURE}


@pytest.mark.parametrize("where", [{"tex_coord": 2}, None])
def test_textures_that_cannot_be_read_stay(images, where):
    texture = images.add(None) if where is None else images.add([[RGBA]], **where)
    material = Material(iridescence=replace(FILM, texture=texture))
    assert simplified(material, images) == (material, {})


@pytest.mark.parametrize(
    ("blue", "factor", "gone", "reason"),
    [
        (0, 0.5, Effect.METAL, "every texel's metalness is 0"),
        (255, 1.0, Effect.DIELECTRIC, "the metallic factor is 1 and every texel's metalness too"),
        (255, 0.5, None, ""),
        (254, 1.0, None, ""),
    ],
)
@pytest.mark.parametrize("greens", [(9, 200), (9, 9)])
def test_a_metalness_of_0_or_1_in_every_texel_leaves_one_lobe(images, blue, factor, gone, reason, greens):
    texture = images.add([[(0, green, blue, 0) for green in greens]])
    material = Material(
        pbr=MetallicRoughness(metallic_factor=factor, metallic_roughness_texture=texture),
        specular=Specular(0.5),
    )
    (plan,) = plan_materials([material], document=images)
    for lobe in (Effect.METAL, Effect.DIELECTRIC):
        assert plan.calls_for(lobe) == (lobe is not gone)
    assert plan.calls_for(Effect.METALLIC_ROUGHNESS_TEXTURE) == (greens[0] != greens[1])
    if gone is not None:
        assert plan.skipped[gone] == reason
    assert plan.calls_for(Effect.SPECULAR) == (gone is not Effect.DIELECTRIC)


def test_a_black_factor_texture_leaves_the_film_out(images):
    (plan,) = plan_materials(
        [Material(iridescence=replace(FILM, texture=images.add([[(0, 9, 9, 9)]])))], document=images
    )
    assert plan.skipped[Effect.IRIDESCENCE] == "the factor is 0"
    assert plan.skipped[Effect.IRIDESCENCE_TEXTURE] == "every texel is 0, which is in the factor now"
    assert plan.method is None


def test_a_thickness_of_0_in_every_texel_leaves_the_film_out(images):
    film = replace(FILM, thickness_min_nm=0.0, thickness_texture=images.add([[(9, 0, 9, 9), (8, 0, 8, 8)]]))
    (plan,) = plan_materials([Material(iridescence=film)], document=images)
    assert plan.skipped[Effect.IRIDESCENCE] == "the film's thickness is 0"


@pytest.mark.parametrize("roughnesses", [(9, 9), (9, 200)])
def test_a_film_of_the_bases_index_in_every_texel_is_left_out(images, roughnesses):
    texture = images.add([[(0, green, 0, 0) for green in roughnesses]])
    material = Material(
        pbr=MetallicRoughness(metallic_roughness_texture=texture),
        specular=Specular(1.0, images.add([[(0, 0, 0, 255)]])),
        iridescence=replace(FILM, film_ior=1.5),
    )
    (plan,) = plan_materials([material], document=images)
    assert plan.skipped[Effect.IRIDESCENCE] == "the film's index is the base's, 1.5"
    (unknown,) = plan_materials([material])
    assert unknown.calls_for(Effect.IRIDESCENCE)


def test_many_materials_with_one_image_look_at_it_twice(images):
    texture = images.add([[RGBA, (1, 2, 3, 4)]])
    plans = plan_materials([textured(texture) for _ in range(40)], document=images)
    assert images.asked == [2]  # for its bounds and, in the thickness' channel, for its spread
    assert len(plans) == 40


def test_every_part_of_a_simplified_material_is_a_legal_one(images):
    def numbers(value):
        if is_dataclass(value):
            return [n for field in fields(value) for n in numbers(getattr(value, field.name))]
        return [value] if isinstance(value, float) else []

    drawn, _ = simplified(textured(images.add([[(255, 0, 128, 1)]])), images)
    assert all(np.isfinite(n) or n == np.inf for n in numbers(drawn))
    assert isinstance(drawn.pbr.base_color_texture, TextureInfo | None)
