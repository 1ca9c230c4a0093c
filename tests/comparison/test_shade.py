"""Shading of single pixels against results worked out by hand."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.comparison.pixels import image_light_of_pixels, surface_of_pixels
from gltf_iri.comparison.shade import shade
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.planning.effects import Effect
from gltf_iri.scene.illuminance import arriving
from gltf_iri.scene.model import Camera, Light

BASE = np.array([0.8, 0.4, 0.2], np.float32).astype(np.float64)
F0 = float(np.float32(0.04))


class PaintedFilm:
    """A film of one colour at every angle, which remembers what it was asked."""

    def __init__(self, colour, undefined=()):
        self.colour = np.asarray(colour)
        self.undefined = undefined
        self.films = []

    def __call__(self, film, sight) -> Evaluation:
        self.films.append(film)
        cases = {case: np.ones(film.shape, np.bool_) for case in self.undefined}
        return Evaluation(np.broadcast_to(self.colour, (*film.shape, 3)), "painted", "none", undefined=cases)


NO_FILM = PaintedFilm([np.nan] * 3)


def all_pixels(inputs, camera):
    mask = inputs.material >= 0
    return surface_of_pixels(inputs, mask, camera), image_light_of_pixels(inputs, mask)


def test_metal_lit_and_seen_head_on(row_of_pixels, camera, plan, sun) -> None:
    """D = 1/(π α²), V = ¼, F = F0: E·F0/(4 π α²) with α = ¼ and E = 3."""
    pixels = all_pixels(row_of_pixels(metallic=1), camera)
    shading = shade(*pixels, plan(), 1.0, [sun()], NO_FILM)
    np.testing.assert_allclose(shading.rgb[0], 3.0 * BASE * 16.0 / (4.0 * np.pi), rtol=1e-12)


def test_dielectric_lit_and_seen_head_on(row_of_pixels, camera, plan, sun) -> None:
    """E·((1 − F0)·c/π + F0/(4 π α²))."""
    pixels = all_pixels(row_of_pixels(), camera)
    shading = shade(*pixels, plan(), 1.0, [sun()], NO_FILM)
    expected = 3.0 * ((1.0 - F0) * BASE / np.pi + F0 * 16.0 / (4.0 * np.pi))
    np.testing.assert_allclose(shading.rgb[0], expected, rtol=1e-12)


def test_film_is_met_at_the_half_vectors_angle(row_of_pixels, camera, plan, sun) -> None:
    """Light from 60° beside a viewer on the normal: H lies at 30°, so V·H = cos 30°, D at sin² = ¼."""
    film = PaintedFilm([0.5, 0.1, 0.3])
    pixels = all_pixels(row_of_pixels(metallic=1, iridescence_factor=0.25), camera)
    light = sun((-np.sin(np.pi / 3), 0.0, -0.5))
    shading = shade(*pixels, plan(method="painted"), 1.4, [light], film)
    cosines = [float(f.cos_theta_1[0]) for f in film.films]
    assert cosines[-1] == pytest.approx(np.sqrt(0.75), rel=1e-12)
    alpha2 = 1.0 / 16.0
    d = alpha2 / (np.pi * (0.25 + alpha2 * 0.75) ** 2)
    v = 0.5 / (0.5 * 1.0 + np.sqrt(alpha2 + (1.0 - alpha2) * 0.25))
    schlick = BASE + (1.0 - BASE) * (1.0 - np.sqrt(0.75)) ** 5
    reflectance = 0.75 * schlick + 0.25 * film.colour
    np.testing.assert_allclose(shading.rgb[0], 3.0 * 0.5 * d * v * reflectance, rtol=1e-10)


def test_image_light_on_film_covered_dielectric(row_of_pixels, camera, plan) -> None:
    """Film 0.5, 0.1, 0.3 at A + B = 0.9 over a base that still gets 1 − 0.45 of the light."""
    film = PaintedFilm([0.5, 0.1, 0.3])
    inputs = row_of_pixels(
        iridescence_factor=1, dfg_a=0.75, dfg_b=0.125, irradiance=(1, 1, 1), reflected_radiance=(2, 2, 2)
    )
    shading = shade(*all_pixels(inputs, camera), plan(method="painted"), 1.4, [], film)
    scaled = 0.875 * film.colour
    np.testing.assert_allclose(shading.rgb[0], (1 - scaled.max()) * BASE + 2 * scaled, rtol=1e-12)


@pytest.mark.parametrize("layering", ["core", "specular"])
def test_white_metal_and_white_dielectric_vanish_in_a_white_room(
    row_of_pixels, camera, plan, layering
) -> None:
    for metallic in (0, 1):
        inputs = row_of_pixels(
            metallic=metallic,
            base_color=(1, 1, 1),
            dfg_a=0.75,
            dfg_b=0.25,
            irradiance=(1, 1, 1),
            reflected_radiance=(1, 1, 1),
        )
        shading = shade(*all_pixels(inputs, camera), plan(layering=layering), 1.0, [], NO_FILM)
        np.testing.assert_allclose(shading.rgb[0], np.ones(3), rtol=1e-7)


def test_specular_weight_reaches_the_base_under_the_film(row_of_pixels, camera, plan) -> None:
    film = PaintedFilm([0.1, 0.1, 0.1])
    pixels = all_pixels(row_of_pixels(iridescence_factor=1, specular_weight=0.5), camera)
    shade(*pixels, plan(method="painted", layering="specular"), 1.4, [], film)
    np.testing.assert_allclose(film.films[0].base.f0[0], 0.5 * F0)


def test_emission_is_added_and_unlit_is_the_base_colour(row_of_pixels, camera, plan, sun) -> None:
    pixels = all_pixels(row_of_pixels(emission=(7, 0, 0)), camera)
    lit_from_behind = shade(*pixels, plan(), 1.0, [sun((0.0, 0.0, 1.0))], NO_FILM)
    np.testing.assert_array_equal(lit_from_behind.rgb[0], [7, 0, 0])
    unlit = shade(*pixels, plan(Effect.UNLIT), 1.0, [sun()], NO_FILM)
    np.testing.assert_array_equal(unlit.rgb[0], BASE)


def test_undefined_rows_are_counted_once_however_many_lights_meet_them(
    row_of_pixels, camera, plan, sun
) -> None:
    film = PaintedFilm([0.1, 0.1, 0.1], undefined=("division by zero",))
    pixels = all_pixels(row_of_pixels(4, iridescence_factor=1), camera)
    shading = shade(*pixels, plan(method="painted"), 1.4, [sun(), sun()], film)
    assert int(shading.undefined["division by zero"].sum()) == 4


def test_orthographic_camera_sees_everything_along_its_axis(row_of_pixels) -> None:
    view = np.eye(4)
    camera = Camera("flat", "orthographic", view, znear_m=0.1, zfar_m=10.0, xmag_m=1.0, ymag_m=1.0)
    pixels = all_pixels(row_of_pixels(position=(5, 3, -2)), camera)
    np.testing.assert_array_equal(pixels[0].view, [[0.0, 0.0, 1.0]])


def lamp(kind: str, **values) -> Light:
    return Light(
        "lamp", kind, (1.0, 0.5, 0.25), 8.0, np.array([0.0, 2.0, 0.0]), np.array([0.0, -1.0, 0.0]), **values
    )


def test_point_light_falls_off_with_the_square_of_distance_to_its_range() -> None:
    points = np.array([[0.0, 0.0, 0.0], [0.0, 4.5, 0.0]])
    direction, illuminance = arriving(lamp("point", range_m=2.4), points)
    np.testing.assert_allclose(direction, [[0, 1, 0], [0, -1, 0]])
    np.testing.assert_allclose(illuminance[0], np.array([2.0, 1.0, 0.5]) * (1 - (2 / 2.4) ** 4))
    np.testing.assert_array_equal(illuminance[1], 0.0)


def test_spot_light_fades_between_its_cones() -> None:
    light = lamp("spot", inner_cone_rad=0.2, outer_cone_rad=0.6)
    angles = np.array([0.1, 0.4, 0.7])
    points = light.position + np.stack([np.sin(angles), -np.cos(angles), 0 * angles], axis=-1)
    _, illuminance = arriving(light, points)
    ramp = (np.cos(0.4) - np.cos(0.6)) / (np.cos(0.2) - np.cos(0.6))
    np.testing.assert_allclose(illuminance[:, 0], [8.0, 8.0 * ramp**2, 0.0], rtol=1e-12)
