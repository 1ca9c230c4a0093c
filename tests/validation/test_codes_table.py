"""The list of codes: all there are, each with a severity and a sentence that people can read."""

from __future__ import annotations

import re

import pytest

from gltf_iri.validation.codes import CODES
from gltf_iri.validation.codes_of_links import CODES_OF_LINKS
from gltf_iri.validation.codes_of_objects import CODES_OF_OBJECTS
from gltf_iri.validation.codes_table import as_text, codes_markdown, every_code, rows
from gltf_iri.validation.issue import SEVERITY_NAMES


def test_every_code_has_a_row_and_ours_come_first() -> None:
    listed = [code for code, _, _ in rows(every_code())]
    assert sorted(listed) == sorted(every_code())
    own = [code.startswith("IRI_") for code in listed]
    assert own == sorted(own, reverse=True)
    assert {"IRI_WORKER_DIED", "ACCESSOR_TOO_LONG"} <= set(listed)


def test_every_row_can_be_read() -> None:
    for code, severity, sentence in rows(every_code()):
        assert re.fullmatch(r"[A-Z][A-Z0-9_]+", code)
        assert severity in SEVERITY_NAMES
        assert sentence.isprintable()
        assert "{" not in sentence


def test_what_a_report_fills_in_is_named() -> None:
    assert as_text("It has {count} of {size:g} bytes.") == "It has ‹count› of ‹size› bytes."


def test_the_page_has_each_of_our_codes_once_in_a_table_of_three_columns() -> None:
    lines = [line for line in codes_markdown().splitlines() if line.startswith("| `")]
    listed = [line.split("`")[1] for line in lines]
    assert len(set(listed)) == len(listed)
    assert {*CODES_OF_LINKS, *CODES_OF_OBJECTS} < set(listed)
    assert {code for code in every_code() if code.startswith("IRI_")} < set(listed)
    assert all(len(re.findall(r"(?<!\\)\|", line)) == 4 for line in lines)


def test_the_page_has_no_codes_of_rules_from_outside(monkeypatch: pytest.MonkeyPatch) -> None:
    page = codes_markdown()
    monkeypatch.setitem(CODES, "SHOP_NO_PRICE", (0, "It has no price."))
    assert codes_markdown() == page
