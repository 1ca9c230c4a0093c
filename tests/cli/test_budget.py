"""`--budget` on the verbs: what it chooses, what it tells, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_iri.budgets.search import figure
from gltf_iri.cli.budget import nanoseconds
from gltf_iri.cli.main import run
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.planning.costs import shipped_costs

FILM = {"iridescenceFactor": 1.0, "iridescenceIor": 1.4}


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


@pytest.fixture
def films(tmp_path: Path) -> str:
    def material(name: str, film: dict[str, Any], **pbr: float) -> dict[str, Any]:
        pbr = {"metallicFactor": 0.0, "roughnessFactor": 0.0, **pbr}
        extensions = {"KHR_materials_iridescence": film} if film else {}
        return {"name": name, "pbrMetallicRoughness": pbr, "extensions": extensions}

    asset = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["KHR_materials_iridescence"],
        "materials": [
            material("plain", {}),
            material("film", FILM),
            material("weak", FILM | {"iridescenceFactor": 0.01}),
            material("film again", FILM),
        ],
    }
    path = tmp_path / "films.gltf"
    path.write_text(json.dumps(asset), encoding="utf-8")
    return str(path)


def answer(capsys: pytest.CaptureFixture[str], *arguments: str) -> Any:
    assert run([*arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_evaluate_tells_the_way_and_keeps_the_budget(capsys: pytest.CaptureFixture[str]) -> None:
    film = ("evaluate", "--thickness", "300", "--base-f0", "0.9,0.6,0.3")
    truth = answer(capsys, *film, "--budget", "0")
    assert (truth["way"], truth["delta_e"]) == ("spectral", 0.0)
    found = answer(capsys, *film, "--budget", "0.5")
    assert found["delta_e"] <= 0.5
    assert found["way"].startswith(found["method"])
    assert np.percentile(delta_e_2000(found["rgb"], truth["rgb"]), 95) <= found["delta_e"]
    assert run([*film, "--budget", "0.5"]) == 0
    assert (
        f"ΔE ≤ {figure(found['delta_e'])} for {nanoseconds(found['ns_per_colour'])} a"
        in capsys.readouterr().out
    )


def test_evaluate_takes_mirrors_and_materials(films: str, capsys: pytest.CaptureFixture[str]) -> None:
    mirror = answer(capsys, "evaluate", "--bragg", "1,1.5,100,90,10", "--cos", "1,0.5", "--budget", "1")
    assert mirror["delta_e"] <= 1.0
    found = answer(capsys, "evaluate", films, "--material", "film", "--budget", "0.1")
    truth = answer(capsys, "evaluate", films, "--material", "film", "--budget", "0")
    assert (found["material"], truth["method"]) == ("film", "spectral")
    assert np.percentile(delta_e_2000(found["rgb"], truth["rgb"]), 95) <= found["delta_e"] <= 0.1
    without = answer(capsys, "evaluate", films, "--material", "film")
    assert "way" not in without


def test_plan_tells_the_way_its_cost_and_its_error(films: str, capsys: pytest.CaptureFixture[str]) -> None:
    plain, film, weak, again = answer(capsys, "plan", films, "--budget", "0.5")["materials"]
    assert plain["way"] is None
    way = film["way"]
    assert 0.0 < way["delta_e"] <= 0.5
    assert way["ns_per_colour"] == shipped_costs().ns_of("glsl", "films", way["label"])
    assert again["way"] == way
    assert "the cheapest within ΔE 0.5" in film["method_reason"]
    assert "iridescence" not in weak["effects"]
    assert "too weak to be seen: without it ΔE ≤" in weak["skipped"]["iridescence"]
    assert run(["plan", films, "--budget", "0.5"]) == 0
    shown = capsys.readouterr().out
    assert f"{way['label']}: ΔE ≤ {figure(way['delta_e'])}, {way['ns_per_colour']:.3g} ns" in shown


def test_a_budget_of_zero_plans_the_truth(films: str, capsys: pytest.CaptureFixture[str]) -> None:
    _, film, weak, _ = answer(capsys, "plan", films, "--budget", "0")["materials"]
    assert film["way"]["label"] == weak["way"]["label"] == "spectral"
    assert film["way"]["tables"] == []


def test_what_cannot_be_kept_names_the_best(films: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["plan", films, "--budget", "1e-9"]) == 2
    shown = capsys.readouterr()
    assert "Nothing keeps ΔE 1e-09 for 3 of 4 materials, 1 film, 2 weak, 3 film again" in shown.err
    told = next(line for line in shown.out.splitlines() if "budget" in line)
    assert "No way keeps ΔE 1e-09: the best is" in told and "Planned without it." in told
    least = told.split("Ask for ")[1].split(" or more")[0]
    assert run(["plan", films, "--budget", least]) == 0
    assert capsys.readouterr().err.count("\n") == 2  # the notes of a file without geometry


# Light travels millimetres in it; the other lies in its reach.
TOO_FINE = {"ior2": 2.0, "periodMaximum": 10000.0, "cells": 1000, "roughness": 0.5}
LAYER = {"ior2": 1.5, "periodMaximum": 220.0, "cells": 2, "roughness": 0.5}


def layered(folder: Path, *layers: dict[str, float]) -> str:
    """Write a file of a film and of one material for each of `layers`."""
    pbr = {"baseColorFactor": [0.0, 0.0, 0.0, 1.0], "metallicFactor": 0.0}
    materials: list[dict[str, Any]] = [{"name": "film", "extensions": {"KHR_materials_iridescence": FILM}}]
    for index, layer in enumerate(layers):
        bragg = {"EXT_materials_bragg": {"braggFactor": 1.0, "layers": [layer]}}
        materials.append({"name": f"wing {index}", "pbrMetallicRoughness": pbr, "extensions": bragg})
    asset = {"asset": {"version": "2.0"}, "materials": materials}
    path = folder / "layered.gltf"
    path.write_text(json.dumps(asset), encoding="utf-8")
    return str(path)


def test_one_material_that_nothing_keeps_leaves_the_others_their_plans(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = layered(tmp_path, TOO_FINE, LAYER)
    assert run(["plan", path, "--budget", "3", "--json"]) == 2
    shown = capsys.readouterr()
    film, fine, coarse = json.loads(shown.out)["materials"]
    assert film["way"] is not None and film["budget_unkept"] is None
    assert 0.0 < coarse["layers"]["delta_e"] <= 3.0 and coarse["budget_unkept"] is None
    assert "fringes so fine cannot be judged" in fine["budget_unkept"]["reason"]
    assert fine["budget_unkept"]["delta_e"] is None
    assert fine["layers"]["delta_e"] is None  # as without a budget
    assert "for material 'wing 0': " in shown.err
    assert run(["plan", path, "--budget", "3"]) == 2
    assert "No ΔE 3 can be promised: Layers in which" in capsys.readouterr().out


@pytest.mark.parametrize("verb", ["evaluate", "plan", "render", "compare"])
@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        (("--budget", "-1"), "not -1"),
        (("--budget", "nan"), "not nan"),
        (("--budget", "inf"), "not inf"),
        (("--budget", "1", "--method", "khr"), "do not go together"),
        (("--budget", "x"), "not a valid float"),
    ],
)
def test_wrong_calls_say_so(
    verb: str,
    wrong: tuple[str, ...],
    says: str,
    films: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    place = {"render": ["-o", str(tmp_path / "out.png")]}.get(verb, [])
    assert run([verb, films, *place, *wrong]) == 2
    assert says in capsys.readouterr().err
    assert not (tmp_path / "out.png").exists()


def test_settings_and_rays_choose_by_themselves(films: str, tmp_path: Path) -> None:
    assert run(["evaluate", "--budget", "1", "--set", "tolerance=1e-3"]) == 2
    assert run(["render", films, "-o", str(tmp_path / "out.png"), "--budget", "1", "--reference"]) == 2


def test_render_tells_each_film_s_way_and_whether_its_table_lay_in_the_cache(
    gl_context: object, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = str(Path(__file__).parents[2] / "samples" / "beetle" / "beetle.glb")
    drawing = ["render", file, "-o", str(tmp_path / "out.png"), "--size", "32x24", "--env", "white"]
    drawing += ["--budget", "0.5"]
    assert run(drawing) == 0
    assert "bytes, filled in " in capsys.readouterr().out
    assert run(drawing) == 0
    assert "bytes, from the cache" in capsys.readouterr().out
    (way,) = answer(capsys, *drawing)["ways"]
    assert way["label"].startswith("table of ")
    assert [table["is_cached"] for table in way["tables"]] == [True]
    assert way["reason"].startswith("of ")
    assert run(["plan", file, "--budget", "0.5"]) == 0
    assert "the cache" not in capsys.readouterr().out
