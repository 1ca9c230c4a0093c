"""Layers on the map of cost and error: every method stands in it with all its settings, and has a price."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.bench import accuracy_layers
from gltf_iri.bench.accuracy_layers import LAYERS, layer_rows, layer_subject, table_entries
from gltf_iri.bench.accuracy_report import costs_json
from gltf_iri.bench.layer_set import layer_set
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import LayerStack
from gltf_iri.planning.costs import shipped_costs
from gltf_iri.planning.method import method_names
from gltf_iri.planning.settings import ACCURACY_SETTINGS, settings_of, with_defaults
from gltf_iri.planning.way import Way

Float64 = NDArray[np.float64]


def ways() -> set[str]:
    """Return the label of every setting of every method for layers."""
    return {
        Way(name, with_defaults(name, each)).label
        for name in method_names("layers")
        for each in settings_of(name, ACCURACY_SETTINGS)
    }


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
    monkeypatch.setattr(accuracy_layers, "_TABLE_BANDS", ())
    rows = layer_rows(LAYERS, layer_subject(stacks=2, poses=1), 0.0, rounds=1)
    assert {row.label for row in rows} == ways() == set(asked)
    assert set(costs_json(rows, {})["ns"]["numpy"][LAYERS]) == ways()
    assert all(row.errors is not None and row.errors.delta_e_max == 0.0 for row in rows)
    assert {row.method for row in rows if row.filling_ns is not None} == {"layers-single-table"}


def test_tables_of_more_bands_err_less_and_their_filling_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(accuracy_layers, "_COS_NODES", 128)
    monkeypatch.setattr(accuracy_layers, "_TABLE_BANDS", (3, 8, 32))
    subject = layer_subject(stacks=1, poses=4)
    truth = [layer_colours("layers-single", stack) for stack in subject.stacks]
    colours, few, many = table_entries(subject, accuracy_layers._colours(truth, subject))
    assert colours.label == "table of colours: cos_theta 128, RGBA32F"
    errors = [each.errors.delta_e_p95 for each in (colours, few, many) if each.errors is not None]
    assert errors[0] > 2.0 * errors[1] > 4.0 * errors[2]
    assert all(each.filling_ns is not None and each.filling_ns > 0.0 for each in (colours, few, many))


def test_every_method_for_layers_has_a_price() -> None:
    missing = [way for way in ways() if not shipped_costs().ns_per_colour("numpy", LAYERS, way)]
    assert missing == [], "measure the map anew: make map"


def test_shorter_sets_of_stacks_begin_longer_ones() -> None:
    (few, seen), (many, _) = layer_set(2, 3), layer_set(5, 3)
    for short, long in zip(few.layers, many.layers, strict=True):
        np.testing.assert_array_equal(short.d1_nm, long.d1_nm[:2])
        np.testing.assert_array_equal(short.alpha, long.alpha[:2])
    assert np.all(np.abs(seen.cos_phi) <= 1.0)
