"""`gltf-iri evaluate --layer`: what it prints, and what it refuses."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_iri.cli.main import run
from gltf_iri.evaluation.layer_energy import stack_energy
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf, coating_reflectance
from gltf_iri.samples.png import encode_png

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
        ([*UPPER, "--period-texel", "0.5"], "no --period-texel"),
        (["--light", "0.5"], "--light asks for the BRDF of layers"),
        (["--period-texel", "0.5"], "give a FILE"),
        (["--bragg", "1,1.5,90,90,3", "--light", "1"], "--light asks"),
        ([*UPPER, "--light", "0.5,2"], "must lie in [−1, 1]"),
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


LAYERS = [
    {"ior2": 1.5, "periodMinimum": 160, "periodMaximum": 220, "fill": 0.25, "cells": 3, "roughness": 0.5},
    {"ior2": 1.7, "periodMaximum": 200, "cells": 2, "roughness": 0.25},
]
OF_FILE = [
    "--layer",
    "1,1.5,55,165,3,0.25",
    "--layer",
    "1,1.7,100,100,2,0.0625",
    "--base-diffuse",
    "0.5,0.3,0.2",
]
PIXEL = "data:image/png;base64," + base64.b64encode(encode_png(np.zeros((1, 1, 3), np.uint8))).decode()


def beetle(folder: Path, *more: dict[str, object], **changes: object) -> str:
    """Write a file of one material with layers, `changes` of its extension made, and of `more` materials."""
    bragg = {"braggFactor": 0.75, "layers": LAYERS, "braggPeriodTexture": {"index": 0}} | changes
    material = {
        "name": "wing",
        "pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.3, 0.2, 1.0], "metallicFactor": 0.0},
        "extensions": {"EXT_materials_bragg": bragg},
    }
    asset = {"asset": {"version": "2.0"}, "extensionsUsed": ["EXT_materials_bragg"]}
    asset |= {"materials": [material, *more], "textures": [{"source": 0}], "images": [{"uri": PIXEL}]}
    path = folder / "beetle.gltf"
    path.write_text(json.dumps(asset))
    return str(path)


def told(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, Any]:
    assert run(["evaluate", *arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("how", [(), ("--light", "0.7,0.5"), ("--light", "0.7", "--white", "E")])
def test_a_file_s_layers_are_those_that_options_describe(
    how: tuple[str, ...], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    of_file = told(capsys, beetle(tmp_path), *how, *TABLE, "--cos", "0.9,0.2")
    given = told(capsys, *OF_FILE, *how, *TABLE, "--cos", "0.9,0.2")
    for key in ("rgb", "transmitted", "absorbed", "from_base") if not how else ("brdf",):
        np.testing.assert_allclose(of_file[key], given[key], rtol=0, atol=1e-12)
    assert {key: of_file[key] for key in ("method", "white", "cos", "parameters")} == {
        key: given[key] for key in ("method", "white", "cos", "parameters")
    }
    assert (of_file["material"], of_file["index"], of_file["factor"]) == ("wing", 0, 0.75)
    assert [layer["period_nm"] for layer in of_file["layers"]] == [220.0, 200.0]


def test_light_from_one_direction_gives_the_brdf(capsys: pytest.CaptureFixture[str]) -> None:
    options = ["--host", "1.3", "--base-diffuse", "0.4", "--cos", "0.8,0.3", *TABLE]
    found = told(capsys, "--layer", "1.3,1.5,100,120,3,0.3", "--light", "0.7,0.25", *options)
    stack = LayerStack.of((BraggLayer.of(1.3, 1.5, 100, 120, 3, 0.3),), 1.3, LayerBase.of(0.4))
    colours = layer_colours("layers-single-table", stack, parameters={"nodes": 32, "wavelengths": 32})
    np.testing.assert_array_equal(found["brdf"], brdf(stack, Pose.of(0.7, [0.8, 0.3], 0.25), colours))
    assert found["light"] == {"cos": 0.7, "cos_phi": 0.25}
    np.testing.assert_array_equal(found["mirrored"], coating_reflectance(1.3, [0.8, 0.3]))
    assert "rgb" not in found


def test_a_texel_places_all_periods(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = (beetle(tmp_path), "--period-texel", "0.5", "--light", "0.6", "--cos", "1", *TABLE)
    found = told(capsys, *arguments)
    assert [layer["period_nm"] for layer in found["layers"]] == [190.0, 225.0]
    assert run(["evaluate", *arguments]) == 0
    assert "190 of 160 to 220  47.5 + 142.5" in capsys.readouterr().out


def test_layered_mixes_the_surface_without_layers_in(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for how, key in (([], "rgb"), (["--light", "0.6"], "brdf")):
        arguments = [beetle(tmp_path), "--layered", *how, *TABLE, "--cos", "0.9,0.2"]
        found = told(capsys, *arguments)
        plain, stack = np.array(found["plain"]), np.array(found[key])
        np.testing.assert_allclose(found["layered"], 0.25 * plain + 0.75 * stack, rtol=0, atol=1e-15)
        assert run(["evaluate", *arguments]) == 0
        shown = capsys.readouterr()
        assert "factor 0.75" in shown.out and "plain R" in shown.out
        assert "0.25 of the surface without layers" in shown.err


def test_textures_are_told_as_left_out_only_where_their_factors_count(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    asked = [beetle(tmp_path, braggTexture={"index": 0}), *TABLE, "--cos", "1"]
    assert told(capsys, *asked)["textures_left_out"] == []
    assert told(capsys, *asked, "--layered")["textures_left_out"] == ["bragg-texture"]


def test_transmission_leaves_less_to_come_back(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = Path(beetle(tmp_path))
    asset = json.loads(path.read_text())
    asset["materials"][0]["extensions"]["KHR_materials_transmission"] = {"transmissionFactor": 0.5}
    path.write_text(json.dumps(asset))
    base = told(capsys, str(path), *TABLE, "--cos", "1", "--light", "1")["base"]
    np.testing.assert_allclose(base["diffuse"], [0.25, 0.15, 0.1])
    np.testing.assert_allclose(base["transmission"], [0.25, 0.15, 0.1])


def test_a_film_beside_excluded_layers_is_evaluated_and_they_are_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = Path(beetle(tmp_path))
    asset = json.loads(path.read_text())
    asset["materials"][0]["extensions"]["KHR_materials_iridescence"] = {"iridescenceFactor": 1.0}
    path.write_text(json.dumps(asset))
    assert run(["evaluate", str(path), "--cos", "1"]) == 0
    shown = capsys.readouterr()
    assert "400 nm" in shown.out
    assert "bragg is not in these numbers: KHR_materials_iridescence" in shown.err
    assert run(["evaluate", str(path), "--light", "1"]) == 2
    assert "--light is for layers" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("changes", "arguments", "says"),
    [
        ({"braggFactor": 0}, [], "no layers: the factor is 0"),
        ({"layers": LAYERS[:1] * 5}, [], "no layers: 5 layers are more than the 4"),
        ({}, ["--thickness", "300"], "--period-texel places them"),
        ({}, ["--period-texel", "2"], "values from 0 to 1"),
        ({"braggPeriodTexture": {"index": 1}}, [], "beetle.gltf: "),
        ({"layers": [{"ior2": 1.5}]}, ["--period-texel", "0.5"], "No period of material 'wing' varies"),
        ({}, ["--base-diffuse", "0.5"], "--base-diffuse"),
        ({}, ["--light", "2"], "must lie in [0, 1]"),
        ({}, ["--light", "0.5,0.5,0.5"], "not 1 or 2 numbers"),
        ({}, ["--method", "khr"], "no method 'khr' for layers"),
        ({}, ["--layer", "1,1.5,1,1,1,1"], "decides --layer"),
        ({}, ["--host", "1.2"], "decides --host;"),
    ],
)
def test_what_a_file_cannot_answer_is_said_in_one_sentence(
    changes: dict[str, object],
    arguments: list[str],
    says: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = beetle(tmp_path, **changes)
    assert run(["evaluate", path, *arguments]) in (1, 2)
    error = capsys.readouterr().err
    assert says in error and error.count("\n") == 1


def test_one_of_several_with_film_or_layers_is_chosen_by_name(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    film = {"name": "film", "extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1.0}}}
    path = beetle(tmp_path, film)
    assert run(["evaluate", path]) == 2
    assert "choose one with --material from: 0 wing, 1 film" in capsys.readouterr().err
    assert told(capsys, path, "--material", "film")["method"] == "khr-guarded"
    assert run(["evaluate", beetle(tmp_path, film, {"name": "plain"}), "--material", "plain"]) == 2
    assert "Material 2 plain has neither film nor layers" in capsys.readouterr().err
    assert run(["evaluate", path, "--material", "film", "--method", "layers-rgb"]) == 2
    assert "no method 'layers-rgb' for a film" in capsys.readouterr().err
