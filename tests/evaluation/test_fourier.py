"""Method `fourier` against the truth, its bound against its errors, its loops against each other."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.backends import Backend, has_numba
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Base, Film, base_from_dispersion, base_from_f0, base_from_ior
from gltf_iri.evaluation.fourier import THIN_OPD_NM, evaluate_fourier
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.spectral import evaluate_spectral

needs_numba = pytest.mark.skipif(not has_numba(), reason="numba is not installed")


def published_set(count: int, thickest_nm: float) -> Film:
    g = np.random.default_rng(0)
    ranges = ((1.1, 2.2), (100.0, thickest_nm), (1.2, 2.5), (0.05, 1.0))
    film_ior, thickness_nm, base_ior, cosine = np.array(
        [[g.uniform(*ends) for ends in ranges] for _ in range(count)]
    ).T
    return Film.of(cosine, thickness_nm, film_ior, base_from_ior(base_ior))


def adversarial(kind: str, count: int = 200) -> Film:
    """Grazing light, films of no thickness and of many fringes, all sorts of bases, dense outsides."""
    g = np.random.default_rng(7)
    thickness_nm = g.choice([0.0, 1e-6, 1.0, 9.0, 20.0, 60.0, 300.0, 1000.0, 5000.0], count)
    thickness_nm = thickness_nm * g.uniform(0.5, 1.5, count)
    at_random = g.uniform(0.0, 1.0, count)
    cosine = np.where(at_random < 0.2, g.choice([0.0, 1e-12, 1e-8, 1e-4, 1e-2, 1.0], count), at_random)
    outside = np.ones(count)
    if kind == "real":
        base = base_from_ior(g.uniform(0.6, 4.0, count))
        outside = np.where(g.random(count) < 0.3, g.uniform(1.0, 2.5, count), 1.0)
    elif kind == "absorbing":
        k = g.choice([0.0, 1e-3, 0.1, 1.0, 5.0], count) * g.random(count)
        base = base_from_ior(g.uniform(0.03, 4.0, count) + 1j * k)
    else:
        f0 = g.choice([0.0, 1e-9, 0.04, 0.5, 0.9, 0.9999, 1.0], (count, 3))
        base = base_from_f0(f0)
    return Film.of(cosine, thickness_nm, g.uniform(1.0, 2.6, count), base, outside)


@pytest.mark.parametrize("thickest_nm", [800.0, 3000.0])
def test_colours_are_those_of_the_truth(thickest_nm: float) -> None:
    film = published_set(200, thickest_nm)
    delta_e = delta_e_2000(evaluate_fourier(film, "D65").rgb, evaluate_spectral(film, "D65").rgb)
    assert np.percentile(delta_e, 95) <= 0.01
    assert delta_e.max() <= 0.1


@pytest.mark.parametrize(("tolerance", "white"), [(1e-3, "D65"), (1e-4, "E"), (2e-5, "D65")])
def test_what_is_left_out_stays_below_the_tolerance(tolerance: float, white: White) -> None:
    film = published_set(120, 3000.0)
    error = evaluate_fourier(film, white, tolerance=tolerance).rgb - evaluate_spectral(film, white).rgb
    assert np.abs(error).max() <= tolerance
    assert np.abs(error).max() > 0.05 * tolerance  # nor is it so cautious that the tolerance says nothing


@pytest.mark.parametrize("kind", ["real", "absorbing", "per channel"])
def test_hard_cases_keep_the_tolerance_too(kind: str) -> None:
    film = adversarial(kind)
    rgb = evaluate_fourier(film, "D65").rgb
    assert np.abs(rgb - evaluate_spectral(film, "D65").rgb).max() <= 1e-4


def test_no_thickness_is_the_bare_base() -> None:
    cosine = np.linspace(0.0, 1.0, 7)[:, None]
    film = Film.of(cosine, 0.0, np.array([1.1, 1.5, 2.4]), base_from_ior(np.array([1.5, 0.2 + 3j, 2.0])))
    bare = Film.of(cosine, 0.0, 1.0, base_from_ior(np.array([1.5, 0.2 + 3j, 2.0])))
    difference = evaluate_fourier(film, "D65").rgb - evaluate_spectral(bare, "D65").rgb
    assert np.abs(difference).max() <= 1e-9


@pytest.mark.parametrize("backend", ["numpy", pytest.param("numba", marks=needs_numba)])
@pytest.mark.parametrize("index", [0.0, 1e-30, 0.0 + 1e-30j])
def test_a_base_without_index_reflects_everything(index: complex, backend: Backend) -> None:
    film = Film.of(np.array([0.0, 0.3, 1.0]), 300.0, 1.4, base_from_ior(index))
    assert np.array_equal(evaluate_fourier(film, "D65", backend=backend).rgb, np.ones((3, 3)))


def test_colours_take_no_step_where_a_term_comes_in() -> None:
    """Ten thousand films a hair apart: the largest step is the slope's, not the tolerance's."""
    thickness_nm = np.linspace(300.0, 300.5, 10_001)
    rgb = evaluate_fourier(
        Film.of(0.4, thickness_nm, 2.0, base_from_ior(0.3 + 3j)), "D65", tolerance=1e-3
    ).rgb
    assert np.abs(np.diff(rgb, axis=0)).max() <= 1e-6


def test_the_thin_end_meets_the_series() -> None:
    """On either side of the change to integration the colours are as near as the tolerance says."""
    thickness_nm = THIN_OPD_NM / (2.0 * 1.5) * np.array([1.0 - 1e-12, 1.0 + 1e-12])
    rgb = evaluate_fourier(
        Film.of(1.0, thickness_nm, 1.5, base_from_ior(0.5 + 4j)), "D65", tolerance=1e-6
    ).rgb
    assert np.abs(rgb[0] - rgb[1]).max() <= 1e-6


def test_total_reflection_on_the_base_is_white_and_a_thin_frustrated_film_is_not() -> None:
    inside = evaluate_fourier(Film.of(0.3, 400.0, 1.8, base_from_ior(1.2), 1.6), "D65").rgb
    assert np.abs(inside - 1.0).max() <= 1e-12
    film = Film.of(0.3, np.array([30.0, 5000.0]), 1.1, base_from_ior(1.6), 1.6)
    rgb = evaluate_fourier(film, "D65").rgb
    assert rgb[0].max() < 0.5
    assert np.abs(rgb[1] - 1.0).max() <= 1e-6


def test_each_channel_has_a_base_of_its_own() -> None:
    f0 = np.array([0.95, 0.64, 0.54])
    coloured = evaluate_fourier(Film.of(0.7, 350.0, 1.4, base_from_f0(f0)), "D65").rgb
    for channel in range(3):
        grey = evaluate_fourier(Film.of(0.7, 350.0, 1.4, base_from_f0(np.full(3, f0[channel]))), "D65").rgb
        assert coloured[channel] == grey[channel]


def test_constant_dispersions_are_constant_indices() -> None:
    constant = Film.of(0.6, 420.0, 1.4, base_from_ior(0.6 + 2.5j))
    base = base_from_dispersion(lambda nm: np.full(nm.shape, 0.6 + 2.5j))
    dispersive = Film.of(0.6, 420.0, lambda nm: np.full(nm.shape, 1.4), base)
    difference = evaluate_fourier(constant, "D65").rgb - evaluate_fourier(dispersive, "D65").rgb
    assert np.abs(difference).max() <= 1e-14


def test_indices_by_wavelength_are_taken_channel_by_channel() -> None:
    """A base that turns from bright to dark along the spectrum: one index for all would miss by a tenth."""
    base = base_from_dispersion(lambda nm: 0.3 + 1j * (1.0 + 3.0 * (nm - 360.0) / 470.0))
    film = Film.of(np.array([1.0, 0.5]), 250.0, 1.4, base)
    truth = evaluate_spectral(film, "D65").rgb
    one_index = Film(
        film.cos_theta_1, film.thickness_nm, film.film_ior, Base(base.f0, base.index), film.outside_ior
    )
    error = np.abs(evaluate_fourier(film, "D65").rgb - truth).max()
    assert error <= 0.02
    assert np.abs(evaluate_fourier(one_index, "D65").rgb - truth).max() >= 5.0 * error


@needs_numba
@pytest.mark.parametrize("kind", ["real", "absorbing", "per channel"])
def test_compiled_loops_give_the_same_colours(kind: str) -> None:
    for film in (adversarial(kind), published_set(500, 3000.0)):
        rgb = [evaluate("fourier", film, backend=backend).rgb for backend in ("numpy", "numba")]
        assert np.abs(rgb[0] - rgb[1]).max() <= 1e-13


@needs_numba
def test_the_compiled_text_gives_the_same_colours_and_the_same_nan() -> None:
    for film in (adversarial("real"), adversarial("per channel"), published_set(500, 3000.0)):
        rgb = [evaluate("khr", film, backend=backend).rgb for backend in ("numpy", "numba")]
        assert np.array_equal(np.isnan(rgb[0]), np.isnan(rgb[1]))
        assert np.nanmax(np.abs(rgb[0] - rgb[1])) <= 1e-13


def test_scalars_and_empty_films_keep_their_shapes() -> None:
    assert evaluate("fourier", Film.of(0.5, 300.0, 1.4, base_from_ior(1.5))).rgb.shape == (3,)
    assert evaluate("fourier", Film.of(np.zeros((2, 0)), 300.0, 1.4, base_from_ior(1.5))).rgb.shape == (
        2,
        0,
        3,
    )
