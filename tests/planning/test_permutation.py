"""Permutations: the key is the ordered defines, each of them known, none of them idle."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import NormalTextureInfo, OcclusionTextureInfo
from gltf_iri.material.unlit import Unlit
from gltf_iri.planning.decide import plan_material
from gltf_iri.planning.effects import SURROUNDINGS, Effect
from gltf_iri.planning.method import METHODS
from gltf_iri.planning.permutation import permutation, plan_scene_effects, primitive_effects
from gltf_iri.rendering.switches import SWITCHES

ALL = frozenset(SURROUNDINGS)
FILM = Material(pbr=MetallicRoughness(metallic_factor=0.0), iridescence=Iridescence(factor=1.0))


def defines(material: Material, surroundings=ALL, method=None):
    return permutation(plan_material(material, 0, method=method), surroundings, ())


@given(
    st.builds(
        Material,
        iridescence=st.none() | st.just(Iridescence(factor=1.0)),
        specular=st.none() | st.just(Specular(0.5)),
        pbr=st.builds(MetallicRoughness, metallic_factor=st.sampled_from([0.0, 0.5, 1.0])),
        unlit=st.none() | st.just(Unlit()),
    ),
    st.frozensets(st.sampled_from(SURROUNDINGS)),
    st.sampled_from([m.name for m in METHODS.values() if m.domain == "film" and m.glsl_function]),
)
def test_defines_are_known_switches_in_a_fixed_order_without_repeats(material, surroundings, method):
    key = defines(material, surroundings, method)
    assert set(key) <= SWITCHES
    assert len(set(key)) == len(key)
    order = [effect.define for effect in Effect]
    effects = [define for define in key if define.startswith("HAS_")]
    assert effects == sorted(effects, key=order.index)
    assert key[: len(effects)] == tuple(effects)


def test_a_material_without_film_names_neither_iridescence_nor_a_method():
    for material in (Material(), Material(iridescence=Iridescence()), Material(specular=Specular(0.5))):
        key = defines(material)
        assert not [define for define in key if "IRIDESCENCE" in define or define.startswith("METHOD_")]


@pytest.mark.parametrize(
    ("method", "tail"),
    [("khr", ("METHOD_KHR",)), ("khr-guarded", ("METHOD_KHR_GUARDED", "LAYERING_SPECULAR"))],
)
def test_a_film_brings_its_method_and_layering_last(method, tail):
    assert defines(FILM, (), method) == ("HAS_DIELECTRIC", "HAS_IRIDESCENCE", *tail)


def test_a_metal_has_no_dielectric_layering():
    assert "LAYERING_SPECULAR" not in defines(Material(iridescence=Iridescence(factor=1.0)))


def test_an_unlit_material_sees_no_light():
    assert defines(Material(unlit=Unlit(), specular=Specular())) == ("HAS_VERTEX_COLOR", "HAS_UNLIT")


def test_tangents_count_only_under_a_normal_map():
    assert "HAS_TANGENTS" not in defines(Material())
    assert "HAS_TANGENTS" in defines(Material(normal_texture=NormalTextureInfo(0)))


def test_occlusion_counts_only_under_image_light():
    occluded = Material(occlusion_texture=OcclusionTextureInfo(0))
    assert "HAS_OCCLUSION_TEXTURE" in defines(occluded)
    assert "HAS_OCCLUSION_TEXTURE" not in defines(occluded, {Effect.PUNCTUAL_LIGHTS})


def light(intensity=1.0, colour=(1.0, 1.0, 1.0)):
    return SimpleNamespace(intensity=intensity, colour=colour)


@pytest.mark.parametrize(
    ("lights", "radiance", "expected"),
    [
        ([], None, set()),
        ([light()], None, {Effect.PUNCTUAL_LIGHTS}),
        ([light(0.0), light(colour=(0.0, 0.0, 0.0))], None, set()),
        ([], np.ones((1, 2, 3)), {Effect.IMAGE_LIGHT}),
        ([light(0.0), light()], np.zeros((1, 2, 3)), {Effect.PUNCTUAL_LIGHTS}),
    ],
)
def test_a_light_that_is_dark_is_no_light(lights, radiance, expected):
    environment = None if radiance is None else SimpleNamespace(radiance=radiance)
    assert plan_scene_effects(SimpleNamespace(lights=lights), environment) == expected


@pytest.mark.parametrize("colours", [None, np.ones((3, 4))])
@pytest.mark.parametrize("tangents", [None, np.ones((3, 4))])
def test_vertices_bring_what_they_have(colours, tangents):
    effects = primitive_effects(SimpleNamespace(colours=colours, tangents=tangents))
    assert (Effect.VERTEX_COLOR in effects) == (colours is not None)
    assert (Effect.TANGENTS in effects) == (tangents is not None)


def test_vertices_tint_a_grey_metal_and_no_dielectric():
    film = Material(pbr=MetallicRoughness(metallic_factor=0.5), iridescence=Iridescence(factor=1.0))
    plan = replace(plan_material(film, 0), grey=frozenset({"dielectric", "metal"}))
    assert {"GREY_DIELECTRIC", "GREY_METAL"} <= set(permutation(plan, ALL - {Effect.VERTEX_COLOR}, ()))
    tinted = permutation(plan, ALL, {Effect.VERTEX_COLOR})
    assert "GREY_DIELECTRIC" in tinted
    assert "GREY_METAL" not in tinted
