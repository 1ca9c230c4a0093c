"""The npm package gltf-validator beside ours: the same bytes, its folder alone, both verdicts."""

from __future__ import annotations

import json
import stat
from pathlib import Path
from typing import Any

import pytest

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.validation.khronos import KhronosValidator, Verdict, find_khronos
from gltf_iri.validation.options import Options

# Eight bytes, of which a file that lies outside must give none.
SECRET = b"\x01\x02\x03\x04\x05\x06\x07\x08"


@pytest.fixture(scope="module")
def installed() -> KhronosValidator:
    try:
        return find_khronos()
    except MissingCapabilityError as error:
        pytest.skip(str(error))


def report(*places: tuple[str, str], errors: int = 0) -> dict[str, Any]:
    messages = [{"code": code, "message": "…", "severity": 1, "pointer": pointer} for code, pointer in places]
    counts = {"numErrors": errors, "numWarnings": len(places), "numInfos": 0, "numHints": 0}
    return {"issues": {**counts, "messages": messages, "truncated": False}}


def asset(**more: Any) -> bytes:
    return json.dumps({"asset": {"version": "2.0"}, **more}).encode()


def told(verdict: Verdict) -> set[tuple[str, int]]:
    assert verdict.report is not None, verdict.failure
    return {(message["code"], message["severity"]) for message in verdict.report["issues"]["messages"]}


# --- both verdicts


def test_a_verdict_agrees_where_both_or_neither_find_errors() -> None:
    assert Verdict(report(errors=2)).agrees(report(errors=1))
    assert Verdict(report()).agrees(report())
    assert not Verdict(report()).agrees(report(errors=1))
    assert not Verdict(None, "it broke down").agrees(report(errors=1))


def test_codes_that_one_tells_alone_are_counted_by_place() -> None:
    ours = report(("A", "/1"), ("B", "/1"), ("B", "/2"), ("B", "/2"))
    theirs = report(("A", "/1"), ("A", "/9"), ("C", "/1"))
    assert Verdict(theirs).differences(ours) == (["B ×2"], ["A", "C"])


def test_verdicts_stand_side_by_side() -> None:
    lines = "".join(Verdict(report(("A", "/1"))).lines(report(("B", "/1"), errors=3))).splitlines()
    assert [line.split() for line in lines] == [
        ["error", "warning", "information", "hint"],
        ["gltf-iri", "3", "1", "0", "0"],
        ["Khronos", "0", "1", "0", "0"],
        ["only", "gltf-iri:", "B"],
        ["only", "Khronos:", "A"],
    ]
    assert len({len(line) for line in lines[:3]}) == 1


def test_a_failure_is_told_on_one_line() -> None:
    (line,) = Verdict(None, "it broke\n\x1b[2J down").lines(report())
    assert line.count("\n") == 1
    assert "\x1b" not in line


# --- where the package is


def test_without_node_the_user_reads_what_to_install(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(MissingCapabilityError, match="install it from nodejs"):
        find_khronos()


def test_without_the_package_the_user_reads_what_to_install(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    node = tmp_path / "node"
    node.write_text("#!/bin/sh\n")
    node.chmod(node.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("NODE_PATH", raising=False)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(MissingCapabilityError, match="'npm install gltf-validator' here"):
        find_khronos()


# --- the package itself


def test_it_judges_what_it_is_given(installed: KhronosValidator) -> None:
    data = asset(foo=1, bar=2)
    verdict = installed.judge(data, "a.gltf", None, Options())
    assert told(verdict) == {("UNEXPECTED_PROPERTY", 1)}
    assert verdict.report is not None
    assert verdict.report["uri"] == "a.gltf"


def test_the_users_choice_holds_for_it_too(installed: KhronosValidator) -> None:
    data = asset(foo=1, asset=3)

    def judge(**options: Any) -> Verdict:
        return installed.judge(data, "a.gltf", None, Options(**options))

    assert told(judge()) == {("UNEXPECTED_PROPERTY", 1), ("TYPE_MISMATCH", 0)}
    assert told(judge(least=0)) == {("TYPE_MISMATCH", 0)}
    assert told(judge(ignore=frozenset({"TYPE_MISMATCH"}))) == {("UNEXPECTED_PROPERTY", 1)}
    assert told(judge(only=frozenset({"TYPE_MISMATCH"}))) == {("TYPE_MISMATCH", 0)}
    assert told(judge(override={"UNEXPECTED_PROPERTY": 0})) >= {("UNEXPECTED_PROPERTY", 0)}
    cut = judge(max_issues=1).report
    assert cut is not None
    assert (len(cut["issues"]["messages"]), cut["issues"]["truncated"]) == (1, True)


@pytest.mark.parametrize(
    "uri",
    [
        "../secret.bin",
        "%2e%2e/secret.bin",
        "link.bin",
        "http://localhost/secret.bin",
        "file:///secret.bin",
        ".",
    ],
)
def test_it_reads_nothing_outside_the_assets_folder(
    installed: KhronosValidator, tmp_path: Path, uri: str
) -> None:
    folder = tmp_path / "asset"
    folder.mkdir()
    (tmp_path / "secret.bin").write_bytes(SECRET)
    (folder / "link.bin").symlink_to("../secret.bin")
    (folder / "own data.bin").write_bytes(SECRET)
    data = asset(buffers=[{"byteLength": 8, "uri": uri}])
    assert ("IO_ERROR", 0) in told(installed.judge(data, "a.gltf", folder, Options()))
    beside = asset(buffers=[{"byteLength": 8, "uri": "own%20data.bin"}])
    assert told(installed.judge(beside, "a.gltf", folder, Options())) == {("UNUSED_OBJECT", 2)}


def test_files_that_are_not_to_be_read_are_no_errors(installed: KhronosValidator) -> None:
    data = asset(buffers=[{"byteLength": 8, "uri": "missing.bin"}])
    assert ("IO_ERROR", 0) not in told(installed.judge(data, "a.gltf", None, Options(resources=False)))


def test_a_file_that_breaks_it_costs_its_verdict_alone(installed: KhronosValidator) -> None:
    deep = b'{"asset": {"version": "2.0"}, "extras": ' + b"[" * 100_000 + b"]" * 100_000 + b"}"
    verdict = installed.judge(deep, "deep.gltf", None, Options())
    assert verdict.report is None
    assert verdict.failure is not None
    assert "RangeError" in verdict.failure
