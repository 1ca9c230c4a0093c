"""Films with exact interfaces: GLSL's are Python's up to the rounding of float32, and numbers everywhere."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.bench.film_set import film_set
from gltf_iri.colour.quadrature import SPECTRAL_DEGREE, colour_rule
from gltf_iri.evaluation.film import Base, Film
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.spectral import film_spectrum
from gltf_iri.optics.refraction import normal_index_squared
from gltf_iri.planning.method import METHODS
from gltf_iri.rendering.optics_tables import optics_table
from gltf_iri.rendering.probe import Probe
from gltf_iri.rendering.twins import ResultType
from gltf_iri.tolerances import GLSL_BRANCH_ULP, GLSL_OPTICS_MAX_ABS

Float64 = NDArray[np.float64]

ROWS = 4_000
AT_ONCE = 500


def spectral_by_the_same_rule(film: Film) -> Float64:
    """`spectral` with GLSL's wavelengths, to tell rounding from quadrature."""
    rule = colour_rule(SPECTRAL_DEGREE, "D65")
    parts = [some(film, slice(i, i + AT_ONCE)) for i in range(0, film.shape[0], AT_ONCE)]
    return np.concatenate(
        [np.einsum("rck,kc->rc", film_spectrum(part, rule.wavelength_nm), rule.weights) for part in parts]
    )


def fourier(film: Film) -> Float64:
    return evaluate("fourier", film, backend="numpy").rgb


def incoherent(film: Film) -> Float64:
    return evaluate("incoherent", film).rgb


PYTHON: dict[str, Callable[[Film], Float64]] = {
    "fourier": fourier,
    "spectral": spectral_by_the_same_rule,
    "incoherent": incoherent,
}

# Bases by their index where the twin of bases by F0 does not stand beside them.
BY_INDEX = {"fourier": "optics/fourier_index.glsl"}


def some(film: Film, rows: slice) -> Film:
    base = Base(film.base.f0[rows], film.base.index[rows])
    return Film(
        film.cos_theta_1[rows], film.thickness_nm[rows], film.film_ior[rows], base, film.outside_ior[rows]
    )


def at_the_bases_critical_angle(film: Film) -> NDArray[np.bool_]:
    """Rows where one float32 step of F0 turns the base from letting light in to reflecting all of it."""
    finite = np.where(np.isfinite(film.base.index), film.base.index, 1e6)
    n1 = film.outside_ior[:, None]
    squared = normal_index_squared(finite, n1, film.cos_theta_1[:, None])
    return np.asarray((np.abs(squared) <= GLSL_BRANCH_ULP * 2.0**-23 * n1**2).any(axis=-1))


@pytest.mark.parametrize("method", PYTHON)
def test_glsl_film_equals_python_film(
    method: str,
    films: Film,
    probe: Probe,
    request: pytest.FixtureRequest,
    record_property: Callable[[str, object], None],
) -> None:
    film = some(films, slice(0, ROWS))
    python, glsl = PYTHON[method](film), probe.evaluate(method, film)
    error = np.abs(glsl.rgb - python).max(axis=-1)
    near = at_the_bases_critical_angle(film)
    record_property(
        "measured",
        f"{request.node.callspec.id}, GLSL on {glsl.backend} against Python: "
        f"max abs {error[~near].max():.2e} over {(~near).sum()} rows; {near.sum()} within "
        f"{GLSL_BRANCH_ULP} ulp of the base's critical angle are not compared",
    )
    assert error[~near].max() <= GLSL_OPTICS_MAX_ABS
    assert np.isfinite(glsl.rgb).all()


def test_glsl_spectral_is_the_truth_of_films_that_its_wavelengths_resolve(probe: Probe) -> None:
    film = film_set(300)
    error = np.abs(probe.evaluate("spectral", film).rgb - evaluate("spectral", film).rgb)
    assert error.max() <= GLSL_OPTICS_MAX_ABS


# Cosines, thicknesses, film indices, bases' F0 and outside indices at the ends of what a film can be.
HARD = list(
    itertools.product(
        [0.0, 1e-40, 1e-20, 1e-8, 1e-4, 0.6, 1.0],
        [0.0, 1e-40, 1e-6, 400.0, 1e6],
        [1.0, 1.2, 1.5, 3.0],
        [0.0, 1e-40, 1e-12, 0.04, 1.0 - 2.0**-24, 1.0],
        [1.0, 1.5],
    )
)


@pytest.mark.parametrize("method", PYTHON)
def test_hard_films_are_numbers_between_nothing_and_all(method: str, probe: Probe) -> None:
    cosine, nm, film_ior, f0, outside = np.array(HARD).T
    given = [outside, film_ior, np.repeat(f0[:, None], 3, axis=1), nm, cosine]
    rgb = called(probe, method, given, f"optics/{method}.glsl")
    assert np.isfinite(rgb).all()
    # Negative lobes of Rec.709 let a colour leave [0, 1]; no film of these does by more.
    assert rgb.min() >= -0.3
    assert rgb.max() <= 1.5
    np.testing.assert_allclose(rgb[f0 == 1.0], 1.0, rtol=0, atol=GLSL_OPTICS_MAX_ABS)
    # Three equal media, and a film without thickness on what lies outside it.
    is_no_film = (film_ior == 1.0) | ((nm == 0.0) & (method != "incoherent"))
    nothing = (outside == 1.0) & (f0 == 0.0) & is_no_film & (cosine >= 1e-8)
    np.testing.assert_allclose(rgb[nothing], 0.0, rtol=0, atol=GLSL_OPTICS_MAX_ABS)


@pytest.mark.parametrize("method", ["fourier", "spectral"])
def test_absorbing_bases_enter_by_their_index(method: str, probe: Probe) -> None:
    g = np.random.default_rng(1902)
    n, k = (g.uniform(low, 5.0, (1000, 3)).astype(np.float32) for low in (0.05, 0.0))
    for channel in (1, 2):  # two equal channels are not yet a grey base
        n[channel::4, channel], k[channel::4, channel] = n[channel::4, 0], k[channel::4, 0]
    single = [g.uniform(low, high, 1000).astype(np.float32) for low, high in ((1.0, 2.5), (0, 1500), (0, 1))]
    film_ior, nm, cosine = (a.astype(np.float64) for a in single)
    index = n.astype(np.float64) + 1j * k
    base = Base(np.zeros((1000, 3)), index)
    python = PYTHON[method](Film(cosine, nm, film_ior, base, np.ones(1000)))
    file = BY_INDEX.get(method, f"optics/{method}.glsl")
    glsl = called(probe, method, [1.0, film_ior, n, k, nm, cosine], file)
    assert np.abs(glsl - python).max() <= GLSL_OPTICS_MAX_ABS


def called(probe: Probe, method: str, arguments: list[Any], file: str) -> Float64:
    twin = METHODS[method]
    defaults = {parameter.name: parameter.default for parameter in twin.parameters}
    tables = {name: optics_table(name, "D65", defaults) for name in twin.glsl_tables}
    types: list[ResultType] = ["vec3" if np.shape(a)[-1:] == (3,) else "float" for a in arguments]
    function = twin.glsl_function or ""
    return probe.call(function, file, arguments, argument_types=types, tables=tables).astype(np.float64)
