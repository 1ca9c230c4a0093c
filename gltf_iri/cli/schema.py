"""`gltf-iri schema`: checks a proposal for a glTF extension, its schemas and its README."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from gltf_iri.cli.common import json_option, note, print_json, print_table

if TYPE_CHECKING:
    from gltf_iri.proposal.check import ProposalReport

__all__ = ["command"]


@click.command(name="schema")
@click.argument(
    "folder", metavar="DIR", type=click.Path(exists=True, file_okay=False, readable=True, path_type=Path)
)
@json_option
def command(folder: Path, as_json: bool) -> None:
    """Check the extension proposal in DIR: schema/*.schema.json, and README.md where there is one.

    DIR is called as the extension. Schemas must be legal in their own draft and keep to the style of glTF's
    registry; defaults must be valid and change nothing; the README's tables, examples, exclusions and
    pointers must agree with the schema. Only errors end with exit code 1, warnings and information do not.
    """
    from gltf_iri.proposal.check import check_proposal

    report = check_proposal(folder)
    if as_json:
        print_json(report.to_json())
    else:
        _print_text(report)
    if report.has_errors:
        raise click.exceptions.Exit(1)


def _print_text(report: ProposalReport) -> None:
    by_file: dict[str, list[tuple[str, str, str, str]]] = {}
    for finding in report.findings:
        place = finding.where.removeprefix(finding.file).lstrip("#:")
        row = (finding.severity.value, finding.code, place, finding.message)
        by_file.setdefault(finding.file, []).append(row)
    for file, rows in by_file.items():
        print_table(("severity", "code", "place", "what"), rows, title=file or report.extension)
        click.echo()
    counts = report.counts()
    told = ", ".join(f"{severity}: {count}" for severity, count in counts.items())
    click.echo(f"{report.extension}: {len(report.checked)} checks; {told}.")
    reasons: dict[str, list[str]] = {}
    for name, reason in report.skipped.items():
        reasons.setdefault(reason, []).append(name)
    for reason, names in reasons.items():
        note(f"Not checked, because {reason}: {', '.join(names)}.")
