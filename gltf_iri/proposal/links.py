"""Do the README's relative links lead to something: files, figures, schemas, headings?"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Final
from urllib.parse import unquote

from gltf_iri.asset.words import shown
from gltf_iri.proposal.finding import Finding
from gltf_iri.proposal.folder import Proposal

__all__ = ["links"]

_SCHEME: Final = re.compile(r"[A-Za-z][A-Za-z0-9+.\-]*:|//")
_HIGHEST: Final = 12  # folders above the proposal in which the repository may begin


def links(proposal: Proposal) -> Iterator[Finding]:
    """Every relative link leads to a file of the folder, or to one of the repository that is here."""
    readme = proposal.readme
    if readme is None:
        return
    root = _repository(proposal.folder)
    for link in readme.links:
        where = readme.at(link.line)
        path, _, anchor = link.target.partition("#")
        if _SCHEME.match(path) or not link.target:
            continue
        if not path:
            if unquote(anchor).lower() not in readme.anchors:
                yield Finding("link-anchor", f"there is no heading for {shown('#' + anchor)}", where)
            continue
        place = _place(proposal.folder, path.partition("?")[0])
        if place is None or not place.is_relative_to(proposal.folder):
            if place is None or not place.is_relative_to(root) or not _exists(place):
                told = f"{shown(link.target)} leads out of the folder, to nothing that is in this checkout"
                yield Finding("link-unverified", told, where)
        elif not _exists(place):
            yield Finding("link-broken", f"there is no {shown(link.target)}", where)


def _place(folder: Path, path: str) -> Path | None:
    """Join without touching the disk: '..' is taken back by name, None where that leaves all folders."""
    steps = [] if path.startswith("/") else list(folder.parts)
    if not steps or "\0" in unquote(path):
        return None
    for step in unquote(path).split("/"):
        if step == "..":
            if len(steps) == 1:
                return None
            steps.pop()
        elif step not in ("", "."):
            steps.append(step)
    return Path(*steps)


def _exists(place: Path) -> bool:
    try:
        return place.exists()
    except OSError:  # a name longer than the system takes
        return False


def _repository(folder: Path) -> Path:
    """Return the folder that links may lead to: the checkout's, else the one that extensions lie in."""
    for above in [folder, *folder.parents][:_HIGHEST]:
        if _exists(above / ".git"):
            return above
    return folder.parent
