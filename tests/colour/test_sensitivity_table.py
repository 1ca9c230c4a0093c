"""The tabulated transform of the colour densities, held to 50 digits and to what a bound must do."""

from __future__ import annotations

import numpy as np
import pytest
from mpmath import mp, mpf

from gltf_iri.colour.observer import illuminant, observer_table
from gltf_iri.colour.quadrature import colour_density, colour_rule
from gltf_iri.colour.sensitivity import GAUSSIANS, eval_sensitivity, gaussian_transform
from gltf_iri.colour.sensitivity_table import (
    CELLS,
    END_NM,
    FADE_NM,
    STEP_NM,
    TABLE_ERROR,
    rgb_density,
    sensitivity_table,
    tabulate_sensitivity,
)
from gltf_iri.colour.spaces import XYZ_TO_REC709, White
from gltf_iri.errors import UsageError


def by_product_integration(opd_nm: np.ndarray, white: White) -> np.ndarray:
    """Another road than the table's: Chebyshev moments of the densities instead of Gauss points."""
    rule = colour_rule(512, white)
    return np.asarray(np.exp(2j * np.pi * opd_nm[:, None] / rule.wavelength_nm) @ rule.weights)


def at_50_digits(opd_nm: float, white: White) -> list[complex]:
    """Each nanometre's panel: a quadratic density, summed by mpmath's own quadrature."""
    with mp.workdps(50):
        total = [mpf(0)] * 3
        for low in range(360, 830):
            nodes = [(mpf(low) + (1 + x) / 2, w / 2) for x, w in LEGENDRE]
            density = colour_density(np.array([low, low + 0.5, low + 1.0]), white)
            for wavelength, weight in nodes:
                turn = mp.expjpi(2 * mpf(opd_nm) / wavelength)
                t = wavelength - low
                for c in range(3):
                    a, b, e = (mpf(float(v)) for v in density[:, c])
                    # Through both ends and the middle; observer and light are linear between them.
                    value = a * (1 - t) * (1 - 2 * t) + 4 * b * t * (1 - t) + e * t * (2 * t - 1)
                    total[c] = total[c] + weight * value * turn
        return [complex(value) for value in total]


def _legendre(count: int) -> list[tuple[mpf, mpf]]:
    with mp.workdps(50):
        roots = [
            mp.findroot(lambda x: mp.legendre(count, x), float(x))
            for x in np.polynomial.legendre.leggauss(count)[0]
        ]
        return [(x, 2 / ((1 - x * x) * mp.diff(lambda y: mp.legendre(count, y), x) ** 2)) for x in roots]


LEGENDRE = _legendre(6)


@pytest.mark.parametrize("white", ["D65", "E"])
def test_the_table_errs_by_less_than_it_says(white: White) -> None:
    opd_nm = np.concatenate(
        [np.linspace(0.0, 4000.0, 1501), np.geomspace(4000.0, END_NM - FADE_NM, 1500), [END_NM - FADE_NM]]
    )
    error = np.abs(sensitivity_table(white).at(opd_nm) - by_product_integration(opd_nm, white))
    assert error.max() <= TABLE_ERROR


@pytest.mark.parametrize("opd_nm", [613.0, 8007.0])
def test_the_nodes_are_exact_to_fifty_digits(opd_nm: float) -> None:
    """At a cell's own points nothing is interpolated: what is left is the rounding of the sum."""
    table = sensitivity_table("D65")
    node = STEP_NM * round(opd_nm / STEP_NM)
    assert np.abs(table.at(node) - np.array(at_50_digits(node, "D65"))).max() <= 1e-12


@pytest.mark.parametrize("white", ["D65", "E"])
def test_no_path_difference_is_white(white: White) -> None:
    assert np.abs(sensitivity_table(white).at(0.0) - 1.0).max() <= 1e-14


def test_cells_meet() -> None:
    edges = STEP_NM * np.arange(1, CELLS)
    table = sensitivity_table("D65")
    jumps = np.abs(table.at(np.nextafter(edges, 0.0)) - table.at(edges))
    assert jumps.max() <= 1e-14
    assert np.abs(table.at(np.nextafter(END_NM, 0.0))).max() <= 1e-14
    assert not table.at(np.array([END_NM, 1e300])).any()


def test_negative_paths_are_conjugate_and_nan_stays() -> None:
    table = sensitivity_table("E")
    assert np.array_equal(table.at(-777.0), table.at(777.0).conj())
    assert np.isnan(table.at(np.nan)).all()


@pytest.mark.parametrize("white", ["D65", "E"])
def test_the_envelope_bounds_all_that_follows(white: White) -> None:
    table = sensitivity_table(white)
    opd_nm = np.linspace(0.0, END_NM - FADE_NM, 40_001)
    size = np.abs(by_product_integration(opd_nm[::8], white)).max(axis=1)
    follows = np.maximum.accumulate(size[::-1])[::-1]
    assert (table.bound(opd_nm[::8]) >= follows).all()
    assert (np.diff(table.bound(opd_nm)) <= 0.0).all()
    assert table.bound(END_NM) == 0.0


