"""Every format tells the same remarks, each as its readers want them, and nothing in a file can break out."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import pytest

from gltf_iri.validation.formats import csv_rows, github, json_lines, sarif, text
from gltf_iri.validation.formats.judged import Judged

ASSET = """{
  "asset": {"version": "2.0"},
  "materials": [
    {"foo": 1}
  ]
}"""
ESCAPE, BELL = "\x1b", "\x07"
HOSTILE = f"a{ESCAPE}[31m\r\n::error::b,c:%\udcff{BELL}.gltf"


def judged(*messages: dict[str, Any], path: str = "models/a b.gltf", **more: Any) -> Judged:
    counts = [sum(message["severity"] == severity for message in messages) for severity in range(4)]
    names = ("numErrors", "numWarnings", "numInfos", "numHints")
    issues = {**dict(zip(names, counts, strict=True)), "messages": list(messages), "truncated": False}
    report = {"uri": path, "mimeType": "model/gltf+json", "validatorVersion": "gltf-iri 1", "issues": issues}
    return Judged(path, report, **more)


def remark(
    code: str = "UNEXPECTED_PROPERTY", severity: int = 1, message: str = "It has no meaning.", **place: Any
) -> dict[str, Any]:
    return {
        "code": code,
        "message": message,
        "severity": severity,
        **(place or {"pointer": "/materials/0/foo"}),
    }


LINED = judged(remark(), data=ASSET.encode())
IN_GLB = judged(remark("GLB_LENGTH_MISMATCH", 0, "Too short.", offset=8), path="x.glb")
WORST = judged(
    remark("UNUSED_OBJECT", 2, f'He said "=1+1",\n{ESCAPE}[2J', pointer=f"/=a{ESCAPE}\n::stop"), path=HOSTILE
)


# --- text


def test_text_stands_below_its_file_with_place_and_line() -> None:
    assert "".join(text.written([LINED])) == (
        "models/a b.gltf: 1 warning\n"
        "  warning  UNEXPECTED_PROPERTY  /materials/0/foo  line 4\n"
        "           It has no meaning.\n"
    )


def test_text_of_a_sound_file_is_one_line() -> None:
    assert "".join(text.written([judged()])) == "models/a b.gltf: no remarks\n"


def test_text_of_several_files_ends_with_the_sum() -> None:
    told = "".join(text.written([LINED, IN_GLB, judged(), judged(remark(), remark())])).splitlines()
    assert "  error  GLB_LENGTH_MISMATCH  byte 8" in told
    assert told[-1] == "4 files, 1 with errors: 1 error, 3 warnings."


def test_text_says_when_it_is_cut_short() -> None:
    cut = judged(remark())
    cut.report["issues"]["truncated"] = True
    assert "--max-issues 0" in "".join(text.written([cut]))


def test_colours_come_only_when_asked_for() -> None:
    assert ESCAPE not in "".join(text.written([LINED]))
    coloured = "".join(text.written([LINED], is_coloured=True))
    assert coloured.count(f"{ESCAPE}[0m") == coloured.count(ESCAPE) / 2 > 0


def test_text_lets_no_name_control_the_terminal() -> None:
    told = "".join(text.written([WORST]))
    assert told.count("\n") == 3
    assert all(line.isprintable() for line in told.splitlines())


# --- JSON


def test_json_is_the_report_itself() -> None:
    pieces = list(json_lines.written([LINED, WORST]))
    assert [json.loads(piece) for piece in pieces] == [LINED.report, WORST.report]
    assert all(piece.count("\n") == 1 and piece.isascii() for piece in pieces)


def test_json_of_one_file_may_be_laid_out_for_people() -> None:
    (piece,) = json_lines.written([LINED], is_indented=True)
    assert json.loads(piece) == LINED.report
    assert '\n  "issues": {' in piece


# --- CSV


def rows(*files: Judged) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO("".join(csv_rows.written(files)), newline="")))


def test_csv_has_a_row_for_each_remark() -> None:
    assert rows(LINED, judged(), IN_GLB) == [
        {
            "file": "models/a b.gltf",
            "severity": "warning",
            "code": "UNEXPECTED_PROPERTY",
            "pointer": "/materials/0/foo",
            "offset": "",
            "line": "4",
            "message": "It has no meaning.",
        },
        {
            "file": "x.glb",
            "severity": "error",
            "code": "GLB_LENGTH_MISMATCH",
            "pointer": "",
            "offset": "8",
            "line": "",
            "message": "Too short.",
        },
    ]


def test_csv_ends_its_lines_as_the_standard_says() -> None:
    written = "".join(csv_rows.written([WORST]))
    assert written.count("\r\n") == written.count("\n") == 2


@pytest.mark.parametrize("start", ["=1+1", "+1", "-1", "@SUM(A1)", "\t=1", " =1", "\r=1"])
def test_no_cell_is_a_formula(start: str) -> None:
    (row,) = rows(judged(remark(message=start, pointer="/a"), path=start))
    assert row["message"].startswith("'")
    assert row["file"].startswith("'")


# --- GitHub


def test_github_gets_a_command_for_each_remark() -> None:
    assert list(github.written([LINED, IN_GLB])) == [
        "::warning file=models/a b.gltf,line=4,title=UNEXPECTED_PROPERTY"
        "::/materials/0/foo: It has no meaning.\n",
        "::error file=x.glb,line=1,title=GLB_LENGTH_MISMATCH::byte 8: Too short.\n",
    ]


def test_github_runs_no_command_from_a_file() -> None:
    (command,) = github.written([WORST])
    assert command.startswith("::notice file=a")
    assert command.count("\n") == 1
    where = command.split("::")[1]
    assert where.count(",") == 2  # file, line, title
    assert "%2Cc%3A%25" in where


# --- SARIF


def run(*files: Judged) -> dict[str, Any]:
    log = json.loads("".join(sarif.written(files)))
    assert (log["version"], len(log["runs"])) == ("2.1.0", 1)
    found: dict[str, Any] = log["runs"][0]
    return found


def test_sarif_names_each_rule_once_with_what_github_demands() -> None:
    told = run(LINED, IN_GLB, LINED, WORST)
    driver = told["tool"]["driver"]
    assert (driver["name"], driver["version"]) == ("gltf-iri", driver["version"])
    assert [rule["id"] for rule in driver["rules"]] == [
        "UNEXPECTED_PROPERTY",
        "GLB_LENGTH_MISMATCH",
        "UNUSED_OBJECT",
    ]
    for rule in driver["rules"]:
        assert all(rule[key]["text"] for key in ("shortDescription", "fullDescription", "help"))
        assert rule["defaultConfiguration"]["level"] in ("error", "warning", "note")
    for result in told["results"]:
        assert driver["rules"][result["ruleIndex"]]["id"] == result["ruleId"]


def test_sarif_helps_with_what_a_remark_on_films_rests_on() -> None:
    hint = judged(remark("IRI_IRIDESCENCE_INDEX_ORDER", 3, "…", pointer="/materials/0"))
    (rule,) = run(hint)["tool"]["driver"]["rules"]
    assert "PlayCanvas" in rule["help"]["text"]


def test_sarif_says_where_and_how_bad() -> None:
    lined, in_glb = run(LINED, IN_GLB)["results"]
    assert (lined["level"], in_glb["level"]) == ("warning", "error")
    assert lined["message"] == {"text": "It has no meaning."}
    assert lined["locations"] == [
        {
            "physicalLocation": {
                "artifactLocation": {"uri": "models/a%20b.gltf"},
                "region": {"startLine": 4},
            },
            "logicalLocations": [{"fullyQualifiedName": "/materials/0/foo"}],
        }
    ]
    (place,) = in_glb["locations"]
    assert place["physicalLocation"]["region"] == {"startLine": 1, "byteOffset": 8}
    assert "logicalLocations" not in place


@pytest.mark.parametrize(
    ("path", "uri"),
    [
        ("./a/../b#?.gltf", "b%23%3F.gltf"),
        ("c:d.gltf", "c%3Ad.gltf"),
        ("/elsewhere/e f.gltf", "file:///elsewhere/e%20f.gltf"),
        ("\udcff.gltf", "%FF.gltf"),
    ],
)
def test_sarif_names_files_by_uris(path: str, uri: str) -> None:
    (result,) = run(judged(remark(), path=path))["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"] == {"uri": uri}


def test_sarif_names_files_of_this_folder_as_the_repository_does(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (result,) = run(judged(remark(), path=str(tmp_path / "a.gltf")))["results"]
    assert result["locations"][0]["physicalLocation"]["artifactLocation"] == {"uri": "a.gltf"}


def test_sarif_tells_of_rules_that_are_unknown_here() -> None:
    (rule,) = run(judged(remark("SHOP_NO_PRICE", 0, "It has no price.")))["tool"]["driver"]["rules"]
    assert rule["shortDescription"] == {"text": "It has no price."}


def test_lines_are_not_looked_up_where_that_takes_seconds() -> None:
    data = b'{"x": [' + b"1," * 1_000_000 + b'1],\n"materials": [{"foo": 1}]}'
    assert judged(remark(), data=data).lines() == [None]
    assert judged(remark(), data=data.replace(b"1,", b"")).lines() == [2]


def test_a_file_that_is_gone_has_no_lines(tmp_path: Path) -> None:
    assert judged(remark(), path=str(tmp_path / "gone.gltf")).lines() == [None]
