"""One film that absorbs nothing: edges of its domain, and both backends."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from gltf_iri.optics.film import film_reflectance, film_reflectance_polarised

DENORMAL = 5e-324
BACKENDS = ["numpy", "numba"]


@pytest.fixture(params=BACKENDS)
def reflectance(request: pytest.FixtureRequest) -> Callable[..., Any]:
    if request.param == "numba":
        pytest.importorskip("numba")
    return lambda *args: film_reflectance(*args, backend=request.param)


def test_phase_is_continuous_where_light_grazes_inside_the_film(reflectance: Callable[..., Any]) -> None:
    critical = np.sqrt(1.0 - (1.0 / 1.5) ** 2)
    cosines = critical + np.arange(-3, 4) * 2.0**-53
    around = reflectance(1.5, 1.0, 1.7 + 0.3j, 300.0, 550.0, cosines)
    assert np.ptp(around) <= 1e-12


@pytest.mark.parametrize("base", [1.5, 1.0, 0.2 + 3.4j, 3j, 1.3, 1e6, np.inf, 0.0, DENORMAL, 1e-160j])
@pytest.mark.parametrize("film", [1.3, 1.0, 0.7])
def test_hard_corners_have_a_reflectance_between_0_and_1(
    reflectance: Callable[..., Any], film: float, base: complex
) -> None:
    cosine = np.array([0.0, DENORMAL, 1e-160, 1e-20, 1e-8, 0.3, 1.0])[:, None, None]
    thickness_nm = np.array([0.0, DENORMAL, 1e-6, 400.0, 1e6])[:, None]
    with np.errstate(all="raise", under="ignore"):
        R = reflectance(1.0, film, base, thickness_nm, np.array([360.0, 555.5, 830.0]), cosine)
    assert np.all((R >= 0.0) & (R <= 1.0))


@pytest.mark.parametrize("which", range(6))
def test_nan_in_is_nan_out(reflectance: Callable[..., Any], which: int) -> None:
    case: list[Any] = [1.0, 1.3, 1.5 + 0.1j, 400.0, 550.0, 0.7]
    case[which] = np.nan
    assert np.isnan(reflectance(*case))


def test_no_film_is_the_bare_base_and_thin_films_go_to_it(reflectance: Callable[..., Any]) -> None:
    cosine = np.linspace(0.0, 1.0, 11)
    bare = reflectance(1.0, 1.5, 1.5, 400.0, 550.0, cosine)
    assert np.abs(reflectance(1.0, 1.3, 1.5, 0.0, 550.0, cosine) - bare).max() <= 2e-15
    assert np.abs(reflectance(1.0, 1.3, 1.5, 1e-6, 550.0, cosine) - bare).max() <= 1e-15


@pytest.mark.parametrize("edge", [1.0 - 2.0**-50, 1.0 + 2.0**-50])
def test_nothing_jumps_where_film_is_outside(reflectance: Callable[..., Any], edge: float) -> None:
    at, near = (reflectance(1.0, n, 1.6 + 0.2j, 400.0, 550.0, [0.05, 0.5, 1.0]) for n in (1.0, edge))
    assert np.abs(at - near).max() <= 1e-12


def test_nothing_jumps_where_phases_get_their_second_float() -> None:
    thickness_nm = 4.0 * 550.0 / (2.0 * 1.3) + np.array([-1e-10, 1e-10])
    thin, thick = (film_reflectance(1.0, 1.3, 1.9 + 1j, d, 550.0, 0.8) for d in thickness_nm)
    assert abs(thin - thick) <= 1e-12


def test_a_full_order_more_changes_nothing_even_in_a_film_of_a_millimetre(
    reflectance: Callable[..., Any],
) -> None:
    """Straight on, n d = kλ/2 is an absentee layer; powers of two make the phase a whole number exactly."""
    bare = reflectance(1.0, 1.5, 1.5 + 0.5j, 0.0, 512.0, 1.0)
    for orders in (1, 7, 4001):
        assert abs(reflectance(1.0, 1.25, 1.5 + 0.5j, orders * 512.0 / 2.5, 512.0, 1.0) - bare) <= 1e-12


def test_backends_agree_on_any_shape_of_grid() -> None:
    pytest.importorskip("numba")
    g = np.random.default_rng(4)
    wavelength, cosine = np.linspace(360.0, 830.0, 7), np.linspace(0.0, 1.0, 5)
    shapes: list[tuple[Any, ...]] = [
        (1.0, 1.3, 1.1 + 1.5j, 4e5, wavelength, cosine[:, None]),
        (1.0, 1.3, 1.5, 400.0, wavelength[:, None], cosine),
        (1.0, 1.3, 1.5, wavelength, 500.0, cosine[:, None]),
        (1.0, 1.2 + wavelength / 1e4, 1.1 + 1j / wavelength, 400.0, wavelength, cosine[:, None]),
        (1.5, 1.0, g.uniform(0.2, 3.0, (3, 1, 1)), 300.0, wavelength, cosine[:, None]),
        (1.5, 1.0, 1.5, 300.0, 500.0, 0.3),
        (1.0, 1.3, np.ones((0, 1)), 400.0, wavelength, 0.5),
    ]
    for case in shapes:
        plain, compiled = (film_reflectance(*case, backend=backend) for backend in ("numpy", "numba"))
        assert plain.shape == compiled.shape
        assert np.abs(plain - compiled).max(initial=0.0) <= 1e-13


def test_large_grids_are_the_same_as_their_rows() -> None:
    wavelength, cosine = np.linspace(360.0, 830.0, 4001), np.linspace(0.0, 1.0, 13)
    grid = film_reflectance(1.0, 1.3, 1.1 + 1.5j, 400.0, wavelength, cosine[:, None])
    rows = [film_reflectance(1.0, 1.3, 1.1 + 1.5j, 400.0, wavelength, c) for c in cosine]
    assert np.array_equal(grid, rows)
    turned = film_reflectance(1.0, 1.3, 1.1 + 1.5j, 400.0, wavelength[:, None], cosine)
    assert np.abs(turned.T - grid).max() <= 1e-14


def test_mean_is_the_mean_of_both_polarisations() -> None:
    case = (1.0, 1.3, 0.2 + 3.4j, 400.0, np.linspace(360.0, 830.0, 9), 0.4)
    s, p = film_reflectance_polarised(*case)
    assert np.abs(film_reflectance(*case) - 0.5 * (s + p)).max() <= 2e-16
    assert np.abs(s - p).max() > 0.01
