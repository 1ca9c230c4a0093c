"""GLSL's mirrors by landmarks are Python's, up to the rounding of float32."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray
from single_precision import rounded

from gltf_iri.bench.mirror_set import mirror_set
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import ParameterValue
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import (
    GLSL_LANDMARKS_GRAZING_MAX_ABS,
    GLSL_LANDMARKS_HALVED_MAX_ABS,
    GLSL_LANDMARKS_MAX_ABS,
    GLSL_LANDMARKS_THICK_MAX_ABS,
)

COUNT = 5000

SETTINGS: list[tuple[str, dict[str, ParameterValue]]] = [
    ("landmarks", {}),
    ("landmarks-sub", {}),
    ("landmarks-sub", {"root_finder": "newton-1", "subdivisions": 5}),
]


def mirror_of(*arguments: ArrayLike) -> Mirror:
    cos_theta_h, n1, n2, d1_nm, d2_nm, host = (rounded(each) for each in arguments)
    return Mirror.of(cos_theta_h, n1, n2, d1_nm, d2_nm, 10, host)


def bench_mirrors() -> Mirror:
    drawn = mirror_set(10, COUNT)
    return mirror_of(drawn.cos_theta_h, 1.0, drawn.n2.real, drawn.d1_nm, drawn.d2_nm, 1.0)


def any_mirrors(thickest_nm: float = 2e3) -> Mirror:
    g = np.random.default_rng(5)
    d1, d2 = np.exp(g.uniform(0.0, np.log(thickest_nm), (2, COUNT)))
    indices = g.uniform(1.0, 2.0, COUNT), g.uniform(1.0, 2.5, COUNT)
    return mirror_of(g.random(COUNT), *indices, d1, d2, g.uniform(1.0, 2.0, COUNT))


def hard_mirrors(*, d1_nm: list[float]) -> Mirror:
    rows = itertools.product(
        [0.0, 1e-45, 1e-8, 1e-4, 0.5547002, 1.0],  # 0.5547: Brewster's angle of 1.5
        [1.0, 1.3],
        [1.0, 1.0 + 1e-7, 1.5, 2.5],
        d1_nm,
        [0.0, 1e-6, 130.0, 1e5, 1e9],
        [1.0, 1.6],
    )
    return mirror_of(*np.array(list(rows)).T)


def errors(
    probe: Probe, mirror: Mirror, method: str, parameters: dict[str, ParameterValue]
) -> NDArray[np.float64]:
    glsl = probe.evaluate(method, mirror, parameters=parameters).rgb
    python = evaluate(method, mirror, parameters=parameters).rgb
    return np.asarray(np.abs(glsl - python).max(axis=-1))


@pytest.mark.parametrize(("method", "parameters"), SETTINGS)
@pytest.mark.parametrize("mirrors", [bench_mirrors, any_mirrors])
def test_glsl_landmarks_equal_python_landmarks(
    method: str,
    parameters: dict[str, ParameterValue],
    mirrors: Callable[[], Mirror],
    probe: Probe,
    record_property: Callable[[str, object], None],
) -> None:
    error = errors(probe, mirrors(), method, parameters)
    record_property("measured", f"{method} in GLSL against Python: max abs {error.max():.1e}")
    assert error.max() < GLSL_LANDMARKS_MAX_ABS


def test_cells_of_a_tenth_of_a_millimetre_agree_too(probe: Probe) -> None:
    error = errors(probe, any_mirrors(thickest_nm=1e5), "landmarks-sub", {})
    assert error.max() < GLSL_LANDMARKS_THICK_MAX_ABS


def test_ten_halvings_agree_but_for_those_that_compare_equals(probe: Probe) -> None:
    error = errors(probe, bench_mirrors(), "landmarks-sub", {"root_finder": "bisect-10"})
    assert error.max() < GLSL_LANDMARKS_HALVED_MAX_ABS
    assert np.percentile(error, 99) < GLSL_LANDMARKS_MAX_ABS


@pytest.mark.parametrize(("method", "parameters"), SETTINGS)
def test_hard_mirrors_agree(method: str, parameters: dict[str, ParameterValue], probe: Probe) -> None:
    mirror = hard_mirrors(d1_nm=[0.0, 1e-6, 100.0, 1e3, 1e5])
    mirror = Mirror.of(*(each[mirror.d2_nm < 1e6] for each in columns(mirror)))
    assert errors(probe, mirror, method, parameters).max() < GLSL_LANDMARKS_GRAZING_MAX_ABS


def test_no_thickness_leaves_glsl_without_a_number(probe: Probe) -> None:
    mirror = hard_mirrors(d1_nm=[0.0, 1e-45, 1e-30, 100.0, 1e9])
    for finder in ("newton-2", "bisect-10"):
        rgb = probe.evaluate("landmarks-sub", mirror, parameters={"root_finder": finder}).rgb
        assert np.all((rgb > -0.6) & (rgb < 1.6))  # false for NaN


def columns(mirror: Mirror) -> tuple[NDArray[np.float64], ...]:
    cells = mirror.cells.astype(np.float64)
    films = mirror.n1.real, mirror.n2.real, mirror.d1_nm, mirror.d2_nm
    every = np.broadcast_arrays(mirror.cos_theta_h, *films, cells, mirror.host_ior)
    return tuple(every)
