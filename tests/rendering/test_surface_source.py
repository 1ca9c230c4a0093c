"""A permutation holds the code of its effects and no other."""

from __future__ import annotations

import itertools
import re

import pytest

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.unlit import Unlit
from gltf_iri.planning.decide import plan_material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.permutation import permutation
from gltf_iri.rendering.programs import ProgramStore, surface_sources
from gltf_iri.rendering.switches import LAYER_INPUTS, SHADING_INPUTS

LIT = (Effect.PUNCTUAL_LIGHTS, Effect.IMAGE_LIGHT)
FILMED = Material(iridescence=Iridescence(factor=1.0))


def identifiers(material, *, surroundings=LIT, method=None, switches=()):
    defines = permutation(plan_material(material, 0, method=method), (), surroundings) + switches
    vertex, fragment = surface_sources(defines)
    code = re.sub(r"//.*|#define .*|#line .*", "", vertex.text + fragment.text)
    return set(re.findall(r"[A-Za-z_]\w*", code))


def test_a_film_brings_its_own_method_only():
    assert "iridescent_fresnel_khr" in identifiers(FILMED, method="khr")
    assert "iridescent_fresnel_khr_guarded" not in identifiers(FILMED, method="khr")
    assert "iridescent_fresnel_khr" not in identifiers(FILMED, method="khr-guarded")


@pytest.mark.parametrize("switches", [(), (SHADING_INPUTS,)])
@pytest.mark.parametrize("material", [Material(), Material(iridescence=Iridescence(factor=0.0))])
def test_without_a_film_there_is_no_iridescence_code(material, switches):
    found = identifiers(material, switches=switches)
    traces = ("iridescen", "sensitivity", "fresnel0", "matched", "thin_opd", "r123")
    assert not [name for name in found if name.startswith("film_") or any(t in name.lower() for t in traces)]


def test_not_even_a_comment_of_the_film_is_left_in_a_shader_without_film():
    defines = permutation(plan_material(Material(), 0), (), LIT)
    text = "".join(source.text for source in surface_sources(defines)).lower()
    assert "iridescen" not in text


def test_without_layers_there_is_no_code_of_layers():
    traces = (
        "clearcoat",
        "coat_",
        "sheen",
        "charlie",
        "anisotropic",
        "tangent",
        "transmi",
        "volume",
        "dispers",
    )
    for switches in ((), (SHADING_INPUTS,), (LAYER_INPUTS,)):
        found = identifiers(Material(), switches=switches)
        # What the targets of the second inputs are called is said in any case.
        held = {name for name in found if not name.startswith("out_")}
        assert not [name for name in held if any(trace in name.lower() for trace in traces)]


def test_a_layer_brings_its_own_code_only():
    coated = identifiers(Material(clearcoat=Clearcoat(factor=1.0)))
    assert "punctual_clearcoat" in coated and "d_charlie" not in coated
    cloth = identifiers(Material(sheen=Sheen((1.0, 1.0, 1.0))))
    assert "d_charlie" in cloth and "punctual_clearcoat" not in cloth and "d_ggx_anisotropic" not in cloth
    brushed = identifiers(Material(anisotropy=Anisotropy(0.5)))
    assert "d_ggx_anisotropic" in brushed and "sheen_weight" not in brushed


def test_an_unlit_material_has_no_lights_and_no_lobes():
    found = identifiers(Material(unlit=Unlit()))
    assert not found & {"d_ggx", "punctual_light", "environment_radiance", "mix_lobes"}


def test_what_does_not_light_the_scene_is_not_in_the_shader():
    found = identifiers(FILMED, surroundings=(Effect.PUNCTUAL_LIGHTS,))
    assert "punctual_light" in found and "environment_radiance" not in found
    found = identifiers(FILMED, surroundings=(Effect.IMAGE_LIGHT,))
    assert "environment_radiance" in found and "punctual_light" not in found


def test_a_pure_metal_has_no_dielectric_layer():
    metal = Material(pbr=MetallicRoughness(metallic_factor=1.0))
    assert "dielectric_layer" not in identifiers(metal)


# Layers of Bragg mirrors exclude films and transmission; test_bragg_source.py compiles theirs.
EXCLUDED = {Effect.UNLIT, *LIT, Effect.BRAGG, Effect.BRAGG_TEXTURE, Effect.BRAGG_PERIOD_TEXTURE}

# One of each: what the shader is must not depend on which other effects are there.
BASES = ((), ("HAS_METAL",), ("HAS_DIELECTRIC",), ("HAS_METAL", "HAS_DIELECTRIC"), ("HAS_UNLIT",))
EXTRAS = (
    ("HAS_IRIDESCENCE", "METHOD_KHR"),
    ("HAS_IRIDESCENCE", "METHOD_KHR_GUARDED", "LAYERING_SPECULAR"),
    (*(f"HAS_IRIDESCENCE{end}" for end in ("", "_THICKNESS_TEXTURE", "_THICKNESS_SPREAD")), "METHOD_FOURIER"),
    ("HAS_NORMAL_TEXTURE",),
    ("HAS_NORMAL_TEXTURE", "HAS_TANGENTS"),
    ("HAS_ALPHA_MASK", "HAS_EMISSION", "HAS_EMISSIVE_TEXTURE", "HAS_VERTEX_COLOR"),
    ("HAS_SPECULAR", "HAS_SPECULAR_TEXTURE", "HAS_SPECULAR_COLOR_TEXTURE", "HAS_ALPHA_BLEND"),
    ("HAS_CLEARCOAT", LAYER_INPUTS),
    ("HAS_CLEARCOAT", "HAS_CLEARCOAT_NORMAL_TEXTURE", "HAS_TANGENTS"),
    ("HAS_SHEEN", "HAS_SHEEN_COLOR_TEXTURE", LAYER_INPUTS),
    ("HAS_ANISOTROPY", "HAS_ANISOTROPY_TEXTURE"),
    ("HAS_ANISOTROPY", "HAS_TANGENTS", LAYER_INPUTS),
    ("HAS_TRANSMISSION", LAYER_INPUTS),
    ("HAS_TRANSMISSION", "HAS_VOLUME", "HAS_ANISOTROPY", "HAS_CLEARCOAT", "HAS_SHEEN"),
    (*(e.define for e in Effect if e not in EXCLUDED), "METHOD_KHR_GUARDED", SHADING_INPUTS),
)


LAYERS = {f"HAS_{name}" for name in ("IRIDESCENCE", "CLEARCOAT", "SHEEN", "ANISOTROPY", "TRANSMISSION")}


@pytest.mark.parametrize(
    ("base", "lights"), list(itertools.product(BASES, [(), tuple(e.define for e in LIT)]))
)
def test_every_kind_of_permutation_compiles(gl_context, base, lights):
    programs = ProgramStore(gl_context)
    for extra in EXTRAS:
        if "HAS_UNLIT" in base and not LAYERS.isdisjoint(extra):
            continue  # plans drop layers under unlit
        defines = tuple(dict.fromkeys((*base, *(() if "HAS_UNLIT" in base else lights), *extra)))
        assert programs.get(defines) is programs.get(defines)
    programs.release()
