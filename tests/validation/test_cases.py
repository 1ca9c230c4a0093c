"""Every case of tests/validation/cases has the verdict that stands beside it."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from write_cases import CASES, OPTICS, cases, folders, measured, report_of

from gltf_iri.validation.codes import CODES
from gltf_iri.validation.rules import every as _every  # noqa: F401  # the rules bring their codes


def _name(path: Path) -> str:
    return path.relative_to(CASES).as_posix()


@pytest.mark.parametrize("case", cases(), ids=_name)
def test_a_case_has_its_report(case: Path) -> None:
    expected = json.loads(case.with_suffix(".report.json").read_text(encoding="utf-8"))
    assert report_of(case) == expected


@pytest.mark.parametrize("folder", folders(), ids=_name)
def test_optics_say_more_in_the_same_remarks(folder: Path) -> None:
    assert measured(folder) == json.loads((folder / OPTICS).read_text(encoding="utf-8"))


def test_every_report_belongs_to_a_case() -> None:
    reports = set(CASES.rglob("*.report.json"))
    assert reports == {case.with_suffix(".report.json") for case in cases()}


@pytest.mark.parametrize("prefix", ["IRI_BRAGG_", "IRI_IRIDESCENCE_", "IRI_POINTER_"])
def test_every_code_of_ours_has_a_case(prefix: str) -> None:
    told = {
        message["code"]
        for path in CASES.rglob("*.report.json")
        for message in json.loads(path.read_text(encoding="utf-8"))["issues"]["messages"]
    }
    assert {code for code in CODES if code.startswith(prefix)} - told == set()
