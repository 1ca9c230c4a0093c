"""What is generated says what the tables say; staleness is seen and named."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from gltf_iri import generate
from gltf_iri.evaluation.khr_guarded import MATCHED_F0
from gltf_iri.material.fields import Kind, properties
from gltf_iri.material.material import Material
from gltf_iri.rendering.constants import film_constants_glsl, glsl_float

CHECKOUT = Path(generate.__file__).resolve().parents[1]


def test_files_of_this_checkout_are_not_stale() -> None:
    assert generate.stale_files(CHECKOUT) == []


def test_writing_removes_staleness_and_writes_nothing_twice(tmp_path: Path) -> None:
    assert generate.stale_files(tmp_path) == list(generate.GENERATED)
    assert generate.write_files(tmp_path) == list(generate.GENERATED)
    assert generate.write_files(tmp_path) == []


def test_one_changed_digit_makes_a_file_stale(tmp_path: Path) -> None:
    generate.write_files(tmp_path)
    constants = tmp_path / "shaders/generated/film_constants.glsl"
    constants.write_text(constants.read_text(encoding="utf-8").replace("594.88", "594.89"), encoding="utf-8")
    assert generate.stale_files(tmp_path) == ["shaders/generated/film_constants.glsl"]


def test_check_names_stale_files_and_writes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "pyproject.toml").touch()
    monkeypatch.setattr(generate, "__file__", str(tmp_path / "gltf_iri" / "generate.py"))
    assert generate.main(["--check"]) == 1
    assert capsys.readouterr().out.splitlines() == [f"stale: {path}" for path in generate.GENERATED]
    assert generate.main([]) == 0
    capsys.readouterr()
    assert generate.main(["--check"]) == 0
    assert capsys.readouterr().out == ""


def test_outside_a_checkout_nothing_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(generate, "__file__", str(tmp_path / "gltf_iri" / "generate.py"))
    assert generate.main([]) == 2
    assert "no checkout" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_literals_are_glsl_and_keep_what_float32_keeps() -> None:
    assert glsl_float(100.0) == "100.0"
    assert re.fullmatch(r"\d+e-\d+|0\.\d+", glsl_float(1e-5))
    assert float(glsl_float(1.0 / 3.0)) == pytest.approx(1.0 / 3.0, rel=1e-9)


def test_constants_carry_pythons_values() -> None:
    found = re.search(r"const float MATCHED_F0 = (\S+);", film_constants_glsl())
    assert found is not None
    assert float(found[1]) == MATCHED_F0


def test_every_key_of_the_material_is_in_the_property_table() -> None:
    table = generate.GENERATED["spec/properties.md"]()
    for _, row in properties(Material):
        assert row.kind is Kind.NESTED or f"| `{row.key}` |" in table
