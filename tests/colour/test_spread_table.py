"""Ŝ(D, s) of the table against plain sums over the spectrum, and its bounds."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.colour.quadrature import colour_density
from gltf_iri.colour.sensitivity_table import END_NM, sensitivity_table
from gltf_iri.colour.spaces import White
from gltf_iri.colour.spread_table import spread_table

NM = np.arange(360.05, 830.0, 0.1)

# The cubics' own error, and the interpolation between spreads.
ERROR = 6e-6


def exact(opd_nm: NDArray[np.float64], spread_nm: float, white: White) -> NDArray[np.complex128]:
    """Midpoint sums over tenths of a nanometre: kinks lie at whole ones, fringes are resolved to 20 µm."""
    weights = 0.1 * colour_density(NM, white) * np.exp(-2.0 * (np.pi * spread_nm / NM[:, None]) ** 2)
    return np.asarray(np.exp(2j * np.pi * opd_nm[:, None] / NM) @ weights)


@pytest.mark.parametrize("white", ["D65", "E"])
@pytest.mark.parametrize("spread_nm", [0.0, 3.0, 6.25, 20.0, 111.0, 318.0, 500.0, 640.0, 2000.0])
def test_values_and_bounds_are_those_of_the_spectrum(white: White, spread_nm: float) -> None:
    opd_nm = np.concatenate([np.arange(0.0, 3000.0, 13.7), np.arange(3000.0, 20_000.0, 331.0)])
    table, spread = spread_table(white), np.full(len(opd_nm), spread_nm)
    truth = exact(opd_nm, spread_nm, white)
    assert np.abs(table.at(opd_nm, spread) - truth).max() <= ERROR
    assert np.array_equal(table.at(opd_nm, spread, real_only=True), table.at(opd_nm, spread).real)
    assert np.all(np.abs(truth).max(axis=-1) <= table.bound(opd_nm, spread) + 2e-8)


def test_without_a_spread_it_is_the_plain_table() -> None:
    opd_nm = np.linspace(0.0, END_NM, 5000)
    plain = sensitivity_table("D65")
    assert np.abs(spread_table("D65").at(opd_nm, np.zeros(5000)) - plain.at(opd_nm)).max() <= 1e-15
    assert np.array_equal(spread_table("D65").bound(opd_nm, np.zeros(5000)), plain.bound(opd_nm))


def test_bounds_never_rise() -> None:
    g = np.random.default_rng(4)
    opd_nm, spread_nm = g.uniform(0.0, 2e4, 3000), g.uniform(0.0, 700.0, 3000)
    table = spread_table("D65")
    here = table.bound(opd_nm, spread_nm)
    assert np.all(table.bound(opd_nm + 50.0, spread_nm) <= here + 1e-12)
    assert np.all(table.bound(opd_nm, spread_nm + 9.0) <= here + 1e-12)
