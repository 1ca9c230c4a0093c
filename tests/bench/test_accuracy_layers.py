"""Layers on the map of cost and error: every method stands in it with all its settings, and has a price."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.bench import accuracy_layers, accuracy_layers_glsl
from gltf_iri.bench.accuracy_layers import (
    LAYERS,
    layer_rows,
    layer_subject,
    layer_truth,
    stack_tables,
    table_entries,
)
from gltf_iri.bench.accuracy_layers_glsl import layer_glsl_rows
from gltf_iri.bench.accuracy_report import costs_json
from gltf_iri.bench.accuracy_row import errors_of
from gltf_iri.bench.layer_set import layer_set
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import LayerStack
from gltf_iri.planning.costs import shipped_costs
from gltf_iri.planning.method import METHODS, method_names
from gltf_iri.planning.settings import ACCURACY_SETTINGS, settings_of, with_defaults
from gltf_iri.planning.way import Way
from gltf_iri.rendering import timed_calls

if TYPE_CHECKING:
    import moderngl

Float64 = NDArray[np.float64]


def ways() -> set[str]:
    """Return the label of every setting of every method for layers."""
    return {
        Way(name, with_defaults(name, each)).label
        for name in method_names("layers")
        for each in settings_of(name, ACCURACY_SETTINGS)
    }


def twins() -> list[str]:
    """Return the methods for layers that GLSL has, with their defaults."""
    names = [name for name in method_names("layers") if METHODS[name].glsl_function]
    return [Way(name, with_defaults(name, {})).label for name in names]


class Grey:
    """Colours of any stack, at once: half of all light."""

    def reflected(self, layer: int, cos_h: Float64, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3)."""
        return np.full((*np.shape(cos_h), 3), 0.5)

    def passed(self, cos_i: Float64, cos_o: Float64) -> Float64:
        """Return (..., 3)."""
        return np.full((*np.shape(cos_i), 3), 0.5)


def test_every_method_for_layers_is_measured_with_all_its_settings(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    def grey(method: str, stack: LayerStack, **chosen: Any) -> Grey:
        asked.append(Way(method, chosen["parameters"]).label)
        return Grey()

    monkeypatch.setattr(accuracy_layers, "layer_colours", grey)
    subject = layer_subject(stacks=2, poses=1)
    rows = layer_rows(LAYERS, subject, layer_truth(subject), [], 0.0, rounds=1)
    assert {row.label for row in rows} == ways() == set(asked)
    assert set(costs_json(rows, {})["ns"]["numpy"][LAYERS]) == ways()
    assert all(row.errors is not None and row.errors.delta_e_max == 0.0 for row in rows)
    assert {row.method for row in rows if row.filling_ns is not None} == {"layers-single-table"}


def test_tables_of_more_bands_err_less_and_their_filling_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(accuracy_layers, "_COS_NODES", 128)
    monkeypatch.setattr(accuracy_layers, "_TABLE_BANDS", (3, 8, 32))
    subject = layer_subject(stacks=1, poses=4)
    colours, few, many = table_entries(stack_tables(subject), subject, layer_truth(subject).rgb)
    assert colours.label == "table of colours: cos_theta 128, RGBA32F"
    errors = [each.errors.delta_e_p95 for each in (colours, few, many) if each.errors is not None]
    assert errors[0] > 2.0 * errors[1] > 4.0 * errors[2]
    assert all(each.filling_ns is not None and each.filling_ns > 0.0 for each in (colours, few, many))


def test_every_method_for_layers_has_a_price() -> None:
    missing = [way for way in ways() if not shipped_costs().ns_per_colour("numpy", LAYERS, way)]
    assert missing == [], "measure the map anew: make map"


def test_twins_and_tables_of_layers_have_a_price_in_opengl() -> None:
    tables = [f"table of {held}" for held in ("colours", "8 bands", "16 bands", "32 bands")]
    missing = [way for way in (*twins(), *tables) if not shipped_costs().ns_per_colour("glsl", LAYERS, way)]
    assert missing == [], "measure the map anew: make map"


@pytest.mark.gl
def test_layers_in_opengl_err_as_their_python_and_are_timed(
    gl_context: moderngl.Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(accuracy_layers, "_COS_NODES", 64)
    monkeypatch.setattr(accuracy_layers, "_TABLE_BANDS", (3, 8))
    monkeypatch.setattr(timed_calls, "_SHORTEST_S", 0.0)
    for side in ("_TWIN_SIDE", "_TABLE_SIDE"):
        monkeypatch.setattr(accuracy_layers_glsl, side, 2)
    subject = layer_subject(stacks=2, poses=1)
    truth, tables = layer_truth(subject), stack_tables(subject)
    rows = layer_glsl_rows(gl_context, LAYERS, subject, truth.rgb, tables, 0.0, rounds=1)
    by_way = {row.way: row for row in rows}
    assert by_way.keys() == {*twins(), "table of colours", "table of 8 bands"}
    expected = {each.way: each.errors for each in table_entries(tables, subject, truth.rgb)}
    for name in twins():
        method, values = name.split(",")[0], with_defaults(name.split(",")[0], {})
        colours = [layer_colours(method, stack, parameters=values) for stack in subject.stacks]
        expected[name] = errors_of(accuracy_layers._colours(colours, subject), truth.rgb)
    for way, row in by_way.items():
        found, wanted = row.errors, expected[way]
        assert found is not None and wanted is not None
        # Twins sum by fixed rules.
        assert found.delta_e_max == pytest.approx(wanted.delta_e_max, abs=0.2 if way in twins() else 1e-3)
        assert row.ns_per_eval > 0.0


def test_shorter_sets_of_stacks_begin_longer_ones() -> None:
    (few, seen), (many, _) = layer_set(2, 3), layer_set(5, 3)
    for short, long in zip(few.layers, many.layers, strict=True):
        np.testing.assert_array_equal(short.d1_nm, long.d1_nm[:2])
        np.testing.assert_array_equal(short.alpha, long.alpha[:2])
    assert np.all(np.abs(seen.cos_phi) <= 1.0)
