"""Names, functions and descriptors of methods say the same."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

from gltf_iri.colour.wavelength_grid import GRID_SAMPLES_MAX, GRID_SAMPLES_MIN
from gltf_iri.colour.wavenumber_rule import SAMPLES_MAX, SAMPLES_MIN
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.registry import EVALUATORS, evaluate
from gltf_iri.optics.landmarks import ROOT_FINDERS
from gltf_iri.planning.method import METHODS, method_names

FILM = Film.of(0.8, 300.0, 1.3, base_from_ior(1.5))


def test_every_method_has_an_evaluator_and_no_other() -> None:
    assert set(EVALUATORS) == set(METHODS)


@pytest.mark.parametrize("name", METHODS)
def test_evaluators_take_what_their_descriptors_say_with_the_same_defaults(name: str) -> None:
    described = {each.name: each.default for each in METHODS[name].parameters}
    if len(METHODS[name].backends) > 1:
        described["backend"] = "numpy"
    _, _, *chosen = inspect.signature(EVALUATORS[name]).parameters.values()
    assert {each.name: each.default for each in chosen} == described
    assert all(each.kind is inspect.Parameter.KEYWORD_ONLY for each in chosen)


def test_bounds_and_words_are_those_of_the_formulas() -> None:
    described = {(name, each.name): each for name, method in METHODS.items() for each in method.parameters}
    assert described["landmarks", "root_finder"].choices == ROOT_FINDERS
    ranges = {
        "bloch": (SAMPLES_MIN, SAMPLES_MAX),
        "spectral-grid": (GRID_SAMPLES_MIN, GRID_SAMPLES_MAX),
        "yeh-grid": (GRID_SAMPLES_MIN, GRID_SAMPLES_MAX),
    }
    for name, limits in ranges.items():
        samples = described[name, "samples"]
        assert (samples.minimum, samples.maximum) == limits


@pytest.mark.parametrize("name", method_names("film"))
def test_arrays_broadcast(name: str) -> None:
    film = Film.of(np.linspace(0.1, 1, 4)[:, None], [100.0, 200.0, 300.0], 1.3, base_from_f0([0.9, 0.6, 0.3]))
    evaluation = evaluate(name, film)
    assert evaluation.rgb.shape == (4, 3, 3)
    assert evaluation.method == name
    single = evaluate(name, Film.of(0.1, 200.0, 1.3, base_from_f0([0.9, 0.6, 0.3]))).rgb
    assert np.abs(evaluation.rgb[0, 1] - single).max() <= 1e-9


@pytest.mark.parametrize("name", method_names("film"))
def test_no_films_give_no_colours(name: str) -> None:
    assert evaluate(name, Film.of(np.zeros(0), 300.0, 1.3, base_from_ior(1.5))).rgb.shape == (0, 3)


def test_unknown_names_are_refused() -> None:
    with pytest.raises(UsageError, match="no method 'KHR'"):
        evaluate("KHR", FILM)
    with pytest.raises(UsageError, match="no white 'D50'"):
        evaluate("khr", FILM, white="D50")


@pytest.mark.parametrize(
    "bad",
    [
        {"cos_theta_1": 1.1},
        {"cos_theta_1": -0.1},
        {"cos_theta_1": np.nan},
        {"thickness_nm": -1.0},
        {"thickness_nm": np.inf},
        {"film_ior": 0.0},
        {"film_ior": np.nan},
        {"outside_ior": -1.0},
        {"thickness_nm": 1e300},
        {"film_ior": 1e200},
        {"outside_ior": 1e-300},
    ],
)
def test_films_that_cannot_be_are_refused(bad: dict[str, float]) -> None:
    good = {"cos_theta_1": 0.5, "thickness_nm": 300.0, "film_ior": 1.3, "outside_ior": 1.0}
    with pytest.raises(UsageError):
        Film.of(**(good | bad), base=base_from_ior(1.5))


def test_bases_that_cannot_be_are_refused() -> None:
    for f0 in ([0.1, 0.2], [-0.1, 0, 0], [0, 0, 1.1], [0, 0, np.nan]):
        with pytest.raises(UsageError):
            base_from_f0(f0)
    for index in (-1.0, 1.5 - 0.1j, np.nan, np.inf, 1e200):
        with pytest.raises(UsageError):
            base_from_ior(index)


@pytest.mark.parametrize("name", ["khr", "khr-guarded"])
@pytest.mark.parametrize("extreme", [1e-6, 1e6])
def test_the_most_extreme_film_still_has_a_colour(name: str, extreme: float) -> None:
    for film_ior, outside_ior, base_ior in ((extreme, 1, 1.5), (1.3, extreme, 1.5), (1.3, 1, extreme)):
        film = Film.of([1e-300, 1.0], 1e12, film_ior, base_from_ior(base_ior), outside_ior)
        evaluation = evaluate(name, film)  # without a warning, which would be an error here
        undefined = np.logical_or.reduce([*evaluation.undefined.values(), np.zeros(2, bool)])
        assert np.all(np.isfinite(evaluation.rgb).all(axis=-1) | undefined)
