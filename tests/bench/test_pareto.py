"""Pareto fronts and standings on rows made by hand."""

from __future__ import annotations

import math

import pytest

from gltf_iri.bench.accuracy_row import SHADINGS, AccuracyRow, Errors
from gltf_iri.bench.pareto import front, standing, standings
from gltf_iri.planning.costs import Device


def row(
    method: str | None, ns: float, p95: float, filling_ns: float | None = None, backend: Device = "numpy"
) -> AccuracyRow:
    """Return a row whose label tells it from others."""
    errors = Errors(p95, p95, p95, p95, 0)
    label = f"{method or 'table'} {ns:g}"
    return AccuracyRow("films", backend, label, label, method, ns, errors, filling_ns=filling_ns)


def test_the_front_is_the_cheapest_at_every_error() -> None:
    cheap, middle, exact = row("khr", 10.0, 2.0), row("fourier", 30.0, 0.1), row("fourier", 90.0, 1e-4)
    beaten, too_far = row("bb17", 50.0, 0.5), row("granier-heidrich", 1.0, 40.0)
    assert front([exact, beaten, too_far, middle, cheap]) == [cheap, middle, exact]


def test_the_front_ends_at_the_first_that_errs_little_enough() -> None:
    enough, better = row("fourier", 30.0, 5e-4), row("spectral", 900.0, 0.0)
    assert front([better, enough]) == [enough]


def test_of_equal_prices_the_better_stands_on_the_front() -> None:
    worse, better = row("khr", 10.0, 2.0), row("fourier", 10.0, 0.5)
    assert front([worse, better]) == [better]


def test_a_front_without_anybody_able_is_empty() -> None:
    assert front([row("khr", 10.0, 9.0), row("bb17", 1.0, math.nan)]) == []


def test_tables_cost_a_share_of_their_filling() -> None:
    table = row(None, 5.0, 0.1, filling_ns=20.0 * SHADINGS)
    assert table.ns == pytest.approx(25.0)
    assert front([table, row("fourier", 20.0, 0.1)])[0].method == "fourier"


def test_a_row_is_beaten_by_time_at_its_error_and_by_error_at_its_time() -> None:
    ours = [row("fourier", 20.0, 0.1), row(None, 10.0, 1.0)]
    published = row("bb17", 60.0, 2.0)
    found = standing(published, [published, *ours])
    assert found.slower == pytest.approx(6.0)
    assert found.further == pytest.approx(20.0)
    assert found.is_beaten


def test_a_row_that_nobody_of_ours_reaches_is_not_beaten() -> None:
    published = row("spectral-grid", 5.0, 0.01)
    found = standing(published, [published, row("fourier", 20.0, 0.1)])
    assert found.slower is None
    assert found.further is None
    assert not found.is_beaten


def test_errors_below_the_least_count_as_it() -> None:
    published = row("spectral-grid", 40.0, 0.0)
    found = standing(published, [published, row("fourier", 10.0, 9e-4)])
    assert found.slower == pytest.approx(4.0)
    assert found.further == pytest.approx(1.0)


def test_rows_are_judged_within_their_own_device_and_ours_are_not_judged() -> None:
    rows = [row("khr", 10.0, 9.0), row("fourier", 1.0, 0.1, backend="glsl"), row(None, 2.0, 0.1)]
    (found,) = standings(rows)
    assert found.row is rows[0]
    assert found.slower == pytest.approx(5.0)
