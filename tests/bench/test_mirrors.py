"""Mirrors: every method has its row, and the descriptors state what is measured."""

from __future__ import annotations

import functools

import pytest

from gltf_iri.bench import mirrors
from gltf_iri.bench.colour_rows import ColourRow
from gltf_iri.bench.landmark_cost import landmark_cost
from gltf_iri.bench.mirrors import MIRROR_WORKLOADS, landmark_parts, measure_mirrors
from gltf_iri.optics.landmarks import ROOT_FINDERS
from gltf_iri.planning.method import METHODS, method_names
from gltf_iri.planning.settings import SETTINGS, settings_of, with_defaults

STATED_ON = "mirrors-20"  # what METHODS' delta_e_mean of mirrors speaks of


@pytest.fixture(scope="module")
def rows() -> list[ColourRow]:
    return measure_mirrors(STATED_ON, rounds=1)


@pytest.mark.parametrize("method", method_names("mirror"))
def test_descriptors_state_what_is_measured(method: str, rows: list[ColourRow]) -> None:
    stated = METHODS[method].delta_e_mean
    row = next(row for row in rows if row.method == method)
    assert stated is not None
    assert row.delta_e_mean == pytest.approx(stated, rel=2e-3, abs=0.01)


def test_every_method_backend_and_setting_has_its_row(rows: list[ColourRow]) -> None:
    measured = {(row.method, row.backend, str(dict(row.parameters))) for row in rows}
    wanted = {
        (name, backend, str(with_defaults(name, chosen)))
        for name in method_names("mirror")
        for backend in METHODS[name].backends
        for chosen in settings_of(name)
    }
    assert measured == wanted
    assert all(row.ns_per_eval > 0.0 for row in rows)


def test_what_landmarks_spend_on_what_has_rows_without_a_colour(monkeypatch: pytest.MonkeyPatch) -> None:
    few = functools.partial(landmark_cost, count=50, rounds=1)
    monkeypatch.setattr(mirrors, "landmark_cost", few)
    parts = landmark_parts()
    assert {row.parameters["root_finder"] for row in parts} == set(ROOT_FINDERS)
    assert all(row.max_abs is None and row.delta_e_max is None for row in parts)


def test_ratios_are_those_of_times_on_the_same_backend(rows: list[ColourRow]) -> None:
    for row in rows:
        if row.method == "yeh-spectral":
            continue
        reference = next(r for r in rows if (r.method, r.backend) == ("landmarks-sub", row.backend))
        assert row.ratio == row.ns_per_eval / reference.ns_per_eval


@pytest.mark.parametrize("method", SETTINGS)
def test_settings_are_those_that_a_method_knows(method: str) -> None:
    known = {each.name: each for each in METHODS[method].parameters}
    for chosen in SETTINGS[method]:
        for name, value in chosen.items():
            assert known[name].checked(value, method) == value


def test_the_workloads_have_the_cells_that_they_are_called_by() -> None:
    for name, subjects in MIRROR_WORKLOADS.items():
        assert subjects().cells == int(name.rpartition("-")[2])
