"""The README's heading and sections, in the order of the registry's template and its material extensions."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from gltf_iri.asset.words import shown
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal

__all__ = ["heading", "sections"]

# What a section's heading says, lowercase, in the order in which the registry has them; and whether the
# template demands it, asks for it, or leaves it open.
_DEMANDED, _ASKED, _OPEN = "section-missing", "section-missing-minor", ""
_SCHEMA: Final = "Schema"
_SECTIONS: Final = (
    ("Contributors", re.compile(r"contributors?\b"), _ASKED),
    ("Status", re.compile(r"status\b"), _DEMANDED),
    ("Dependencies", re.compile(r"dependenc(?:y|ies)\b"), _DEMANDED),
    ("Exclusions", re.compile(r"exclusions?\b"), _OPEN),
    ("Overview", re.compile(r"overview\b"), _DEMANDED),
    ("Extending …", re.compile(r"extending\b"), _OPEN),
    ("Properties", re.compile(r"properties\b"), _OPEN),
    (_SCHEMA, re.compile(r"(?:json |gltf )?schemas?(?: updates)?$"), _ASKED),
    ("Appendix", re.compile(r"appendix\b.*copyright"), _OPEN),
)


def heading(proposal: Proposal) -> Iterator[Finding]:
    """The first heading is the extension's name."""
    readme = proposal.readme
    if readme is None:
        return
    first = next(iter(readme.headings), None)
    if first is None or first.text != proposal.name:
        told = f"the first heading is {shown(first.text) if first else 'missing'}, not {proposal.name}"
        yield Finding("heading-differs", told, readme.at(first.line if first else 1))


def sections(proposal: Proposal) -> Iterator[Finding]:
    """Sections that the template demands are there, and known ones stand in the usual order."""
    readme = proposal.readme
    if readme is None:
        return
    latest, name_of_latest = 0, ""
    for name, pattern, severity in _SECTIONS:
        deepest = 3 if name == _SCHEMA else 2  # the template has it inside another section
        found = [h for h in readme.headings[1:] if h.level <= deepest and pattern.match(h.text.lower())]
        if not found:
            if severity:
                yield Finding(severity, f"there is no section {name!r}", readme.at(1))
            continue
        line = found[-1 if name == _SCHEMA else 0].line
        if line < latest:
            told = f"the section {name!r} stands before {name_of_latest!r}"
            yield Finding("section-order", told, readme.at(line))
        else:
            latest, name_of_latest = line, name
