"""Method khr-guarded: each guard closes what it says, and is continuous where the text jumps."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.colour.sensitivity import SENSITIVITY_WHITE, eval_sensitivity
from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.khr import F0_OFFSET, evaluate_khr, iridescent_fresnel_khr
from gltf_iri.evaluation.khr_guarded import MATCHED_F0, evaluate_khr_guarded, f_schlick_matched
from gltf_iri.optics.fresnel import f_schlick


def guarded(film: Film) -> NDArray[np.float64]:
    return evaluate_khr_guarded(film, "D65").rgb


COSINES = np.linspace(0.0, 1.0, 41)


def test_perfect_metal_is_white_and_defined() -> None:
    rgb = guarded(Film.of(COSINES, 300.0, 1.3, base_from_f0(np.ones(3))))
    assert np.abs(rgb - 1.0).max() <= 2e-3
    assert evaluate_khr_guarded(Film.of(COSINES, 300.0, 1.3, base_from_f0(np.ones(3))), "D65").undefined == {}


@pytest.mark.parametrize("ior", [1.16, 1.2, 1.5, 2.0])
def test_film_like_its_base_shows_no_fringes(ior: float) -> None:
    thickness = np.linspace(0.0, 1500.0, 61)[:, None]
    rgb = guarded(Film.of(COSINES, thickness, ior, base_from_ior(ior)))
    assert np.ptp(rgb, axis=-1).max() <= 1e-12
    assert np.ptp(rgb, axis=0).max() <= 1e-12


@pytest.mark.parametrize("f0", [MATCHED_F0, 0.04, 0.9])
def test_film_like_air_is_the_bare_base(f0: float) -> None:
    rgb = guarded(Film.of(COSINES, 400.0, 1.0, base_from_f0(np.full(3, f0))))
    assert np.abs(rgb - f_schlick(np.full(3, f0), COSINES[:, None])).max() <= 1e-12


def test_thickness_fades_in_without_a_step() -> None:
    thickness = np.linspace(0.0, 200.0, 20_001)
    rgb = guarded(Film.of(0.9, thickness, 1.8, base_from_f0([0.9, 0.6, 0.3])))
    assert np.abs(np.diff(rgb, axis=0)).max() <= 1e-3
    assert np.abs(rgb[0] - f_schlick([0.9, 0.6, 0.3], 0.9)).max() <= 1e-12


def test_from_100_nm_of_path_difference_on_the_film_is_whole() -> None:
    film_ior, f0 = 1.8, np.array([0.2, 0.15, 0.1])
    opd_nm = np.array([90.0, 100.0, 110.0, 400.0])
    text_with_white_fringes = iridescent_fresnel_khr(
        1.0,
        film_ior,
        f0 - F0_OFFSET,
        opd_nm / (2.0 * film_ior),
        1.0,
        sensitivity=lambda opd, shift: eval_sensitivity(opd, shift) / SENSITIVITY_WHITE,
    )
    ours = guarded(Film.of(1.0, opd_nm / (2.0 * film_ior), film_ior, base_from_f0(f0)))
    difference = np.abs(ours - text_with_white_fringes).max(axis=-1)
    assert difference[0] > 1e-4
    assert difference[1:].max() <= 1e-12


def test_a_thick_film_over_a_white_mirror_sends_everything_back() -> None:
    """No fringe is left at 1 mm, and the sum over all inter-reflections is 1, at grazing angles too."""
    cosines = np.array([1e-3, 1e-2, 0.1, 0.5, 1.0])
    rgb = guarded(Film.of(cosines, 1e6, 1.16, base_from_f0(np.ones(3))))
    assert np.abs(rgb - 1.0).max() <= 2e-4


def test_contrast_fades_in_without_a_step() -> None:
    """The text's phase flips where film and base swap order; here nothing reflects at that point."""
    ior = np.linspace(1.49, 1.51, 20_001)
    rgb = guarded(Film.of(0.2, 400.0, ior, base_from_ior(1.5)))
    assert np.abs(np.diff(rgb, axis=0)).max() <= 1e-4
    text = evaluate_khr(Film.of(0.2, 400.0, ior, base_from_ior(1.5)), "D65").rgb
    assert np.abs(np.diff(text, axis=0)).max() > 1e-2


def test_result_stays_between_black_and_white() -> None:
    g = np.random.default_rng(5)
    film = Film.of(
        g.uniform(0, 1, 5000),
        g.uniform(0, 1200, 5000),
        g.uniform(1, 2.5, 5000),
        base_from_f0(g.uniform(0, 1, (5000, 3))),
    )
    rgb = guarded(film)
    assert rgb.min() >= 0.0
    assert rgb.max() <= 1.0
    text = evaluate_khr(film, "D65").rgb
    assert np.nanmax(text) > 1.05  # what the upper clamp is for


def test_schlick_with_contrast_is_schlick_for_ordinary_interfaces() -> None:
    f0 = np.array([MATCHED_F0, 0.04, 0.9])
    assert np.array_equal(f_schlick_matched(f0, 0.3), f_schlick(f0, 0.3))
    assert f_schlick_matched(0.0, 0.0) == 0.0
