"""`gltf-iri bench`: the contract of its JSON."""

from __future__ import annotations

import json

import pytest

from gltf_iri.cli.main import run

CONTRACT = {"workload", "method", "backend", "ns_per_eval", "max_abs", "delta_e_mean", "delta_e_p95"}


def test_rows_keep_the_contract(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["bench", "films", "--json"]) == 0
    rows = json.loads(capsys.readouterr().out)["rows"]
    assert len(rows) == len({row["method"] for row in rows}) >= 6
    assert all(set(row) >= CONTRACT and row["workload"] == "films" for row in rows)


def test_unknown_workload_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["bench", "nothing"]) == 2
    assert "films" in capsys.readouterr().err
