"""A film of varying thickness is the average over thickness, here summed over the truth by brute force."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from gltf_iri.evaluation.bb17 import evaluate_bb17, prefiltered_bb17
from gltf_iri.evaluation.film import Base, Film, base_from_ior
from gltf_iri.evaluation.fourier import evaluate_fourier
from gltf_iri.evaluation.prefiltered import prefiltered_fourier
from gltf_iri.evaluation.spectral import evaluate_spectral

STEPS = np.linspace(-6.0, 6.0, 121)
WEIGHTS = np.exp(-0.5 * STEPS**2) / np.exp(-0.5 * STEPS**2).sum()


def films(spread_nm: float) -> Film:
    g = np.random.default_rng(3)
    base = base_from_ior(np.where(np.arange(8) % 2, g.uniform(1.2, 2.5, 8), g.uniform(0.1, 1.5, 8) + 2.5j))
    return Film.of(
        g.uniform(0.1, 1.0, 8), 6.0 * spread_nm + g.uniform(50.0, 600.0, 8), g.uniform(1.2, 2.2, 8), base
    )


def averaged(film: Film, spread_nm: float, colour: Callable[[Film], np.ndarray]) -> np.ndarray:
    around = film.thickness_nm + spread_nm * STEPS[:, None]
    base = Base(film.base.f0, film.base.index)
    rgb = colour(Film(film.cos_theta_1, around, film.film_ior, base, film.outside_ior))
    return np.asarray(np.einsum("k,krc->rc", WEIGHTS, rgb))


@pytest.mark.parametrize("spread_nm", [4.0, 25.0, 90.0])
def test_a_spread_of_thickness_is_the_average_of_the_truth(spread_nm: float) -> None:
    film = films(spread_nm)
    truth = averaged(film, spread_nm, lambda f: evaluate_spectral(f, "D65").rgb)
    assert np.abs(prefiltered_fourier(film, spread_nm, "D65") - truth).max() <= 1e-4
    assert np.abs(prefiltered_fourier(film, spread_nm, "D65", 1e-7) - truth).max() <= 2e-6


@pytest.mark.parametrize("spread_nm", [4.0, 90.0])
def test_the_fits_spread_in_closed_form(spread_nm: float) -> None:
    film = films(spread_nm)
    average = averaged(film, spread_nm, lambda f: evaluate_bb17(f, "E").rgb)
    assert np.abs(prefiltered_bb17(film, spread_nm, "E") - average).max() <= 1e-8


def test_no_spread_changes_nothing() -> None:
    film = films(0.0)
    difference = prefiltered_fourier(film, 0.0, "E") - evaluate_fourier(film, "E").rgb
    assert np.abs(difference).max() <= 1e-14


def test_a_wide_spread_leaves_grey() -> None:
    rgb = prefiltered_fourier(Film.of(0.8, 9000.0, 1.5, base_from_ior(2.0)), 1500.0, "D65")
    assert np.ptp(rgb) <= 1e-6


def test_films_without_a_series_are_averaged_too() -> None:
    """A thin film and a frustrated one, for which colours are integrated at each thickness."""
    film = Film.of(
        np.array([1.0, 0.2]),
        np.array([6.0, 60.0]),
        np.array([1.3, 1.1]),
        base_from_ior(1.5),
        np.array([1.0, 1.5]),
    )
    truth = averaged(film, 1.0, lambda f: evaluate_spectral(f, "D65").rgb)
    assert np.abs(prefiltered_fourier(film, 1.0, "D65") - truth).max() <= 1e-7


def test_spread_wider_than_the_film_is_the_average_over_what_lies_above() -> None:
    """A film of half a fringe, spread over three: real bases look the same from below thickness 0."""
    film = Film.of(np.array([0.2, 0.9]), 60.0, 1.6, base_from_ior(np.array([1.9, 2.4])))
    steps = np.linspace(-6.0, 6.0, 601)
    weights = np.exp(-0.5 * steps**2) / np.exp(-0.5 * steps**2).sum()
    around = Film.of(film.cos_theta_1, np.abs(60.0 + 200.0 * steps)[:, None], film.film_ior, film.base)
    truth = np.einsum("k,krc->rc", weights, evaluate_spectral(around, "D65").rgb)
    assert np.abs(prefiltered_fourier(film, 200.0, "D65", 1e-7) - truth).max() <= 2e-6
