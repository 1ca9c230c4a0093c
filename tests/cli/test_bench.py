"""`gltf-iri bench`: the contract of its JSON, and what it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from gltf_iri.bench import dispersion_cost
from gltf_iri.bench.film_set import film_set
from gltf_iri.bench.films import FILM_WORKLOADS
from gltf_iri.bench.workloads import WORKLOADS
from gltf_iri.cli import bench
from gltf_iri.cli.main import run

CONTRACT = {"workload", "method", "backend", "ns_per_eval", "max_abs", "delta_e_mean", "delta_e_p95"}


def test_rows_of_films_keep_the_contract(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(FILM_WORKLOADS, "films", lambda: film_set(40))
    assert run(["bench", "films", "--rounds", "1", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    rows = report["rows"]
    names = {(row["method"], row["backend"], json.dumps(row["parameters"])) for row in rows}
    assert len(rows) == len(names) >= 6
    assert all(set(row) >= CONTRACT and row["workload"] == "films" for row in rows)
    assert report["machine"]["numpy"]


def test_rows_of_optics_keep_the_contract(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    plot = tmp_path / "bench.png"
    assert run(["bench", "W1", "--rounds", "1", "--json", "--plot", str(plot)]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["rows"]
    assert all(set(row) >= CONTRACT and row["workload"] == "W1" for row in report["rows"])
    assert all(row["is_correct"] for row in report["rows"])
    assert report["machine"]["threads"] == 1
    assert plot.read_bytes().startswith(b"\x89PNG")


def test_gold_costs_one_index_a_channel_more_than_glass_does(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(dispersion_cost, "DISPERSIVE_PAIRS", (("SiO2", "gold"), ("SiO2", "N-BK7")))
    assert run(["bench", "dispersion", "--json"]) == 0
    gold, glass = json.loads(capsys.readouterr().out)["rows"]
    assert (gold["workload"], glass["workload"]) == ("SiO2 on gold", "SiO2 on N-BK7")
    assert gold["delta_e_mean"] > 10.0 * glass["delta_e_mean"] > 0.0


def test_names_are_those_of_the_workloads() -> None:
    assert tuple(WORKLOADS) == bench.OPTICS
    assert tuple(FILM_WORKLOADS) == bench.FILMS


def test_a_table_names_machine_and_methods(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["bench", "W1", "--rounds", "1"]) == 0
    printed = capsys.readouterr().out
    assert "50 digits" in printed
    assert "AVX-512" in printed
    assert "stack" in printed


def test_compiled_loops_that_are_not_there_are_named(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(bench, "has_numba", lambda: False)
    assert run(["bench", "W1", "--rounds", "1", "--json"]) == 0
    streams = capsys.readouterr()
    assert "gltf-iri[fast]" in json.loads(streams.out)["skipped"]["numba"]
    assert "numba is left out" in streams.err


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["nothing"], "films"),
        (["films", "--peers"], "optics"),
        (["films", "--plot", "x.png"], "optics"),
        (["W1", "--plot", "x.txt"], ".png"),
        (["W1", "--plot", "no-such-folder/x.png"], "no-such-folder"),
        (["films", "--rounds", "0"], "rounds"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_wrong_calls_are_refused(arguments: list[str], says: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["bench", *arguments]) == 2
    assert says in capsys.readouterr().err
