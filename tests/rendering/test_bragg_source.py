"""A shader of Bragg layers holds what its layers need, and one without layers nothing of them."""

from __future__ import annotations

import re
from dataclasses import replace

import pytest
from bragg_files import bragg_ball

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import NormalTextureInfo, OcclusionTextureInfo, TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.planning.decide import plan_material, plan_materials
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.permutation import permutation
from gltf_iri.planning.savings import pruned_defines
from gltf_iri.rendering.programs import surface_sources
from gltf_iri.rendering.switches import BRAGG_INPUTS, LAYER_INPUTS, SHADING_INPUTS
from gltf_iri.scene.load import load

LIT = (Effect.PUNCTUAL_LIGHTS, Effect.IMAGE_LIGHT)
T = TextureInfo(0)
LAYER = MirrorLayer(period_min_nm=300.0, period_max_nm=500.0, roughness=0.3)
BLACK = MetallicRoughness((0.0, 0.0, 0.0, 1.0), metallic_factor=0.0)
PAINT = MetallicRoughness(metallic_factor=0.0)
# The most that OpenGL 3.3 promises a program.
SAMPLERS_MAX = 16


def source(material, *, lights=LIT, switches=(), method=None):
    defines = permutation(plan_material(material, 0, method=method), (), lights) + switches
    return "".join(each.text for each in surface_sources(defines))


def words(material, **options):
    return set(re.findall(r"[A-Za-z_]\w*", re.sub(r"//.*|#define .*", "", source(material, **options))))


def layered(*layers, pbr=PAINT, host=1.0, **others):
    return Material(pbr=pbr, bragg=Bragg(1.0, None, host, layers), **others)


@pytest.mark.parametrize("lights", [(), LIT])
@pytest.mark.parametrize("switches", [(), (SHADING_INPUTS,), (LAYER_INPUTS,)])
@pytest.mark.parametrize(
    "material",
    [
        Material(),
        Material(bragg=Bragg(0.0, layers=(LAYER,))),
        Material(iridescence=Iridescence(1.0), bragg=Bragg(1.0, layers=(LAYER,))),
        Material(clearcoat=Clearcoat(1.0), sheen=Sheen((1.0, 1.0, 1.0)), anisotropy=Anisotropy(0.5)),
    ],
)
def test_without_layers_there_is_nothing_of_them_and_the_source_is_the_same(material, lights, switches):
    found = source(material, lights=lights, switches=switches)
    assert "bragg" not in found.lower()
    assert found == source(replace(material, bragg=None), lights=lights, switches=switches)


def test_only_the_third_inputs_name_layers_where_there_are_none():
    assert {word for word in words(Material(), switches=(BRAGG_INPUTS,)) if "bragg" in word} == {
        word for word in words(Material(), switches=(BRAGG_INPUTS,)) if word.startswith("out_bragg")
    }


def test_one_layer_over_nothing_needs_no_transmission():
    found = words(layered(LAYER, pbr=BLACK))
    assert {"layer_reflected", "layer_albedo"} <= found
    assert not [w for w in found if "passed" in w or w in ("SCATTERED_SLICE", "MIRRORED_SLICE")]


def test_each_part_comes_with_what_asks_for_it():
    one, two = words(layered(LAYER)), words(layered(LAYER, LAYER))
    assert "passed_bands" in words(layered(LAYER, LAYER, pbr=BLACK)) - words(layered(LAYER, pbr=BLACK))
    assert {"layers_passed", "passed_bands", "scattered_albedo"} <= one & two
    coated = words(layered(replace(LAYER, ior_1=1.4), host=1.4))
    assert "mirrored_by_coating" in coated - one
    metal = words(layered(LAYER, pbr=MetallicRoughness()))
    assert "metal_albedo" in metal - one and "u_bragg_metal_roughness" not in metal
    varying = MetallicRoughness(metallic_roughness_texture=T)
    assert "u_bragg_metal_roughness" in words(layered(LAYER, pbr=varying))
    assert "sample_bragg_period" not in one and "sample_bragg" not in one
    assert {"facet_weight", "u_dfg"} <= one
    assert "mirrored_radiance" not in words(layered(LAYER), lights=(Effect.PUNCTUAL_LIGHTS,))


