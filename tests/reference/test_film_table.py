"""Films by polynomial against the method that they stand for."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from numpy.testing import assert_allclose

from gltf_iri.evaluation.film import Evaluation, Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.reference.film_table import TabulatedFilm


class Counted:
    """Counts the films that a method is asked for."""

    def __init__(self, method: str) -> None:
        self.asked, self._method = 0, partial(evaluate, method)

    def __call__(self, film: Film) -> Evaluation:
        self.asked += int(np.prod(film.shape))
        return self._method(film)


@pytest.mark.parametrize("f0", [[0.04, 0.04, 0.04], [0.9, 0.6, 0.3], [0.0, 0.2, 0.99]])
@pytest.mark.parametrize("thickness_nm", [0.0, 400.0])
def test_the_truth_is_met_between_the_nodes(f0: list[float], thickness_nm: float) -> None:
    cosine = np.concatenate([np.linspace(0, 1, 30), [1e-4, 1e-3, 1e-2]])
    film = Film.of(cosine, thickness_nm, 1.3, base_from_f0(np.tile(f0, (33, 1))))
    table = TabulatedFilm(partial(evaluate, "spectral"))
    truth = evaluate("spectral", film)
    found = table(film)
    assert_allclose(found.rgb, truth.rgb, atol=1e-6)
    assert (found.method, found.white) == (truth.method, truth.white)


def test_many_points_cost_few_films() -> None:
    method = Counted("spectral")
    table = TabulatedFilm(method)
    base = base_from_f0(np.tile([0.04, 0.04, 0.04], (5000, 1)))
    for seed in (0, 1):
        table(Film.of(np.random.default_rng(seed).random(5000), 400.0, 1.3, base))
    assert method.asked < 500


def test_films_of_a_texture_are_evaluated_one_by_one() -> None:
    thickness = np.linspace(100, 400, 40)
    film = Film.of(np.full(40, 0.5), thickness, 1.3, base_from_f0(np.full((40, 3), 0.04)))
    method = Counted("khr-guarded")
    assert_allclose(TabulatedFilm(method)(film).rgb, evaluate("khr-guarded", film).rgb, rtol=0)
    assert method.asked == 40


def test_what_no_polynomial_follows_is_evaluated_itself() -> None:
    film = Film.of(np.linspace(0, 1, 40), 400.0, 1.3, base_from_f0(np.full((40, 3), 1.0)))
    table = TabulatedFilm(partial(evaluate, "khr"))
    found, expected = table(film), evaluate("khr", film)
    assert_allclose(found.rgb, expected.rgb, atol=1e-6)
    assert found.undefined.keys() == expected.undefined.keys()
