"""The published figures of the film set are found again."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.bench.colour_rows import ColourRow
from gltf_iri.bench.film_set import film_set
from gltf_iri.bench.films import measure_films, thicker_film_set
from gltf_iri.planning.method import METHODS, method_names

# ΔE2000 mean and 95th percentile on the film set, D65, computed by independent throw-away code before this
# package existed; a dash there means "rounds to zero".
PUBLISHED = {
    "khr": (3.86, 9.0),
    "khr, exact sensitivity": (3.16, 8.7),
    "exact interfaces, m ≤ 1": (0.72, 3.3),
    "exact interfaces, m ≤ 2": (0.091, 0.42),
    "exact interfaces, m ≤ 3": (0.018, 0.05),
}
TOLERANCE = 0.05


@pytest.fixture(scope="module")
def rows() -> list[ColourRow]:
    return measure_films(rounds=1)


def first(rows: list[ColourRow], method: str) -> ColourRow:
    """Return the row of a method with its defaults."""
    return next(row for row in rows if row.method == method)


@pytest.mark.parametrize("method", PUBLISHED)
def test_published_mean_and_p95_are_found_again(method: str, rows: list[ColourRow]) -> None:
    row = first(rows, method)
    assert (row.delta_e_mean, row.delta_e_p95) == pytest.approx(PUBLISHED[method], rel=TOLERANCE)


def test_six_orders_are_as_good_as_the_truth(rows: list[ColourRow]) -> None:
    row = first(rows, "exact interfaces, m ≤ 6")
    assert row.delta_e_mean < 5e-4
    assert row.delta_e_p95 < 5e-4


@pytest.mark.parametrize(
    "method", [name for name in method_names("film") if METHODS[name].delta_e_mean is not None]
)
def test_descriptors_state_what_is_measured(method: str, rows: list[ColourRow]) -> None:
    assert first(rows, method).delta_e_mean == pytest.approx(METHODS[method].delta_e_mean, rel=1e-3, abs=0.01)


def test_every_method_and_backend_has_its_row(rows: list[ColourRow]) -> None:
    measured = {(row.method, row.backend) for row in rows}
    assert measured >= {
        (name, backend) for name in method_names("film") for backend in METHODS[name].backends
    }
    assert all(row.ns_per_eval > 0.0 for row in rows)


def test_backends_are_equally_far_from_the_truth(rows: list[ColourRow]) -> None:
    for row in rows:
        twin = next(other for other in rows if other.label == row.label and other.backend == "numpy")
        assert row.max_abs == pytest.approx(twin.max_abs, abs=1e-12)


def test_thicker_films_are_the_same_draws() -> None:
    g = np.random.default_rng(0)
    drawn = [
        (g.uniform(1.1, 2.2), g.uniform(100, 3000), g.uniform(1.2, 2.5), g.uniform(0.05, 1)) for _ in range(5)
    ]
    thicker = thicker_film_set()
    np.testing.assert_allclose(thicker.thickness_nm[:5], [d for _, d, _, _ in drawn], rtol=1e-12)
    np.testing.assert_array_equal(thicker.film_ior[:5], [n for n, _, _, _ in drawn])
    np.testing.assert_array_equal(thicker.cos_theta_1, film_set().cos_theta_1)
