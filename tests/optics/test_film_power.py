"""Where the light of one film goes: 50 digits, conservation, and the corners of the domain."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from gltf_iri.bench.fifty_digits import stack_50_digits
from gltf_iri.optics.airy import FilmPower, film_power
from gltf_iri.optics.film import film_reflectance_polarised
from gltf_iri.optics.fresnel import amplitude_s

HARD_COSINES = [0.0, 5e-324, 1e-160, 1e-20, 1e-8, 0.3, 1.0, np.sqrt(1.0 - 0.49), np.sqrt(1.0 - 1.0 / 2.25)]
HARD_THICKNESSES_NM = [0.0, 5e-324, 1e-6, 400.0, 1e6, 5.5e6]


def lost(power: FilmPower) -> float:
    s, p = power.R_s + power.T_s + power.A_s, power.R_p + power.T_p + power.A_p
    return float(max(np.abs(s - 1.0).max(), np.abs(p - 1.0).max()))


def test_all_shares_agree_with_50_digits(record_property: Callable[[str, object], None]) -> None:
    g = np.random.default_rng(3)
    worst = worst_sum = 0.0
    for _ in range(250):
        film = complex(g.uniform(0.3, 3.0), g.choice([0.0, 10.0 ** g.uniform(-6.0, 1.0)]))
        base = complex(g.uniform(0.1, 4.0), g.choice([0.0, 10.0 ** g.uniform(-3.0, 1.0)]))
        outside = float(g.choice([1.0, 1.5]))
        d_nm, wavelength_nm = 10.0 ** g.uniform(-6.0, 3.5), g.uniform(360.0, 830.0)
        cosine = 10.0 ** g.uniform(-6.0, 0.0)
        ours = film_power(outside, film, base, d_nm, wavelength_nm, cosine)
        exact = stack_50_digits([outside, film, base], [d_nm], wavelength_nm, cosine)
        pairs = [(ours.R_s, exact.R_s), (ours.R_p, exact.R_p), (ours.T_s, exact.T_s), (ours.T_p, exact.T_p)]
        worst = max(worst, *(abs(float(e - float(o))) for o, e in pairs))
        worst_sum = max(worst_sum, lost(ours))
    record_property("measured", f"R and T of films that may absorb, against 50 digits: {worst:.1e}")
    record_property("measured", f"R + T + A − 1 with A from the absorbed flux: {worst_sum:.1e}")
    assert worst <= 1e-13
    assert worst_sum <= 1e-13


def test_thick_films_keep_their_resonances() -> None:
    """Up to a millimetre between metals and flat light: phases of ten thousand turns, to the last bit."""
    g = np.random.default_rng(12)
    for _ in range(60):
        outside, film = g.uniform(1.0, 1.6), g.uniform(1.7, 2.5)
        base = complex(g.uniform(0.03, 0.3), g.uniform(2.0, 9.0))
        d_nm, wavelength_nm, cosine = (
            10.0 ** g.uniform(3.0, 6.0),
            g.uniform(360.0, 830.0),
            g.uniform(0.01, 1.0),
        )
        ours = film_power(outside, film, base, d_nm, wavelength_nm, cosine)
        exact = stack_50_digits([outside, film, base], [d_nm], wavelength_nm, cosine)
        for name in ("R_s", "R_p", "T_s", "T_p"):
            assert abs(float(getattr(exact, name) - float(getattr(ours, name)))) <= 1e-14


@pytest.mark.parametrize("base", [1.5, 1.0, 0.7, 0.2 + 3.4j, 3j, 1e6, 1e-6, 1e6j])
@pytest.mark.parametrize("film", [1.3, 1.0, 0.7, 1.3 + 0.01j, 1.3 + 1e-8j, 2.0 + 1.0j, 0.7 + 1e-7j])
def test_no_light_is_lost_at_hard_corners(film: complex, base: complex) -> None:
    cosine = np.array(HARD_COSINES)[:, None, None]
    thickness_nm = np.array(HARD_THICKNESSES_NM)[:, None]
    with np.errstate(all="raise", under="ignore"):
        for outside in (1.0, 1.5):
            power = film_power(outside, film, base, thickness_nm, np.array([360.0, 555.5]), cosine)
            assert lost(power) <= 1e-13
            for share in (power.R_s, power.R_p, power.T_s, power.T_p, power.A_s, power.A_p):
                assert np.all((share >= 0.0) & (share <= 1.0 + 1e-13))


def test_film_that_absorbs_nothing_absorbs_nothing_and_reflects_what_the_fast_form_says() -> None:
    case = (1.0, 1.3, 0.2 + 3.4j, 400.0, np.linspace(360.0, 830.0, 95), np.linspace(0.01, 1.0, 12)[:, None])
    power = film_power(*case)
    s, p = film_reflectance_polarised(*case)
    assert np.array_equal(power.A_s, np.zeros_like(power.A_s))
    assert max(np.abs(power.R_s - s).max(), np.abs(power.R_p - p).max()) <= 1e-13


def test_film_of_10000_wavelengths_hides_its_base_where_it_absorbs() -> None:
    first, second = (film_power(1.0, 1.5 + 1e-3j, base, 5.5e6, 550.0, 0.6) for base in (1.0, 0.2 + 3.4j))
    assert abs(first.R_s - second.R_s) <= 1e-15
    assert first.T_s <= 1e-50
    assert abs(first.A_p - (1.0 - first.R_p)) <= 1e-14


def test_weakly_absorbing_film_goes_over_into_one_that_absorbs_nothing() -> None:
    powers = [film_power(1.5, 1.0 + k, 1.5, 300.0, 550.0, 0.6) for k in (0.0, 1e-14j)]
    assert abs(powers[0].R_p - powers[1].R_p) <= 1e-12


def test_light_takes_the_same_way_back() -> None:
    """T is the same from both sides where the base absorbs nothing: reciprocity."""
    cosine = 0.6
    inside = np.sqrt(1.0 - (1.0 - cosine**2) / 1.7**2)
    there = film_power(1.0, 1.4 + 0.2j, 1.7, 250.0, 550.0, cosine)
    back = film_power(1.7, 1.4 + 0.2j, 1.0, 250.0, 550.0, inside)
    assert abs(there.T_s - back.T_s) <= 1e-15
    assert abs(there.T_p - back.T_p) <= 1e-15
    assert abs(there.A_s - back.A_s) > 0.01


def test_wrong_sign_of_k_would_cost_half() -> None:
    """n − ik belongs to exp(+iωt): its amplitude, the conjugate, meets the phase the wrong way round."""
    base, thickness_nm = 1.1 + 2.5j, np.linspace(0.0, 400.0, 801)
    ours = film_power(1.0, 2.6, base, thickness_nm, 550.0, 1.0).R_s
    r12, there_and_back = amplitude_s(1.0, 2.6), np.exp(4j * np.pi * 2.6 * thickness_nm / 550.0)

    def airy(r23: np.ndarray) -> np.ndarray:
        return np.abs((r12 + r23 * there_and_back) / (1.0 + r12 * r23 * there_and_back)) ** 2

    right = amplitude_s(2.6, base)
    assert np.abs(ours - airy(right)).max() <= 1e-14
    assert np.abs(ours - airy(right.conj())).max() > 0.5


@pytest.mark.parametrize("which", range(6))
def test_nan_in_is_nan_out(which: int) -> None:
    case: list[complex] = [1.0, 1.3 + 0.1j, 1.5 + 0.1j, 400.0, 550.0, 0.7]
    case[which] = np.nan
    power = film_power(*case)
    assert all(
        np.isnan(share) for share in (power.R_s, power.R_p, power.T_s, power.T_p, power.A_s, power.A_p)
    )
