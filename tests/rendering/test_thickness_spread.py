"""A film's thickness spreads as it does within the pixel; a shader without the effect knows nothing of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.texture import TextureInfo
from gltf_iri.planning.decide import plan_material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.permutation import permutation
from gltf_iri.rendering.programs import surface_sources

LINEAR, LINEAR_MIPMAP_LINEAR, NEAREST = 9729, 9987, 9728
CLAMP = 33071
FILM = Iridescence(1.0, thickness_min_nm=900.0, thickness_max_nm=400.0)  # turned around: the range is 500 nm
RANGE_NM = 500.0
LIT = (Effect.PUNCTUAL_LIGHTS,)


def filmed(texture: int) -> Material:
    film = replace(FILM, thickness_texture=TextureInfo(texture))
    return Material(pbr=MetallicRoughness(metallic_factor=1.0), iridescence=film)


def seen(stage, props, texels, size, *, uv_scale=(1.0, 1.0), min_filter=LINEAR_MIPMAP_LINEAR, **options):
    """Mean and standard deviation of the thickness (h, w) on a square that shows `texels` uv_scale times."""
    images = props.Images()
    grey = np.repeat(np.asarray(texels, np.uint8)[..., None], 4, axis=-1)
    filters = {"mag_filter": LINEAR, "min_filter": min_filter} | options.pop("sampler", {})
    texture = images.add(grey, wrap_s=CLAMP, wrap_t=CLAMP, **filters)
    quad = props.quad()
    quad = replace(quad, uvs=(quad.uvs[0] * np.float32(uv_scale),))
    frame = stage.draw(
        quad, filmed(texture), images=images, size=size, method="fourier", with_inputs=True, **options
    )
    inputs = frame.inputs
    return inputs.iridescence_thickness_nm, inputs.iridescence_thickness_std_nm


def checkerboard(side: int) -> np.ndarray:
    return np.where(np.indices((side, side)).sum(axis=0) % 2, 255, 0)


def test_a_checkerboard_of_small_squares_has_its_two_thicknesses_in_every_pixel(stage, props):
    mean_nm, std_nm = seen(stage, props, checkerboard(256), (16, 16))
    assert np.abs(mean_nm - 650.0).max() < 0.1
    assert np.abs(std_nm - RANGE_NM / 2).max() < 0.1


# Texels and pixels have no common measure, so that pixels lie everywhere among the texels.
@pytest.mark.parametrize("pixels", [9, 19, 37, 53, 79, 131])
def test_a_slope_spreads_as_over_the_width_of_a_pixel(stage, props, pixels):
    slope = np.tile(np.arange(0, 256, 4), (64, 1))
    _, std_nm = seen(stage, props, slope, (pixels, pixels))
    across_nm = RANGE_NM * 256 / 255 / pixels
    inside = std_nm[:, pixels // 8 : -pixels // 8]  # clamping flattens the slope at its ends
    # Between two levels their variances are mixed: with 1.7 texels a pixel this is 12 % wider.
    assert np.sqrt(np.mean(inside**2)) == pytest.approx(across_nm / np.sqrt(12), rel=0.13)


def test_the_spread_goes_with_the_size_of_a_pixel_within_a_texel(stage, props):
    for pixels in (256, 512):
        _, std_nm = seen(stage, props, checkerboard(4), (pixels, pixels))
        texels = 4 / pixels
        assert std_nm.max() <= RANGE_NM / 2 * texels * np.sqrt(0.5) + 1e-3


def test_a_texel_alone_does_not_spread(stage, props):
    _, std_nm = seen(stage, props, checkerboard(4), (256, 256), sampler={"mag_filter": NEAREST})
    assert std_nm.max() == 0.0
    _, std_nm = seen(stage, props, np.full((64, 64), 77), (16, 16))
    assert std_nm.max() == 0.0


@pytest.mark.parametrize("min_filter", [NEAREST, LINEAR, LINEAR_MIPMAP_LINEAR])
def test_every_sampler_is_averaged_over_a_pixel(stage, props, min_filter):
    _, std_nm = seen(stage, props, checkerboard(128), (16, 16), min_filter=min_filter)
    assert np.abs(std_nm - RANGE_NM / 2).max() < 0.1


@pytest.mark.parametrize("turned", [False, True])
def test_a_pixel_longer_than_wide_spreads_along_its_length_only(stage, props, turned):
    # A pixel spans 9.1 texels one way and 3.03 the other, and the thickness slopes along one of them.
    slope = np.tile(np.arange(256)[:, None], (1, 256))
    long, short = 300 / 256, 100 / 256
    scale, texels = ((short, long), 300 / 33) if turned else ((long, short), 100 / 33)
    _, std_nm = seen(stage, props, slope, (33, 33), uv_scale=scale)
    rms_nm = np.sqrt(np.mean(std_nm[2:25] ** 2))
    assert rms_nm == pytest.approx(texels * RANGE_NM / 255 / np.sqrt(12), rel=0.08)


def test_sharp_textures_show_the_texel_at_the_pixels_centre_alone(stage, props):
    texels = np.random.default_rng(1).integers(0, 256, (63, 63))
    mean_nm, std_nm = seen(stage, props, texels, (9, 9), sharp_textures=True)
    assert std_nm.max() == 0.0
    np.testing.assert_allclose(mean_nm, 900.0 - RANGE_NM * texels[3::7, 3::7] / 255, atol=0.05)


def test_a_shader_without_the_spread_holds_no_word_of_it():
    for method, is_there in (("fourier", True), ("khr-guarded", False)):
        _, fragment = surface_sources(permutation(plan_material(filmed(0), 0, method=method), (), LIT))
        for word in ("s.iridescence_thickness_std_nm", "thickness_in_pixel", "MOMENTS", "fourier_spread"):
            assert (word in fragment.text) == is_there
