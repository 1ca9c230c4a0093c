"""`gltf-iri validate`: what is wrong with glTF files, and what their optics make of them."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gltf_iri.cli.common import note, print_json, print_table, progress
from gltf_iri.errors import UsageError
from gltf_iri.validation.find import find_files
from gltf_iri.validation.formats.judged import Judged
from gltf_iri.validation.issue import SEVERITY_NAMES
from gltf_iri.validation.options import DEFAULT_MAX_ISSUES, Options

if TYPE_CHECKING:
    from gltf_iri.validation.results_file import ResultsFile

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
    found = find_files(paths)
    for passed_over in found.passed_over:
        note(f"Passed over {passed_over}.")
    # An object for people to read only where one file was asked for by its name: a folder means lines.
    is_one = len(paths) == 1 and found.files == list(paths)
    with ExitStack() as held:
        files, keep, has_errors = found.files, None, False
        if out or resume:
            results = _results_file(out, resume)
            held.enter_context(results)
            files = [file for file in files if file not in results.done]
            keep, has_errors = results.append, results.errors > 0
            if results.done:
                note(f"{len(results.done)} files were checked before, {results.errors} with errors.")
        from gltf_iri.validation.run import ask_khronos, judge_files

        judged = judge_files(files, options, jobs=jobs, scheduler=scheduler, keep=keep)
        if khronos:
            from gltf_iri.validation.khronos import find_khronos

            judged = ask_khronos(judged, find_khronos(), options)
        watch = _Watch(judged)
        is_quiet = keep is not None and form == "json"
        # On a terminal the results themselves show how far it is; a bar below them would cost more than they.
        if len(files) > 1 and (is_quiet or not sys.stdout.isatty()):
            watch.advance = held.enter_context(progress("Checking", len(files)))
        for piece in _written(form, watch, is_one=is_one):
            if not is_quiet:
                sys.stdout.write(piece)
                sys.stdout.flush()
    if has_errors or watch.has_errors:
        raise click.exceptions.Exit(1)


class _Watch:
    """Lets files pass, and remembers whether one of them had errors."""

    def __init__(self, files: Iterable[Judged]) -> None:
        self._files = files
        self.advance = _stand_still
        self.has_errors = False

    def __iter__(self) -> Iterator[Judged]:
        for file in self._files:
            self.has_errors = self.has_errors or file.has_errors
            yield file
            self.advance()


def _stand_still() -> None:
    """Show no progress."""


def _written(form: str, files: Iterable[Judged], *, is_one: bool) -> Iterator[str]:
    if form == "json":
        from gltf_iri.validation.formats import json_lines

        return json_lines.written(files, is_indented=is_one)
    if form == "sarif":
        from gltf_iri.validation.formats import sarif

        return sarif.written(files)
    if form == "csv":
        from gltf_iri.validation.formats import csv_rows

        return csv_rows.written(files)
    if form == "github":
        from gltf_iri.validation.formats import github

        return github.written(files)
    from gltf_iri.validation.formats import text

    # no-color.org: whatever the variable holds.
    return text.written(files, is_coloured=sys.stdout.isatty() and not os.environ.get("NO_COLOR"))


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


def _results_file(out: Path | None, resume: Path | None) -> ResultsFile:
    from gltf_iri.validation.results_file import ResultsFile

    place = resume or out
    if place is None:
        raise UsageError("There is no file to keep reports in.")
    return ResultsFile(place, is_resumed=resume is not None)


def _print_codes(*, as_json: bool) -> None:
    from gltf_iri.validation.codes_table import every_code, rows

    listed = list(rows(every_code()))
    columns = ("code", "severity", "message")
    if as_json:
        print_json([dict(zip(columns, row, strict=True)) for row in listed])
    else:
        print_table(columns, listed)
