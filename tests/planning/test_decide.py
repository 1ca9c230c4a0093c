"""The plan: nothing is left out without its reason, and nothing is drawn that changes nothing."""

from __future__ import annotations

from dataclasses import replace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.errors import UsageError
from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.emissive_strength import EmissiveStrength
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import NormalTextureInfo, OcclusionTextureInfo, TextureInfo
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.unlit import Unlit
from gltf_iri.material.volume import Volume
from gltf_iri.planning.decide import plan_material, plan_materials
from gltf_iri.planning.effects import MATERIAL_EFFECTS, Effect
from gltf_iri.planning.method import METHODS

T = TextureInfo(0)
DIELECTRIC = MetallicRoughness(metallic_factor=0.0)
FILM = Iridescence(factor=1.0)

FACTORS = st.sampled_from([0.0, 0.5, 1.0])
TEXTURES = st.sampled_from([None, T, TextureInfo(1, tex_coord=2)])
COLOURS = st.sampled_from([(0.0, 0.0, 0.0), (0.5, 1.0, 0.0)])
MATERIALS = st.builds(
    Material,
    pbr=st.builds(
        MetallicRoughness,
        base_color_texture=TEXTURES,
        metallic_factor=FACTORS,
        roughness_factor=FACTORS,
        metallic_roughness_texture=TEXTURES,
    ),
    normal_texture=st.none() | st.builds(NormalTextureInfo, st.just(0), scale=FACTORS),
    occlusion_texture=st.none() | st.builds(OcclusionTextureInfo, st.just(0), strength=FACTORS),
    emissive_texture=TEXTURES,
    emissive_factor=COLOURS,
    alpha_mode=st.sampled_from(["OPAQUE", "MASK", "BLEND"]),
    alpha_cutoff=FACTORS,
    double_sided=st.booleans(),
    ior=st.none() | st.builds(Ior, st.sampled_from([0.0, 1.3, 1.5])),
    specular=st.none() | st.builds(Specular, FACTORS, TEXTURES, COLOURS, TEXTURES),
    iridescence=st.none()
    | st.builds(Iridescence, FACTORS, TEXTURES, st.sampled_from([1.0, 1.3, 1.5]), FACTORS, FACTORS, TEXTURES),
    emissive_strength=st.none() | st.builds(EmissiveStrength, FACTORS),
    unlit=st.none() | st.just(Unlit()),
    transmission=st.none() | st.builds(Transmission, FACTORS, TEXTURES),
    volume=st.none() | st.builds(Volume, FACTORS),
    clearcoat=st.none() | st.builds(Clearcoat, FACTORS),
    unread_extensions=st.sampled_from([(), ("KHR_materials_diffuse_transmission",)]),
)
METHOD_NAMES = st.none() | st.sampled_from([m.name for m in METHODS.values() if m.domain == "film"])


def skipped(material: Material, effect: Effect, method: str | None = None) -> str:
    return plan_material(material, 0, method=method).skipped[effect]


def has_film(material: Material, method: str | None = None) -> bool:
    return plan_material(material, 0, method=method).calls_for(Effect.IRIDESCENCE)


@given(MATERIALS, METHOD_NAMES)
def test_every_effect_is_simulated_or_skipped_or_admitted_exactly_once(material, method):
    plan = plan_material(material, 0, method=method)
    admitted = [effect for effect in Effect if effect.value in plan.not_drawn]
    told = [*plan.effects, *plan.skipped, *admitted]
    assert sorted(told, key=MATERIAL_EFFECTS.index) == list(MATERIAL_EFFECTS)
    assert all(plan.skipped.values()) and all(plan.not_drawn.values())
    assert plan.absent <= set(plan.skipped)


@given(MATERIALS, METHOD_NAMES)
def test_effects_stand_in_the_order_of_the_shader(material, method):
    effects = plan_material(material, 0, method=method).effects
    assert list(effects) == [effect for effect in Effect if effect in effects]


