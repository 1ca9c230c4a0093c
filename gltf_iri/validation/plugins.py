"""Rules from outside: installed packages name them under the entry point group "gltf_iri.rules".

What they may state, with an example, stands in spec/validator-rules.md.
"""

from __future__ import annotations

import sys
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from gltf_iri.validation.codes import add_codes, issue
from gltf_iri.validation.issue import SEVERITIES
from gltf_iri.validation.reading import codes as _codes  # noqa: F401  # makes them known
from gltf_iri.validation.rules.registry import add_data_rules, add_rules
from gltf_iri.validation.tables import TABLES, add_tables

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from gltf_iri.validation.issue import Issue

__all__ = ["GROUP", "load_plugins"]

GROUP = "gltf_iri.rules"


@cache
def load_plugins() -> tuple[Issue, ...]:
    """Add all rules from outside, once in a process, and return a remark on each package that failed."""
    if not any(map(_declares_rules, _entry_point_files())):
        return ()
    # Imported late: it takes longer than a small file's verdict, and hardly any machine has such a package.
    from importlib.metadata import entry_points

    failures = []
    for found in sorted(entry_points(group=GROUP), key=lambda point: point.name):
        try:
            _add(found.load())
        except Exception as error:
            reason = f"{type(error).__name__}: {error}"
            failures.append(issue("IRI_PLUGIN_FAILED", "", plugin=found.name, reason=reason))
    return tuple(failures)


def _entry_point_files() -> Iterator[Path]:
    # The folders that pip and setuptools leave beside packages; an archive on the path has none to list.
    return (file for folder in sys.path for file in Path(folder).glob("*-info/entry_points.txt"))


def _declares_rules(file: Path) -> bool:
    try:
        return f"[{GROUP}]".encode() in file.read_bytes()
    except OSError:  # it went away, or is not ours to read
        return False


def _add(stated: Any) -> None:
    """Add what a package states; whatever it leaves out adds nothing."""
    codes = dict(getattr(stated, "codes", {}))
    for code, (severity, sentence) in codes.items():
        if severity not in SEVERITIES or not isinstance(sentence, str):
            raise ValueError(f"{code} must state a severity from 0 to 3 and a sentence")
    rules, data_rules = dict(getattr(stated, "rules", {})), dict(getattr(stated, "data_rules", {}))
    tables = {"objects": {}, "extensions": {}, **getattr(stated, "tables", {})}
    unknown = (rules.keys() | data_rules.keys()) - TABLES.keys() - tables["objects"].keys()
    if unknown:
        raise ValueError(f"there is no table {min(unknown)!r}")
    add_codes(codes)
    add_tables(tables)
    add_rules(rules)
    add_data_rules(data_rules)
