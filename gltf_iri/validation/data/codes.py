"""Our own code of data that was not looked at."""

from __future__ import annotations

from gltf_iri.validation.codes import add_codes
from gltf_iri.validation.issue import WARNING

__all__ = ["DATA_CODES"]

DATA_CODES: dict[str, tuple[int, str]] = {
    # A kilobyte of JSON can have a thousand million numbers looked at that no byte of a file stands for.
    "IRI_DATA_NOT_CHECKED": (
        WARNING,
        "These numbers are not looked at: {reason}.",
    ),
}

add_codes(DATA_CODES)
