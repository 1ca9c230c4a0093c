"""`gltf-iri render` of layers of Bragg mirrors: by which method they are drawn, and what is told of it."""

from __future__ import annotations

import base64
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gltf_iri.cli.main import run

LAYER = {"ior1": 1.0, "ior2": 1.5, "periodMaximum": 500.0, "cells": 5, "roughness": 0.4}


@pytest.fixture(autouse=True)
def own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


@pytest.fixture
def painted(tmp_path: Path) -> str:
    """A triangle with one layer over paint."""
    points = np.array([[-1, -1, 0], [1, -1, 0], [0, 1, 0]], np.float32)
    data = base64.b64encode(points.tobytes()).decode()
    asset = {
        "asset": {"version": "2.0"},
        "extensionsUsed": ["EXT_materials_bragg"],
        "extensionsRequired": ["EXT_materials_bragg"],
        "buffers": [{"byteLength": 36, "uri": f"data:application/octet-stream;base64,{data}"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "type": "VEC3",
                "count": 3,
                "min": [-1, -1, 0],
                "max": [1, 1, 0],
            }
        ],
        "materials": [
            {
                "name": "painted",
                "pbrMetallicRoughness": {"metallicFactor": 0.0},
                "extensions": {"EXT_materials_bragg": {"braggFactor": 1.0, "layers": [LAYER]}},
            }
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "nodes": [{"mesh": 0}],
        "scenes": [{"nodes": [0]}],
    }
    path = tmp_path / "painted.gltf"
    path.write_text(json.dumps(asset), encoding="utf-8")
    return str(path)


def rendered(painted: str, capsys: pytest.CaptureFixture[str], *options: str) -> Any:
    out = str(Path(painted).with_name("out.png"))
    assert run(["render", painted, "-o", out, "--size", "12x12", *options, "--json"]) == 0
    (told,) = json.loads(capsys.readouterr().out)["layers"]
    return told


@pytest.mark.gl
def test_the_report_names_method_and_tables_and_whence_they_came(gl_context, painted, capsys):
    told = rendered(painted, capsys)
    assert (told["name"], told["method"]) == ("painted", "layers-bands")
    assert told["tables"]["bands"] == 16 and not told["tables"]["is_cached"]
    assert rendered(painted, capsys)["tables"]["is_cached"]


@pytest.mark.gl
def test_the_truth_is_drawn_without_tables(gl_context, painted, capsys):
    told = rendered(painted, capsys, "--method", "layers-single", "--env", "none")
    assert (told["method"], told["tables"], told["reason"]) == ("layers-single", None, "asked for")


@pytest.mark.gl
def test_what_is_printed_names_the_method(gl_context, painted, capsys):
    assert run(["render", painted, "-o", str(Path(painted).with_name("out.png")), "--size", "12x12"]) == 0
    printed = capsys.readouterr()
    assert "1 in a host of index 1, by layers-bands" in printed.out + printed.err


def test_plan_takes_a_method_for_layers(painted, capsys):
    assert run(["plan", painted, "--method", "layers-single", "--json"]) == 0
    (material,) = json.loads(capsys.readouterr().out)["materials"]
    assert material["layers"]["method"] == "layers-single"
    assert "bragg" in material["effects"]
