"""What a file is, by its bytes and its name; how far it is judged; and rules that fail."""

from __future__ import annotations

import json

import pytest

from gltf_iri.validation.options import Options
from gltf_iri.validation.reading.read import is_binary, json_bytes
from gltf_iri.validation.rules.registry import RULES
from gltf_iri.validation.validate import validate

ASSET = b'{"asset":{"version":"2.0"}}'
GLB = b"glTF\x02\0\0\0\x30\0\0\0\x1c\0\0\0JSON" + ASSET + b" "


@pytest.mark.parametrize(
    ("data", "name", "expected"),
    [
        (GLB, "", True),
        (GLB, "a.gltf", True),  # the magic says more than the name
        (b"g", "", True),
        (b"glXF", "", True),
        (b"garbage", "a.gltf", False),
        (b"", "a.GLB", True),
        (b"", "", False),
        (ASSET, "a.glb", True),  # named a GLB, and none
        (ASSET, "a.gltf", False),
        (b"\0\0\0\0", "a.glb", True),
        (b"\0\0\0\0", "", False),
    ],
)
def test_the_magic_decides_then_the_name_then_the_first_byte(data, name, expected):
    assert is_binary(data, name) is expected
    report = validate(data, uri=name)
    assert (report.mime_type == "model/gltf-binary") is expected


def test_the_name_of_a_path_counts_as_that_of_bytes(tmp_path):
    path = tmp_path / "a.glb"
    path.write_bytes(ASSET)
    assert [(i.code, i.offset) for i in validate(path).issues] == [("GLB_INVALID_MAGIC", 0)]


def test_the_json_of_either_container_is_its_text():
    assert json_bytes(ASSET, "") == ASSET
    assert json_bytes(GLB, "") == ASSET + b" "
    assert json_bytes(GLB[:30], "") == b""


FAULTS = {
    "materials": [{"alphaCutoff": -1}],
    "nodes": [{"mesh": 7}],
    "scene": 4,
    "extensions": {"A": 1},
    "extras": 5,
    "unknown": 1,
    "extensionsUsed": ["_x"],
}
READ_FIRST = {
    ("UNEXPECTED_PROPERTY", "/unknown"),
    ("INVALID_EXTENSION_NAME_FORMAT", "/extensionsUsed/0"),
    ("UNSUPPORTED_EXTENSION", "/extensionsUsed/0"),
}


# Each as the Khronos validator 2.0.0-dev.3.10 tells it.
@pytest.mark.parametrize(
    ("asset", "told"),
    [
        ({}, {("UNDEFINED_PROPERTY", "/asset")}),
        ([], {("TYPE_MISMATCH", "/asset")}),
        ({"version": "1.0"}, {("UNKNOWN_ASSET_MAJOR_VERSION", "/asset/version")}),
        ({"version": "3.2", "minVersion": "3.1"}, {("UNKNOWN_ASSET_MAJOR_VERSION", "/asset/version")}),
        ({"version": "9" * 5000 + ".0"}, {("UNKNOWN_ASSET_MAJOR_VERSION", "/asset/version")}),
        ({"version": "2"}, {("PATTERN_MISMATCH", "/asset/version")}),
        ({"version": "2.0\n"}, {("PATTERN_MISMATCH", "/asset/version")}),
        ({"version": "٢.0"}, {("PATTERN_MISMATCH", "/asset/version")}),
        ({"version": 2.0}, {("TYPE_MISMATCH", "/asset/version")}),
    ],
)
def test_without_a_known_version_only_what_is_read_first_is_judged(judge, asset, told):
    report = judge(json.dumps({**FAULTS, "asset": asset}))
    assert {(i.code, i.pointer) for i in report.issues} == told | READ_FIRST
    assert (report.mime_type, report.info) == ("model/gltf+json", None)


@pytest.mark.parametrize("version", ["2.0", "2.1", "02.00"])
def test_with_a_known_version_all_is_judged(codes, version):
    told = codes(json.dumps({**FAULTS, "asset": {"version": version}}))
    assert told > READ_FIRST
    assert {("UNRESOLVED_REFERENCE", "/nodes/0/mesh"), ("NON_OBJECT_EXTRAS", "/extras")} < told


def test_enough_remarks_stop_the_work_and_the_report_says_so(judge):
    many = {**FAULTS, "asset": {"version": "2.0"}}
    whole = judge(json.dumps(many))
    for most in range(1, len(whole.issues)):
        report = judge(json.dumps(many), max_issues=most)
        assert report.issues == whole.issues[:most]
        assert (report.is_truncated, report.info) == (True, None)
    assert not judge(json.dumps(many), max_issues=len(whole.issues)).is_truncated
    assert judge(b"\xef\xbb\xbf[", max_issues=1).is_truncated


def test_all_remarks_are_told_unless_asked_otherwise():
    data = json.dumps({"asset": {"version": "2.0"}, **{f"x{i}": 1 for i in range(2000)}}).encode()
    report = validate(data)
    assert (len(report.issues), report.is_truncated) == (2000, False)


@pytest.fixture
def failing_rule(monkeypatch):
    def fails(entry, asset):
        yield from ()
        raise LookupError("x" * 10_000)

    monkeypatch.setitem(RULES, "scene", (*RULES.get("scene", ()), fails))
    return fails


def test_a_rule_that_fails_is_told_and_the_rest_goes_on(failing_rule):
    data = b'{"asset":{"version":"2.0"},"scenes":[{},{}],"nodes":[{"mesh":1}]}'
    told = validate(data).issues
    failed = [issue for issue in told if issue.code == "IRI_RULE_FAILED"]
    assert [issue.pointer for issue in failed] == ["/scenes/0", "/scenes/1"]
    assert "fails" in failed[0].message and "LookupError: xxx" in failed[0].message
    assert len(failed[0].message) < 400
    assert "UNUSED_OBJECT" in {issue.code for issue in told}


@pytest.mark.parametrize("stage", ["check_links", "check_usage", "check_resources", "asset_info"])
def test_a_stage_that_fails_is_told_and_the_others_run(monkeypatch, stage):
    def fails(_):
        raise ZeroDivisionError

    monkeypatch.setattr(f"gltf_iri.validation.validate.{stage}", fails)
    told = {(i.code, i.pointer) for i in validate(b'{"asset":{"version":"2.0"},"cameras":[{}]}').issues}
    assert {("IRI_RULE_FAILED", ""), ("UNDEFINED_PROPERTY", "/cameras/0")} <= told


def test_who_writes_a_rule_sees_it_fail(failing_rule):
    data = b'{"asset":{"version":"2.0"},"scenes":[{}]}'
    with pytest.raises(LookupError):
        validate(data, options=Options(raises=True))
