"""Interfaces: Brewster, energy, the text's special cases."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.optics.fresnel import (
    amplitude_p,
    amplitude_s,
    f_schlick,
    interface_power,
    phase_rad,
    transmission_p,
    transmission_s,
)
from gltf_iri.optics.ior import fresnel0_to_ior, ior_to_fresnel0
from gltf_iri.optics.refraction import cos_theta_2_squared, normal_index, normal_index_squared

COSINES = np.linspace(0.0, 1.0, 101)


def test_brewster_angle_reflects_no_p_light() -> None:
    n = 1.5
    cosine = 1.0 / np.sqrt(1.0 + n * n)  # tan θ = n
    q = normal_index(normal_index_squared(n, 1.0, cosine))
    assert abs(amplitude_p(1.0, cosine, n, q)) <= 1e-15
    assert abs(amplitude_s(cosine, q)) > 0.3


@pytest.mark.parametrize("n_2", [1.5, 2.5, 0.7, 0.2 + 3.4j, 1.5 + 1e-6j, 3j])
def test_reflected_and_transmitted_power_sum_to_one(n_2: complex) -> None:
    q_1, q_2 = 1.0 * COSINES[1:], normal_index(normal_index_squared(n_2, 1.0, COSINES[1:]))
    power = interface_power(1.0, q_1, n_2, q_2)
    assert np.abs(power.R_s + power.T_s - 1.0).max() <= 1e-14
    assert np.abs(power.R_p + power.T_p - 1.0).max() <= 1e-14
    assert power.T_s.max() > 0.0 or n_2 == 3j


@pytest.mark.parametrize("n_2", [1.5, 0.2 + 3.4j])
def test_fields_along_the_interface_are_the_same_on_both_sides(n_2: complex) -> None:
    """s: 1 + r = t. p: along it the fields are cosθ₁(1 − r) and cosθ₂ t, magnetic ones n₁(1 + r), n₂t."""
    q_1, q_2 = COSINES[1:], normal_index(normal_index_squared(n_2, 1.0, COSINES[1:]))
    assert np.abs(1.0 + amplitude_s(q_1, q_2) - transmission_s(q_1, q_2)).max() <= 1e-15
    r, t = amplitude_p(1.0, q_1, n_2, q_2), transmission_p(1.0, q_1, n_2, q_2)
    assert np.abs(1.0 + r - n_2 * t).max() <= 1e-14
    assert np.abs(q_1 * (1.0 - r) - (q_2 / n_2) * t).max() <= 1e-14


def test_matched_interface_lets_all_through_even_at_grazing() -> None:
    assert transmission_s(0.0, 0.0) == 1.0
    assert transmission_p(1.3, 0.0, 1.3, 0.0) == 1.0


def test_total_reflection_turns_the_phase_as_in_the_textbook() -> None:
    """Born & Wolf, §1.5.4, Eq. 60: tan δ_s/2 = −√(sin²θ − n²)/cosθ, and n⁻² times that for p."""
    n = 1.0 / 1.5
    cosine = np.linspace(0.01, np.sqrt(1.0 - n * n) - 0.01, 40)
    q_2 = normal_index(normal_index_squared(1.0, 1.5, cosine))
    steep = np.sqrt((1.0 - cosine**2) - n * n) / cosine
    s, p = amplitude_s(1.5 * cosine, q_2), amplitude_p(1.5, 1.5 * cosine, 1.0, q_2)
    assert np.abs(phase_rad(s) + 2.0 * np.arctan(steep)).max() <= 1e-14
    assert np.abs(phase_rad(p) + 2.0 * np.arctan(steep / (n * n))).max() <= 1e-14
    assert np.abs(np.abs([s, p]) - 1.0).max() <= 1e-15


def test_metals_delay_as_n_plus_ik_and_exp_minus_iwt_say() -> None:
    """Straight on, tan δ = −2k/(1 − n² − k²): the sign of k is that of δ."""
    n, k = 0.2, 3.4
    delta = phase_rad(amplitude_s(1.0, n + 1j * k))
    assert delta == pytest.approx(np.arctan2(-2.0 * k, 1.0 - n * n - k * k), abs=1e-15)
    assert phase_rad(amplitude_s(1.0, n - 1j * k)) == -delta
    assert -np.pi < delta < 0.0


def test_straight_on_both_polarisations_reflect_the_same() -> None:
    n = 0.2 + 3.4j
    q = normal_index(normal_index_squared(n, 1.0, 1.0))
    s, p = amplitude_s(1.0, q), amplitude_p(1.0, 1.0, n, q)
    assert abs(s + p) <= 1e-15
    assert abs(s) ** 2 == pytest.approx(abs((n - 1) / (n + 1)) ** 2, rel=1e-14)


def test_matched_interface_reflects_nothing_even_at_grazing() -> None:
    q = normal_index(normal_index_squared(1.3, 1.3, COSINES))
    for r in (amplitude_s(1.3 * COSINES, q), amplitude_p(1.3, 1.3 * COSINES, 1.3, q)):
        assert r[0] == 0.0
        assert np.abs(r).max() <= 2e-16


def test_schlick_meets_its_ends() -> None:
    assert f_schlick(0.04, 1.0) == 0.04
    assert f_schlick(0.04, 0.0) == 1.0


def test_f0_and_index_are_each_others_inverse() -> None:
    f0 = np.linspace(0.0, 0.99, 50)
    assert np.abs(ior_to_fresnel0(fresnel0_to_ior(f0), 1.0) - f0).max() <= 1e-14
    assert np.isinf(fresnel0_to_ior(1.0))


def test_squared_contrast_does_not_know_which_side_is_denser() -> None:
    assert ior_to_fresnel0(1.3, 1.8) == ior_to_fresnel0(1.8, 1.3)


def test_both_forms_of_snells_law_agree() -> None:
    exact = normal_index_squared(1.4, 1.0, COSINES).real / 1.4**2
    assert np.abs(cos_theta_2_squared(1.0, 1.4, COSINES) - exact).max() <= 1e-15


def test_cancelling_terms_keep_their_digits() -> None:
    """At the critical angle q² is a difference of near-equal products: compare with rationals."""
    from fractions import Fraction

    cosine = float(np.sqrt(1.0 - (1.0 / 1.5) ** 2))
    for c in (cosine, np.nextafter(cosine, 0.0), np.nextafter(cosine, 1.0)):
        n1, c1 = Fraction(1.5), Fraction(float(c))
        exact = 1 - n1**2 * (1 - c1**2)
        assert float(normal_index_squared(1.0, 1.5, c).real) == pytest.approx(float(exact), rel=1e-12)


@pytest.mark.parametrize("n", [1.5, 0.2 + 3.4j, 3j, 1.0 + 1e-9j])
def test_waves_run_or_fade_onward(n: complex) -> None:
    q = normal_index(normal_index_squared(n, 1.8, COSINES))
    assert np.all(q.real >= 0.0)
    assert np.all(q.imag >= 0.0)
    assert np.abs(q * q - normal_index_squared(n, 1.8, COSINES)).max() <= 1e-14
