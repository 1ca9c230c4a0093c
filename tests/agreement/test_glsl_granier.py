"""The layered surface of Granier & Heidrich: GLSL's is Python's, also with tilted and lobed boundaries."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from single_precision import rounded

from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.granier_heidrich import evaluate_granier_heidrich
from gltf_iri.optics.granier_heidrich import inner_normal, layered_diffuse, layered_reflection
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import GLSL_OPTICS_MAX_ABS

ROWS = 20_000
FILE = "optics/granier_heidrich.glsl"

Float64 = NDArray[np.float64]
G = np.random.default_rng(2003)


def unit(spread: float) -> Float64:
    """Directions about the vertical."""
    slopes = G.normal(0.0, spread, (ROWS, 2))
    vectors = np.column_stack([slopes, np.ones(ROWS)])
    return rounded(vectors / np.linalg.norm(vectors, axis=1)[:, None])


def bound(turns: Float64) -> Float64:
    """What float32 leaves of an undamped fringe: some four roundings of each of its turns, in radians."""
    return np.asarray(GLSL_OPTICS_MAX_ABS + 4.0 * 2.0**-24 * 2.0 * np.pi * turns)


def test_the_brdf_of_tilted_boundaries(probe: Probe) -> None:
    layer_ior, nm = rounded(G.uniform(1.3, 2.0, (ROWS, 3))), rounded(G.uniform(0.0, 400.0, ROWS))
    lobes = [rounded(G.uniform(1.0, 20.0, ROWS)) for _ in range(2)]
    up = np.tile([0.0, 0.0, 1.0], (ROWS, 1))
    arguments = [unit(1.0), unit(1.0), up, unit(0.1), np.ones(ROWS), layer_ior, nm, *lobes]
    error = np.abs(probe.call("layered_reflection", FILE, arguments) - layered_reflection(*arguments))
    # The exponents multiply the lobes' rounding.
    assert error.max() <= 20.0 * GLSL_OPTICS_MAX_ABS
    assert error.mean() <= GLSL_OPTICS_MAX_ABS


def test_the_diffuse_share(probe: Probe) -> None:
    layer_ior, nm = rounded(G.uniform(1.0, 2.5, (ROWS, 3))), rounded(G.uniform(0.0, 1000.0, ROWS))
    arguments = [np.ones(ROWS), layer_ior, nm]
    error = np.abs(probe.call("layered_diffuse", FILE, arguments) - layered_diffuse(*arguments))
    assert np.all(error <= bound(2.0 * 2.5 * nm / 445.0)[:, None])


def test_the_inner_normal(probe: Probe) -> None:
    along = np.tile(np.eye(3)[:2], (ROWS, 1, 1))
    slopes = [rounded(G.normal(0.0, 0.5, ROWS)) for _ in range(2)]
    arguments = [np.tile([0.0, 0.0, 1.0], (ROWS, 1)), along[:, 0], along[:, 1], *slopes]
    error = np.abs(probe.call("inner_normal", FILE, arguments) - inner_normal(*arguments))
    assert error.max() <= GLSL_OPTICS_MAX_ABS


@pytest.mark.parametrize("longest_nm", [1_000.0, 10_000.0])
def test_the_method(probe: Probe, longest_nm: float) -> None:
    outside = rounded(np.where(np.arange(ROWS) % 4 == 0, G.uniform(1.0, 1.7, ROWS), 1.0))
    film = Film.of(
        rounded(G.random(ROWS)),
        rounded(longest_nm * G.random(ROWS)),
        rounded(G.uniform(1.0, 3.0, ROWS)),
        base_from_ior(1.5),
        outside,
    )
    python = evaluate_granier_heidrich(film, "D65").rgb
    error = np.abs(probe.evaluate("granier-heidrich", film).rgb - python).max(axis=-1)
    # Next to the critical angle the layer's cosine is what float32 leaves of a difference of ones.
    ratio = film.outside_ior / film.film_ior
    inside = np.sqrt(np.maximum(1.0 - ratio**2 * (1.0 - film.cos_theta_1**2), 0.0))
    is_ordinary = inside > 0.05
    turns = 2.0 * film.film_ior * film.thickness_nm / 445.0 / np.maximum(inside, 0.05)
    assert is_ordinary.mean() > 0.8
    assert np.all(error[is_ordinary] <= bound(turns)[is_ordinary])
    assert np.all(np.isfinite(error))
