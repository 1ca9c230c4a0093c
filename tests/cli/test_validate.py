"""`gltf-iri validate`: the contract's JSON, exit codes, and what wrong input is told."""

from __future__ import annotations

import io
import json
import os
import pty
import subprocess
import sys
from pathlib import Path

import pytest

from gltf_iri.cli import door
from gltf_iri.cli.main import run

SOUND = {"asset": {"version": "2.0"}}
FAULTY = {**SOUND, "scene": 7}
DOUBTFUL = {**SOUND, "foo": 1}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    for name, asset in (("sound", SOUND), ("faulty", FAULTY), ("sub/doubtful", DOUBTFUL)):
        file = tmp_path / f"{name}.gltf"
        file.parent.mkdir(exist_ok=True)
        file.write_text(json.dumps(asset))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def call(folder, capsys):
    """Return a function that validates: (exit code, stdout, stderr)."""

    def validate(*arguments):
        code = run(["validate", *map(str, arguments)])
        told = capsys.readouterr()
        return code, told.out, told.err

    return validate


def codes(report):
    return [message["code"] for message in report["issues"]["messages"]]


# --- the contract


def test_one_file_gives_one_object(call):
    code, out, err = call("faulty.gltf", "--json")
    report = json.loads(out)
    assert (code, err) == (1, "")
    assert (report["uri"], report["mimeType"]) == ("faulty.gltf", "model/gltf+json")
    assert codes(report) == ["UNRESOLVED_REFERENCE"]
    assert call("faulty.gltf", "--format", "json") == (1, out, "")


def test_several_files_give_a_line_each_in_their_order(call):
    code, out, _ = call("sub", "sound.gltf", "faulty.gltf", "--json")
    reports = [json.loads(line) for line in out.splitlines()]
    assert [report["uri"] for report in reports] == ["sub/doubtful.gltf", "sound.gltf", "faulty.gltf"]
    assert code == 1


def test_a_folder_gives_lines_even_where_it_holds_one_file(call):
    _, out, _ = call("sub", "--json")
    assert out.count("\n") == 1


@pytest.mark.parametrize(
    ("file", "code"), [("sound.gltf", 0), ("sub/doubtful.gltf", 0), ("faulty.gltf", 1), (".", 1)]
)
def test_only_errors_end_with_1(call, file, code):
    assert call(file)[0] == code


@pytest.mark.parametrize("jobs", [1, 2])
def test_more_processes_tell_the_same_in_the_same_order(call, jobs):
    assert call(".", "--jobs", jobs) == call(".")


def test_standard_input_is_a_file_called_dash(call, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(json.dumps(FAULTY).encode())))
    code, out, _ = call("-", "--json")
    assert (code, json.loads(out)["uri"]) == (1, "-")


def test_standard_input_keeps_its_place_among_files(call, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(json.dumps(DOUBTFUL).encode())))
    _, out, _ = call("sound.gltf", "-", "faulty.gltf")
    assert [line.split(":")[0] for line in out.splitlines() if line[0] != " "] == [
        *("sound.gltf", "-", "faulty.gltf", "3 files, 1 with errors"),
    ]


def test_standard_input_beyond_the_bound_is_refused(call, monkeypatch):
    monkeypatch.setattr("gltf_iri.validation.run.MAX_FILE_BYTES", 10)
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b" " * 11)))
    code, _, err = call("-")
    assert code == 1
    assert "more than the 10 bytes allowed" in err


def test_a_closed_standard_input_is_told(call, monkeypatch):
    monkeypatch.setattr(sys, "stdin", None)
    code, _, err = call("-")
    assert (code, err) == (2, "gltf-iri: Standard input is closed: give the path of a file instead of '-'.\n")


# --- what the user wants to hear


def test_severities_below_the_one_asked_for_are_left_out(call):
    _, out, _ = call("sub/doubtful.gltf", "--severity", "error", "--json")
    assert json.loads(out)["issues"]["messages"] == []


def test_codes_are_left_out_told_alone_or_made_graver(call):
    assert call("faulty.gltf", "--ignore", "UNRESOLVED_REFERENCE")[0] == 0
    assert call("faulty.gltf", "--only", "UNUSED_OBJECT")[0] == 0
    assert call("sub/doubtful.gltf", "--override", "UNEXPECTED_PROPERTY=error")[0] == 1


def test_a_configuration_counts_and_options_win_over_it(call, folder):
    (folder / "c.yaml").write_text("override: {UNRESOLVED_REFERENCE: 1}")
    assert call("faulty.gltf", "--config", "c.yaml")[0] == 0
    assert call("faulty.gltf", "--config", "c.yaml", "--override", "UNRESOLVED_REFERENCE=0")[0] == 1


