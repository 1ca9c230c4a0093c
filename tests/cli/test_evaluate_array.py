"""`gltf-iri evaluate --in --out`: colours are those of `evaluate`, and wrong calls are one sentence."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri import evaluate as evaluate_films
from gltf_iri.cli.main import run
from gltf_iri.colour.difference import delta_e_2000

MIXED = {
    "asset": {"version": "2.0"},
    "materials": [
        {
            "name": "half",
            "pbrMetallicRoughness": {"metallicFactor": 0.25, "baseColorFactor": [0.9, 0.6, 0.3, 1.0]},
            "extensions": {
                "KHR_materials_iridescence": {"iridescenceFactor": 1.0, "iridescenceIor": 1.7},
                "KHR_materials_specular": {"specularFactor": 0.5, "specularColorFactor": [1.0, 0.8, 0.6]},
            },
        }
    ],
    "extensionsUsed": ["KHR_materials_iridescence", "KHR_materials_specular"],
}


def written(path: Path, *columns: tuple[float, float], count: int = 300, dtype: str = "f8") -> NDArray[Any]:
    g = np.random.default_rng(3)
    rows = np.stack([g.uniform(low, high, count) for low, high in columns], axis=1).astype(dtype)
    np.save(path, rows)
    return rows


def evaluated(
    capsys: pytest.CaptureFixture[str], folder: Path, *options: str
) -> tuple[dict[str, Any], NDArray[Any]]:
    out = folder / "colours.npy"
    arguments = ["evaluate", "--in", str(folder / "films.npy"), "--out", str(out), *options, "--json"]
    assert run(arguments) == 0
    return json.loads(capsys.readouterr().out), np.load(out)


@pytest.mark.parametrize("method", ["khr", "khr-guarded", "fourier", "spectral"])
def test_colours_are_those_of_evaluate(
    method: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rows = written(tmp_path / "films.npy", (0.0, 1.0), (0.0, 900.0))
    options = "--film-ior 1.4 --base-nk 0.2,3.4 --outside-ior 1.1 --white E --method"
    report, colours = evaluated(capsys, tmp_path, *options.split(), method)
    expected = evaluate_films(
        method,
        cos_theta_1=rows[:, 0],
        thickness_nm=rows[:, 1],
        film_ior=1.4,
        base_nk=(0.2, 3.4),
        outside_ior=1.1,
        white="E",
        backend="numpy",
    )
    assert np.array_equal(colours, expected.rgb)
    assert (report["method"], report["white"], report["backend"]) == (method, "E", "numpy")
    assert (report["rows"], report["delta_e"]) == (300, None)
    assert report["undefined"] == {c: int(m.sum()) for c, m in expected.undefined.items()}


def test_every_column_is_read_by_its_name(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    unit = (0.0, 1.0)
    rows = written(tmp_path / "films.npy", unit, (1.2, 2.0), unit, (1.0, 1.5), unit, (50.0, 900.0), unit)
    names = "base_g,film_ior,cos,outside_ior,base_r,thickness,base_b"
    _, colours = evaluated(capsys, tmp_path, "--columns", names, "--method", "fourier")
    g, film_ior, cosine, outside_ior, r, thickness_nm, b = rows.T
    expected = evaluate_films(
        "fourier",
        cos_theta_1=cosine,
        thickness_nm=thickness_nm,
        film_ior=film_ior,
        outside_ior=outside_ior,
        base_f0=np.stack([r, g, b], axis=1),
    ).rgb
    assert np.array_equal(colours, expected)


def test_a_grey_base_is_one_column(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = written(tmp_path / "films.npy", (0.0, 1.0), (0.0, 1.0), dtype="f4")
    _, colours = evaluated(capsys, tmp_path, "--columns", "cos,base_f0", "--thickness", "300")
    expected = evaluate_films(
        cos_theta_1=rows[:, 0], thickness_nm=300.0, base_f0=np.repeat(rows[:, 1:], 3, axis=1)
    ).rgb
    assert colours.dtype == np.float32
    assert np.array_equal(colours, expected.astype(np.float32))


def test_a_files_material_is_mixed_as_without_arrays(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "mixed.gltf"
    path.write_text(json.dumps(MIXED), encoding="utf-8")
    cosines = np.linspace(0.0, 1.0, 11)
    np.save(tmp_path / "films.npy", np.stack([cosines, np.full(11, 250.0)], axis=1))
    _, colours = evaluated(capsys, tmp_path, str(path), "--material", "half")
    named = ",".join(map(repr, cosines.tolist()))
    assert run(["evaluate", str(path), "--thickness", "250", "--cos", named, "--json"]) == 0
    alone = json.loads(capsys.readouterr().out)["rgb"]
    assert np.abs(colours - np.array(alone)).max() < 1e-14


def test_people_read_one_sentence(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    written(tmp_path / "films.npy", (0.0, 1.0), (0.0, 900.0))
    out = str(tmp_path / "colours.npy")
    assert run(["evaluate", "--in", str(tmp_path / "films.npy"), "--out", out]) == 0
    assert "300 colours" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ("--in {films}", "--out"),
        ("--out {out}", "--in"),
        ("--columns cos,thickness", "--in"),
        ("--in {films} --out {films}", "another one"),
        ("--in {films} --out {out} --cos 1,0.5", "column"),
        ("--in {films} --out {out} --layered", "--layered"),
        ("--in {films} --out {out} --thickness 300", "the column thickness"),
        ("--in {films} --out {out} --columns cos,base_f0 --base-nk 1,2", "the column base_f0"),
        ("--in {films} --out {out} --columns cos,colour", "no column 'colour'"),
        ("--in {films} --out {out} --columns cos", "shape"),
        ("--in {films} --out {out} --bragg 1,1.5,300,300,5", "mirror"),
        ("--in {films} --out {out} --base-ior 1.5 --base-f0 0.04", "one of them"),
        ("--in {films} --out {out} --base-edge-tint 1,1,1", "--base-f0"),
        ("--in {films} --out {out} --material half", "FILE"),
        ("--in {films} --out {out} --white F", "no white"),
        ("--in {films} --out {out} --method bloch", "bloch"),
        ("--in {films} --out {out} --method khr --set tolerance=1", "tolerance"),
        ("--in {films} --out {out} --method fourier --set tolerance=x", "tolerance"),
        ("--in none.npy --out {out}", "no file"),
    ],
)
def test_wrong_calls_are_refused_and_write_nothing(
    options: str, says: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    written(tmp_path / "films.npy", (0.0, 1.0), (0.0, 900.0))
    before = (tmp_path / "films.npy").read_bytes()
    names = {"films": str(tmp_path / "films.npy"), "out": str(tmp_path / "out.npy")}
    assert run(["evaluate", *options.format(**names).split()]) == 2
    assert says in capsys.readouterr().err
    assert [each.name for each in tmp_path.iterdir()] == ["films.npy"]
    assert (tmp_path / "films.npy").read_bytes() == before


@pytest.mark.parametrize("budget", ["0.5", "0.01"])
@pytest.mark.parametrize(
    ("names", "spans", "way"),
    [
        ("cos,thickness", ((0.0, 1.0), (300.0, 310.0)), "table of 2 axes"),
        ("cos,film_ior", ((0.0, 1.0), (1.2, 2.0)), "fourier"),
    ],
)
def test_a_budget_is_kept_by_tables_or_where_tables_do_not_reach_by_a_method(
    budget: str,
    names: str,
    spans: tuple[tuple[float, float], ...],
    way: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    rows = written(tmp_path / "films.npy", *spans, count=30_000)
    options = ("--columns", names, "--budget", budget, "--base-ior", "1.5", "--backend", "numpy")
    report, colours = evaluated(capsys, tmp_path, *options)
    few = slice(0, None, 61)
    given: dict[str, Any] = {"thickness_nm": 400.0} | {
        {"cos": "cos_theta_1", "thickness": "thickness_nm"}.get(name, name): column[few]
        for name, column in zip(names.split(","), rows.T, strict=True)
    }
    delta_e = delta_e_2000(colours[few], evaluate_films("spectral", base_ior=1.5, **given).rgb)
    if budget == "0.5":
        assert way in report["way"]
    assert report["delta_e"] <= float(budget)
    assert np.percentile(delta_e, 95) <= float(budget)


def test_memory_stays_bounded_whatever_the_rows(tmp_path: Path) -> None:
    peaks = []
    for count in (1 << 19, 1 << 21):
        rows = np.lib.format.open_memmap(tmp_path / "films.npy", mode="w+", dtype="f4", shape=(count, 2))
        rows.flush()
        out = str(tmp_path / "colours.npy")
        options = ("--method", "naive-rgb", "--backend", "numpy", "--json")
        # A process of its own: what earlier tests left free in this one would hide or add to what is used.
        command = [sys.executable, "-m", "gltf_iri", "evaluate", "--in", str(tmp_path / "films.npy")]
        done = subprocess.run([*command, "--out", out, *options], capture_output=True, text=True, check=True)
        peaks.append(json.loads(done.stdout)["anonymous_bytes"])
    if None in peaks:
        pytest.skip("the system does not tell how much memory a process holds")
    # As float64, what is read and written by the second call alone takes 84 MB, and by the first 21.
    assert peaks[1] - peaks[0] < 40e6
