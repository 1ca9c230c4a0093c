"""Method `bb17`: what the fits and the cut series get right, and what they break."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from gltf_iri.bench.film_set import film_set
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.evaluation.bb17 import evaluate_bb17
from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.spectral import evaluate_spectral
from gltf_iri.planning.method import find_method


def test_orders_bring_it_nearer_to_the_truth_and_its_row_says_how_near() -> None:
    film = film_set(400)
    truth = evaluate_spectral(film, "D65").rgb
    means = [float(delta_e_2000(evaluate_bb17(film, "D65", orders=m).rgb, truth).mean()) for m in (1, 2, 3)]
    assert means[0] > means[1] > means[2]
    assert means[2] == pytest.approx(find_method("bb17").delta_e_mean, abs=0.06)


def test_each_order_asked_for_is_one_fringe_more() -> None:
    """None leaves the interfaces' mean, a spectrum without fringes, which is grey; each one adds less."""
    film = Film.of(0.8, np.linspace(100.0, 700.0, 31), 1.5, base_from_ior(2.2))
    rgb = [evaluate_bb17(film, "D65", orders=m).rgb for m in range(5)]
    assert np.ptp(rgb[0]) <= 1e-14
    steps = [np.abs(more - less).max() for less, more in itertools.pairwise(rgb)]
    assert steps[0] > 0.05
    assert all(later < earlier for earlier, later in itertools.pairwise(steps))


def test_its_white_is_e() -> None:
    mirror = Film.of(np.linspace(0.0, 1.0, 5), 350.0, 1.4, base_from_f0(np.ones(3)))
    assert np.abs(evaluate_bb17(mirror, "D65").rgb - 1.0).max() <= 1e-14
    # A film too thick for fringes is as grey as its mean.
    thick = evaluate_bb17(Film.of(0.9, 1e5, 1.5, base_from_ior(2.0)), "D65").rgb
    assert np.ptp(thick) <= 1e-14


def test_it_knows_no_illuminant() -> None:
    film = film_set(20)
    assert np.array_equal(evaluate("bb17", film, white="D65").rgb, evaluate("bb17", film, white="E").rgb)


def test_total_reflection_of_the_film_is_all_reflected() -> None:
    film = Film.of(0.2, np.array([10.0, 900.0]), 1.1, base_from_ior(1.6), 1.6)
    assert (evaluate_bb17(film, "D65").rgb == 1.0).all()


def test_bb17_breaks_it_a_cut_series_is_no_bare_base_at_no_thickness() -> None:
    films = Film.of(0.2, 0.0, np.array([1.1, 2.4]), base_from_ior(1.05))
    assert np.ptp(evaluate_bb17(films, "D65").rgb, axis=0).max() > 0.01
