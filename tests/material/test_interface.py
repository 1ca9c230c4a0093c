"""The shader interface: declarations and values come from the same rows and stand behind real defines."""

from __future__ import annotations

import math
import re
import shutil
import subprocess
from dataclasses import replace
from itertools import chain, combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.material.anisotropy import Anisotropy
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.emissive_strength import EmissiveStrength
from gltf_iri.material.interface import (
    SAMPLERS,
    UNIFORMS,
    interface_glsl,
    material_textures,
    material_uniforms,
)
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.sheen import Sheen
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import NormalTextureInfo, OcclusionTextureInfo, TextureInfo, TextureTransform
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.planning.effects import Effect
from gltf_iri.resources import shader_root

ALL_DEFINES = frozenset(effect.define for effect in Effect) - {Effect.UNLIT.define}

# Every slot holds its own texture, so that a mixed-up binding shows.
FULL = Material(
    pbr=MetallicRoughness(
        base_color_texture=TextureInfo(0), metallic_roughness_texture=TextureInfo(1), metallic_factor=0.25
    ),
    normal_texture=NormalTextureInfo(2, scale=0.5),
    occlusion_texture=OcclusionTextureInfo(3, strength=0.75),
    emissive_texture=TextureInfo(4),
    emissive_factor=(0.1, 0.2, 0.3),
    emissive_strength=EmissiveStrength(10.0),
    ior=Ior(2.0),
    specular=Specular(0.5, TextureInfo(5), (1.0, 2.0, 3.0), TextureInfo(6)),
    iridescence=Iridescence(1.0, TextureInfo(7), 1.8, 200.0, 300.0, TextureInfo(8, tex_coord=1)),
    bragg=Bragg(0.5, TextureInfo(17), 1.35, (MirrorLayer(), MirrorLayer()), TextureInfo(18, tex_coord=1)),
    anisotropy=Anisotropy(0.5, 1.0, TextureInfo(9)),
    transmission=Transmission(1.0, TextureInfo(10)),
    volume=Volume(2.0, TextureInfo(11), 3.0, (0.1, 0.5, 1.0)),
    dispersion=Dispersion(0.3),
    sheen=Sheen((0.1, 0.2, 0.3), TextureInfo(12), 0.4, TextureInfo(13)),
    clearcoat=Clearcoat(0.6, TextureInfo(14), 0.7, TextureInfo(15), NormalTextureInfo(16, scale=0.25)),
)


def declared(defines: frozenset[str]) -> set[str]:
    """Uniforms of the generated GLSL that survive the preprocessor under these defines."""
    names, stack = set(), []
    for line in interface_glsl().splitlines():
        if match := re.match(r"#(ifdef|ifndef) (\w+)", line):
            stack.append((match[2] in defines) == (match[1] == "ifdef"))
        elif line == "#endif":
            stack.pop()
        elif (match := re.match(r"uniform \w+ (\w+);", line)) and all(stack):
            names.add(match[1])
    return names


def test_every_define_in_the_glsl_is_the_define_of_an_effect():
    used = set(re.findall(r"\b(?:HAS|METHOD|LAYERING)_\w+", interface_glsl()))
    assert used
    assert used <= {effect.define for effect in Effect}


def test_every_texture_effect_has_a_sampler_behind_its_define():
    assert {sampler.guard for sampler in SAMPLERS} == {
        e.define for e in Effect if e.name.endswith("_TEXTURE")
    }


def test_no_uniform_is_declared_twice():
    assert len({uniform.name for uniform in UNIFORMS}) == len(UNIFORMS)


@given(st.frozensets(st.sampled_from([effect.define for effect in Effect])))
def test_values_are_given_for_exactly_what_the_shader_declares(defines):
    given_values = set(material_uniforms(FULL, defines)) | set(material_textures(FULL, defines))
    assert given_values == declared(defines)


def test_without_iridescence_nothing_of_it_is_declared_or_given():
    defines = frozenset(define for define in ALL_DEFINES if "IRIDESCENCE" not in define)
    names = declared(defines) | set(material_uniforms(FULL, defines)) | set(material_textures(FULL, defines))
    assert not [name for name in names if "iridescence" in name]


def test_each_sampler_gets_its_own_texture_in_its_own_colour_space():
    bindings = material_textures(FULL, ALL_DEFINES)
    assert {name: (b.texture, b.colour_space) for name, b in bindings.items()} == {
        "u_base_color_texture": (0, "srgb"),
        "u_metallic_roughness_texture": (1, "linear"),
        "u_normal_texture": (2, "linear"),
        "u_occlusion_texture": (3, "linear"),
        "u_emissive_texture": (4, "srgb"),
        "u_specular_texture": (5, "linear"),
        "u_specular_color_texture": (6, "srgb"),
        "u_iridescence_texture": (7, "linear"),
        "u_iridescence_thickness_texture": (8, "linear"),
        "u_bragg_texture": (17, "linear"),
        "u_bragg_period_texture": (18, "linear"),
        "u_anisotropy_texture": (9, "linear"),
        "u_transmission_texture": (10, "linear"),
        "u_volume_thickness_texture": (11, "linear"),
        "u_sheen_color_texture": (12, "srgb"),
        "u_sheen_roughness_texture": (13, "linear"),
        "u_clearcoat_texture": (14, "linear"),
        "u_clearcoat_roughness_texture": (15, "linear"),
        "u_clearcoat_normal_texture": (16, "linear"),
    }


