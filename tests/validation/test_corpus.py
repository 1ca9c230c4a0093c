"""The Khronos validator's own test files: same codes, severities and places, same verdict, same info."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from gltf_iri.validation.options import Options
from gltf_iri.validation.validate import validate

# Path of a case to why our remarks differ from its report; spec/validator-differences.md tells them too.
KNOWN_DIFFERENCES: dict[str, str] = {}
KNOWN_DIFFERENCES_OF_INFO: dict[str, str] = {}

# Remarks of ours that Khronos does not make.
OWN = "IRI_"

Told = set[tuple[str, int, str | int | None]]


class Case(NamedTuple):
    """What is expected of a file and what was said of it, as report JSON."""

    wanted: dict[str, Any]
    found: dict[str, Any]


@pytest.fixture(scope="module")
def cases(shared_dir: Path) -> dict[str, Case]:
    corpus = shared_dir / "validator-corpus"
    if not corpus.is_dir():
        pytest.skip(f"the corpus is not there: {corpus}")
    judged = {}
    for report in sorted(corpus.rglob("*.report.json")):
        path = report.with_name(report.name.removesuffix(".report.json"))
        wanted = json.loads(report.read_text(encoding="utf-8"))
        found = validate(path, uri=wanted["uri"], options=Options(max_issues=0, raises=True))
        judged[path.relative_to(corpus).as_posix()] = Case(wanted, found.to_json())
    return judged


def told(report: dict[str, Any]) -> Told:
    """Return what the corpus fixes of a report's messages; the sentences are each validator's own."""
    return {
        (message["code"], message["severity"], message.get("pointer", message.get("offset")))
        for message in report["issues"]["messages"]
        if not message["code"].startswith(OWN)
    }


def test_the_corpus_is_there_whole(cases: dict[str, Case]) -> None:
    assert len(cases) >= 190


def test_remarks_are_those_of_the_corpus(cases: dict[str, Case]) -> None:
    differing = {name for name, case in cases.items() if told(case.wanted) != told(case.found)}
    assert differing == set(KNOWN_DIFFERENCES)
    assert len(differing) <= 0.05 * len(cases)


def test_verdicts_are_those_of_the_corpus(cases: dict[str, Case]) -> None:
    def is_invalid(report: dict[str, Any]) -> bool:
        return bool(report["issues"]["numErrors"])

    assert not [name for name, case in cases.items() if is_invalid(case.wanted) != is_invalid(case.found)]


@pytest.mark.parametrize("key", ["uri", "mimeType", "info"])
def test_the_rest_of_the_report_is_that_of_the_corpus(cases: dict[str, Case], key: str) -> None:
    differing = {name for name, case in cases.items() if case.wanted.get(key) != case.found.get(key)}
    assert differing == (set(KNOWN_DIFFERENCES_OF_INFO) if key == "info" else set())
