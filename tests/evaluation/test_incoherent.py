"""`incoherent` is the mean over the phase of the film's exact reflectance."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from mpmath import mp

from gltf_iri.evaluation.film import Film, base_from_dispersion, base_from_f0, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.incoherent import film_reflectance_incoherent


@pytest.mark.parametrize("base", [1.5, 2.6, 0.2 + 3.4j, 3.0 + 0.01j])
@pytest.mark.parametrize("cosine", [0.3, 1.0])
def test_mean_over_one_fringe_by_transfer_matrices_of_fifty_digits(
    base: complex, cosine: float, film_reflectance: object
) -> None:
    """Equal steps over a period integrate what is periodic and smooth: 64 leave |z|⁶⁴."""
    film_ior, nm = 1.38, 550.0
    period_nm = nm / (2.0 * np.sqrt(film_ior**2 - 1.0 + cosine**2))
    with mp.workdps(30):
        sums = [
            sum(film_reflectance(1.0, film_ior, base, k * period_nm / 64, nm, cosine)) / 2 for k in range(64)
        ]
        mean = float(sum(sums) / 64)
    ours = evaluate("incoherent", Film.of(cosine, 300.0, film_ior, base_from_ior(base))).rgb
    assert ours == pytest.approx([mean] * 3, abs=1e-13)


def test_mean_of_the_truth_over_many_thicknesses() -> None:
    """Fringes of every order have faded from 50 µm on; the mean over thicknesses fades the rest."""
    thickness_nm = np.linspace(60_000.0, 70_000.0, 21)[:, None]
    cosine = np.array([0.2, 0.7, 1.0])
    base = base_from_f0([0.2, 0.5, 0.8])
    truth = evaluate("spectral", Film.of(cosine, thickness_nm, 1.5, base)).rgb.mean(axis=0)
    assert np.abs(evaluate("incoherent", Film.of(cosine, 0.0, 1.5, base)).rgb - truth).max() < 2e-5


def test_intensities_of_all_inter_reflections_add_up_to_it() -> None:
    """R₁₂ + T₁₂R₂₃T₂₁/(1 − R₁₂R₂₃), polarisation by polarisation, from the package tmm's interfaces."""
    from tmm import interface_R, interface_T, snell

    for base, theta in itertools.product((1.5, 0.6 + 2.1j), (0.0, 0.9, 1.4)):
        inside, below = snell(1.0, 1.4, theta), snell(1.0, base, theta)
        total = 0.0
        for pol in ("s", "p"):
            first = interface_R(pol, 1.0, 1.4, theta, inside)
            second = interface_R(pol, 1.4, base, inside, below)
            through = interface_T(pol, 1.0, 1.4, theta, inside) * interface_T(pol, 1.4, 1.0, inside, theta)
            total += 0.5 * (first + through * second / (1.0 - first * second))
        assert film_reflectance_incoherent(1.0, 1.4, base, np.cos(theta)) == pytest.approx(total, abs=1e-13)


def test_film_that_frustrates_the_light_reflects_all_of_it() -> None:
    film = Film.of(0.3, 1e5, 1.0, base_from_ior([1.2, 1.5, 0.3 + 2j]), 1.6)
    assert evaluate("incoherent", film).rgb == pytest.approx(np.ones((3, 3)), abs=1e-12)
    assert evaluate("spectral", film).rgb == pytest.approx(np.ones((3, 3)), abs=1e-12)


def test_base_that_reflects_in_total_sends_all_back() -> None:
    below_critical = np.sqrt(1.0 - (1.1 / 1.3) ** 2) * 0.9
    film = Film.of(below_critical, 400.0, 1.7, base_from_ior(1.1), 1.3)
    assert evaluate("incoherent", film).rgb == pytest.approx([1.0] * 3, abs=1e-14)


def test_film_of_its_bases_index_is_the_bare_base() -> None:
    cosine = np.linspace(0.0, 1.0, 11)
    film = Film.of(cosine, 500.0, 1.5, base_from_ior(1.5))
    bare = evaluate("spectral", Film.of(cosine, 0.0, 1.5, base_from_ior(1.5))).rgb
    assert np.abs(evaluate("incoherent", film).rgb - bare).max() < 1e-14


def test_mirrors_are_white_and_channels_have_their_own_bases() -> None:
    rgb = evaluate("incoherent", Film.of(0.6, 400.0, 1.4, base_from_f0([0.1, 0.5, 1.0]))).rgb
    assert rgb[2] == 1.0
    for channel, f0 in enumerate((0.1, 0.5)):
        grey = evaluate("incoherent", Film.of(0.6, 400.0, 1.4, base_from_f0([f0] * 3))).rgb
        assert rgb[channel] == grey[channel]


def test_dispersive_indices_are_those_of_each_channel() -> None:
    film = Film.of(
        0.6, 400.0, lambda nm: 1.4 + 8e3 / nm**2, base_from_dispersion(lambda nm: 0.2 + nm * 5e-3j)
    )
    thick = Film.of(0.6, np.linspace(6e4, 7e4, 21), film.film_ior_at, film.base)
    truth = evaluate("spectral", thick).rgb.mean(axis=0)
    assert evaluate("incoherent", film).rgb == pytest.approx(truth, abs=5e-4)


def test_every_film_has_a_reflectance_within_0_and_1() -> None:
    bases = (base_from_f0([0.0, 0.5, 1.0]), base_from_ior(3j), base_from_ior(1e-6), base_from_ior(1e6))
    for outside_ior, film_ior, base in itertools.product((1.0, 1e-6, 1e6), (1.0, 1.3, 1e-6, 1e6), bases):
        rgb = evaluate(
            "incoherent", Film.of([0.0, 5e-324, 1e-8, 0.5, 1.0], 1.0, film_ior, base, outside_ior)
        ).rgb
        assert np.all((rgb >= 0.0) & (rgb <= 1.0))
