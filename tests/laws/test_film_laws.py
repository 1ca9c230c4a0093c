"""Laws of thin films, asked of every method; a method that breaks one is named with the reason."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Film, base_from_f0, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.fresnel import amplitude_p, amplitude_s, f_schlick
from gltf_iri.optics.refraction import normal_index, normal_index_squared
from gltf_iri.planning.method import method_names

# The text's floor of 1e-5 on R123, its sensitivities' own white and its fringes at zero thickness.
METHODS = method_names("film")
LAWFUL = [name for name in METHODS if name != "khr"]

# Exactly grazing, and everything whose square float64 can hold.
cosines = st.just(0.0) | st.floats(1e-100, 1.0)
thicknesses_nm = st.floats(0.0, 3000.0)
film_iors = st.floats(1.0, 2.5)
base_iors = st.floats(1.0, 3.0)


def bare(method: str, base_ior: float, cosine: float) -> NDArray[np.float64]:
    """Return what the method's own Fresnel equation gives without a film."""
    if method != "spectral":
        return np.full(3, f_schlick(((base_ior - 1.0) / (base_ior + 1.0)) ** 2, cosine))
    q = normal_index(normal_index_squared(base_ior, 1.0, cosine))
    s, p = amplitude_s(cosine, q), amplitude_p(1.0, cosine, base_ior, q)
    return np.full(3, 0.5 * (abs(s) ** 2 + abs(p) ** 2))


@pytest.mark.parametrize("method", LAWFUL)
@given(film_ior=film_iors, base_ior=base_iors, cosine=cosines)
@settings(deadline=None, max_examples=40)
def test_zero_thickness_is_the_bare_base(
    method: str, film_ior: float, base_ior: float, cosine: float
) -> None:
    rgb = evaluate(method, Film.of(cosine, 0.0, film_ior, base_from_ior(base_ior))).rgb
    assert np.abs(rgb - bare(method, base_ior, cosine)).max() <= 1e-9


def test_khr_breaks_it_fringes_do_not_vanish_with_thickness() -> None:
    """Two orders of fringes, tinted by the sensitivities' white, do not sum to the bare base."""
    rgb = evaluate("khr", Film.of(1.0, 0.0, 1.3, base_from_ior(1.5))).rgb
    assert np.ptp(rgb) > 0.005


@pytest.mark.parametrize("method", LAWFUL)
@given(thickness_nm=thicknesses_nm, ior=st.floats(1.05, 2.5), cosine=cosines)
@settings(deadline=None, max_examples=40)
def test_film_like_its_base_adds_no_colour(
    method: str, thickness_nm: float, ior: float, cosine: float
) -> None:
    rgb = evaluate(method, Film.of(cosine, thickness_nm, ior, base_from_ior(ior))).rgb
    assert np.ptp(rgb) <= 1e-9


def test_khr_breaks_it_its_floor_draws_fringes() -> None:
    """clamp(R12 · R23, 1e-5, …) leaves a fringe of amplitude √1e-5 where the second interface is none."""
    rgb = evaluate("khr", Film.of(1.0, 200.0, 1.5, base_from_ior(1.5))).rgb
    assert np.ptp(rgb) > 0.01


@pytest.mark.parametrize("white", ["D65", "E"])
@pytest.mark.parametrize("method", LAWFUL)
def test_fringes_finer_than_the_eye_leave_grey(method: str, white: str) -> None:
    """A film of many micrometres over a grey base has no hue."""
    rgb = evaluate(method, Film.of(0.7, 40_000.0, 1.5, base_from_ior(2.0)), white=white).rgb
    assert np.ptp(rgb) <= 2e-3


@pytest.mark.parametrize("method", LAWFUL)
@pytest.mark.parametrize("white", ["D65", "E"])
def test_perfect_mirror_is_white(method: str, white: str) -> None:
    film = Film.of(np.linspace(0.0, 1.0, 11), 350.0, 1.4, base_from_f0(np.ones(3)))
    assert np.abs(evaluate(method, film, white=white).rgb - 1.0).max() <= 2e-3


def test_khr_breaks_it_a_white_metal_exceeds_white() -> None:
    """F0 = 1 turns the base index negative: the odd fringe changes sign and the sum passes 1."""
    rgb = evaluate("khr", Film.of(1.0, 350.0, 1.4, base_from_f0(np.ones(3)))).rgb
    assert rgb.max() > 1.0


@pytest.mark.parametrize("method", METHODS)
@given(thickness_nm=thicknesses_nm, film_ior=st.floats(1.05, 2.5), base_ior=st.floats(1.05, 3.0))
@settings(deadline=None, max_examples=25)
def test_grazing_light_is_all_reflected(
    method: str, thickness_nm: float, film_ior: float, base_ior: float
) -> None:
    rgb = evaluate(method, Film.of(0.0, thickness_nm, film_ior, base_from_ior(base_ior))).rgb
    if method == "khr-guarded" and ((film_ior - 1.0) / (film_ior + 1.0)) ** 2 < 0.005:
        return  # its guard: an interface of so little contrast fades at grazing too
    assert np.abs(rgb - 1.0).max() <= 1e-9


@given(thickness_nm=thicknesses_nm, film_ior=film_iors, base_ior=base_iors, cosine=st.floats(0.01, 1.0))
@settings(deadline=None, max_examples=40)
def test_light_may_run_backwards(
    thickness_nm: float, film_ior: float, base_ior: float, cosine: float
) -> None:
    """A lossless film reflects as much of the light that comes from below along the same path."""
    sine = np.sqrt(1.0 - cosine**2) / base_ior
    down = evaluate("spectral", Film.of(cosine, thickness_nm, film_ior, base_from_ior(base_ior))).rgb
    up = evaluate(
        "spectral", Film.of(np.sqrt(1.0 - sine**2), thickness_nm, film_ior, base_from_ior(1.0), base_ior)
    ).rgb
    assert np.abs(down - up).max() <= 1e-6  # the refracted cosine is rounded, which grazing light magnifies


@given(
    thickness_nm=thicknesses_nm,
    film_ior=film_iors,
    n=st.floats(0.05, 4.0),
    k=st.floats(0.0, 8.0),
    cosine=cosines,
)
@settings(deadline=None, max_examples=40)
def test_no_film_amplifies(thickness_nm: float, film_ior: float, n: float, k: float, cosine: float) -> None:
    from gltf_iri.evaluation.spectral import film_spectrum

    film = Film.of(cosine, thickness_nm, film_ior, base_from_ior(complex(n, k)))
    spectrum = film_spectrum(film, np.linspace(360.0, 830.0, 95))
    assert spectrum.min() >= 0.0
    assert spectrum.max() <= 1.0 + 1e-12


def test_quarter_wave_film_of_the_root_of_the_base_index_is_invisible() -> None:
    """At its own wavelength n₂ = √(n₁n₃) cancels all reflection (Born & Wolf §1.6.4)."""
    from gltf_iri.evaluation.spectral import film_spectrum

    film = Film.of(1.0, 550.0 / 4.0 / 1.5, 1.5, base_from_ior(2.25))
    assert film_spectrum(film, np.array([550.0])).max() <= 1e-30


def test_half_wave_film_is_absent() -> None:
    from gltf_iri.evaluation.spectral import film_spectrum

    film = Film.of(1.0, 550.0 / 2.0 / 1.8, 1.8, base_from_ior(1.5))
    assert film_spectrum(film, np.array([550.0])) == pytest.approx(0.04, abs=1e-15)
