"""The list of codes that people read is the list of the program."""

from __future__ import annotations

import re
from pathlib import Path

from gltf_iri.proposal.finding import CODES
from gltf_iri.proposal.rules import BLOCKING, RULES, UNREAD

NOTES = Path(__file__).parents[2] / "spec" / "decisions" / "schema-checker.md"


def test_the_notes_list_every_code_with_its_severity_and_reason() -> None:
    rows = re.findall(
        r"^\| `([a-z-]+)` \| (\w+) \| (.*) \|$", NOTES.read_text(encoding="utf-8"), re.MULTILINE
    )
    assert rows == [(code, kind.severity.value, kind.why) for code, kind in CODES.items()]


def test_codes_that_stop_other_checks_exist() -> None:
    assert UNREAD < BLOCKING < CODES.keys()


def test_rules_are_told_apart_by_name() -> None:
    assert len({rule.name for rule in RULES}) == len(RULES)
