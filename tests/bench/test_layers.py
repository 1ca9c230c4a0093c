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
from gltf_iri.bench.layers_table2 import (
    CONFIGURATIONS,
    LAYER_A,
    LAYER_B,
    PRINTED_2,
    WAYS_2,
    Costs,
    measure_table2,
    smape,
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
            printed = [row.printed["speedup"] for row in rows if row.backend == backend and row.printed]
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


@pytest.fixture(scope="module")
def second() -> list[LayerRow]:
    once = pytest.MonkeyPatch()
    once.setattr(timing, "_SHORTEST_NS", 0)
    try:
        return measure_table2(Costs(side=6, samples=8, truth_samples=8, degree=16, cos_nodes=32), 1)
    finally:
        once.undo()


def test_every_printed_efficiency_has_its_row(second: list[LayerRow]) -> None:
    for place, name in enumerate(CONFIGURATIONS):
        rows = {row.method: row for row in second if row.workload == f"table 2: {name}"}
        assert set(rows) >= set(WAYS_2)
        for method, printed in PRINTED_2.items():
            assert tuple(rows[method].printed.values()) == printed[place]


def test_efficiency_is_that_of_times_and_errors(second: list[LayerRow]) -> None:
    for truth in (row for row in second if row.smape == 0.0):
        assert set(json.loads(json.dumps(truth.to_json()))) >= CONTRACT
        for row in second:
            if row.workload == truth.workload and row.smape:
                spent = row.ns_per_eval * row.parameters["samples"] * row.smape
                whole = truth.ns_per_eval * truth.parameters["samples"]
                assert row.efficiency == pytest.approx(whole / spent)


def test_the_models_ways_differ_by_less_than_their_noise(second: list[LayerRow]) -> None:
    for name in CONFIGURATIONS:
        found = {row.method: row.smape for row in second if row.workload == f"table 2: {name}"}
        # They look into the same directions: what is left is what tables and bands make of the spectra.
        for ours in ("layers-single-table", "layers-bands"):
            assert found[ours] == pytest.approx(found["layers-single"], abs=0.05)


def test_layers_are_the_printed_ones() -> None:
    for layer, thickness_nm, alpha in ((LAYER_A, 250.0, 0.1), (LAYER_B, 494.0, 0.05)):
        assert (float(layer.n1), float(layer.n2), int(layer.cells)) == (1.0, 1.5, 10)
        assert float(layer.d1_nm) == float(layer.d2_nm) == thickness_nm
        assert float(layer.alpha) == alpha
    assert CONFIGURATIONS["A over B on ρ 0.5"].base.diffuse.tolist() == [0.5] * 3


def test_smape_is_that_of_the_paper() -> None:
    assert smape(np.array([1.0, 0.0, 3.0]), np.array([3.0, 0.0, 3.0])) == pytest.approx(1.0 / 3.0)
    assert smape(np.array([1.0]), np.array([0.0])) == pytest.approx(2.0)
