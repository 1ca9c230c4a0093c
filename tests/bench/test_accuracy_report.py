"""What `bench accuracy` writes: all files tell the same, and nothing is written where nothing can be."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.bench import accuracy, accuracy_glsl, accuracy_report, accuracy_tables, timing
from gltf_iri.bench.accuracy import Subject
from gltf_iri.bench.accuracy_plot import plot_accuracy
from gltf_iri.bench.accuracy_row import AccuracyRow, Errors
from gltf_iri.bench.accuracy_text import BEGIN, END
from gltf_iri.bench.film_parts import point_parts
from gltf_iri.bench.film_set import film_set
from gltf_iri.bench.mirror_set import mirror_set
from gltf_iri.bench.real_materials import set_names
from gltf_iri.cli.main import run
from gltf_iri.planning.method import method_names
from gltf_iri.rendering import timed_calls

PNG = b"\x89PNG"
MEASURED = (*method_names("film"), *method_names("mirror"))


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make every set small and every timing short; parameters stay as they are."""
    film, mirror = film_set(8), mirror_set(5, 2)
    sets = {
        "films": lambda: Subject(film, [point_parts(film, "dielectric", 1)]),
        "mirrors-20": lambda: Subject(mirror, []),
    }
    monkeypatch.setattr(accuracy, "subjects", lambda files: sets)
    monkeypatch.setattr(accuracy, "mirror_tables", lambda mirrors: [])
    monkeypatch.setattr(accuracy_report, "plot_accuracy", lambda name, rows, renderer: PNG)
    monkeypatch.setattr(accuracy_glsl, "_SIDE", 8)
    monkeypatch.setattr(timed_calls, "_SHORTEST_S", 0.0)
    monkeypatch.setattr(timing, "_SHORTEST_NS", 0)
    monkeypatch.setattr(accuracy_tables, "_ALONG_COSINES", (16, 64))
    monkeypatch.setattr(accuracy_tables, "_POINTS", 20)


@pytest.mark.usefixtures("small")
def test_the_files_agree_and_name_every_method(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "new" / "map"
    assert run(["bench", "accuracy", "--rounds", "1", "-o", str(out), "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)["rows"]
    written = json.loads((out / "accuracy.json").read_text(encoding="utf-8"))
    with (out / "accuracy.csv").open(encoding="utf-8", newline="") as stream:
        table = list(csv.DictReader(stream))
    assert len(printed) == len(written["rows"]) == len(table)
    for row, line in zip(written["rows"], table, strict=True):
        assert [row[key] for key in ("workload", "backend", "label")] == [
            line[key] for key in ("workload", "backend", "label")
        ]
        for key in ("ns_per_eval", "delta_e_p95", "max_abs"):
            assert line[key] == ("" if row[key] is None else str(row[key]))
    assert {row["method"] for row in written["rows"]} == {*MEASURED, None}
    assert set(written["fronts"]) == {"films", "mirrors-20"}
    assert written["machine"]["threads"] == 1

    text = (out / "accuracy.md").read_text(encoding="utf-8")
    block = text[text.index(BEGIN) : text.index(END)]
    assert [name for name in MEASURED if f"| `{name}` |" not in block] == []
    costs = json.loads((out / "costs.json").read_text(encoding="utf-8"))["ns"]["numpy"]
    assert costs["films"]["fourier, tolerance 0.0001"] > 0.0
    for name in ("films", "mirrors-20"):
        assert (out / f"{name}.png").read_bytes() == PNG


def test_a_plot_takes_an_error_of_nothing_and_one_beyond_all() -> None:
    rows = [
        AccuracyRow("films", "numpy", name, name, name, ns, Errors(e, e, e, e, 0))
        for name, ns, e in (("spectral", 9e4, 0.0), ("fourier", 500.0, 0.01), ("khr", 300.0, np.nan))
    ]
    assert plot_accuracy("films", rows, None).startswith(PNG)


@pytest.mark.parametrize("below", [(), ("deeper",)])
def test_a_file_in_place_of_the_folder_is_refused_before_anything_is_measured(
    below: tuple[str, ...],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(accuracy, "subjects", lambda files: pytest.fail("measured"))
    place = tmp_path / "taken"
    place.write_text("mine", encoding="utf-8")
    assert run(["bench", "accuracy", "-o", str(place.joinpath(*below))]) == 2
    assert "not a folder" in capsys.readouterr().err
    assert place.read_text(encoding="utf-8") == "mine"


@pytest.mark.parametrize("option", ["-o", "--file"])
def test_options_of_the_map_want_the_map(option: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["bench", "films", option, __file__]) == 2
    assert "accuracy" in capsys.readouterr().err


def test_sets_of_files_have_plain_names_of_their_own() -> None:
    paths = [Path("a/x y.glb"), Path("b/x y.gltf"), Path("../…/é.glb"), Path("n" * 200 + ".glb")]
    names = set_names(paths)
    assert names[:3] == ["file-x-y", "file-x-y-2", "file-file"]
    assert len(names[3]) < 60
