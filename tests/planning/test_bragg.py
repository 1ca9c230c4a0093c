"""Layers of Bragg mirrors: drawn where they are to be seen, and otherwise the plan says why not."""

from __future__ import annotations

from dataclasses import replace

import pytest

from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import SPECULAR_GLOSSINESS, Material, MetallicRoughness
from gltf_iri.material.texture import TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.unlit import Unlit
from gltf_iri.material.volume import Volume
from gltf_iri.planning.bragg import period_texel
from gltf_iri.planning.decide import plan_material, plan_materials
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.layers import plan_layers
from gltf_iri.planning.reach import Span

T = TextureInfo(0)
DIELECTRIC = MetallicRoughness(metallic_factor=0.0)
LAYER = MirrorLayer(period_min_nm=300.0, period_max_nm=500.0)
ONE = Bragg(1.0, layers=(LAYER,))
# Its first index is not that of its host.
BENDING = replace(LAYER, ior_1=1.2)


def made(bragg: Bragg = ONE, pbr: MetallicRoughness = DIELECTRIC, **others) -> Material:
    return Material(pbr=pbr, bragg=bragg, **others)


def test_layers_and_their_textures_are_drawn():
    effects = plan_material(made(replace(ONE, texture=T, period_texture=T)), 0).effects
    assert {Effect.BRAGG, Effect.BRAGG_TEXTURE, Effect.BRAGG_PERIOD_TEXTURE} <= set(effects)


@pytest.mark.parametrize(
    ("bragg", "reason"),
    [
        (Bragg(0.0, layers=(LAYER,)), "the factor is 0"),
        (Bragg(0.0, T, layers=(LAYER,)), "the factor is 0, and its texture can only multiply it"),
        (Bragg(1.0), "the list of layers is empty"),
    ],
)
def test_layers_that_are_not_to_be_seen_are_left_out_with_their_textures(bragg, reason):
    plan = plan_material(made(replace(bragg, period_texture=T)), 0)
    assert plan.skipped[Effect.BRAGG].startswith(reason)
    assert plan.skipped[Effect.BRAGG_PERIOD_TEXTURE].startswith(f"there are no layers: {reason}")
    assert not any("bragg" in effect.value for effect in plan.effects)


@pytest.mark.parametrize(
    "layer",
    [
        replace(LAYER, ior_1=1.5),  # a step at the layer itself
        replace(LAYER, fill=0.0),  # one slab of the second film
        replace(LAYER, ior_2=1.0),  # nothing, but where the base's interface was
    ],
)
def test_layers_stand_for_the_base_s_interface_whatever_they_reflect(layer):
    assert plan_material(made(replace(ONE, layers=(layer,))), 0).calls_for(Effect.BRAGG)


def test_a_least_period_counts_only_where_a_texture_leads_to_it():
    thinning = replace(ONE, layers=(replace(LAYER, period_min_nm=300.0, period_max_nm=0.0), LAYER))
    assert len(plan_layers(made(replace(thinning, period_texture=T))).layers) == 2
    assert len(plan_layers(made(thinning)).layers) == 1
    wide = replace(ONE, layers=(replace(LAYER, period_min_nm=1e6),))
    assert plan_material(made(wide), 0).calls_for(Effect.BRAGG)
    textured = plan_material(made(replace(wide, period_texture=T)), 0)
    assert "a period of 1e+06 nm is beyond" in textured.not_drawn["bragg"]


@pytest.mark.parametrize(
    ("material", "named"),
    [
        (made(iridescence=Iridescence()), "KHR_materials_iridescence"),
        (made(unread_extensions=(SPECULAR_GLOSSINESS,)), SPECULAR_GLOSSINESS),
        (made(replace(ONE, layers=(LAYER,) * 5)), "5 layers are more than the 4"),
        (made(replace(ONE, layers=(replace(LAYER, cells=1001),))), "1001 cells are more than the 1000"),
        (made(replace(ONE, layers=(replace(LAYER, ior_2=11.0),))), "an index of 11 is beyond"),
        (made(replace(ONE, layers=(replace(LAYER, ior_1=1.2), LAYER))), "only the last layer"),
        (made(replace(ONE, layers=(BENDING,)), MetallicRoughness()), "no metal"),
        (made(replace(ONE, layers=(BENDING,)), transmission=Transmission(0.5)), "no light from behind"),
    ],
)
def test_what_is_asked_for_and_not_drawn_is_admitted(material, named):
    plan = plan_material(material, 0)
    assert named in plan.not_drawn["bragg"]
    assert not plan.calls_for(Effect.BRAGG)


def test_a_first_index_that_nobody_names_is_that_of_the_host():
    named = replace(ONE, host_ior=1.4, layers=(replace(LAYER, ior_1=1.4),))
    unnamed = replace(ONE, host_ior=1.4, layers=(LAYER,))
    assert plan_layers(made(unnamed)) == plan_layers(made(named))


@pytest.mark.parametrize("volume", [None, Volume(thickness_factor_m=0.5)])
def test_layers_over_what_light_passes_are_drawn_with_all_that_it_does_inside(volume):
    material = made(transmission=Transmission(1.0), volume=volume, dispersion=Dispersion(1.0))
    plan = plan_material(material, 0)
    assert {Effect.BRAGG, Effect.TRANSMISSION} <= set(plan.effects)
    assert plan.calls_for(Effect.VOLUME) == plan.calls_for(Effect.DISPERSION) == (volume is not None)
    assert plan.layers.under == "base"


def test_a_transmission_that_lets_nothing_through_does_not_stop_layers_that_bend():
    through = replace(ONE, layers=(BENDING,))
    assert plan_material(made(through, transmission=Transmission(0.0)), 0).calls_for(Effect.BRAGG)


def test_unlit_layers_are_left_out():
    assert plan_material(made(unlit=Unlit()), 0).skipped[Effect.BRAGG] == "the material is unlit"


def test_textures_of_one_value_are_folded_into_factor_and_periods(images):
    texture = images.add([[(51, 102, 0, 0)] * 2])
    (plan,) = plan_materials(
        [made(replace(ONE, factor=0.5, texture=texture, period_texture=texture))], document=images
    )
    (layer,) = plan.material.bragg.layers
    assert plan.material.bragg.factor == pytest.approx(0.1)
    assert layer.period_min_nm == layer.period_max_nm == pytest.approx(300.0 + 0.4 * 200.0)
    assert plan.effects == (Effect.DIELECTRIC, Effect.BRAGG)


def test_periods_run_along_the_texels_that_there_are(images):
    texture = images.add([[(0, 51, 0, 0), (255, 102, 0, 0)]])
    assert period_texel(made(replace(ONE, period_texture=texture)), images) == Span(0.2, 0.4)
    assert period_texel(made(replace(ONE, period_texture=texture)), None) == Span(0.0, 1.0)
    assert period_texel(made(), images) == Span.at(1.0)


def test_layers_are_planned_wherever_they_are_drawn(images):
    # No texel is metal, which could not be drawn through a layer that bends light.
    pbr = MetallicRoughness(metallic_roughness_texture=images.add([[(0, 51, 0, 0), (0, 99, 0, 0)]]))
    material = made(replace(ONE, layers=(BENDING,)), pbr=pbr)
    (plan,) = plan_materials([material], document=images)
    assert plan.calls_for(Effect.BRAGG) and plan.layers is not None
    assert plan_material(material, 0).layers is None
