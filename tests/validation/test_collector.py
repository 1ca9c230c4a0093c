"""Remarks are kept as the user wants to hear them, and a flood of small ones hides no error."""

from __future__ import annotations

import pytest

from gltf_iri.validation import collector
from gltf_iri.validation.collector import Collector, EnoughError
from gltf_iri.validation.issue import ERROR, INFORMATION, Issue
from gltf_iri.validation.options import Options

SMALL = Issue("SMALL", "Small.", INFORMATION, "/a")
LARGE = Issue("LARGE", "Large.", ERROR, "/b")


def test_the_users_limit_ends_the_work() -> None:
    kept = Collector(Options(max_issues=2))
    kept.add_all([SMALL, SMALL])
    assert not kept.is_truncated
    with pytest.raises(EnoughError):
        kept.add(LARGE)
    assert (kept.issues, kept.is_truncated, kept.has_errors) == ([SMALL, SMALL], True, False)


def test_errors_are_heard_over_a_flood(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(collector, "_MOST_KEPT", 3)
    kept = Collector(Options(max_issues=0))
    kept.add_all([SMALL] * 10)
    kept.add_all([LARGE] * 3)
    assert kept.issues == [SMALL] * 3 + [LARGE] * 3
    assert kept.is_truncated
    assert kept.has_errors
    with pytest.raises(EnoughError):
        kept.add(LARGE)


def test_what_is_left_out_counts_for_nothing() -> None:
    kept = Collector(Options(max_issues=1, ignore=frozenset({"SMALL"})))
    kept.add_all([SMALL, SMALL, LARGE])
    assert kept.issues == [LARGE]


def test_severities_are_the_users() -> None:
    kept = Collector(Options(override={"SMALL": ERROR, "LARGE": INFORMATION}, least=ERROR))
    kept.add_all([SMALL, LARGE])
    assert [(i.code, i.severity) for i in kept.issues] == [("SMALL", ERROR)]
    assert kept.has_errors
