"""The codes of the Khronos glTF validator: its names and severities (2.0.0-dev.3.11), our own sentences.

Every code is stated once, in two tables; a rule names the code and the numbers, and `issue` makes the
sentence. The validator's own list is KhronosGroup/glTF-Validator, ISSUES.md.
"""

from __future__ import annotations

from gltf_iri.validation.codes_of_links import CODES_OF_LINKS
from gltf_iri.validation.codes_of_objects import CODES_OF_OBJECTS
from gltf_iri.validation.issue import Issue

__all__ = ["CODES", "add_codes", "issue"]

# Code to severity and sentence; rules from outside add theirs.
CODES: dict[str, tuple[int, str]] = {**CODES_OF_OBJECTS, **CODES_OF_LINKS}


def issue(code: str, pointer: str | None = None, *, offset: int | None = None, **told: object) -> Issue:
    """Return the remark `code` about what stands at `pointer` or `offset`; `told` fills its sentence."""
    severity, sentence = CODES[code]
    return Issue(code, sentence.format(**told) if told else sentence, severity, pointer, offset)


def add_codes(codes: dict[str, tuple[int, str]]) -> None:
    """Make more codes known; ValueError where one is known with another meaning."""
    for code, stated in codes.items():
        if CODES.setdefault(code, stated) != stated:
            raise ValueError(f"the code {code} is known with another meaning")
