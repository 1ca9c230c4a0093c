"""`gltf-iri evaluate`: the contract of its JSON and its one-sentence failures."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from gltf_iri import backends
from gltf_iri.cli.main import run
from gltf_iri.evaluation.film import Film, base_from_edge_tint, base_from_f0, base_from_ior
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import METHODS, method_names

TWO_FILMS = {
    "asset": {"version": "2.0"},
    "materials": [
        {"name": "plain"},
        {"name": "a", "extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 0.5}}},
        {"name": "b", "extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1.0}}},
    ],
    "extensionsUsed": ["KHR_materials_iridescence"],
}


@pytest.fixture
def two_films(tmp_path: Path) -> str:
    path = tmp_path / "two.gltf"
    path.write_text(json.dumps(TWO_FILMS), encoding="utf-8")
    return str(path)


def answer(capsys: pytest.CaptureFixture[str], *arguments: str) -> dict[str, object]:
    assert run(["evaluate", *arguments, "--json"]) == 0
    return json.loads(capsys.readouterr().out)


@pytest.mark.parametrize("method", method_names("film"))
def test_options_describe_the_film(method: str, capsys: pytest.CaptureFixture[str]) -> None:
    options = "--film-ior 1.4 --thickness 250 --base-nk 0.2,3.4 --outside-ior 1.1 --cos 1,0.5 --white E"
    found = answer(capsys, *options.split(), "--method", method)
    expected = evaluate(method, Film.of([1.0, 0.5], 250.0, 1.4, base_from_ior(0.2 + 3.4j), 1.1), white="E")
    assert found["method"] == method
    assert found["white"] == expected.white
    assert found["cos"] == [1.0, 0.5]
    assert np.array_equal(np.array(found["rgb"]), expected.rgb)


def test_one_reflectance_stands_for_three_channels(capsys: pytest.CaptureFixture[str]) -> None:
    found = answer(capsys, "--base-f0", "0.5", "--cos", "0.7")
    expected = evaluate("khr-guarded", Film.of([0.7], 400.0, 1.3, base_from_f0([0.5] * 3))).rgb
    assert np.array_equal(np.array(found["rgb"]), expected)


def test_edge_tint_makes_a_metal_of_the_base_colour(capsys: pytest.CaptureFixture[str]) -> None:
    options = "--base-f0 0.9,0.6,0.3 --base-edge-tint 1,0.5,0 --method spectral --cos 1,0.3 --thickness 300"
    found = answer(capsys, *options.split())
    base = base_from_edge_tint([0.9, 0.6, 0.3], [1.0, 0.5, 0.0])
    assert base.index[0].imag > 0.0
    assert base.index[2].imag == 0.0
    expected = evaluate("spectral", Film.of([1.0, 0.3], 300.0, 1.3, base)).rgb
    assert np.array_equal(np.array(found["rgb"]), expected)
    assert run(["evaluate", "--base-edge-tint", "1,0.5,0"]) == 2
    assert run(["evaluate", "--base-f0", "0.5", "--base-edge-tint", "1,0.5,2"]) == 2


@pytest.mark.parametrize("method", method_names("mirror"))
def test_options_describe_the_mirror(method: str, capsys: pytest.CaptureFixture[str]) -> None:
    options = "--bragg 1.56,1.68,95,90,20 --host 1.1 --cos 1,0.5 --white E"
    found = answer(capsys, *options.split(), "--method", method)
    mirror = Mirror.of([1.0, 0.5], 1.56, 1.68, 95.0, 90.0, 20, 1.1)
    expected = evaluate(method, mirror, white="E")
    assert found["method"] == method
    assert np.array_equal(np.array(found["rgb"]), expected.rgb)
    assert found["backend"] == "numpy"
    assert found["parameters"] == dict(expected.parameters)


def test_a_setting_reaches_its_method(capsys: pytest.CaptureFixture[str]) -> None:
    options = "--film-ior 1.9 --cos 1 --method bb17 --set orders=1"
    found = answer(capsys, *options.split())
    film = Film.of([1.0], 400.0, 1.9, base_from_ior(1.5))
    assert found["parameters"] == {"orders": 1}
    assert np.array_equal(np.array(found["rgb"]), evaluate("bb17", film, parameters={"orders": 1}).rgb)
    assert not np.array_equal(np.array(found["rgb"]), evaluate("bb17", film).rgb)


def test_help_names_every_parameter(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", "--help"]) == 0
    shown = capsys.readouterr().out
    assert all(each.name in shown for method in METHODS.values() for each in method.parameters)


def test_compiled_loops_that_are_not_there_are_asked_for(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(backends, "has_numba", lambda: False)
    assert run(["evaluate", "--method", "fourier", "--backend", "numba"]) == 3
    assert "gltf-iri[fast]" in capsys.readouterr().err


def test_undefined_values_are_null_and_named(capsys: pytest.CaptureFixture[str]) -> None:
    found = answer(capsys, "--base-f0", "0.9999", "--method", "khr", "--cos", "1")
    assert found["rgb"] == [[None, None, None]]
    assert list(found["undefined"].values()) == [[1.0]]


def test_material_is_chosen_by_name_or_number(two_films: str, capsys: pytest.CaptureFixture[str]) -> None:
    by_name = answer(capsys, two_films, "--material", "b")
    by_number = answer(capsys, two_films, "--material", "2")
    assert by_name == by_number
    assert by_name["material"] == "b"
    assert (by_name["factor"], by_name["thickness_range_nm"]) == (1.0, [400.0, 400.0])


def test_layered_adds_specular_and_base_weight(two_films: str, capsys: pytest.CaptureFixture[str]) -> None:
    found = answer(capsys, two_films, "--material", "a", "--layered", "--cos", "1,0.3")
    assert np.array(found["specular"]).shape == (2, 3)
    assert np.array(found["base_weight"]).shape == (2,)


def test_textures_that_change_the_base_are_named_when_left_out(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    base = {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 0}}
    textured = {**TWO_FILMS["materials"][2], "pbrMetallicRoughness": base}
    images = {"textures": [{"source": 0}], "images": [{"uri": "a.png"}]}
    path = tmp_path / "textured.gltf"
    path.write_text(json.dumps({**TWO_FILMS, "materials": [TWO_FILMS["materials"][1], textured], **images}))
    assert answer(capsys, str(path), "--material", "a")["textures_left_out"] == []
    left_out = ["base-color-texture", "metallic-roughness-texture"]
    assert answer(capsys, str(path), "--material", "b")["textures_left_out"] == left_out
    assert run(["evaluate", str(path), "--material", "b"]) == 0
    assert f"without {', '.join(left_out)}." in capsys.readouterr().err


def test_table_shows_what_json_says(two_films: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", two_films, "--material", "b", "--cos", "0.5"]) == 0
    shown = capsys.readouterr().out
    rgb = answer(capsys, two_films, "--material", "b", "--cos", "0.5")["rgb"][0]
    assert all(f"{value:.6f}" in shown for value in rgb)


@pytest.mark.parametrize(
    "wrong",
    [
        "--cos 1,x",
        "--cos 2",
        "--base-nk 1",
        "--base-f0 0.1,0.2",
        "--base-f0 1.5",
        "--base-f0 0.1 --base-ior 1.5",
        "--method nobody",
        "--method=",
        "--white D50",
        "--material 1",
        "--layered",
        "--thickness -1",
        "--host 1",
        "--base-edge-tint 1,1,1",
        "--bragg 1.5,1.6,90,90",
        "--bragg 1.5,1.6,90,90,0",
        "--bragg 1.5,1.6,90,90,2.5",
        "--bragg 1.5,nan,90,90,5",
        "--bragg 1.5,1.6,-1,90,5",
        "--bragg 1.5,1.6,1e9,1e9,1000000 --cos 1",
        "--bragg 1.5,1.6,90,90,5 --thickness 100",
        "--bragg 1.5,1.6,90,90,5 --method fourier",
        "--bragg 1.9,1.2,90,90,5 --method bloch",
        "--method bloch",
        "--method bb17 --set orders",
        "--method bb17 --set orders=4",
        "--method bb17 --set order=1",
        "--method bb17 --set orders=1 --set orders=2",
        "--method spectral --backend numba",
        "--backend gpu",
        "missing.gltf",
    ],
)
def test_wrong_calls_leave_with_two_and_one_line(wrong: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["evaluate", *wrong.split()]) == 2
    streams = capsys.readouterr()
    assert streams.out == ""
    assert streams.err.count("\n") == 1


@pytest.mark.parametrize(
    "wrong", ["", "--material plain", "--material 7", "--material b --film-ior 2", "--material b --method="]
)
def test_wrong_questions_about_a_file_too(
    wrong: str, two_films: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["evaluate", two_films, *wrong.split()]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_choice_is_offered_only_where_there_is_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "some.gltf"

    def refusal(materials: list[object], *arguments: str) -> str:
        path.write_text(json.dumps({**TWO_FILMS, "materials": materials}), encoding="utf-8")
        assert run(["evaluate", str(path), *arguments]) == 2
        return capsys.readouterr().err

    plain, *films = TWO_FILMS["materials"]
    assert refusal([plain]).endswith("some.gltf has no material with a film or layers; name another file.\n")
    assert refusal([plain, *films]).endswith("choose one with --material from: 1 a, 2 b.\n")
    assert refusal([plain] * 500, "--material", "x").endswith("7 plain and 492 more.\n")
