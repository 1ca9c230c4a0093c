"""Tables of Fourneau et al. 2024 remade: every printed figure has its row, at the printed parameters."""

from __future__ import annotations

import json

import numpy as np
import pytest

from gltf_iri.bench import timing
from gltf_iri.bench.layers_rows import LayerRow
from gltf_iri.bench.layers_table1 import (
    ALPHAS,
    PERIODS_NM,
    PRINTED,
    WAYS,
    facets_drawn,
    measure_table1,
    rough_layer,
    table1_name,
)
from gltf_iri.optics.rough_bragg import facet_weight
from gltf_iri.rendering import timed_calls
from gltf_iri.rendering.context import create_context

ALPHA = 0.1
CONTRACT = {"workload", "method", "backend", "ns_per_eval", "max_abs", "delta_e_mean", "delta_e_p95"}


@pytest.fixture(scope="module")
def first() -> list[LayerRow]:
    context = create_context()
    once = pytest.MonkeyPatch()
    # One call each will do where times are not of interest.
    once.setattr(timing, "_SHORTEST_NS", 0)
    once.setattr(timed_calls, "_SHORTEST_S", 0.0)
    try:
        return measure_table1(context, 1, alphas=(ALPHA,), count=48, side=8)
    finally:
        once.undo()
        context.release()


def test_every_printed_speedup_has_its_row_on_every_backend(first: list[LayerRow]) -> None:
    for period_nm in PERIODS_NM:
        rows = [row for row in first if row.workload == table1_name(period_nm, ALPHA)]
        for backend in {row.backend for row in first}:
            printed = [row.printed for row in rows if row.backend == backend and row.printed]
            assert tuple(printed) == PRINTED[period_nm]
            assert len([row for row in rows if row.backend == backend]) == len(WAYS)


def test_rows_are_well_formed_and_speedups_those_of_the_same_layer_and_backend(
    first: list[LayerRow],
) -> None:
    for row in first:
        assert set(json.loads(json.dumps(row.to_json()))) >= CONTRACT
        same = (row.workload, row.backend, row.speedup_over)
        reference = next(each for each in first if (each.workload, each.backend, each.label) == same)
        assert row.speedup == reference.ns_per_eval / row.ns_per_eval


def test_ways_err_alike_on_every_backend(first: list[LayerRow]) -> None:
    for row in first:
        if row.backend != "numpy":
            twin = next(
                each
                for each in first
                if (each.workload, each.label, each.backend) == (row.workload, row.label, "numpy")
            )
            # float32 against float64; a landmark at the edge of the visible range moves by a step of a table.
            assert row.delta_e_mean == pytest.approx(twin.delta_e_mean, abs=0.01)


def test_what_is_ours_is_nearer_to_the_truth_than_what_was_printed(first: list[LayerRow]) -> None:
    for workload in {row.workload for row in first}:
        rows = [row for row in first if row.workload == workload]
        theirs = min(row.delta_e_mean for row in rows if row.printed)
        assert all(20.0 * row.delta_e_mean < theirs for row in rows if row.method in ("bloch", "table"))


@pytest.mark.parametrize("alpha", ALPHAS)
def test_facets_are_those_of_light_and_viewer(alpha: float) -> None:
    at = facets_drawn(alpha, 500)
    # |i + o|·cosθ_n of the half vector is cosθ_i + cosθ_o, |i + o| = 2 i·h.
    cos_n = np.sqrt(1.0 - at.n_cross_h_squared)
    np.testing.assert_allclose(2.0 * at.cos_h * cos_n, at.cos_i + at.cos_o, atol=1e-9)
    assert np.all(facet_weight(at.n_cross_h_squared, at.cos_i, at.cos_o, alpha) > 0.0)


def test_the_layer_is_the_printed_one() -> None:
    mirror = rough_layer(500.0, 0.1, 8).mirror
    assert (float(mirror.n1.real), float(mirror.n2.real)) == (1.0, 1.5)
    assert float(mirror.d1_nm) == float(mirror.d2_nm) == 250.0
