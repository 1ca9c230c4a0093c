"""Where others divide by zero or overflow, a mirror stays a mirror: between 0 and 1, without a warning."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from gltf_iri.bench.fifty_digits import mirror_50_digits
from gltf_iri.optics.bragg import bragg_powers, bragg_reflectance

DENORMAL = 5e-324


@pytest.mark.parametrize("backend", ["numpy", "numba"])
def test_every_combination_of_the_limits_reflects_between_nothing_and_all(backend: str) -> None:
    if backend == "numba":
        pytest.importorskip("numba")
    rows = itertools.product(
        [1.0, 1.5],
        [1.0, 1.5, 2.0],
        [1.0, 1.0 + 1e-15, 1.5, 2.3],
        [0.0, DENORMAL, 1e-6, 100.0, 1e6],
        [0.0, DENORMAL, 1e-6, 100.0, 1e6],
        [1, 1000, 10**6],
        [360.0, 551.0],
        [0.0, DENORMAL, 1e-8, 0.5547001962252291, 1.0],  # 0.5547: Brewster's angle of 1.5
    )
    reflected = bragg_reflectance(*np.array(list(rows)).T, backend=backend)  # type: ignore[arg-type]
    assert reflected.min() >= 0.0
    assert reflected.max() <= 1.0


def test_absorbing_cells_at_the_limits_share_all_light_out() -> None:
    rows = itertools.product(
        [1.0, 1.5],
        [1.0, 1.5 + 1e-300j, 2.0 + 3.0j],
        [1.0 + 1e-9j, 0.2 + 3.4j, 1e-6 + 1e-3j],
        [0.0, 1e-6, 100.0, 1e6],
        [0.0, 100.0, 5e6],  # ten thousand wavelengths
        [1, 1000, 10**6],
        [551.0],
        [0.0, 1e-8, 0.5, 1.0],
    )
    host, n1, n2, d1_nm, d2_nm, cells, wavelength_nm, cosine = np.array(list(rows)).T
    real = [each.real for each in (d1_nm, d2_nm, cells, wavelength_nm, cosine)]
    p = bragg_powers(host.real, n1, n2, *real)
    assert min(each.min() for each in p) >= 0.0
    for total in (p.R_s + p.T_s + p.A_s, p.R_p + p.T_p + p.A_p):
        assert np.abs(total - 1.0).max() <= 1e-9


def test_a_nan_in_any_argument_comes_out() -> None:
    for n2 in (1.9, 1.9 + 0.1j):
        good = [1.2, 1.5, n2, 100.0, 80.0, 10, 500.0, 0.7]
        for place in (0, 1, 2, 3, 4, 6, 7):
            bad = [*good[:place], np.nan, *good[place + 1 :]]
            assert np.isnan(bragg_reflectance(*bad))
            assert all(np.isnan(share) for share in bragg_powers(*bad)[:4])


def test_grazing_light_is_all_reflected_unless_all_media_match() -> None:
    assert bragg_reflectance(1.0, 1.0, 1.5, 100.0, 80.0, 10, 500.0, 0.0) == 1.0
    assert bragg_reflectance(1.0, 1.3, 1.5, 100.0, 80.0, 10, 500.0, 0.0) == 1.0
    assert bragg_reflectance(1.5, 1.5, 1.5, 100.0, 80.0, 10, 500.0, 0.0) == 0.0


def test_at_brewsters_angle_all_gaps_of_p_close() -> None:
    n1, n2 = 1.0, 1.5
    cosine = n1 / np.hypot(n1, n2)
    wavelength_nm = np.linspace(360.0, 830.0, 300)
    p = bragg_powers(n1, n1, n2, 120.0, 90.0, 10**6, wavelength_nm, cosine)
    assert p.R_p.max() <= 1e-9
    assert p.R_s.max() == 1.0


def test_in_the_middle_of_a_gap_nothing_passes_and_what_does_is_exact() -> None:
    quarter_nm = 550.0 / 4.0
    p = bragg_powers(1.0, 1.0, 1.5, quarter_nm, quarter_nm / 1.5, np.array([10, 200, 10**6]), 550.0, 1.0)
    assert p.T_s[:2] == pytest.approx([4.0 / (1.5**10 + 1.5**-10) ** 2, 4.0 * 1.5**-400], rel=1e-12)
    assert p.T_s[2] == 0.0


def test_light_that_fades_in_n1_is_all_reflected_and_none_passes() -> None:
    p = bragg_powers(1.8, 1.2, 1.6, 50.0, 60.0, 4, 500.0, 0.3)
    assert (p.R_s, p.R_p, p.T_s, p.T_p) == (1.0, 1.0, 0.0, 0.0)


def test_nothing_jumps_where_light_begins_to_fade_in_n2() -> None:
    critical = np.sqrt(1.0 - (1.2 / 1.5) ** 2)
    for cells in (1, 10):
        cosines = critical * (1.0 + np.array([-1e-14, 0.0, 1e-14]))
        near = bragg_reflectance(1.5, 1.5, 1.2, 100.0, 80.0, cells, 500.0, cosines)
        exact = [mirror_50_digits(1.5, 1.5, 1.2, 100.0, 80.0, cells, 500.0, c).reflected for c in cosines]
        assert np.abs(near - np.array(exact, dtype=float)).max() <= 1e-12
        assert np.ptp(near) <= 1e-12


def test_numbers_of_cells_may_differ_from_row_to_row() -> None:
    cells = np.array([1, 2, 7, 10, 200, 10**6])
    together = bragg_reflectance(1.0, 1.4, 1.9, 90.0, 70.0, cells, 500.0, 0.6)
    apart = [bragg_reflectance(1.0, 1.4, 1.9, 90.0, 70.0, int(n), 500.0, 0.6) for n in cells]
    assert np.all(np.abs(together - np.array(apart)) <= 1e-15 * np.maximum(cells, 1000))


def test_any_shapes_that_broadcast_are_the_same_numbers() -> None:
    g = np.random.default_rng(3)
    wavelength_nm, cosine, n2 = g.uniform(400.0, 700.0, 5), g.uniform(0.1, 1.0, 7), g.uniform(1.1, 2.0, 30)
    rows = bragg_reflectance(1.0, 1.0, n2[:, None, None], 90.0, 70.0, 10, wavelength_nm, cosine[:, None])
    turned = bragg_reflectance(1.0, 1.0, n2[:, None, None], 90.0, 70.0, 10, wavelength_nm[:, None], cosine)
    one = bragg_reflectance(1.0, 1.0, float(n2[4]), 90.0, 70.0, 10, float(wavelength_nm[2]), float(cosine[3]))
    assert rows.shape == (30, 7, 5)
    assert np.abs(rows - np.swapaxes(turned, 1, 2)).max() <= 1e-13
    assert one.shape == ()
    assert rows[4, 3, 2] == pytest.approx(float(one), abs=1e-13)
