"""Every code that the validator may tell, with its severity and its sentence."""

from __future__ import annotations

import re
from collections.abc import Iterator

from gltf_iri.validation.codes import CODES
from gltf_iri.validation.issue import SEVERITY_NAMES

__all__ = ["OWN", "as_text", "codes_markdown", "every_code", "rows"]

# How our own codes begin; all others are the Khronos validator's, or a plug-in's.
OWN = "IRI_"

_PLACEHOLDER = re.compile(r"\{(\w+)[^}]*\}")


def every_code() -> dict[str, tuple[int, str]]:
    """Return code to severity and sentence, of all that may be told."""
    # These bring codes of their own.
    from gltf_iri.validation import many as _many  # noqa: F401
    from gltf_iri.validation.rules import every as _every  # noqa: F401

    return CODES


def rows() -> Iterator[tuple[str, str, str]]:
    """Yield code, severity and sentence, our own codes first, each group by name."""
    known = every_code()
    for code in sorted(known, key=lambda code: (not code.startswith(OWN), code)):
        severity, sentence = known[code]
        yield code, SEVERITY_NAMES[severity], as_text(sentence)


def as_text(sentence: str) -> str:
    """Return a sentence with ‹name› where a report has the value."""
    return _PLACEHOLDER.sub(r"‹\1›", sentence)


def codes_markdown() -> str:
    """Return spec/validator-codes.md."""
    return "\n".join(
        (
            "# Codes of `gltf-iri validate`",
            "",
            "Written from the validator's tables by `python -m gltf_iri.generate`; ‹name› stands for what a "
            "report fills in.",
            "",
            "## Our own",
            "",
            *_table(is_own=True),
            "",
            "## The Khronos validator's",
            "",
            "The names and severities of KhronosGroup/glTF-Validator, ISSUES.md (2.0.0-dev.3.11); "
            "the sentences are ours.",
            "",
            *_table(is_own=False),
            "",
        )
    )


def _table(*, is_own: bool) -> Iterator[str]:
    yield "| code | severity | what it says |"
    yield "|---|---|---|"
    for code, severity, sentence in rows():
        if code.startswith(OWN) == is_own:
            # Bars would end the cell, and square brackets may look like links.
            told = re.sub(r"([|\[\]*_<`\\])", r"\\\1", sentence)
            yield f"| `{code}` | {severity} | {told} |"