@given(MATERIALS, METHOD_NAMES)
def test_a_method_is_chosen_exactly_where_there_is_a_film(material, method):
    plan = plan_material(material, 0, method=method)
    assert plan.method == ((method or "khr-guarded") if plan.calls_for(Effect.IRIDESCENCE) else None)
    assert plan.method_reason


@given(MATERIALS, METHOD_NAMES)
def test_textures_of_a_film_need_the_film(material, method):
    plan = plan_material(material, 0, method=method)
    if not plan.calls_for(Effect.IRIDESCENCE):
        assert not plan.calls_for(Effect.IRIDESCENCE_TEXTURE)
        assert not plan.calls_for(Effect.IRIDESCENCE_THICKNESS_TEXTURE)


@given(MATERIALS, METHOD_NAMES)
def test_a_lit_material_has_a_lobe_and_an_unlit_one_has_none(material, method):
    lobes = {Effect.METAL, Effect.DIELECTRIC} & set(plan_material(material, 0, method=method).effects)
    assert bool(lobes) == (material.unlit is None)


@given(MATERIALS, METHOD_NAMES)
def test_only_what_the_file_mentions_is_more_than_absent(material, method):
    without = replace(material, iridescence=None)
    plan = plan_material(without, 0, method=method)
    for effect in (Effect.IRIDESCENCE, Effect.IRIDESCENCE_TEXTURE, Effect.IRIDESCENCE_THICKNESS_TEXTURE):
        assert effect in plan.absent
    assert not [effect for effect in plan.effects if "iridescence" in effect.value]


def test_the_default_material_is_a_rough_metal_and_nothing_else():
    plan = plan_material(Material(), -1)
    assert plan.effects == (Effect.METAL,)
    assert plan.not_drawn == {}
    assert plan.method is None


@pytest.mark.parametrize("film", [FILM, replace(FILM, film_ior=1.0), replace(FILM, thickness_max_nm=0.0)])
@pytest.mark.parametrize("method", [None, "khr", "khr-guarded", "spectral"])
def test_a_film_of_factor_0_is_left_out_whatever_the_method(film, method):
    assert (
        skipped(Material(iridescence=replace(film, factor=0.0)), Effect.IRIDESCENCE, method)
        == "the factor is 0"
    )


def test_a_factor_texture_cannot_raise_a_factor_of_0():
    reason = skipped(Material(iridescence=Iridescence(texture=T)), Effect.IRIDESCENCE)
    assert reason == "the factor is 0, and its texture can only multiply it"


IDLE_FILMS = [
    (Material(iridescence=replace(FILM, film_ior=1.0)), "the film's index is the outside's, 1"),
    (Material(iridescence=replace(FILM, thickness_max_nm=0.0)), "the film's thickness is 0"),
    (
        Material(iridescence=replace(FILM, thickness_min_nm=0.0, thickness_max_nm=0.0, thickness_texture=T)),
        "the film's thickness is 0",
    ),
    (
        Material(pbr=DIELECTRIC, iridescence=replace(FILM, film_ior=1.5)),
        "the film's index is the base's, 1.5",
    ),
    (
        Material(pbr=DIELECTRIC, ior=Ior(1.3), specular=Specular(), iridescence=FILM),
        "the film's index is the base's, 1.3",
    ),
]


@pytest.mark.parametrize(("material", "reason"), IDLE_FILMS, ids=[reason for _, reason in IDLE_FILMS])
def test_a_film_that_changes_nothing_is_left_out_except_by_the_letter_of_the_text(material, reason):
    for method in (None, "khr-guarded", "spectral"):
        assert skipped(material, Effect.IRIDESCENCE, method) == reason
    plan = plan_material(material, 0, method="khr")
    assert plan.calls_for(Effect.IRIDESCENCE)
    assert reason in plan.method_reason


