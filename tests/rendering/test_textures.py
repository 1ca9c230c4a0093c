"""Textures arrive upright, in their colour space, wrapped by their sampler, no more often than needed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.colour.transfer import srgb_decode
from gltf_iri.material.interface import TextureBinding
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.texture import TextureInfo
from gltf_iri.material.unlit import Unlit
from gltf_iri.rendering.textures import TextureStore

RED, GREEN, BLUE, WHITE = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (255, 255, 255, 255)
LINEAR, LINEAR_MIPMAP_LINEAR = 9729, 9987
REPEAT, CLAMP, MIRROR = 10497, 33071, 33648


def unlit(texture):
    return Material(pbr=MetallicRoughness(base_color_texture=TextureInfo(texture)), unlit=Unlit())


@pytest.mark.parametrize("float_textures", [False, True])
def test_a_textures_first_row_is_on_top_and_its_first_column_on_the_left(stage, props, float_textures):
    images = props.Images()
    frame = stage.draw(
        props.quad(),
        unlit(images.add([[RED, GREEN], [BLUE, WHITE]])),
        images=images,
        float_textures=float_textures,
    )
    corners = [frame.rgba[y, x, :3].tolist() for y, x in ((8, 8), (8, 56), (56, 8), (56, 56))]
    assert corners == [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]]


@pytest.mark.parametrize(("float_textures", "tolerance"), [(False, 2e-3), (True, 1e-7)])
def test_colour_textures_are_decoded_from_srgb(stage, props, float_textures, tolerance):
    images = props.Images()
    material = unlit(images.add([[(188, 64, 10, 255)]]))
    frame = stage.draw(props.quad(), material, images=images, float_textures=float_textures)
    expected = srgb_decode(np.array([188, 64, 10]) / 255)
    assert np.abs(frame.rgba[32, 32, :3] - expected).max() <= tolerance


@pytest.mark.parametrize("float_textures", [False, True])
def test_alpha_of_a_colour_texture_is_linear(stage, props, float_textures):
    images = props.Images()
    material = replace(unlit(images.add([[(255, 255, 255, 51)]])), alpha_mode="BLEND")
    frame = stage.draw(props.quad(), material, images=images, float_textures=float_textures)
    assert frame.rgba[32, 32, 3] == pytest.approx(0.2, abs=1e-6)


@pytest.mark.parametrize("float_textures", [False, True])
def test_data_textures_are_not_decoded(stage, props, float_textures):
    images = props.Images()
    texture = TextureInfo(images.add([[(9, 128, 64, 255)]]))
    pbr = MetallicRoughness(metallic_roughness_texture=texture)
    frame = stage.draw(
        props.quad(), Material(pbr=pbr), images=images, with_inputs=True, float_textures=float_textures
    )
    assert frame.inputs.perceptual_roughness[32, 32] == pytest.approx(128 / 255, abs=1e-6)
    assert frame.inputs.metallic[32, 32] == pytest.approx(64 / 255, abs=1e-6)


@pytest.mark.parametrize(
    ("wrap", "columns"),
    [(REPEAT, "RGRG"), (MIRROR, "RGGR"), (CLAMP, "RGGG")],
)
def test_coordinates_beyond_one_follow_the_sampler(stage, props, wrap, columns):
    images = props.Images()
    texture = images.add([[RED, GREEN]], wrap_s=wrap, wrap_t=CLAMP)
    stretched = props.quad(uvs=((props.quad().uvs[0] * np.float32([2, 1])),))
    frame = stage.draw(stretched, unlit(texture), images=images)
    found = ["RG"[int(frame.rgba[32, x, 1])] for x in (8, 24, 40, 56)]
    assert "".join(found) == columns


def test_linear_filtering_blends_light_not_stored_values(stage, props):
    images = props.Images()
    black = (0, 0, 0, 255)
    texture = images.add([[black, WHITE]], mag_filter=LINEAR, min_filter=LINEAR, wrap_s=CLAMP)
    frame = stage.draw(props.quad(), unlit(texture), images=images, size=(65, 65))
    assert frame.rgba[32, 32, 0] == pytest.approx(0.5, abs=0.01)


@pytest.mark.parametrize("float_textures", [False, True])
def test_a_small_picture_of_a_chessboard_averages_light(stage, props, float_textures):
    images = props.Images()
    chessboard = np.where((np.indices((64, 64)).sum(axis=0) % 2)[..., None], WHITE, (0, 0, 0, 255))
    texture = images.add(chessboard, min_filter=LINEAR_MIPMAP_LINEAR, mag_filter=LINEAR)
    frame = stage.draw(
        props.quad(), unlit(texture), images=images, size=(8, 8), float_textures=float_textures
    )
    assert np.abs(frame.rgba[..., :3] - 0.5).max() <= 0.01


def test_an_image_is_uploaded_once_for_each_way_of_reading_it(gl_context, props):
    images = props.Images()
    first, again = images.add([[RED]]), images.add([[RED]])
    images.textures[again] = images.textures[first]
    store = TextureStore(gl_context, images)
    assert store.get(TextureBinding(first, "srgb")) is store.get(TextureBinding(again, "srgb"))
    assert store.get(TextureBinding(first, "srgb")) is not store.get(TextureBinding(first, "linear"))
    store.release()


def test_a_texture_that_no_shader_samples_is_not_read(stage, props):
    images = props.Images()
    pbr = MetallicRoughness(metallic_roughness_texture=TextureInfo(99))  # there is no texture 99
    frame = stage.draw(props.quad(), Material(pbr=pbr, unlit=Unlit()), images=images)
    assert frame.rgba[32, 32].tolist() == [1, 1, 1, 1]