@pytest.mark.parametrize("white", ["D65", "E"])
def test_what_the_tables_end_leaves_out_is_bounded(white: White) -> None:
    """Under E kinks a nanometre apart make Ŝ rise again, to its greatest beyond the end at 0.19 mm."""
    beyond_nm = np.concatenate(
        [np.linspace(END_NM - FADE_NM, 1.1 * END_NM, 80), np.linspace(188e3, 190e3, 40)]
    )
    nodes, gauss = np.polynomial.legendre.leggauss(12)
    wavelength_nm = (np.arange(360.0, 830.0)[:, None] + 0.5 * (1.0 + nodes)).reshape(-1)
    density = colour_density(wavelength_nm, white) * np.tile(0.5 * gauss, 470)[:, None]
    size = np.abs(np.exp(2j * np.pi * beyond_nm[:, None] / wavelength_nm) @ density).max()
    beyond = sensitivity_table(white).beyond
    assert 0.9 * beyond <= size <= beyond


def test_beyond_the_reach_fringes_are_as_weak_as_was_asked() -> None:
    """Under D65 below 0.02 from 8 µm and below 0.005 from 20 µm on; the same rule in any white."""
    table = sensitivity_table("D65")
    assert 6000.0 < table.reach_nm(0.02) < 8000.0
    assert 15_000.0 < table.reach_nm(0.005) <= 20_000.0
    assert table.reach_nm(0.02) < table.reach_nm(0.005)
    for epsilon in (0.05, 0.005, 0.001):
        reach = table.reach_nm(epsilon)
        further = reach + np.linspace(0.0, 20_000.0, 4001)
        assert np.abs(by_product_integration(further, "D65")).max() <= epsilon
        assert table.bound(reach - 3.0 * STEP_NM) > epsilon
    assert table.reach_nm(1e-9) == END_NM
    assert table.reach_nm(2.0) == 0.0


def test_any_light_and_space_can_be_tabulated() -> None:
    """XYZ under a single line of 550 ± 1 nm turns once in 550 nm, in each channel alike."""

    def line(wavelength_nm: np.ndarray) -> np.ndarray:
        return np.maximum(0.0, 1.0 - np.abs(wavelength_nm - 550.0))

    table = tabulate_sensitivity(rgb_density(line, np.eye(3)))
    assert np.abs(table.at(550.0) - 1.0).max() <= 1e-3  # the observer leans within the line
    assert np.abs(table.at(275.0) + 1.0).max() <= 1e-3


def test_a_channel_that_sees_nothing_is_refused() -> None:
    with pytest.raises(UsageError, match="sees nothing"):
        tabulate_sensitivity(rgb_density(lambda nm: np.zeros_like(nm), XYZ_TO_REC709))


def test_a_spread_of_paths_is_the_average_over_them() -> None:
    density = rgb_density(lambda nm: illuminant(nm, "D65"), XYZ_TO_REC709)
    spread_nm, opd_nm = 90.0, np.array([0.0, 310.0, 1500.0, 4200.0])
    steps = np.linspace(-7.0, 7.0, 141)
    weights = np.exp(-0.5 * steps**2) / np.exp(-0.5 * steps**2).sum()
    around = (opd_nm[:, None] + spread_nm * steps).reshape(-1)
    average = np.einsum("k,rkc->rc", weights, by_product_integration(around, "D65").reshape(4, 141, 3))
    table = tabulate_sensitivity(density, opd_std_nm=spread_nm)
    assert np.abs(table.at(opd_nm) - average).max() <= TABLE_ERROR


def test_the_fits_transform_is_the_texts_sensitivity() -> None:
    opd_nm, shift = np.linspace(0.0, 5000.0, 301), 0.7
    turned = (gaussian_transform(opd_nm) * np.exp(1j * shift)).real
    wanted = eval_sensitivity(opd_nm, np.full((301, 3), shift))
    assert np.abs(turned @ XYZ_TO_REC709.T - wanted).max() <= 1e-14


def test_the_fits_spread_is_the_average_over_paths() -> None:
    spread_nm, opd_nm = 150.0, np.array([0.0, 200.0, 900.0, 2500.0])
    steps = np.linspace(-8.0, 8.0, 401)
    weights = np.exp(-0.5 * steps**2) / np.exp(-0.5 * steps**2).sum()
    average = np.einsum("k,rkc->rc", weights, gaussian_transform(opd_nm[:, None] + spread_nm * steps))
    assert np.abs(gaussian_transform(opd_nm, spread_nm) - average).max() <= 1e-13


def test_the_fits_are_near_the_observer() -> None:
    """They were fitted to it: X, Y and Z under E within 0.07 of the exact transform at any path."""
    knots = observer_table()
    opd_nm = np.linspace(0.0, 8000.0, 401)
    turns = np.exp(2j * np.pi * opd_nm[:, None] / knots[:, 0])
    exact = (turns @ knots[:, 1:]) / knots[:, 1:].sum(axis=0)
    assert len(GAUSSIANS) == 4
    assert np.abs(gaussian_transform(opd_nm) - exact).max() <= 0.07
