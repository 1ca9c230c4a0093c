"""Our own codes of reading a file and running its rules.

An error is what leaves the file unread, for what nobody looked at must not pass. The rest warns.
"""

from __future__ import annotations

from gltf_iri.validation.codes import add_codes
from gltf_iri.validation.issue import ERROR, WARNING

__all__ = ["READING_CODES"]

READING_CODES: dict[str, tuple[int, str]] = {
    # glTF 2.0 §2.7: keys SHOULD be unique, and readers SHOULD take the last. Some refuse the file, ours too.
    "IRI_DUPLICATE_KEY": (WARNING, "The key stands twice in its object; the last value holds."),
    # The grammar of JSON allows it, but no UTF-8 can hold it (RFC 8259 §8.2): some readers refuse it.
    "IRI_LONE_SURROGATE": (
        WARNING,
        "The text holds half of a surrogate pair, which is no character; some readers refuse such a file.",
    ),
    # RFC 8259 §9 lets a reader set limits; what is beyond them was not looked at.
    "IRI_JSON_TOO_DEEP": (
        ERROR,
        "From byte {place} of the JSON on it nests deeper than {most} levels, the most that are read.",
    ),
    "IRI_JSON_TOO_LARGE": (ERROR, "The JSON has {size}, more than the {most} that are read."),
    "IRI_GLB_TOO_MANY_CHUNKS": (ERROR, "The GLB has more than {most} chunks, the most that are read."),
    # The fault is the rule's, not the file's; all others were followed.
    "IRI_RULE_FAILED": (WARNING, "The rule {rule} broke off and may have left faults untold: {reason}."),
    "IRI_PLUGIN_FAILED": (
        WARNING,
        "The rules of {plugin} are left out, for they cannot be loaded: {reason}.",
    ),
}

add_codes(READING_CODES)
