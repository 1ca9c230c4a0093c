"""`gltf-iri validate`: what is wrong with glTF files, and what their optics make of them."""

from __future__ import annotations

from pathlib import Path

import click

from gltf_iri.cli.common import print_json, print_table
from gltf_iri.errors import UsageError
from gltf_iri.validation.issue import SEVERITY_NAMES
from gltf_iri.validation.options import DEFAULT_MAX_ISSUES, Options

__all__ = ["command"]

FORMATS = ("text", "json", "sarif", "csv", "github")
# Those that can tell more than the Khronos report holds, and that share stdout with a file of reports.
_OPEN_FORMATS = ("text", "json")


@click.command("validate")
@click.argument("paths", metavar="PATH...", nargs=-1)
@click.option(
    "--format",
    "form",
    type=click.Choice(FORMATS),
    default="text",
    show_default=True,
    help="How to tell results.",
)
@click.option("--json", "as_json", is_flag=True, help="The same as --format json.")
@click.option(
    "--severity",
    type=click.Choice(SEVERITY_NAMES),
    default="hint",
    show_default=True,
    help="The least to tell.",
)
@click.option(
    "--config",
    metavar="FILE",
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="YAML as the Khronos validator reads it: max-issues, ignore, only, override.",
)
@click.option("--ignore", metavar="CODE", multiple=True, help="Leave a code out; may be repeated.")
@click.option("--only", metavar="CODE", multiple=True, help="Tell this code alone; may be repeated.")
@click.option(
    "--override", metavar="CODE=SEVERITY", multiple=True, help="Change a code's severity; may be repeated."
)
@click.option(
    "--max-issues",
    type=click.IntRange(min=0),
    help="Stop after so many remarks on a file; 0, the default, for never.",
)
@click.option("--no-resources", is_flag=True, help="Do not read buffers and pictures.")
@click.option("--optics", is_flag=True, help="Measure in ΔE what remarks on films and layers mean; slow.")
@click.option("--jobs", type=click.IntRange(min=1), default=1, show_default=True, help="Processes at work.")
@click.option("--scheduler", metavar="tcp://HOST:PORT", help="Let the workers of a Dask cluster do the work.")
@click.option(
    "-o",
    "out",
    metavar="FILE",
    type=click.Path(dir_okay=False, path_type=Path),
    help="Keep the reports as JSON Lines, each as soon as it is there.",
)
@click.option(
    "--resume",
    metavar="FILE",
    type=click.Path(dir_okay=False, path_type=Path),
    help="As -o, but leave out what FILE has already.",
)
@click.option(
    "--khronos", is_flag=True, help="Ask the npm package gltf-validator too, and show both verdicts."
)
@click.option(
    "--codes", is_flag=True, help="List every code with its severity and meaning, and check nothing."
)
def command(
    paths: tuple[str, ...],
    form: str,
    as_json: bool,
    severity: str,
    config: Path | None,
    ignore: tuple[str, ...],
    only: tuple[str, ...],
    override: tuple[str, ...],
    max_issues: int | None,
    no_resources: bool,
    optics: bool,
    jobs: int,
    scheduler: str | None,
    out: Path | None,
    resume: Path | None,
    khronos: bool,
    codes: bool,
) -> None:
    """Check glTF files with the Khronos validator's codes, and films and layers with our own.

    PATHs are files, folders with all in them, patterns such as 'models/**/*.glb', and - for standard input.
    JSON is the Khronos validator's report: one object for one file, a line each for several. Only errors end
    with exit code 1.
    """
    form = "json" if as_json else form
    if codes:
        _print_codes(as_json=form == "json")
        return
    if not paths:
        raise click.UsageError("Missing argument 'PATH...'.")
    if form not in _OPEN_FORMATS:
        if out or resume:
            raise UsageError(f"-o and --resume keep JSON Lines; send {form} to a file with '>'.")
        if khronos:
            raise UsageError(f"--khronos shows both verdicts as text or json, not as {form}.")
    if out and resume:
        raise UsageError("--resume adds to its own FILE: leave out -o.")
    options = _options(
        config,
        *(ignore, only, override, max_issues),
        least=SEVERITY_NAMES.index(severity),
        resources=not no_resources,
        optics=optics,
    )
    from gltf_iri.cli.validate_files import validate_files

    has_errors = validate_files(
        paths,
        options,
        form=form,
        jobs=jobs,
        scheduler=scheduler,
        kept=resume or out,
        is_resumed=resume is not None,
        khronos=khronos,
    )
    if has_errors:
        raise click.exceptions.Exit(1)


def _options(
    config: Path | None,
    ignore: tuple[str, ...],
    only: tuple[str, ...],
    override: tuple[str, ...],
    max_issues: int | None,
    *,
    least: int,
    resources: bool,
    optics: bool,
) -> Options:
    if not (config or ignore or only or override):
        most = DEFAULT_MAX_ISSUES if max_issues is None else max_issues
        return Options(least=least, max_issues=most, resources=resources, optics=optics)
    from gltf_iri.validation.config import Settings, overrides, read_settings

    said = Settings(ignore, only, overrides(override), max_issues).checked()
    settings = read_settings(config).with_more(said) if config else said
    return Options(
        ignore=settings.ignore,
        only=settings.only,
        override=settings.override,
        least=least,
        max_issues=DEFAULT_MAX_ISSUES if settings.max_issues is None else settings.max_issues,
        resources=resources,
        optics=optics,
    )


def _print_codes(*, as_json: bool) -> None:
    from gltf_iri.validation.codes_table import every_code, rows

    listed = list(rows(every_code()))
    columns = ("code", "severity", "message")
    if as_json:
        print_json([dict(zip(columns, row, strict=True)) for row in listed])
    else:
        print_table(columns, listed)
