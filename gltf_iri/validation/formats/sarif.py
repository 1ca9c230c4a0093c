"""Reports as SARIF 2.1.0 (OASIS), the form that GitHub's code scanning and other dashboards take.

What GitHub demands beyond the schema: a description, help and level for each rule, and for each result a
place with a line (docs.github.com, "SARIF support for code scanning"). Remarks on a GLB, which has no lines,
stand in line 1; their byte or pointer says where they belong.
"""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

from gltf_iri import __version__
from gltf_iri.validation.codes import CODES
from gltf_iri.validation.codes_table import as_text
from gltf_iri.validation.formats.judged import Judged
from gltf_iri.validation.iridescence.codes import IRIDESCENCE_REASONS
from gltf_iri.validation.issue import ERROR, INFORMATION, WARNING

__all__ = ["SCHEMA", "written"]

SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"

_LEVELS = {ERROR: "error", WARNING: "warning"}


def written(files: Iterable[Judged]) -> Iterator[str]:
    """Yield one log with one run."""
    rules: dict[str, dict[str, Any]] = {}
    results = []
    for file in files:
        uri = _uri(file.path)
        for message, line in zip(file.messages, file.lines(), strict=True):
            rule = rules.setdefault(message["code"], {"index": len(rules), **_rule(message)})
            results.append(
                {
                    "ruleId": message["code"],
                    "ruleIndex": rule["index"],
                    "level": _LEVELS.get(message["severity"], "note"),
                    "message": {"text": message["message"]},
                    "locations": [_location(uri, message, line)],
                }
            )
    driver = {
        "name": "gltf-iri",
        "version": __version__,
        "rules": [{key: value for key, value in rule.items() if key != "index"} for rule in rules.values()],
    }
    # Columns are not told; the schema wants to know all the same what one would count.
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": results}
    yield json.dumps({"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}, indent=1) + "\n"


def _rule(message: dict[str, Any]) -> dict[str, Any]:
    # A rule from outside may be known to the workers that used it and not here.
    severity, sentence = CODES.get(message["code"], (INFORMATION, message["message"]))
    text = {"text": as_text(sentence)}
    reason = IRIDESCENCE_REASONS.get(message["code"])
    level = {"level": _LEVELS.get(severity, "note")}
    return {
        "id": message["code"],
        "shortDescription": text,
        "fullDescription": text,
        "help": text if reason is None else {"text": reason},
        "defaultConfiguration": level,
    }


def _location(uri: str, message: dict[str, Any], line: int | None) -> dict[str, Any]:
    region: dict[str, int] = {"startLine": line or 1}
    if "offset" in message:
        region["byteOffset"] = message["offset"]
    location: dict[str, Any] = {
        "physicalLocation": {"artifactLocation": {"uri": uri}, "region": region},
    }
    if message.get("pointer"):
        location["logicalLocations"] = [{"fullyQualifiedName": message["pointer"]}]
    return location


def _uri(path: str) -> str:
    """Return a file's URI: relative where it lies below this folder, as it then does in the repository."""
    place = Path(path)
    if place.is_absolute() and place.is_relative_to(Path.cwd()):
        place = place.relative_to(Path.cwd())
    if place.is_absolute():
        return place.as_uri()
    return quote(os.fsencode(Path(os.path.normpath(place)).as_posix()))
