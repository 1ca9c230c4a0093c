"""The work of `gltf-iri validate` once its options are read; needs no click."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack
from pathlib import Path

from gltf_iri.validation.find import find_files
from gltf_iri.validation.formats.judged import Judged
from gltf_iri.validation.options import Options
from gltf_iri.validation.run import ask_khronos, judge_files

__all__ = ["validate_files"]


def validate_files(
    paths: tuple[str, ...],
    options: Options,
    *,
    form: str = "text",
    jobs: int = 1,
    scheduler: str | None = None,
    kept: Path | None = None,
    is_resumed: bool = False,
    khronos: bool = False,
) -> bool:
    """Check all that `paths` mean, write the results to stdout, and return whether a file has errors.

    kept : also write each report there, as a line of JSON; with `is_resumed`, go on with the run that did.
    """
    found = find_files(paths)
    for passed_over in found.passed_over:
        _note(f"Passed over {passed_over}.")
    # An object for people to read only where one file was asked for by its name: a folder means lines.
    is_one = len(paths) == 1 and found.files == list(paths)
    with ExitStack() as held:
        files, keep, has_errors = found.files, None, False
        if kept is not None:
            from gltf_iri.validation.many.results_file import ResultsFile

            results = held.enter_context(ResultsFile(kept, is_resumed=is_resumed))
            files = [file for file in files if file not in results.done]
            keep, has_errors = results.append, results.errors > 0
            if results.done:
                _note(f"{len(results.done)} files were checked before, {results.errors} with errors.")
        judged = judge_files(files, options, jobs=jobs, scheduler=scheduler, keep=keep)
        if khronos:
            from gltf_iri.validation.khronos import find_khronos

            judged = ask_khronos(judged, find_khronos(), options)
        watch = _Watch(judged)
        is_quiet = keep is not None and form == "json"
        # On a terminal the results themselves show how far it is; a bar below them would cost more than they.
        if len(files) > 1 and (is_quiet or not sys.stdout.isatty()):
            from gltf_iri.cli.common import progress

            watch.advance = held.enter_context(progress("Checking", len(files)))
        for piece in _written(form, watch, is_one=is_one):
            if not is_quiet:
                sys.stdout.write(piece)
                sys.stdout.flush()
    return has_errors or watch.has_errors


class _Watch:
    """Lets files pass, and remembers whether one of them had errors."""

    def __init__(self, files: Iterable[Judged]) -> None:
        self._files = files
        self.advance: Callable[[], None] = _stand_still
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


def _note(sentence: str) -> None:
    from gltf_iri.cli.common import note

    note(sentence)