def test_remarks_stop_where_the_user_says(call, folder):
    (folder / "many.gltf").write_text(json.dumps({**SOUND, **{f"x{i}": 1 for i in range(150)}}))
    for most, kept in ((None, 150), (3, 3), (0, 150)):
        said = [] if most is None else ["--max-issues", most]
        issues = json.loads(call("many.gltf", "--json", *said)[1])["issues"]
        assert (len(issues["messages"]), issues["truncated"]) == (kept, kept < 150)


def test_buffers_are_left_alone_where_the_user_says(call, folder):
    (folder / "b.gltf").write_text(json.dumps({**SOUND, "buffers": [{"byteLength": 4, "uri": "gone.bin"}]}))
    assert "IO_ERROR" in call("b.gltf")[1]
    assert "IO_ERROR" not in call("b.gltf", "--no-resources")[1]


def test_every_code_is_listed(call):
    code, out, _ = call("--codes")
    assert code == 0
    assert any(line.split()[:2] == ["UNUSED_OBJECT", "information"] for line in out.splitlines())
    listed = json.loads(call("--codes", "--json")[1])
    assert {"code", "severity", "message"} == set(listed[0])


# --- formats and results that are kept


@pytest.mark.parametrize(
    ("form", "start"),
    [("text", "./faulty.gltf: 1 error"), ("csv", "file,severity"), ("github", "::error file=")],
)
def test_formats_say_the_same_to_different_readers(call, form, start):
    code, out, _ = call(".", "--format", form)
    assert code == 1
    assert out.startswith(start)
    assert "UNRESOLVED_REFERENCE" in out


def test_sarif_is_one_document_for_all_files(call):
    code, out, _ = call(".", "--format", "sarif")
    assert code == 1
    assert {result["ruleId"] for result in json.loads(out)["runs"][0]["results"]} == {
        *("UNRESOLVED_REFERENCE", "UNEXPECTED_PROPERTY"),
    }


def test_reports_are_kept_and_a_run_goes_on_where_it_stopped(call, folder):
    code, out, _ = call(".", "--json", "-o", "kept.jsonl")
    assert (code, out) == (1, "")
    kept = (folder / "kept.jsonl").read_text()
    assert [json.loads(line)["uri"] for line in kept.splitlines()] == [
        *("./faulty.gltf", "./sound.gltf", "./sub/doubtful.gltf"),
    ]
    (folder / "kept.jsonl").write_text("".join(kept.splitlines(keepends=True)[:2]) + kept[:30])
    code, out, err = call(".", "--resume", "kept.jsonl")
    assert (code, out.splitlines()[0]) == (1, "./sub/doubtful.gltf: 1 warning")
    assert "2 files were checked before, 1 with errors" in err
    assert (folder / "kept.jsonl").read_text() == kept


# --- wrong calls and wrong input


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        ([], "Missing argument 'PATH...'"),
        (["gone.gltf"], "gone.gltf does not exist."),
        (["sound.gltf", "gone.gltf"], "gone.gltf does not exist."),
        (["*.glb"], "Nothing matches *.glb."),
        (["empty"], "There is no .gltf or .glb file in empty."),
        (["/dev/null"], "/dev/null is not a regular file"),
        (["x" * 5000], "File name too long"),
        (["sound.gltf", "--ignore", "UNUSED_OBJEKT"], "the nearest is 'UNUSED_OBJECT'"),
        (["sound.gltf", "--ignore", "NODE_EMPTY", "--only", "NODE_EMPTY"], "exclude each other"),
        (["sound.gltf", "--config", "gone.yaml"], "'gone.yaml' does not exist"),
        (["sound.gltf", "--config", "wrong.yaml"], "there is no key 'ignored'; the nearest is 'ignore'"),
        (["sound.gltf", "--format", "csv", "-o", "x"], "send csv to a file with '>'"),
        (["sound.gltf", "--format", "sarif", "--khronos"], "as text or json, not as sarif"),
        (["sound.gltf", "-o", "a", "--resume", "b"], "leave out -o"),
        (["sound.gltf", "--resume", "sound.gltf"], "Line 1 of 'sound.gltf' is no result"),
        (["sound.gltf", "--jobs", "0"], "0 is not in the range x>=1"),
    ],
    ids=str,
)
def test_a_wrong_call_ends_with_2_and_a_sentence(call, folder, arguments, told):
    (folder / "empty").mkdir()
    (folder / "wrong.yaml").write_text("ignored: []")
    before = sorted(path.read_bytes() for path in folder.rglob("*.gltf"))
    code, out, err = call(*arguments)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert told in err
    assert sorted(path.read_bytes() for path in folder.rglob("*.gltf")) == before