def test_colours_in_place_of_bands_need_no_weights():
    assert "u_bragg_weights" in words(layered(LAYER))
    assert "u_bragg_weights" not in words(layered(LAYER), method="layers-rgb")


def test_the_truth_needs_no_tables_and_tables_need_no_spectra():
    direct = words(layered(LAYER), method="layers-single")
    assert {"stack_reflected", "spectral_rule"} <= direct and "u_bragg_tables" not in direct
    tables = words(layered(LAYER))
    assert "u_bragg_tables" in tables and not {"stack_reflected", "spectral_rule"} & tables


def test_layers_of_factor_1_leave_the_plain_surface_out():
    assert "light_on_base" not in words(layered(LAYER))
    half = replace(layered(LAYER), bragg=Bragg(0.5, layers=(LAYER,)))
    assert {"light_on_base", "light_on_layers"} <= words(half)


@pytest.mark.parametrize("lights", [(), LIT])
@pytest.mark.parametrize("volume", [None, Volume(0.5)])
def test_light_from_behind_brings_what_crosses_layers_once_and_no_interface_below_them(lights, volume):
    glass = layered(LAYER, LAYER, transmission=Transmission(1.0), volume=volume)
    found = words(glass, lights=lights)
    assert {"layers_entering", "passed_from_behind", "transmitted_radiance"} <= found
    assert not {"mix_lobes", "dielectric_layer", "transmitted_share", "light_on_base"} & found
    # Lights of a point draw caustics through a body.
    assert ("light_from_behind" in found) == (volume is None and bool(lights))
    half = replace(glass, bragg=replace(glass.bragg, factor=0.5))
    assert {"layers_entering", "mix_lobes"} <= words(half, lights=lights)
    black = replace(glass, pbr=BLACK)
    assert not {"layers_entering", "passed_from_behind"} & words(black, lights=lights)
    assert "layers_entering" not in words(layered(LAYER), lights=lights)


def test_what_belongs_to_the_surface_below_is_left_out_and_listed_as_pruned():
    material = layered(LAYER, specular=Specular(0.5, T), anisotropy=Anisotropy(0.5, texture=T))
    plan = plan_material(material, 0)
    gone = (Effect.SPECULAR, Effect.SPECULAR_TEXTURE, Effect.ANISOTROPY, Effect.ANISOTROPY_TEXTURE)
    assert all(plan.skipped[effect].startswith("Bragg layers stand everywhere") for effect in gone)
    seen = permutation(plan, (), LIT)
    assert {effect.define for effect in gone} <= set(pruned_defines([plan], seen))
    half = replace(material, bragg=Bragg(0.5, layers=(LAYER,)))
    assert set(gone) <= set(plan_material(half, 0).effects)


def test_every_texture_of_core_and_layers_fits_what_opengl_promises():
    pbr = MetallicRoughness(base_color_texture=T, metallic_roughness_texture=T)
    material = Material(
        pbr=pbr,
        normal_texture=NormalTextureInfo(0),
        occlusion_texture=OcclusionTextureInfo(0),
        emissive_texture=T,
        emissive_factor=(1.0, 1.0, 1.0),
        bragg=Bragg(1.0, T, 1.3, (replace(LAYER, ior_1=1.3),) * 4, T),
    )
    for method in (None, "layers-single"):
        found = source(material, method=method)
        assert len(re.findall(r"^\s*uniform (?:highp )?sampler", found, re.MULTILINE)) <= SAMPLERS_MAX


def test_layers_compile_under_every_kind_of_light(gl_context, tmp_path):
    from gltf_iri.rendering.programs import ProgramStore

    store = ProgramStore(gl_context)
    coated = load(bragg_ball(tmp_path, "coated")).materials
    many = layered(LAYER, LAYER, clearcoat=Clearcoat(1.0))
    glass = replace(many, transmission=Transmission(1.0), pbr=replace(PAINT, metallic_factor=0.5))
    for plan in (*plan_materials(coated), plan_material(many, 0), plan_material(glass, 0)):
        for lights in ((), LIT[:1], LIT[1:]):
            for switches in ((), (SHADING_INPUTS,), (LAYER_INPUTS,), (BRAGG_INPUTS,)):
                assert store.get(permutation(plan, (), lights) + switches)
    store.release()
