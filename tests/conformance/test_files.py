"""The files of vectors: any row regenerates alone, no value hangs on a last bit, and every kind is there."""

from __future__ import annotations

import json
from collections.abc import Iterator
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_iri.conformance.bragg_cases import BRAGG_CASES
from gltf_iri.conformance.bragg_draw import BRAGG_KINDS
from gltf_iri.conformance.bragg_input import read_bragg_input
from gltf_iri.conformance.bragg_truth import bragg_outputs
from gltf_iri.conformance.khr_rows import KHR_CASES
from gltf_iri.conformance.rows import TIE, draw_row, rounded
from gltf_iri.conformance.spectral_sum import NotSettledError
from gltf_iri.conformance.vectors import ROWS, VECTORS, drawn_line, file_text

# Edge cases and random rows of every kind, but none that takes a second and more.
BRAGG_ROWS = [14, 28, 42, 56, 103, 146, 189, 275, 361, 404, 447, 490, 576, 662, 705, 791, 834, 877]
KHR_ROWS = range(0, ROWS, 53)


def numbers(value: Any) -> Iterator[float]:
    if isinstance(value, dict):
        for each in value.values():
            yield from numbers(each)
    elif isinstance(value, list):
        for each in value:
            yield from numbers(each)
    elif isinstance(value, float):
        yield value


@pytest.mark.parametrize(
    ("name", "rows"), [("ext_materials_bragg.json", BRAGG_ROWS), ("khr_materials_iridescence.json", KHR_ROWS)]
)
def test_rows_regenerate_alone_to_the_letter(name: str, rows: list[int], folder: Path) -> None:
    lines = (folder / name).read_text(encoding="utf-8").split('"rows": [\n')[1].splitlines()[:-1]
    assert len(lines) == ROWS
    for number in rows:
        assert drawn_line(name, number).line == lines[number].removesuffix(","), number


def test_rows_are_the_same_without_compiled_loops(bragg: dict[str, Any]) -> None:
    for number in (28, 103, 404, 705):
        row = bragg["rows"][number]
        assert rounded(bragg_outputs(read_bragg_input(row["input"]), "numpy")) == row["output"]


@pytest.mark.parametrize("name", VECTORS)
def test_heads_are_those_of_the_generator(name: str, folder: Path) -> None:
    text = (folder / name).read_text(encoding="utf-8")
    head = text.split('"rows": [\n')[0]
    assert file_text(name, []).startswith(head)
    assert len(text) < 1_250_000


@pytest.mark.parametrize("name", VECTORS)
def test_every_number_that_is_given_has_a_tolerance_and_its_reason(name: str, folder: Path) -> None:
    found = json.loads((folder / name).read_text(encoding="utf-8"))
    tolerances = found["tolerances"]
    for row in found["rows"]:
        assert set(row["output"]) - {"undefined"} == set(tolerances)
    for each in tolerances.values():
        assert 1e-9 <= each["absolute"] <= 1e-3
        assert len(each["reason"]) > 10
    assert set(tolerances) <= set(found["conventions"])


@pytest.mark.parametrize("name", VECTORS)
def test_numbers_have_nine_decimals_at_most(name: str, folder: Path) -> None:
    found = json.loads((folder / name).read_text(encoding="utf-8"))
    for row in found["rows"]:
        for value in numbers(row["output"]):
            assert Decimal(repr(value)).as_tuple().exponent >= -9  # type: ignore[operator]
            assert np.isfinite(value)


def test_a_value_beside_a_rounding_tie_is_drawn_again() -> None:
    values = {0: 0.1234567895 + 0.5 * TIE, 1: float("nan"), 2: 0.1234567895 + 3.0 * TIE}

    def draw(number: int, g: np.random.Generator) -> Any:
        drawn = g.random()
        attempt = next(k for k in range(9) if np.random.default_rng([number, k]).random() == drawn)
        if attempt == 1:
            raise NotSettledError("not this one")
        return None, {"attempt": attempt}, {"value": [values[attempt]]}

    drawn = draw_row(draw, 7)
    assert json.loads(drawn.line) == {"row": 7, "input": {"attempt": 2}, "output": {"value": [0.12345679]}}
    assert (drawn.tied, drawn.unsettled) == (1, 1)


def test_no_zero_is_negative() -> None:
    assert str(rounded({"a": [-1e-12]})) == "{'a': [0.0]}"


def test_every_edge_case_is_told_in_words(bragg: dict[str, Any], khr: dict[str, Any]) -> None:
    for found, cases in ((bragg, BRAGG_CASES), (khr, KHR_CASES)):
        words = [row.get("case") for row in found["rows"]]
        assert words == [case[0] for case in cases] + [None] * (ROWS - len(cases))
        assert len(set(words)) == len(cases) + 1
        assert [row["row"] for row in found["rows"]] == list(range(ROWS))


def test_the_rows_of_layers_cover_what_files_may_say(bragg: dict[str, Any]) -> None:
    rows = [read_bragg_input(row["input"]) for row in bragg["rows"]]
    facets = [each for row in rows for each in row.facets]
    shares = {
        "layers 1": [len(row.facets) == 1 for row in rows],
        "layers 2": [len(row.facets) == 2 for row in rows],
        "layers 3": [len(row.facets) == 3 for row in rows],
        "layers 4": [len(row.facets) == 4 for row in rows],
        "hosts": [row.host_ior > 1.0 for row in rows],
        "bends": [any(each.n1 != each.host_ior for each in row.facets) for row in rows],
        "metal": [row.metallic > 0.0 for row in rows],
        "glass": [row.transmission > 0.0 for row in rows],
        "black": [not row.base_colour.any() for row in rows],
        "mixed": [0.0 < row.bragg < 1.0 for row in rows],
        "no number for a smooth layer's lobe": [row.is_smooth for row in rows],
        "grazing": [min(row.cos_theta_i, row.cos_theta_o) < 0.2 for row in rows],
        "many cells": [any(each.cells > 30 for each in row.facets) for row in rows],
    }
    assert {name: sum(each) for name, each in shares.items() if sum(each) < 40} == {}
    assert sum(each.n2 < each.host_ior for each in facets) >= 40
    assert sum(each.alpha > 0.0 for each in facets) >= 800
    assert max(each.cells for each in facets) == 200
    assert min(each.alpha for each in facets if each.alpha > 0.0) >= 0.04
    assert len(BRAGG_KINDS) == 10


def test_the_rows_of_films_cover_dielectrics_and_metals(khr: dict[str, Any]) -> None:
    inputs = [row["input"] for row in khr["rows"]]
    assert sum("base_f0" in each for each in inputs) >= 400
    assert sum("base_ior" in each for each in inputs) >= 400
    assert all(("base_f0" in each) != ("base_ior" in each) for each in inputs)
    undefined = [row for row in khr["rows"] if "undefined" in row["output"]]
    assert len(undefined) >= 3
    assert all(row["output"]["khr"] is None for row in undefined)
    assert all(row["output"]["khr"] is not None for row in khr["rows"] if row not in undefined)
