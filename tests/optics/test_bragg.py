"""Mirrors are what 50 digits say they are: any host, absorption, total reflection, up to 10⁶ cells."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.bench.fifty_digits import mirror_50_digits, stack_50_digits
from gltf_iri.optics.bragg import bragg_powers, bragg_reflectance
from gltf_iri.optics.bragg_cell import cell_optics
from gltf_iri.optics.film import film_reflectance

Float64 = NDArray[np.float64]
Draw = Callable[[np.random.Generator], tuple[complex, ...]]

COUNT = 120


def like_the_bench(g: np.random.Generator) -> tuple[complex, ...]:
    period_nm, share = g.uniform(150.0, 1000.0), g.uniform(0.1, 0.9)
    n2, cosine = g.uniform(1.3, 2.2), g.uniform(0.1, 1.0)
    return 1.0, 1.0, n2, share * period_nm, (1.0 - share) * period_nm, g.uniform(380.0, 780.0), cosine


def under_any_host(g: np.random.Generator) -> tuple[complex, ...]:
    """Total reflection in either film among them."""
    return *g.uniform(1.0, 2.5, 3), *g.uniform(20.0, 500.0, 2), g.uniform(380.0, 780.0), g.uniform(0.02, 1.0)


def absorbing(g: np.random.Generator) -> tuple[complex, ...]:
    k1, k2 = g.choice([0.0, 1e-6, 1e-3, 0.1, 1.0]), g.choice([1e-8, 1e-4, 1e-2, 1.0, 5.0])
    host, n1, n2, d1_nm, d2_nm, wavelength_nm, cosine = under_any_host(g)
    return host, n1 + 1j * k1, n2 + 1j * k2, d1_nm, d2_nm, wavelength_nm, cosine


def drawn(draw: Draw, count: int = COUNT) -> list[NDArray[np.complex128] | Float64]:
    """host, n1, n2, d1, d2, wavelength, cosine: real where all are."""
    g = np.random.default_rng(1988)
    columns = [np.array(column) for column in zip(*(draw(g) for _ in range(count)), strict=True)]
    return [c.real if not np.any(c.imag) else c for c in columns]


def errors(draw: Draw, cells: int, bound: float = 1.0) -> Float64:
    """Return the errors; above `bound`, less what a step of the wavelength changes at a narrow resonance."""
    host, n1, n2, d1_nm, d2_nm, wavelength_nm, cosine = drawn(draw)
    powers = bragg_powers(host, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, cosine)
    worst = []
    for i, row in enumerate(zip(host, n1, n2, d1_nm, d2_nm, wavelength_nm, cosine, strict=True)):
        exact = mirror_50_digits(*(x.item() for x in row[:5]), cells, *(x.item() for x in row[5:]))
        seen = powers.R_s[i], powers.R_p[i], powers.T_s[i], powers.T_p[i]
        error = max(abs(float(a - b.item())) for a, b in zip(exact, seen, strict=True))
        if error > bound and draw is not like_the_bench:
            next_nm = float(np.nextafter(row[5], np.inf))
            moved = mirror_50_digits(*(x.item() for x in row[:5]), cells, next_nm, row[6].item())
            error -= max(abs(float(a - b)) for a, b in zip(exact, moved, strict=True))
        worst.append(error)
    return np.array(worst)


@pytest.mark.parametrize("draw", [like_the_bench, under_any_host, absorbing], ids=lambda d: d.__name__)
@pytest.mark.parametrize(("cells", "bound"), [(1, 1e-14), (10, 1e-13), (200, 1e-11)])
def test_reflected_and_transmitted_power_against_50_digits(
    draw: Draw, cells: int, bound: float, record_property: Callable[[str, object], None]
) -> None:
    error = errors(draw, cells, bound).max()
    record_property("measured", f"{draw.__name__}, {cells} cells: {error:.1e}")
    assert error <= bound


@pytest.mark.parametrize("draw", [like_the_bench, under_any_host, absorbing], ids=lambda d: d.__name__)
def test_a_million_cells_against_50_digits(
    draw: Draw, record_property: Callable[[str, object], None]
) -> None:
    error = errors(draw, 10**6)
    record_property("measured", f"{draw.__name__}: p99 {np.quantile(error, 0.99):.1e}, max {error.max():.1e}")
    assert np.quantile(error, 0.99) <= 1e-8
    assert error.max() <= 1e-7


@pytest.mark.parametrize("cells", [10, 200, 10**6])
def test_at_a_band_edge_the_error_is_a_few_steps_of_the_wavelength(cells: int) -> None:
    g = np.random.default_rng(5)
    for _ in range(6):
        _, _, n2, d1_nm, d2_nm, start_nm, cosine = (float(np.real(x)) for x in like_the_bench(g))
        wavelength_nm = float(band_edge_nm(n2, d1_nm, d2_nm, cosine, start_nm))
        nearby = wavelength_nm + np.spacing(wavelength_nm) * np.array([-1.0, 0.0, 1.0])
        exact = [
            float(mirror_50_digits(1.0, 1.0, n2, d1_nm, d2_nm, cells, each, cosine).reflected)
            for each in nearby
        ]
        step = max(abs(exact[0] - exact[1]), abs(exact[2] - exact[1]), 2.0**-53)
        error = abs(
            float(bragg_reflectance(1.0, 1.0, n2, d1_nm, d2_nm, cells, wavelength_nm, cosine)) - exact[1]
        )
        assert error <= 16.0 * step


def band_edge_nm(n2: float, d1_nm: float, d2_nm: float, cosine: float, start_nm: float) -> float:
    """Bisect s-polarised |cos KΛ| = 1 beyond `start_nm`, or give an edge of the first gap there is."""
    cell = cell_optics(1.0, 1.0, n2, d1_nm, d2_nm, cosine)

    def beyond(wavelength_nm: Float64) -> Float64:
        phi_1, phi_2 = (2.0 * np.pi * p / wavelength_nm for p in (cell.path_1_nm, cell.path_2_nm))
        omega = cell.contrast_s + 1.0 / cell.contrast_s
        return np.abs(np.cos(phi_1) * np.cos(phi_2) - 0.5 * omega * np.sin(phi_1) * np.sin(phi_2)) - 1.0

    grid = np.linspace(start_nm, 10.0 * start_nm, 200_001)
    first = int(np.flatnonzero(np.diff(np.sign(beyond(grid))))[0])
    low, high = grid[first], grid[first + 1]
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if beyond(middle) * beyond(low) > 0.0 else (low, middle)
    return float(low)


def test_what_is_reflected_transmitted_and_absorbed_adds_up() -> None:
    for draw in (under_any_host, absorbing):
        host, n1, n2, d1_nm, d2_nm, wavelength_nm, cosine = drawn(draw, 2000)
        for cells in (1, 10, 10**6):
            p = bragg_powers(host, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, cosine)
            assert min(each.min() for each in p) >= 0.0
            assert np.abs(p.R_s + p.T_s + p.A_s - 1.0).max() <= 1e-14
            assert np.abs(p.R_p + p.T_p + p.A_p - 1.0).max() <= 1e-14


def test_weak_absorption_takes_a_share_in_proportion_to_k() -> None:
    k = 1e-4
    once, twice = (bragg_powers(1.0, 1.5, 2.0 + 1j * s * k, 80.0, 60.0, 10, 500.0, 0.8) for s in (1.0, 2.0))
    assert twice.A_s / once.A_s == pytest.approx(2.0, rel=1e-2)
    assert once.A_p == pytest.approx(1.0 - once.R_p - once.T_p, abs=1e-14)


def test_absorption_that_vanishes_leaves_the_closed_form() -> None:
    host, n1, n2, d1_nm, d2_nm, wavelength_nm, cosine = drawn(under_any_host, 2000)
    arguments = d1_nm, d2_nm, 3, wavelength_nm, cosine
    lossless = bragg_powers(host, n1, n2, *arguments)
    barely = bragg_powers(host, n1 + 1e-300j, n2, *arguments)
    for a, b in zip(lossless, barely, strict=True):
        assert np.abs(a - b).max() <= 1e-12


def test_a_whole_wave_more_in_a_film_changes_nothing() -> None:
    _, n1, n2, d1_nm, d2_nm, wavelength_nm, cosine = drawn(under_any_host, 500)
    whole_nm = wavelength_nm / (n1 * cosine)
    once = bragg_reflectance(1.0, n1, n2, d1_nm, d2_nm, 7, wavelength_nm, 1.0)
    again = bragg_reflectance(1.0, n1, n2, d1_nm + wavelength_nm / n1, d2_nm, 7, wavelength_nm, 1.0)
    assert np.abs(once - again).max() <= 1e-12
    once = bragg_reflectance(n1, n1, n2, d1_nm, d2_nm, 7, wavelength_nm, cosine)
    again = bragg_reflectance(n1, n1, n2, d1_nm + whole_nm, d2_nm, 7, wavelength_nm, cosine)
    assert np.abs(once - again).max() <= 1e-12


def test_only_under_a_host_does_the_order_of_the_films_show() -> None:
    for host, is_visible in ((1.4, False), (1.0, True)):
        mirror = bragg_reflectance(host, 1.4, 1.9, 90.0, 70.0, 5, 500.0, 0.7)
        turned = float(stack_50_digits([host, *[1.9, 1.4] * 5, 1.4], [70.0, 90.0] * 5, 500.0, 0.7).reflected)
        assert (abs(float(mirror) - turned) > 1e-3) is is_visible
        if not is_visible:
            assert float(mirror) == pytest.approx(turned, abs=1e-13)


def test_one_cell_under_n1_is_the_slab_n2() -> None:
    _, n1, n2, d1_nm, d2_nm, wavelength_nm, cosine = drawn(under_any_host, 500)
    slab = film_reflectance(n1, n2, n1, d2_nm, wavelength_nm, cosine)
    mirror = bragg_reflectance(n1, n1, n2, d1_nm, d2_nm, 1, wavelength_nm, cosine)
    assert np.abs(mirror - slab).max() <= 1e-13