@pytest.mark.parametrize(
    "material",
    [
        Material(pbr=MetallicRoughness(metallic_factor=0.5), iridescence=replace(FILM, film_ior=1.5)),
        Material(pbr=DIELECTRIC, specular=Specular(0.5), iridescence=replace(FILM, film_ior=1.5)),
        Material(
            pbr=DIELECTRIC,
            specular=Specular(color_factor=(1.0, 0.5, 0.5)),
            iridescence=replace(FILM, film_ior=1.5),
        ),
        Material(pbr=DIELECTRIC, ior=Ior(1.6), iridescence=replace(FILM, film_ior=1.5)),
    ],
    ids=["partly metal", "weighted reflection", "tinted reflection", "other base"],
)
def test_a_film_of_index_1_5_over_another_base_than_glass_is_kept(material):
    assert has_film(material)


def test_a_film_that_is_thick_only_where_its_texture_is_0_is_kept():
    film = replace(FILM, thickness_min_nm=300.0, thickness_max_nm=0.0)
    assert has_film(Material(iridescence=replace(film, thickness_texture=T)))
    assert not has_film(Material(iridescence=film))


def test_without_thickness_texture_the_reason_names_the_thickness_that_holds():
    reason = skipped(Material(iridescence=FILM), Effect.IRIDESCENCE_THICKNESS_TEXTURE)
    assert reason == "no thickness texture: the maximum, 400 nm, holds everywhere"


def test_a_thickness_texture_between_equal_ends_is_left_out():
    film = replace(FILM, thickness_min_nm=400.0, thickness_texture=T)
    reason = skipped(Material(iridescence=film), Effect.IRIDESCENCE_THICKNESS_TEXTURE)
    assert reason == "minimum and maximum are both 400 nm, so it changes nothing"


def test_an_unlit_material_has_no_film_and_the_exclusion_is_named():
    plan = plan_material(Material(unlit=Unlit(), iridescence=FILM, transmission=Transmission(1.0)), 0)
    assert plan.effects == (Effect.UNLIT,)
    assert "KHR_materials_iridescence excludes" in plan.skipped[Effect.IRIDESCENCE]
    assert plan.skipped[Effect.METAL] == plan.skipped[Effect.TRANSMISSION] == "the material is unlit"


def test_specular_glossiness_is_admitted_and_its_exclusion_named():
    plan = plan_material(
        Material(iridescence=FILM, unread_extensions=("KHR_materials_pbrSpecularGlossiness",)), 0
    )
    assert "KHR_materials_iridescence excludes it" in plan.not_drawn["KHR_materials_pbrSpecularGlossiness"]


