"""Limits of the film's layering: strength 0 and 1, energy, and where the text's two variants part."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.optics.layering import (
    conductor_fresnel,
    fresnel_mix,
    iridescent_conductor_layer,
    iridescent_dielectric_layer,
    iridescent_dielectric_layer_specular,
    rgb_mix,
    transmitted_share,
)

share = st.floats(0.0, 1.0)
colour = st.tuples(share, share, share).map(np.array)

PLAIN = np.array([0.04, 0.04, 0.04])
FILM = np.array([0.5, 0.1, 0.3])


def test_metal_without_film_strength_is_the_bare_metal() -> None:
    np.testing.assert_array_equal(iridescent_conductor_layer(0.0, PLAIN, FILM), PLAIN)


def test_metal_under_a_full_film_shows_only_the_film() -> None:
    np.testing.assert_array_equal(iridescent_conductor_layer(1.0, PLAIN, FILM), FILM)


@pytest.mark.parametrize(
    "layered",
    [
        lambda s: iridescent_dielectric_layer(s, PLAIN, FILM),
        lambda s: iridescent_dielectric_layer_specular(s, 1.0, PLAIN, FILM),
    ],
    ids=["core", "specular"],
)
def test_dielectric_variants_agree_at_both_ends_of_the_strength(layered) -> None:
    for strength, expected in ((0.0, rgb_mix(PLAIN)), (1.0, rgb_mix(FILM))):
        layer = layered(strength)
        np.testing.assert_allclose(layer.specular, expected.specular, rtol=1e-15)
        np.testing.assert_allclose(layer.base_weight, expected.base_weight, rtol=1e-15)


def test_variants_part_where_bare_and_film_peak_in_different_channels() -> None:
    """Core: ½(1 − 0.8) + ½(1 − 0.6) = 0.3. Specular: the mixed colour is (0.4, 0.3, 0), 1 − 0.4 = 0.6."""
    bare, film = np.array([0.8, 0.0, 0.0]), np.array([0.0, 0.6, 0.0])
    assert iridescent_dielectric_layer(0.5, bare, film).base_weight == pytest.approx(0.3)
    assert iridescent_dielectric_layer_specular(0.5, 1.0, bare, film).base_weight == pytest.approx(0.6)


def test_specular_weight_scales_the_bare_reflection_only() -> None:
    layer = iridescent_dielectric_layer_specular(0.25, 0.5, PLAIN, FILM)
    np.testing.assert_allclose(layer.specular, 0.75 * 0.5 * PLAIN + 0.25 * FILM, rtol=1e-15)


@given(strength=share, weight=share, plain=colour, film=colour)
def test_layers_never_add_energy(strength, weight, plain, film) -> None:
    for layer in (
        iridescent_dielectric_layer(strength, plain, film),
        iridescent_dielectric_layer_specular(strength, weight, plain, film),
    ):
        assert np.all(layer.specular + layer.base_weight <= 1.0 + 1e-15)
        assert layer.base_weight >= -1e-15


@given(reflectance=st.tuples(*[st.floats(-0.2, 1.3)] * 3).map(np.array))
def test_what_is_reflected_is_not_transmitted(reflectance) -> None:
    passed = transmitted_share(reflectance)
    assert np.all((passed >= 0.0) & (passed <= 1.0))
    inside = (reflectance >= 0.0) & (reflectance <= 1.0)
    np.testing.assert_array_equal((passed + reflectance)[inside], ((1.0 - reflectance) + reflectance)[inside])
    assert np.all(passed[reflectance > 1.0] == 0.0)
    assert np.all(passed[reflectance < 0.0] == 1.0)


@given(fresnel=share)
def test_colourless_layer_is_rgb_mix_of_equal_channels(fresnel) -> None:
    grey, colourless = rgb_mix(np.full(3, fresnel)), fresnel_mix(fresnel)
    np.testing.assert_array_equal(grey.specular, colourless.specular)
    assert grey.base_weight == colourless.base_weight


def test_metal_reflects_its_base_colour_head_on_and_white_at_the_horizon() -> None:
    f0 = np.array([1.0, 0.77, 0.34])
    np.testing.assert_allclose(conductor_fresnel(f0, [1.0, -1.0]), [f0, f0], rtol=1e-15)
    np.testing.assert_allclose(conductor_fresnel(f0, 0.0), np.ones(3), rtol=1e-15)


def test_arrays_of_pixels_keep_their_shape() -> None:
    strength = np.linspace(0, 1, 6).reshape(2, 3)
    layer = iridescent_dielectric_layer(strength, np.tile(PLAIN, (2, 3, 1)), FILM)
    assert layer.specular.shape == (2, 3, 3)
    assert layer.base_weight.shape == (2, 3)
