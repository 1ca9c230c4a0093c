"""Sensitivities under a spread of path differences, against plain sums over the spectrum."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.colour.damped_sensitivity import (
    DAMPING_PER_NM2,
    SPREAD_END_NM,
    SPREADS,
    damped_sensitivity,
    spread_bounds,
    spreads_nm,
)
from gltf_iri.colour.quadrature import colour_density
from gltf_iri.colour.sensitivity_table import END_NM, TABLE_ERROR
from gltf_iri.colour.spaces import White
from gltf_iri.tolerances import SPREAD_TABLE_ERROR

Float64 = np.ndarray[tuple[int, ...], np.dtype[np.float64]]

NM = np.arange(360.05, 830.0, 0.1)


def exact(opd_nm: Float64, spread_nm: float, white: White) -> Float64:
    """Midpoint sums over tenths of a nanometre: kinks lie at whole ones, fringes are resolved to 20 µm."""
    weights = 0.1 * colour_density(NM, white) * np.exp(-2.0 * (np.pi * spread_nm / NM[:, None]) ** 2)
    return np.asarray(np.cos(2.0 * np.pi * opd_nm[:, None] / NM) @ weights)


@pytest.fixture(scope="module", params=["D65", "E"])
def table(request: pytest.FixtureRequest) -> tuple[White, Float64, Float64]:
    return request.param, *damped_sensitivity(request.param)


@pytest.fixture(scope="module")
def place() -> Float64:
    return np.unique(np.r_[0:2000:13, 2000:9000:151, 9000:24000:1009])


def test_rows_are_the_spectrum_damped_by_each_spread(
    table: tuple[White, Float64, Float64], place: Float64
) -> None:
    white, opd_nm, damped = table
    spreads = spreads_nm()
    assert (spreads[0], spreads[-1], len(spreads)) == (0.0, pytest.approx(SPREAD_END_NM), SPREADS)
    assert opd_nm[-1] == END_NM
    for row in (0, 1, 4, 12, SPREADS - 1):
        error = np.abs(damped[row, place] - exact(opd_nm[place], spreads[row], white)).max()
        assert error <= (TABLE_ERROR if row == 0 else 1e-6)


def test_lines_between_two_spreads_err_by_less_than_is_said(
    table: tuple[White, Float64, Float64], place: Float64
) -> None:
    white, opd_nm, damped = table
    squared = spreads_nm() ** 2
    damping = np.array(DAMPING_PER_NM2)
    for row in range(SPREADS - 1):
        low, high = squared[row], squared[row + 1]
        u = 0.5 * (low + high)
        narrower, wider = np.exp(-damping * (u - low)), np.exp(damping * (high - u))
        line = 0.5 * (narrower * damped[row, place] + wider * damped[row + 1, place])
        assert np.abs(line - exact(opd_nm[place], np.sqrt(u), white)).max() <= SPREAD_TABLE_ERROR


def test_next_to_nothing_is_left_of_the_widest_spread(table: tuple[White, Float64, Float64]) -> None:
    assert np.abs(table[2][-1]).max() < 2e-5


def test_bounds_hold_for_all_that_lies_farther_and_wider(
    table: tuple[White, Float64, Float64], place: Float64
) -> None:
    white, opd_nm, damped = table
    bounds = spread_bounds(damped)
    assert np.all(np.diff(bounds, axis=0) <= 0.0)
    assert np.all(np.diff(bounds, axis=1) <= 0.0)
    squared = spreads_nm() ** 2
    for row in range(0, SPREADS - 1, 3):
        u = squared[row] + 0.4 * (squared[row + 1] - squared[row])
        line = 0.6 * bounds[row, place] + 0.4 * bounds[row + 1, place]
        assert np.all(np.abs(exact(opd_nm[place], np.sqrt(u), white)).max(axis=-1) <= line + 1e-12)
