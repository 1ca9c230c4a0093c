"""Extensions that must not stand on the same object: named on both sides, and nowhere contradicted."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import takewhile
from typing import Final

from gltf_iri.proposal.bounds import MAX_SIBLINGS
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal, read_readme
from gltf_iri.proposal.markdown import Block, Markdown
from gltf_iri.proposal.naming import EXTENSION_NAME

__all__ = ["contradictions", "excluded_by", "reciprocity"]

_EXCLUSIONS: Final = re.compile(r"exclusions?\b", re.IGNORECASE)
_TOGETHER: Final = re.compile(
    r"interact|combin|defined with|other extensions|together with|dependenc", re.IGNORECASE
)
_FORBIDS: Final = re.compile(
    r"exclu|\bnot\b|\bnever\b|\bcannot\b|\bundefined\b|\bforbid|\bignored?\b|\binstead\b|\brather\b|\bno\b",
    re.IGNORECASE,
)
# Khronos' own: published, so another proposal cannot change what their READMEs say.
_PUBLISHED: Final = "KHR_"


def excluded_by(readme: Markdown, name: str) -> dict[str, Block]:
    """Return the extensions that a README's section on exclusions names, each with its first block."""
    found: dict[str, Block] = {}
    for block in readme.blocks:
        if any(_EXCLUSIONS.match(heading.text) for heading in block.headings):
            for other in EXTENSION_NAME.findall(block.text):
                if other != name:
                    found.setdefault(other, block)
    return found


def reciprocity(proposal: Proposal) -> Iterator[Finding]:
    """Whom the README excludes excludes it too, as far as the folders beside it tell."""
    readme = proposal.readme
    if readme is None:
        return
    excluded = excluded_by(readme, proposal.name)
    beside = dict(_siblings(proposal))
    for other, block in excluded.items():
        where = readme.at(block.line)
        theirs = beside.get(other)
        if theirs is not None and proposal.name in excluded_by(theirs, other):
            continue
        if other.startswith(_PUBLISHED):
            told = f"{other} must be asked to exclude {proposal.name} in turn"
            yield Finding("exclusion-to-propose", told, where)
        elif theirs is None:
            told = f"whether {other} excludes {proposal.name} in turn is not known here"
            yield Finding("exclusion-unverified", told, where)
        else:
            told = f"{other} does not exclude {proposal.name} in turn"
            yield Finding("exclusion-one-sided", told, where)
    for other, theirs in beside.items():
        if proposal.name in excluded_by(theirs, other) and other not in excluded:
            told = f"{other} excludes {proposal.name}, which does not exclude it in turn"
            yield Finding("exclusion-unanswered", told, readme.name)


def _siblings(proposal: Proposal) -> Iterator[tuple[str, Markdown]]:
    """Yield the READMEs of the extensions in the folders beside this one."""
    root = proposal.folder.parent
    try:
        folders = sorted(path for path in root.iterdir() if EXTENSION_NAME.fullmatch(path.name))
    except OSError:  # the folder above may be closed to us
        return
    for folder in folders[:MAX_SIBLINGS]:
        if folder.name == proposal.name or folder.is_symlink() or not folder.is_dir():
            continue
        try:
            readme, _ = read_readme(root, folder)
        except OSError:
            continue
        if readme is not None:
            yield folder.name, readme


def contradictions(proposal: Proposal) -> Iterator[Finding]:
    """Nothing that is excluded is spoken of as working together, or as needed, elsewhere."""
    readme = proposal.readme
    if readme is None:
        return
    excluded = excluded_by(readme, proposal.name)
    told_of = set()
    for position, block in enumerate(readme.blocks):
        if any(_EXCLUSIONS.match(heading.text) for heading in block.headings):
            continue
        if not any(_TOGETHER.search(heading.text) for heading in block.headings):
            continue
        named = [other for other in dict.fromkeys(EXTENSION_NAME.findall(block.text)) if other in excluded]
        if not named or _FORBIDS.search(_said(readme, position)):
            continue
        for other in named:
            if other not in told_of:
                told_of.add(other)
                told = (
                    f"{other} is excluded in line {excluded[other].line}, and here it is not: say which holds"
                )
                yield Finding("exclusion-contradicted", told, readme.at(block.line))


def _said(readme: Markdown, position: int) -> str:
    """Return a block's text; of a heading, with all that stands under it."""
    block = readme.blocks[position]
    if not (block.headings and block.headings[-1].line == block.line):
        return block.text
    # The section's end ends the search: a text of nothing but headings is read once for each level of them.
    after = (readme.blocks[place] for place in range(position + 1, len(readme.blocks)))
    below = takewhile(lambda b: block.headings[-1] in b.headings, after)
    return " ".join([block.text, *(b.text for b in below)])
