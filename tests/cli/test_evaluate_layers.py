"""`gltf-iri evaluate --layer`: what it prints, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.cli.main import run
from gltf_iri.evaluation.layer_energy import stack_energy
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack

UPPER = ["--layer", "1,1.5,100,120,3,0.3"]
TABLE = ["--method", "layers-single-table", "--set", "nodes=32", "--set", "wavelengths=32"]


def test_json_says_where_the_light_goes(capsys: pytest.CaptureFixture[str]) -> None:
    base = ["--base-metal", "0.9,0.6,0.3", "--base-alpha", "0.2", "--base-diffuse", "0.1"]
    assert (
        run(["evaluate", *UPPER, "--layer", "1,1.7,90,110,2,0.1", *base, *TABLE, "--cos", "1,0.4", "--json"])
        == 0
    )
    found = json.loads(capsys.readouterr().out)
    assert found["method"] == "layers-single-table"
    assert found["parameters"] == {"nodes": 32, "wavelengths": 32}
    assert (found["white"], found["cos"]) == ("D65", [1.0, 0.4])
    layers = BraggLayer.of(1, 1.5, 100, 120, 3, 0.3), BraggLayer.of(1, 1.7, 90, 110, 2, 0.1)
    stack = LayerStack.of(layers, 1.0, LayerBase.of(0.1, [0.9, 0.6, 0.3], 1.0, 0.2))
    colours = layer_colours("layers-single-table", stack, parameters={"nodes": 32, "wavelengths": 32})
    energy = stack_energy(stack, [1.0, 0.4], colours)
    np.testing.assert_array_equal(found["rgb"], energy.reflected)
    np.testing.assert_array_equal(found["transmitted"], energy.transmitted)
    np.testing.assert_array_equal(found["absorbed"], energy.absorbed)


def test_people_get_a_row_for_each_angle(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", *UPPER, "--host", "1", "--cos", "1,0", *TABLE]) == 0
    shown = capsys.readouterr()
    assert "layers-single-table" in shown.out
    assert "absorbed" in shown.out
    assert "more than once" in shown.err


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--base-diffuse", "0.5"], "give --layer too"),
        ([*UPPER, "--film-ior", "1.3"], "no --film-ior"),
        ([*UPPER, "--base-alpha", "0.2"], "give both"),
        ([*UPPER, "--base-diffuse", "0.5", "--base-metal", "0.2,0.6,0.2"], "more than 1"),
        ([*UPPER, "--budget", "-1"], "A budget is"),
        ([*UPPER, "--method", "khr"], "no method 'khr' for layers"),
        ([*UPPER, "--cos", "1.5"], "must lie in [0, 1]"),
        ([*UPPER, "--white", "D50"], "no white 'D50'"),
        (["--layer", "1,1.5,100"], "is not 6 numbers"),
        (["--host", "1.2", *UPPER, "--layer", "1.2,1.5,100,100,3,0.1"], "must be the last"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_sentence(
    arguments: list[str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["evaluate", *arguments]) != 0
    assert says in capsys.readouterr().err


def test_a_budget_chooses_the_method_and_tells_what_it_errs(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", *UPPER, "--cos", "1", "--budget", "1", "--json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert told["delta_e"] <= 1.0 and told["ns_per_colour"] > 0.0
    assert run(["evaluate", *UPPER, "--cos", "1", "--budget", "0"]) == 0
    assert "layers-single, ΔE ≤ 0" in capsys.readouterr().out


def test_a_file_whose_material_has_layers_is_told_what_else_to_ask(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    layers = {"EXT_materials_bragg": {"braggFactor": 1, "layers": [{"cells": 3}]}}
    asset = {"asset": {"version": "2.0"}, "materials": [{"extensions": layers}]}
    (tmp_path / "beetle.gltf").write_text(json.dumps(asset))
    assert run(["evaluate", str(tmp_path / "beetle.gltf")]) == 2
    assert "give layers by --layer" in capsys.readouterr().err
