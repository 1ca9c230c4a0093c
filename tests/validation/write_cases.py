"""Writes what the validator says of every case beside it: ``python tests/validation/write_cases.py``.

With names of folders, of those alone.

Read each difference before it is committed: the reports are what the validator is held to.

    X.gltf, X.glb   a case, named by what is special about it
    X.report.json   its report, without the validator's version and the numbers of the asset
    optics.json     of one folder: the remarks that `--optics` says more in, by case
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from gltf_iri.validation.options import Options
from gltf_iri.validation.validate import validate

CASES = Path(__file__).with_name("cases")
OPTICS = "optics.json"


def cases() -> list[Path]:
    """Return all cases, by folder and name."""
    return sorted(path for path in CASES.rglob("*") if path.suffix in (".gltf", ".glb"))


def folders() -> list[Path]:
    """Return the folders that hold cases."""
    return sorted({case.parent for case in cases()})


def report_of(case: Path, *, optics: bool = False) -> dict[str, Any]:
    """Return the report of a case as JSON, without the validator's version and its numbers of the asset."""
    report = validate(
        case, uri=case.name, options=Options(max_issues=0, optics=optics, raises=True)
    ).to_json()
    del report["validatorVersion"]
    report.pop("info", None)
    return report


def measured(folder: Path) -> dict[str, dict[str, str]]:
    """Return by case what `--optics` says more: code and pointer to message.

    Raises ValueError where it makes other remarks, or of another severity.
    """
    told = {}
    for case in cases():
        if case.parent == folder:
            plain, full = (report_of(case, optics=optics)["issues"]["messages"] for optics in (False, True))
            if [{**m, "message": ""} for m in plain] != [{**m, "message": ""} for m in full]:
                raise ValueError(f"--optics changes the verdict of {case}")
            more = {f"{m['code']} {m['pointer']}": m["message"] for m in full if m not in plain}
            if more:
                told[case.name] = more
    return told


def as_text(report: dict[str, Any]) -> str:
    """Return JSON as the files hold it."""
    return json.dumps(report, indent=2, ensure_ascii=False) + "\n"


def main(names: list[str]) -> None:
    """Write the reports of the folders `names`, or of all."""
    for folder in folders():
        if not names or folder.name in names:
            for case in cases():
                if case.parent == folder:
                    case.with_suffix(".report.json").write_text(as_text(report_of(case)), encoding="utf-8")
            (folder / OPTICS).write_text(as_text(measured(folder)), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
