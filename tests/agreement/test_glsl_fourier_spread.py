"""Films whose thickness varies within a pixel: GLSL's averages are Python's up to what the table errs."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
import pytest
import single_precision
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.fourier import FOURIER_TOLERANCE
from gltf_iri.evaluation.prefiltered import prefiltered_fourier
from gltf_iri.planning.method import METHODS
from gltf_iri.rendering.optics_tables import Table, optics_table
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import GLSL_OPTICS_MAX_ABS, GLSL_SPREAD_MAX_ABS

Float32 = NDArray[np.float32]

FOURIER = METHODS["fourier"]
FINE = 1e-7
ROWS = 1500


@pytest.fixture(scope="module")
def tables() -> Mapping[str, Table]:
    """For as many orders as leave the table's error alone to be seen."""
    return {name: optics_table(name, "D65", {"tolerance": FINE}) for name in FOURIER.glsl_spread_tables}


def glsl(probe: Probe, film: Film, std_nm: NDArray[np.float64], tables: Mapping[str, Table]) -> Float32:
    arguments = film.outside_ior, film.film_ior, film.base.f0, film.thickness_nm, std_nm, film.cos_theta_1
    function = FOURIER.glsl_spread_function or ""
    return probe.call(function, "optics/fourier_spread.glsl", arguments, tables=tables)


def thick_films(seed: int, count: int = ROWS) -> Film:
    """Films of 60 nm to 6 µm with fringes, over every base that has an F0."""
    g = np.random.default_rng(seed)
    f0, nm = g.uniform(0.0, 1.0, (count, 3)) ** 2, 60.0 * 100.0 ** g.random(count)
    return single_precision.film_of(1.0, g.uniform(1.05, 2.5, count), f0, nm, g.uniform(0.0, 1.0, count))


def spreads(seed: int, count: int = ROWS) -> NDArray[np.float64]:
    return single_precision.rounded(10.0 ** np.random.default_rng(seed).uniform(-1.0, 2.5, count))


def test_averages_are_pythons(
    probe: Probe, tables: Mapping[str, Table], record_property: Callable[[str, object], None]
) -> None:
    film, std_nm = thick_films(5), spreads(6)
    error = np.abs(glsl(probe, film, std_nm, tables) - prefiltered_fourier(film, std_nm, "D65", FINE))
    record_property("measured", f"films of varying thickness, GLSL against Python: max abs {error.max():.2e}")
    assert error.max() <= GLSL_SPREAD_MAX_ABS


def test_by_default_as_many_orders_count_as_the_tolerance_asks_for(probe: Probe) -> None:
    defaults = {
        name: optics_table(name, "D65", {"tolerance": FOURIER_TOLERANCE})
        for name in FOURIER.glsl_spread_tables
    }
    film, std_nm = thick_films(7), spreads(8)
    error = np.abs(glsl(probe, film, std_nm, defaults) - prefiltered_fourier(film, std_nm, "D65", FINE))
    assert error.max() <= FOURIER_TOLERANCE + GLSL_SPREAD_MAX_ABS


def test_without_a_spread_it_is_fourier(films: Film, probe: Probe, tables: Mapping[str, Table]) -> None:
    plain = probe.evaluate("fourier", films, parameters={"tolerance": FINE}).rgb
    assert np.abs(glsl(probe, films, np.zeros(()), tables) - plain).max() <= GLSL_OPTICS_MAX_ABS


def test_films_without_fringes_are_averaged_too(probe: Probe, tables: Mapping[str, Table]) -> None:
    """So thin that all orders are in phase, and frustrated ones; sharper resonances want a finer rule."""
    g = np.random.default_rng(9)
    f0, count = g.uniform(0.0, 0.95, (400, 3)), 400
    nm, std_nm = g.uniform(0.0, 6.0, count), single_precision.rounded(g.uniform(0.0, 5.0, count))
    thin = single_precision.film_of(1.0, g.uniform(1.05, 2.5, count), f0, nm, g.uniform(0.05, 1.0, count))
    frustrated = single_precision.film_of(1.6, 1.1, f0, 20.0 * nm, g.uniform(0.0, 0.6, count))
    for film in (thin, frustrated):
        error = np.abs(glsl(probe, film, std_nm, tables) - prefiltered_fourier(film, std_nm, "D65", FINE))
        assert error.max() <= GLSL_SPREAD_MAX_ABS


def test_spread_wider_than_a_thin_film_is_a_number(probe: Probe, tables: Mapping[str, Table]) -> None:
    std_nm = np.array([0.0, 1e-30, 1.0, 1e3, 1e6])
    for nm in (0.0, 1e-6, 5.0, 1e6):
        for cosine in (0.0, 1e-8, 1.0):
            film = single_precision.film_of(1.0, 1.5, np.array([0.0, 0.5, 1.0]), nm, cosine)
            rgb = glsl(probe, film, std_nm, tables)
            assert np.isfinite(rgb).all()
            assert np.abs(rgb[:, 2] - 1.0).max() <= GLSL_OPTICS_MAX_ABS


def test_wide_spread_leaves_the_incoherent_film(probe: Probe, tables: Mapping[str, Table]) -> None:
    film = thick_films(10, 300)
    keep = film.cos_theta_1 > 0.0
    grey = probe.evaluate("incoherent", film).rgb
    rgb = glsl(probe, film, np.full(300, 600.0), tables)
    assert np.abs(rgb - grey)[keep].max() <= 2e-5
