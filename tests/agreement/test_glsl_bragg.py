"""GLSL's mirrors are Python's mirrors, up to the rounding of float32."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray
from single_precision import rounded

from gltf_iri.bench.mirror_set import low_contrast_set, mirror_set
from gltf_iri.colour.quadrature import SPECTRAL_DEGREE, colour_rule
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.yeh_spectral import mirror_spectrum
from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import GLSL_MIRROR_COLOUR_MAX_ABS, GLSL_OPTICS_MAX_ABS

Float64 = NDArray[np.float64]

COUNT = 5000


def reflectance(probe: Probe, arguments: list[Float64]) -> Float64:
    values = probe.call(
        "bragg_reflectance", "optics/bragg.glsl", arguments, "float", argument_types=["float"] * 8
    )
    return values.astype(np.float64)


def some_steps(arguments: list[Float64]) -> Float64:
    """Return the most that up to four float32 steps of the wavelength change in the exact reflectance."""
    here = bragg_reflectance(*arguments)
    step_nm = np.spacing(arguments[6].astype(np.float32)).astype(np.float64)
    moved = [
        np.abs(bragg_reflectance(*arguments[:6], arguments[6] + n * step_nm, arguments[7]) - here)
        for n in (-4.0, -2.0, -1.0, 1.0, 2.0, 4.0)
    ]
    return np.asarray(np.max(moved, axis=0))


@pytest.mark.gl
@pytest.mark.parametrize("cells", [1, 2, 5, 10, 20, 200])
@pytest.mark.parametrize("is_under_n1", [True, False], ids=["under n1", "any host"])
def test_glsl_mirror_equals_python_mirror(
    cells: int, is_under_n1: bool, probe: Probe, record_property: Callable[[str, object], None]
) -> None:
    """Beyond GLSL_OPTICS_MAX_ABS only where float32 steps of the wavelength move the reflectance as much."""
    g = np.random.default_rng(1988)
    n1, n2 = g.uniform(1.0, 2.0, COUNT), g.uniform(1.0, 2.5, COUNT)
    host = n1 if is_under_n1 else g.uniform(1.0, 2.0, COUNT)
    rest = [*g.uniform(20.0, 500.0, (2, COUNT)), np.full(COUNT, cells), g.uniform(380.0, 780.0, COUNT)]
    arguments = [rounded(each) for each in (host, n1, n2, *rest, g.uniform(0.05, 1.0, COUNT))]
    error = np.abs(reflectance(probe, arguments) - bragg_reflectance(*arguments))
    record_property("measured", f"{cells} cells: p99 {np.quantile(error, 0.99):.1e}, max {error.max():.1e}")
    # Doubling N times doubles the rounding of a fringe's height too, which no step of the wavelength shows.
    bound = GLSL_OPTICS_MAX_ABS * max(1.0, cells / 20.0)
    assert np.all(error <= bound + some_steps(arguments))
    if cells <= 20:
        assert np.quantile(error, 0.98) <= GLSL_OPTICS_MAX_ABS


@pytest.mark.gl
def test_glsl_mirror_knows_no_nan(probe: Probe) -> None:
    rows = itertools.product(
        [1.0, 1.5],
        [1.0, 1.5, 2.0],
        [1.0, 1.0 + 1.2e-7, 1.5, 2.3],
        [0.0, 1e-45, 1e-6, 100.0, 1e6],
        [0.0, 1e-45, 1e-6, 100.0, 1e6],
        [1, 2, 1000, 10**6],
        [360.0, 551.0, 830.0],
        [0.0, 1e-45, 1e-8, 0.5547002, 1.0],
    )
    values = reflectance(probe, [rounded(column) for column in np.array(list(rows)).T])
    assert values.min() >= 0.0
    assert values.max() <= 1.0


@pytest.mark.gl
@pytest.mark.parametrize(
    "mirror", [mirror_set(3), mirror_set(10), low_contrast_set(8)], ids=["3", "10", "low"]
)
def test_glsl_sums_the_spectrum_that_python_sums(
    mirror: Mirror, probe: Probe, record_property: Callable[[str, object], None]
) -> None:
    """By the same rule: of many cells it leaves fringes unresolved, in both alike."""
    cosine, n1, n2, d1_nm, d2_nm, host = (
        rounded(np.real(a))
        for a in (mirror.cos_theta_h, mirror.n1, mirror.n2, mirror.d1_nm, mirror.d2_nm, mirror.host_ior)
    )
    small = Mirror.of(cosine, n1, n2, d1_nm, d2_nm, mirror.cells, host)
    rule = colour_rule(SPECTRAL_DEGREE, "D65")
    python = mirror_spectrum(small, rule.wavelength_nm) @ rule.weights
    error = np.abs(probe.evaluate("yeh-spectral", small).rgb - python).max()
    record_property("measured", f"{int(mirror.cells)} cells: {error:.1e}")
    assert error <= GLSL_MIRROR_COLOUR_MAX_ABS
