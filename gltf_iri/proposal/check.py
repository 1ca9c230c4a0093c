"""Asks every rule about a proposal and gathers what was found, what was checked and what was not."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

from gltf_iri.proposal.bounds import MAX_FINDINGS
from gltf_iri.proposal.finding import Finding, Severity
from gltf_iri.proposal.folder import README, Proposal, read_proposal
from gltf_iri.proposal.rules import BLOCKING, RULES, UNREAD, Needs

__all__ = ["ProposalReport", "check_proposal"]


@dataclass(frozen=True)
class ProposalReport:
    """What was found; `skipped` says of each rule that was not asked why not."""

    extension: str
    findings: tuple[Finding, ...]
    checked: tuple[str, ...]
    skipped: Mapping[str, str]

    @property
    def has_errors(self) -> bool:
        """Whether a finding is an error."""
        return any(finding.severity is Severity.ERROR for finding in self.findings)

    def counts(self) -> dict[str, int]:
        """How many findings each severity has."""
        return {s.value: sum(f.severity is s for f in self.findings) for s in Severity}

    def to_json(self) -> dict[str, Any]:
        """The report as the command line prints it."""
        return {
            "extension": self.extension,
            "findings": [finding.to_json() for finding in self.findings],
            "counts": self.counts(),
            "checked": self.checked,
            "skipped": [{"check": name, "reason": reason} for name, reason in self.skipped.items()],
        }


def check_proposal(folder: Path) -> ProposalReport:
    """Check the extension proposal in `folder`: ``schema/*.schema.json`` (or beside it) and ``README.md``.

    The folder is called as the extension. Nothing outside it is read but READMEs of extensions beside it, and
    nothing is fetched. Raises OSError where the folder cannot be listed; whatever is wrong with what it holds
    becomes a finding.
    """
    proposal = read_proposal(folder)
    findings = list(proposal.findings)
    checked: list[str] = []
    skipped: dict[str, str] = {}
    for rule in RULES:
        reason = _hindrance(proposal, findings, rule.needs)
        if reason:
            skipped[rule.name] = reason
        else:
            checked.append(rule.name)
            found = list(islice(rule.check(proposal), MAX_FINDINGS + 1))
            if len(found) > MAX_FINDINGS:
                skipped[rule.name] = f"it has more than {MAX_FINDINGS} findings, and the others are left out"
            findings += found[:MAX_FINDINGS]
    findings = list(dict.fromkeys(findings))  # two objects may share a schema and its faults
    return ProposalReport(proposal.name, tuple(findings), tuple(checked), skipped)


def _hindrance(proposal: Proposal, findings: list[Finding], needs: Needs) -> str:
    """Return why a rule with these needs cannot be asked, or ""."""
    if needs in (Needs.README, Needs.BOTH) and proposal.readme is None:
        is_there = any(finding.code == "readme-unreadable" for finding in findings)
        return f"{README} cannot be read" if is_there else f"there is no {README}"
    hindering = {Needs.FILES: UNREAD, Needs.SCHEMAS: BLOCKING, Needs.BOTH: BLOCKING}.get(needs, ())
    blocking = next((f.code for f in findings if f.code in hindering), None)
    if blocking is not None:
        return f"the schemas are not sound: {blocking}"
    return ""
