"""`gltf-iri bench aliasing`: its rows, its folder, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from gltf_iri.bench import aliasing
from gltf_iri.cli.main import run

CONTRACT = {"workload", "method", "backend", "ns_per_eval", "max_abs", "delta_e_mean", "delta_e_p95"}


@pytest.mark.usefixtures("gl_context")
def test_figures_and_pictures_lie_in_the_folder(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(aliasing, "ALIASING_SIZES", {16: 8})
    monkeypatch.setattr(aliasing, "TEXTURE_ROWS", 64)
    folder = tmp_path / "new"
    assert run(["bench", "aliasing", "-o", str(folder), "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert [row["way"] for row in report["rows"]] == list(aliasing.WAYS)
    assert all(set(row) >= CONTRACT and row["workload"] == "aliasing" for row in report["rows"])
    assert report["machine"]["gl_renderer"]
    assert json.loads((folder / "aliasing.json").read_text())["rows"] == report["rows"]
    assert (folder / "aliasing.webp").read_bytes()[8:12] == b"WEBP"


def test_a_folder_is_for_the_workloads_that_write_one(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    assert run(["bench", "films", "-o", str(tmp_path)]) == 2
    assert "accuracy or aliasing" in capsys.readouterr().err
