"""What the verbs share: strict JSON, tables and notes."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.cli.common import material_label, note, print_json, print_table, printable, progress
from gltf_iri.planning.effects import Effect


def refuse_constant(name: str) -> None:
    raise AssertionError(f"{name} is not JSON")


def printed(capsys, value):
    print_json(value)
    return json.loads(capsys.readouterr().out, parse_constant=refuse_constant)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (float("nan"), None),
        (np.float32("inf"), None),
        (np.array([[1.0, np.nan]]), [[1.0, None]]),
        (np.int64(3), 3),
        (np.bool_(True), True),
        (Path("a/b.glb"), "a/b.glb"),
        (Effect.METAL, "metal"),
        ({Effect.METAL: (1, "λ")}, {"metal": [1, "λ"]}),
        ("\ud800", "\ud800"),
    ],
)
def test_json_output_is_strict_and_plain(capsys, value, expected):
    assert printed(capsys, {"value": value}) == {"value": expected}


def test_a_table_in_a_pipe_is_aligned_text_without_escape_codes(capsys):
    print_table(["name", "effects"], [["a", "metal"], ["long\x1bname", "dielectric"]], title="Plan")
    assert capsys.readouterr().out == (
        "Plan\nname       effects\na          metal\nlong\N{REPLACEMENT CHARACTER}name  dielectric\n"
    )


def test_a_title_cannot_steer_the_terminal_either(capsys, monkeypatch):
    print_table(["a"], [], title="red\x1b[31m\x07")
    assert not {"\x1b", "\x07"} & set(capsys.readouterr().out)
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    print_table(["a wide column"], [], title="[/red] title")
    assert "[/red]" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("index", "name", "label"),
    [
        (0, "nacre", "0 nacre"),
        (3, "", "3 unnamed"),
        (-1, "", "glTF's default"),
        (1, "x" * 100, "1 " + "x" * 59 + "…"),
    ],
)
def test_a_material_is_labelled_by_number_and_name(index, name, label):
    assert material_label(index, name) == label


def test_an_empty_table_shows_its_columns(capsys):
    print_table(["name", "effects"], [])
    assert capsys.readouterr().out == "name  effects\n"


def test_notes_and_progress_keep_stdout_clean(capsys):
    note("a\nb")
    with progress("working", 2) as advance:
        advance()
    shown = capsys.readouterr()
    assert shown.out == ""
    assert shown.err == "note: a b\n"


@pytest.mark.parametrize("text", ["perle é λ", "[red]"])
def test_ordinary_names_are_shown_as_they_are(text):
    assert printable(text) == text
