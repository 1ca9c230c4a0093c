"""`smits-meyer` is two beams, as written down a second time here, and right where interfaces are weak."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from gltf_iri.colour.integrate import integrate_colour
from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.smits_meyer import LONGEST_OPD_NM


def fresnel(n_1: float, c_1: float, n_2: float, c_2: float) -> float:
    s = (n_1 * c_1 - n_2 * c_2) / (n_1 * c_1 + n_2 * c_2)
    p = (n_2 * c_1 - n_1 * c_2) / (n_2 * c_1 + n_1 * c_2)
    return 0.5 * (s * s + p * p)


@pytest.mark.parametrize("indices", [(1.0, 1.3, 1.5), (1.0, 1.7, 1.4), (1.5, 1.3, 1.2), (1.4, 1.3, 1.6)])
@pytest.mark.parametrize("white", ["D65", "E"])
def test_two_beams_interfere(indices: tuple[float, float, float], white: str) -> None:
    n_1, n_2, n_3 = indices
    c_1, d_nm = 0.8, 380.0
    c_2, c_3 = (np.sqrt(1.0 - (n_1 / n) ** 2 * (1.0 - c_1**2)) for n in (n_2, n_3))
    front, back = fresnel(n_1, c_1, n_2, c_2), fresnel(n_2, c_2, n_3, c_3)
    first = np.sqrt(front) * np.sign(n_1 - n_2)
    second = (1.0 - front) * np.sqrt(back) * np.sign(n_2 - n_3)

    def beams(rows: np.ndarray, wavelength_nm: np.ndarray) -> np.ndarray:
        power = np.abs(first + second * np.exp(4j * np.pi * n_2 * d_nm * c_2 / wavelength_nm)) ** 2
        return np.broadcast_to(power, (len(rows), wavelength_nm.shape[-1]))

    ours = evaluate("smits-meyer", Film.of(c_1, d_nm, n_2, base_from_ior(n_3), n_1), white=white).rgb
    assert ours == pytest.approx(integrate_colour(beams, 1, white=white)[0], abs=1e-9)


def test_weak_interfaces_leave_it_right() -> None:
    """Inter-reflections are of third order in the amplitudes; straight on, polarisations do not differ."""
    departures = []
    for contrast in (0.02, 0.04):
        film = Film.of(1.0, np.linspace(0.0, 900.0, 40), 1.0 + contrast, base_from_ior(1.0 + 2.0 * contrast))
        departures.append(np.abs(evaluate("smits-meyer", film).rgb - evaluate("spectral", film).rgb).max())
    assert departures[0] <= 1e-7
    assert departures[1] / departures[0] == pytest.approx(2.0**4, rel=0.3)


def test_no_base_conducts() -> None:
    metal = evaluate("smits-meyer", Film.of(0.7, 300.0, 1.4, base_from_ior(1.8 + 3.0j))).rgb
    glass = evaluate("smits-meyer", Film.of(0.7, 300.0, 1.4, base_from_ior(1.8))).rgb
    assert np.array_equal(metal, glass)


def test_longest_path_is_continuous() -> None:
    """Fringes that the eye does not see are left out without a step."""
    thickness_nm = LONGEST_OPD_NM / 2.6 * np.array([1.0 - 1e-12, 1.0 + 1e-12])
    short, long = evaluate("smits-meyer", Film.of(1.0, thickness_nm, 1.3, base_from_ior(1.7))).rgb
    assert np.abs(short - long).max() <= 1e-5


@pytest.mark.parametrize("base", [base_from_f0([0.0, 0.5, 1.0]), base_from_ior(3j), base_from_ior(1e-6)])
def test_every_film_has_a_colour(base: object) -> None:
    for outside_ior, film_ior, thickness_nm in itertools.product(
        (1.0, 1e-6, 1e6), (1.0, 1.3, 1e6), (0, 5e-324, 1e12)
    ):
        film = Film.of([0.0, 5e-324, 1e-8, 0.5, 1.0], thickness_nm, film_ior, base, outside_ior)
        assert np.isfinite(evaluate("smits-meyer", film).rgb).all()
