"""Reports keep to spec/validation.schema.json, ours and those that the Khronos validator wrote."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from gltf_iri.resources import spec_root
from gltf_iri.validation.khronos import Verdict
from gltf_iri.validation.options import Options
from gltf_iri.validation.validate import validate

SAMPLES = sorted((Path(__file__).resolve().parents[2] / "samples").glob("*/*.gl*"))
BROKEN = {
    "nothing": b"",
    "no JSON": b"{",
    "no object": b"[]",
    "no asset": b"{}",
    "binary": bytes(range(256)),
    "GLB cut short": b"glTF\x02\0\0\0\xff\0\0\0",
    "wrong everywhere": b'{"asset": 3, "\\ud800": 1e999, "nodes": [{"mesh": 2}], "buffers": [{"uri": 1}]}',
}


@pytest.fixture(scope="module")
def schema() -> jsonschema.Draft202012Validator:
    stated = json.loads((spec_root() / "validation.schema.json").read_text(encoding="utf-8"))
    jsonschema.Draft202012Validator.check_schema(stated)
    return jsonschema.Draft202012Validator(stated)


@pytest.mark.parametrize("sample", SAMPLES, ids=lambda path: path.name)
def test_reports_of_the_samples_keep_to_the_schema(
    schema: jsonschema.Draft202012Validator, sample: Path
) -> None:
    schema.validate(validate(sample).to_json())


@pytest.mark.parametrize("data", BROKEN.values(), ids=BROKEN)
def test_reports_of_broken_files_keep_to_the_schema(
    schema: jsonschema.Draft202012Validator, data: bytes
) -> None:
    schema.validate(validate(data, uri="x.gltf").to_json())
    schema.validate(validate(data, options=Options(max_issues=1)).to_json())


def test_reports_with_both_verdicts_keep_to_the_schema(schema: jsonschema.Draft202012Validator) -> None:
    report = validate(b'{"asset": {"version": "2.0"}}').to_json()
    schema.validate({**report, "khronos": Verdict(report).to_json(report)})
    schema.validate({**report, "khronos": Verdict(None, "it broke down").to_json(report)})


def test_reports_that_khronos_wrote_keep_to_the_schema(
    schema: jsonschema.Draft202012Validator, shared_dir: Path
) -> None:
    paths = sorted((shared_dir / "validator-corpus").rglob("*.report.json"))
    assert paths
    for path in paths:
        report = json.loads(path.read_text(encoding="utf-8"))
        schema.validate({**report, "validatorVersion": "gltf-iri 0"})


@pytest.mark.parametrize(
    "change",
    [
        {"issues": None},
        {"mimeType": "text/plain"},
        {"colour": "red"},
        {"messages": [{"code": "A", "message": "a"}]},
        {"messages": [{"code": "A", "message": "a", "severity": 4}]},
        {"messages": [{"code": "A", "message": "a", "severity": 0, "pointer": "a"}]},
        {"messages": [{"code": "A", "message": "a", "severity": 0, "pointer": "/a", "offset": 0}]},
    ],
    ids=str,
)
def test_the_schema_refuses_what_is_no_report(
    schema: jsonschema.Draft202012Validator, change: dict[str, Any]
) -> None:
    issues = {
        "numErrors": 0,
        "numWarnings": 0,
        "numInfos": 0,
        "numHints": 0,
        "messages": [],
        "truncated": False,
    }
    report: dict[str, Any] = {"validatorVersion": "gltf-iri 0", "issues": issues}
    schema.validate(report)
    if "messages" in change:
        issues.update(change)
    else:
        report.update(change)
    assert not schema.is_valid(report)
