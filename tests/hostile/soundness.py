"""What must hold of every report, whatever the file: known codes, true counts, places that are there."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from gltf_iri.validation.codes import CODES
from gltf_iri.validation.report import Report

__all__ = ["faults"]

LONGEST_SENTENCE = 1000


def faults(report: Report, source: Path | bytes) -> Iterator[str]:
    """Yield a sentence for everything about the report that does not hold together."""
    told = json.loads(json.dumps(report.to_json(), allow_nan=False))
    messages = told["issues"]["messages"]
    counts = [told["issues"][key] for key in ("numErrors", "numWarnings", "numInfos", "numHints")]
    if counts != [sum(m["severity"] == severity for m in messages) for severity in range(4)]:
        yield f"the counts {counts} are not those of the messages"
    tree = _tree(source)
    for message in messages:
        if message["code"] not in CODES:
            yield f"the code {message['code']} is not known"
        if message["code"] == "IRI_RULE_FAILED":
            yield message["message"]
        if len(message["message"]) > LONGEST_SENTENCE:
            yield f"{message['message'][:200]}… is no sentence"
        if ("pointer" in message) == ("offset" in message):
            yield f"{message['code']} has no place"
        if tree is not None and "pointer" in message and not _leads_somewhere(tree, message["pointer"]):
            yield f"{message['code']} points to {message['pointer'][:200]}, which is nowhere"


def _tree(source: Path | bytes) -> Any:
    data = source if isinstance(source, bytes) else source.read_bytes()
    if data.startswith(b"glTF"):
        data = data[20 : 20 + int.from_bytes(data[12:16], "little")]
    try:
        return json.loads(data)
    except (ValueError, RecursionError):
        return None


def _leads_somewhere(tree: Any, pointer: str) -> bool:
    """Tell whether the pointer leads to a value, or to where a missing member of an object belongs."""
    if pointer in ("", "/"):
        return True
    tokens = [token.replace("~1", "/").replace("~0", "~") for token in pointer.split("/")[1:]]
    value = tree
    for token in tokens[:-1]:
        if isinstance(value, list) and token.isdigit() and int(token) < len(value):
            value = value[int(token)]
        elif isinstance(value, dict) and token in value:
            value = value[token]
        else:
            return len(token) >= LONGEST_SENTENCE  # cut short in the report
    return isinstance(value, dict | list)
