"""The verdict on one file, in the Khronos validator's report format."""

from __future__ import annotations

from typing import Any

from gltf_iri import __version__
from gltf_iri.validation.issue import ERROR, SEVERITIES, Issue

__all__ = ["VALIDATOR_VERSION", "Report"]

VALIDATOR_VERSION = f"gltf-iri {__version__}"

_COUNT_NAMES = ("numErrors", "numWarnings", "numInfos", "numHints")


class Report:
    """What was found in a file.

    uri : the file as it was named; "" for bytes without a name.
    mime_type : "model/gltf+json", "model/gltf-binary", or None where the file could not be read.
    issues : all remarks, in the order of the file's own stages.
    info : numbers about the asset (the format's "info"), or None where its version could not be read.
    is_truncated : there were more remarks than were asked for.
    """

    __slots__ = ("info", "is_truncated", "issues", "mime_type", "uri")

    def __init__(
        self,
        uri: str,
        mime_type: str | None,
        issues: tuple[Issue, ...],
        info: dict[str, Any] | None = None,
        *,
        is_truncated: bool = False,
    ) -> None:
        self.uri = uri
        self.mime_type = mime_type
        self.issues = issues
        self.info = info
        self.is_truncated = is_truncated

    @property
    def counts(self) -> tuple[int, int, int, int]:
        """How many errors, warnings, pieces of information and hints there are."""
        errors, warnings, infos, hints = (sum(i.severity == s for i in self.issues) for s in SEVERITIES)
        return errors, warnings, infos, hints

    @property
    def has_errors(self) -> bool:
        """Whether the file breaks a rule of the specification."""
        return any(issue.severity == ERROR for issue in self.issues)

    def to_json(self) -> dict[str, Any]:
        """Return the report as the Khronos validator writes it, but without a time."""
        return {
            **({"uri": self.uri} if self.uri else {}),
            **({"mimeType": self.mime_type} if self.mime_type else {}),
            "validatorVersion": VALIDATOR_VERSION,
            "issues": {
                **dict(zip(_COUNT_NAMES, self.counts, strict=True)),
                "messages": [_message(issue) for issue in self.issues],
                "truncated": self.is_truncated,
            },
            **({"info": self.info} if self.info is not None else {}),
        }


def _message(issue: Issue) -> dict[str, Any]:
    told: dict[str, Any] = {"code": issue.code, "message": issue.message, "severity": issue.severity}
    if issue.offset is not None:
        told["offset"] = issue.offset
    elif issue.pointer is not None:
        told["pointer"] = issue.pointer
    return told
