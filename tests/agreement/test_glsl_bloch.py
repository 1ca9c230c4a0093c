"""GLSL's `bloch` is Python's, up to the rounding of float32."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray
from single_precision import rounded

from gltf_iri.bench.mirror_set import low_contrast_set, mirror_set
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import ParameterValue
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import GLSL_BLOCH_MAX_ABS, GLSL_BLOCH_THICK_MAX_ABS

COUNT = 3000


def mirror_of(*arguments: ArrayLike) -> Mirror:
    """Return the mirrors in which light does not fade in n2 alone, which `bloch` leaves to others."""
    every = (np.ravel(each) for each in np.broadcast_arrays(*(rounded(a) for a in arguments)))
    cosine, n1, n2, d1_nm, d2_nm, cells, host = every
    tangential = host * host * (1.0 - cosine * cosine)
    runs = (tangential < n2 * n2) | (tangential > n1 * n1 * (1.0 + 1e-6))
    return Mirror.of(*(each[runs] for each in (cosine, n1, n2, d1_nm, d2_nm, cells, host)))


def bench_mirrors() -> Mirror:
    drawn = mirror_set(10, COUNT)
    cells = np.resize([1, 2, 5, 20, 200, 10**6], COUNT)
    return mirror_of(drawn.cos_theta_h, 1.0, drawn.n2.real, drawn.d1_nm, drawn.d2_nm, cells, 1.0)


def low_contrast_mirrors() -> Mirror:
    drawn = low_contrast_set(8, COUNT)
    return mirror_of(drawn.cos_theta_h, 1.59, 1.67, drawn.d1_nm, drawn.d2_nm, np.resize([8, 30], COUNT), 1.0)


def any_mirrors(thickest_nm: float = 2e3) -> Mirror:
    g = np.random.default_rng(8)
    d1, d2 = np.exp(g.uniform(0.0, np.log(thickest_nm), (2, COUNT)))
    cells = np.rint(10.0 ** g.uniform(0.0, 4.0, COUNT))
    indices = g.uniform(1.0, 2.0, COUNT), g.uniform(1.0, 2.5, COUNT)
    return mirror_of(g.random(COUNT), *indices, d1, d2, cells, g.uniform(1.0, 2.0, COUNT))


def hard_mirrors(thicknesses_nm: list[float], cosines: list[float]) -> Mirror:
    rows = itertools.product(
        cosines,
        [1.0, 1.3],
        [1.0, 1.0 + 1e-7, 1.5, 2.5],
        thicknesses_nm,
        thicknesses_nm,
        [1, 10**3, 10**6],
        [1.0, 1.6],
    )
    return mirror_of(*np.array(list(rows)).T)


def errors(
    probe: Probe, mirror: Mirror, parameters: dict[str, ParameterValue] | None = None
) -> NDArray[np.float64]:
    glsl = probe.evaluate("bloch", mirror, parameters=parameters or {}).rgb
    python = evaluate("bloch", mirror, backend="numpy", parameters=parameters or {}).rgb
    return np.asarray(np.abs(glsl - python).max(axis=-1))


@pytest.mark.parametrize("samples", [12, 32])
@pytest.mark.parametrize("mirrors", [bench_mirrors, low_contrast_mirrors, any_mirrors])
def test_glsl_bloch_equals_python_bloch(
    mirrors: Callable[[], Mirror],
    samples: int,
    probe: Probe,
    record_property: Callable[[str, object], None],
) -> None:
    error = errors(probe, mirrors(), {"samples": samples})
    record_property("measured", f"bloch in GLSL against Python, {samples} samples: max abs {error.max():.1e}")
    assert error.max() < GLSL_BLOCH_MAX_ABS


def test_cells_of_a_tenth_of_a_millimetre_agree_too(probe: Probe) -> None:
    assert errors(probe, any_mirrors(thickest_nm=1e5)).max() < GLSL_BLOCH_THICK_MAX_ABS


def test_hard_mirrors_agree(probe: Probe) -> None:
    # 0.5547 is Brewster's angle of 1.5.
    mirror = hard_mirrors([0.0, 100.0, 1e3, 1e5], [1e-3, 0.03, 0.5547002, 1.0])
    assert errors(probe, mirror).max() < GLSL_BLOCH_THICK_MAX_ABS


def test_nothing_leaves_glsl_without_a_number(probe: Probe) -> None:
    mirror = hard_mirrors([0.0, 1e-45, 1e-6, 100.0, 1e5, 1e9], [0.0, 1e-45, 1e-8, 1e-4, 0.03, 1.0])
    rgb = probe.evaluate("bloch", mirror).rgb
    assert np.all((rgb > -0.4) & (rgb < 1.45))  # false for NaN


def test_light_that_fades_in_the_second_film_is_reflected(probe: Probe) -> None:
    rgb = probe.evaluate("bloch", Mirror.of([0.0, 0.2, 0.5], 1.5, 1.2, 100.0, 100.0, 10)).rgb
    assert np.array_equal(rgb, np.ones((3, 3)))
