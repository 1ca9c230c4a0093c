"""Every code that the validator may tell, with its severity and its sentence."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from gltf_iri.validation.codes import CODES
from gltf_iri.validation.codes_of_links import CODES_OF_LINKS
from gltf_iri.validation.codes_of_objects import CODES_OF_OBJECTS
from gltf_iri.validation.iridescence.codes import IRIDESCENCE_REASONS
from gltf_iri.validation.issue import SEVERITY_NAMES

__all__ = ["OWN", "as_text", "codes_markdown", "every_code", "rows"]

# How our own codes begin; all others are the Khronos validator's, or of rules from outside.
OWN = "IRI_"

_PLACEHOLDER = re.compile(r"\{(\w+)[^}]*\}")


def every_code() -> dict[str, tuple[int, str]]:
    """Return code to severity and sentence, of all that may be told here, rules from outside included."""
    from gltf_iri.validation.plugins import load_plugins

    _load_own()
    load_plugins()
    return CODES


def rows(codes: Iterable[str]) -> Iterator[tuple[str, str, str]]:
    """Yield code, severity and sentence, our own codes first, each group by name."""
    for code in sorted(codes, key=lambda code: (not code.startswith(OWN), code)):
        severity, sentence = CODES[code]
        yield code, SEVERITY_NAMES[severity], as_text(sentence)


def as_text(sentence: str) -> str:
    """Return a sentence with ‹name› where a report has the value."""
    return _PLACEHOLDER.sub(r"‹\1›", sentence)


def codes_markdown() -> str:
    """Return spec/validator-codes.md, which has no rules from outside, whatever is installed."""
    _load_own()
    return "\n".join(
        (
            "# Codes of `gltf-iri validate`",
            "",
            "Written from the validator's tables by `python -m gltf_iri.generate`; ‹name› stands for what a "
            "report fills in.",
            "",
            "## Our own",
            "",
            *_table(code for code in CODES if code.startswith(OWN)),
            "",
            "## What remarks on films rest on",
            "",
            "Sections are those of the README of KHR\\_materials\\_iridescence, if no other is named. "
            "Renderers are three.js 0.187, Babylon.js 9.34, the Khronos sample renderer 1.1.0 and PlayCanvas "
            "2.23, by their sources.",
            "",
            *(f"- `{code}`: {_escaped(reason)}" for code, reason in sorted(IRIDESCENCE_REASONS.items())),
            "",
            "## The Khronos validator's",
            "",
            "The names and severities of KhronosGroup/glTF-Validator, ISSUES.md (2.0.0-dev.3.11); "
            "the sentences are ours.",
            "",
            *_table((*CODES_OF_OBJECTS, *CODES_OF_LINKS)),
            "",
        )
    )


def _load_own() -> None:
    # These bring codes of their own.
    from gltf_iri.validation import validate as _validate  # noqa: F401
    from gltf_iri.validation.many import many as _many  # noqa: F401


def _table(codes: Iterable[str]) -> Iterator[str]:
    yield "| code | severity | what it says |"
    yield "|---|---|---|"
    for code, severity, sentence in rows(codes):
        yield f"| `{code}` | {severity} | {_escaped(sentence)} |"


def _escaped(sentence: str) -> str:
    # Bars would end a cell, and brackets, stars and the like are Markdown.
    return re.sub(r"([|\[\]*_<`\\])", r"\\\1", sentence)