def test_numbers_reach_the_uniform_of_their_name():
    values = material_uniforms(FULL, ALL_DEFINES)
    assert values["u_metallic_factor"] == 0.25
    assert values["u_normal_scale"] == 0.5
    assert values["u_occlusion_strength"] == 0.75
    assert values["u_emissive_factor"] == pytest.approx((1.0, 2.0, 3.0))
    assert values["u_dielectric_f0"] == pytest.approx(1 / 9)
    assert values["u_specular_color_factor"] == (1.0, 2.0, 3.0)
    assert values["u_iridescence_film_ior"] == 1.8
    assert (values["u_iridescence_thickness_min_nm"], values["u_iridescence_thickness_max_nm"]) == (
        200.0,
        300.0,
    )
    assert values["u_iridescence_uv_set"] == 0
    assert values["u_iridescence_thickness_uv_set"] == 1


def test_an_absent_extension_gives_the_default_of_its_rows():
    values = material_uniforms(Material(), ALL_DEFINES)
    assert values["u_dielectric_f0"] == pytest.approx(0.04)
    assert values["u_specular_factor"] == 1.0
    assert values["u_emissive_factor"] == (0.0, 0.0, 0.0)
    assert values["u_iridescence_factor"] == 0.0


def test_a_texture_is_sampled_in_the_channels_of_its_row():
    functions = dict(re.findall(r"(\w+ sample_\w+)\(.*\n    return texture\(.*\)(.*);", interface_glsl()))
    types = {1: "float", 2: "vec2", 3: "vec3", 4: "vec4"}
    assert functions == {
        f"{types[len(s.row.channels)]} sample_{s.slot}": f".{s.row.channels}" for s in SAMPLERS
    }


@pytest.mark.parametrize("path", sorted(shader_root().glob("material/*.glsl")), ids=lambda path: path.name)
def test_no_shader_chooses_channels_itself(path):
    assert not re.findall(r"sample_\w+\([^)]*\)\.\w+", path.read_text(encoding="utf-8"))


def transformed(transform: TextureTransform, uv: tuple[float, float]) -> np.ndarray:
    """Apply the uniform as GLSL does: nine floats are three columns."""
    material = replace(FULL, pbr=MetallicRoughness(base_color_texture=TextureInfo(0, transform=transform)))
    columns = material_uniforms(material, ALL_DEFINES)["u_base_color_uv_transform"]
    return (np.reshape(columns, (3, 3)).T @ [*uv, 1.0])[:2]


def test_a_texture_without_transform_is_read_at_the_vertex_uv():
    columns = material_uniforms(FULL, ALL_DEFINES)["u_base_color_uv_transform"]
    np.testing.assert_array_equal(np.reshape(columns, (3, 3)), np.eye(3))


def test_uv_are_scaled_then_rotated_then_shifted():
    quarter = TextureTransform(offset=(0.25, 0.5), rotation_rad=math.pi / 2, scale=(2.0, 3.0))
    # Counter-clockwise where v points down: +u goes to −v, +v to +u.
    np.testing.assert_allclose(transformed(quarter, (1.0, 0.0)), [0.25, 0.5 - 2.0], atol=1e-15)
    np.testing.assert_allclose(transformed(quarter, (0.0, 1.0)), [0.25 + 3.0, 0.5], atol=1e-15)


def test_the_transforms_uv_set_replaces_the_textures():
    info = TextureInfo(0, tex_coord=1, transform=TextureTransform(tex_coord=0))
    material = Material(pbr=MetallicRoughness(base_color_texture=info))
    assert material_uniforms(material, ALL_DEFINES)["u_base_color_uv_set"] == 0


def switch_sets() -> list[tuple[str, ...]]:
    switches = sorted({g for g in (u.guard.lstrip("!") for u in UNIFORMS) if g} | {s.guard for s in SAMPLERS})
    return list(chain([(), tuple(switches)], combinations(switches, 1)))


@pytest.mark.parametrize("header", ["#version 330 core", "#version 300 es\nprecision highp float;"])
def test_the_glsl_compiles_under_every_switch(tmp_path, header):
    compiler = shutil.which("glslangValidator")
    if compiler is None:
        pytest.skip("glslangValidator is not installed")
    paths = []
    for i, defines in enumerate(switch_sets()):
        lines = [header, *(f"#define {name}" for name in defines), interface_glsl()]
        path = tmp_path / f"{i}.frag"
        path.write_text(
            "\n".join([*lines, "out vec4 colour;\nvoid main() { colour = u_base_color_factor; }"])
        )
        paths.append(str(path))
    done = subprocess.run([compiler, *paths], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