@pytest.mark.parametrize(
    ("material", "effect", "reason"),
    [
        (Material(), Effect.DIELECTRIC, "the metallic factor is 1 and no texture lowers it"),
        (Material(pbr=DIELECTRIC), Effect.METAL, "the metallic factor is 0"),
        (Material(emissive_texture=T), Effect.EMISSION, "the emissive factor is 0"),
        (Material(emissive_texture=T), Effect.EMISSIVE_TEXTURE, "the emissive factor is 0"),
        (
            Material(emissive_factor=(1.0, 1.0, 1.0), emissive_strength=EmissiveStrength(0.0)),
            Effect.EMISSION,
            "the emissive strength is 0",
        ),
        (Material(normal_texture=NormalTextureInfo(0, scale=0.0)), Effect.NORMAL_TEXTURE, "its scale is 0"),
        (
            Material(occlusion_texture=OcclusionTextureInfo(0, strength=0.0)),
            Effect.OCCLUSION_TEXTURE,
            "its strength is 0",
        ),
        (
            Material(alpha_mode="MASK", alpha_cutoff=0.0),
            Effect.ALPHA_MASK,
            "the cutoff is 0, which no alpha falls below",
        ),
        (
            Material(pbr=DIELECTRIC, specular=Specular()),
            Effect.SPECULAR,
            "weight 1 and a white tint change nothing",
        ),
        (
            Material(specular=Specular(0.5)),
            Effect.SPECULAR,
            "only dielectrics read it, and the metallic factor is 1 and no texture lowers it",
        ),
        (
            Material(pbr=DIELECTRIC, specular=Specular(0.0, T)),
            Effect.SPECULAR_TEXTURE,
            "the specular factor is 0",
        ),
        (
            Material(pbr=DIELECTRIC, specular=Specular(color_factor=(0.0, 0.0, 0.0), color_texture=T)),
            Effect.SPECULAR_COLOR_TEXTURE,
            "the specular color factor is 0",
        ),
        (
            Material(transmission=Transmission(1.0)),
            Effect.TRANSMISSION,
            "only dielectrics transmit, and the metallic factor is 1 and no texture lowers it",
        ),
        (
            Material(pbr=DIELECTRIC, transmission=Transmission()),
            Effect.TRANSMISSION,
            "the transmission factor is 0",
        ),
        (Material(clearcoat=Clearcoat()), Effect.CLEARCOAT, "the clearcoat factor is 0"),
        (
            Material(pbr=DIELECTRIC, transmission=Transmission(1.0), volume=Volume()),
            Effect.VOLUME,
            "the thickness is 0: a thin wall has no inside",
        ),
    ],
)
def test_what_changes_nothing_is_left_out_with_its_reason(material, effect, reason):
    plan = plan_material(material, 0)
    assert plan.skipped[effect] == reason
    assert effect not in plan.absent or effect in (Effect.DIELECTRIC, Effect.METAL)


def test_a_metallic_texture_keeps_both_lobes():
    plan = plan_material(Material(pbr=MetallicRoughness(metallic_roughness_texture=T)), 0)
    assert plan.calls_for(Effect.METAL)
    assert plan.calls_for(Effect.DIELECTRIC)


def test_layers_that_change_the_picture_are_called_for():
    material = Material(
        pbr=DIELECTRIC,
        transmission=Transmission(1.0),
        volume=Volume(1.0),
        dispersion=Dispersion(1.0),
        clearcoat=Clearcoat(1.0),
        sheen=Sheen((1.0, 1.0, 1.0)),
        anisotropy=Anisotropy(1.0),
    )
    plan = plan_material(material, 0)
    called_for = {"transmission", "volume", "dispersion", "clearcoat", "sheen", "anisotropy"}
    assert called_for <= {effect.value for effect in plan.effects}
    assert plan.not_drawn == {}


def test_an_extension_without_rows_is_admitted_as_not_drawn():
    plan = plan_material(Material(unread_extensions=("KHR_materials_diffuse_transmission",)), 0)
    assert set(plan.not_drawn) == {"KHR_materials_diffuse_transmission"}


def test_a_texture_on_a_third_uv_set_is_admitted_as_not_drawn():
    material = Material(iridescence=replace(FILM, thickness_texture=TextureInfo(0, tex_coord=2)))
    assert "UV set 2" in plan_material(material, 0).not_drawn["iridescence-thickness-texture"]


@pytest.mark.parametrize(
    ("material", "method", "layering"),
    [
        (Material(iridescence=FILM), "khr", "core"),
        (Material(iridescence=FILM), "spectral", "core"),
        (Material(iridescence=FILM), None, "specular"),
        (Material(iridescence=FILM, specular=Specular()), "khr", "specular"),
        (Material(), None, "core"),
        (Material(specular=Specular()), None, "specular"),
    ],
)
def test_the_layering_follows_the_extension_and_the_guarded_method_closes_its_gap(material, method, layering):
    assert plan_material(material, 0, method=method).layering == layering


def test_an_unknown_method_is_a_wrong_call():
    with pytest.raises(UsageError, match="no method 'airy'"):
        plan_materials([Material()], method="airy")
