"""What reaches the lobes is what glTF says: the right channel, colour space, factor, UV set and transform.

The comparison with Python starts from the shader's own inputs; only here are those held against the file.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.colour.transfer import srgb_decode
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.specular import Specular
from gltf_iri.material.texture import OcclusionTextureInfo, TextureInfo, TextureTransform
from gltf_iri.material.unlit import Unlit

# Four channels that no mistake can confuse.
RGBA = (51, 102, 153, 204)
R, G, B, A = (value / 255 for value in RGBA)


def inputs_of(stage, props, build, **more):
    """Draw a quad of the material that `build` makes with a texture of RGBA everywhere."""
    images = props.Images()
    texture = TextureInfo(images.add([[RGBA]]))
    frame = stage.draw(props.quad(), build(texture), images=images, with_inputs=True, **more)
    return {name: getattr(frame.inputs, name)[32, 32] for name in frame.inputs.__slots__}


def film(**changes):
    return Iridescence(**({"factor": 0.5, "thickness_min_nm": 100.0, "thickness_max_nm": 600.0} | changes))


@pytest.mark.parametrize(("low_nm", "high_nm"), [(100.0, 600.0), (600.0, 100.0), (0.0, 300.0)])
def test_film_thickness_runs_with_green_from_minimum_to_maximum(stage, props, low_nm, high_nm):
    found = inputs_of(
        stage,
        props,
        lambda t: Material(
            iridescence=film(thickness_min_nm=low_nm, thickness_max_nm=high_nm, thickness_texture=t)
        ),
    )
    expected = low_nm + (high_nm - low_nm) * G
    assert found["iridescence_thickness_nm"] == pytest.approx(expected, rel=1e-6)
    assert found["iridescence_factor"] == 0.5


def test_without_thickness_texture_the_maximum_holds_and_red_scales_the_factor(stage, props):
    found = inputs_of(stage, props, lambda t: Material(iridescence=film(texture=t)))
    assert found["iridescence_thickness_nm"] == 600.0
    assert found["iridescence_factor"] == pytest.approx(0.5 * R, rel=1e-6)


def test_specular_weight_is_in_alpha_and_its_tint_in_srgb_cut_at_one(stage, props):
    tint = (1.5, 0.5, 100.0)
    found = inputs_of(
        stage,
        props,
        lambda t: Material(
            pbr=MetallicRoughness(metallic_factor=0.0),
            ior=Ior(1.8),
            specular=Specular(factor=0.75, texture=t, color_factor=tint, color_texture=t),
        ),
        float_textures=True,
    )
    assert found["specular_weight"] == pytest.approx(0.75 * A, rel=1e-6)
    expected = np.minimum((0.8 / 2.8) ** 2 * np.array(tint) * srgb_decode([R, G, B]), 1.0)
    assert found["dielectric_f0"] == pytest.approx(expected, rel=1e-6)


def test_occlusion_is_in_red_and_dims_image_light_by_its_strength(stage, props, furnace):
    found = inputs_of(
        stage,
        props,
        lambda t: Material(occlusion_texture=OcclusionTextureInfo(t.texture, strength=0.5)),
        environment=furnace,
    )
    assert found["irradiance"] == pytest.approx(1.0 + 0.5 * (R - 1.0), rel=1e-5)
    assert found["reflected_radiance"] == pytest.approx(1.0 + 0.5 * (R - 1.0), rel=1e-5)


def test_a_texture_is_turned_and_may_read_the_second_uv_set(stage, props):
    """A quarter turn, u′ = v and v′ = −u: counter-clockwise to the eye, for v points down."""
    images = props.Images()
    colours = [[(255, 0, 0, 255), (0, 255, 0, 255)], [(0, 0, 255, 255), (255, 255, 255, 255)]]
    turned = TextureTransform(rotation_rad=np.pi / 2, tex_coord=1)
    texture = TextureInfo(images.add(colours), transform=turned)
    quad = props.quad()
    quad = replace(quad, uvs=(quad.uvs[0] * 0.0, quad.uvs[0]))
    material = Material(pbr=MetallicRoughness(base_color_texture=texture), unlit=Unlit())
    frame = stage.draw(quad, material, images=images)
    corners = [frame.rgba[y, x, :3].tolist() for y, x in ((8, 8), (8, 56), (56, 8), (56, 56))]
    # Upper left (¼, ¼) reads (¼, −¼), which repeats as the lower left texel, and so on round the square.
    assert corners == [[0, 0, 1], [1, 0, 0], [1, 1, 1], [0, 1, 0]]