def test_a_file_in_a_folder_that_cannot_be_read_is_an_error_of_its_own(call, folder, monkeypatch):
    (folder / "huge.glb").write_bytes(b"glTF")
    os.truncate(folder / "huge.glb", 2**31 + 1)  # a hole: it takes no room
    code, out, _ = call(".")
    assert code == 1
    assert "IO_ERROR" in out
    assert "./sound.gltf: no remarks" in out


def test_what_is_passed_over_is_noted(call, folder):
    (folder / "dangling.gltf").symlink_to("nowhere")
    code, _, err = call(".")
    assert code == 1
    assert err == "note: Passed over ./dangling.gltf: it is no regular file, or a link to nothing.\n"


@pytest.mark.parametrize("data", [b"", b"\0" * 100, bytes(range(256)), b"glTF", b"\x1f\x8b\x08"], ids=repr)
def test_junk_gets_a_report(call, folder, data):
    (folder / "junk.glb").write_bytes(data)
    code, out, err = call("junk.glb", "--json")
    assert (code, err) == (1, "")
    assert json.loads(out)["issues"]["numErrors"] > 0


def test_khronos_without_the_package_ends_with_3(call, monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    code, out, err = call("sound.gltf", "--khronos")
    assert (code, out) == (3, "")
    assert "install it from nodejs.org" in err


# --- with and without click


@pytest.mark.parametrize(
    "arguments",
    [
        ["faulty.gltf"],
        [".", "--json"],
        ["--format", "json", "sound.gltf"],
        ["sound.gltf", "--format", "text", "--json", "sub"],
        ["--json", "sound.gltf", "--format", "text"],
        ["faulty.gltf", "--format", "text", "--format", "json"],
        ["faulty.gltf", "--format", "csv"],
        ["faulty.gltf", "--format=github"],
        ["faulty.gltf", "--format"],
        ["faulty.gltf", "--format", "pdf"],
        ["faulty.gltf", "--severity", "error"],
        ["gone.gltf"],
        ["--", "faulty.gltf"],
        ["faulty.gltf", "--nonsense"],
        ["--json"],
        [],
        ["--help"],
    ],
    ids=str,
)
def test_the_short_way_in_says_what_the_long_one_says(folder, capsys, arguments):
    told = []
    for way in (door.run, run):
        told.append((way(["validate", *arguments]), capsys.readouterr()))
    assert told[0] == told[1]


# --- a process of its own


def process(*arguments, **more):
    command = [sys.executable, "-m", "gltf_iri", "validate", *arguments]
    return subprocess.run(command, capture_output=True, check=False, **more)


def test_the_hook_of_pre_commit_checks_the_files_that_it_is_given(folder):
    hooks = (Path(__file__).resolve().parents[2] / ".pre-commit-hooks.yaml").read_text()
    entry = next(line for line in hooks.splitlines() if "entry:" in line).partition("entry: ")[2]
    program, *arguments = entry.split()
    assert program == "gltf-iri"
    command = [sys.executable, "-m", "gltf_iri", *arguments, "sound.gltf", "faulty.gltf"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "faulty.gltf: 1 error" in done.stdout


def test_one_file_loads_no_more_than_it_needs(folder):
    command = [sys.executable, "-X", "importtime", "-m", "gltf_iri", "validate", "sound.gltf"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    loaded = {line.split("|")[2].strip() for line in done.stderr.splitlines() if "|" in line}
    assert "gltf_iri.validation.formats.text" in loaded  # the listing was read
    heavy = {"numpy", "yaml", "rich", "jsonschema", "PIL", "csv", "urllib.request", "concurrent.futures"}
    heavy |= {"click", "inspect", "multiprocessing", "subprocess", "dataclasses", "importlib.metadata"}
    ours = {f"gltf_iri.validation.{name}" for name in ("many", "khronos", "config", "formats.sarif")}
    assert loaded & (heavy | ours) == set()


def test_a_terminal_gets_colours_unless_they_are_not_wanted(folder):
    def on_terminal(**environment):
        try:
            leader, follower = pty.openpty()
        except OSError:
            pytest.skip("the machine has no pseudo-terminals")
        command = [sys.executable, "-m", "gltf_iri", "validate", "faulty.gltf"]
        with os.fdopen(follower, "wb") as terminal:
            subprocess.run(command, stdout=terminal, check=False, env={**os.environ, **environment})
        told = os.read(leader, 10_000)
        os.close(leader)
        return told

    assert b"\x1b[31m" in on_terminal(NO_COLOR="")
    assert b"\x1b" not in on_terminal(NO_COLOR="1")
    assert b"\x1b" not in process("faulty.gltf").stdout
