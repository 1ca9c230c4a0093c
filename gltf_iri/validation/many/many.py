"""Many files: the same work in this process, on local processes, or on a Dask cluster, one report a file.

Everything goes through the interface of `concurrent.futures`. A batch whose worker died is tried again file
by file, one at a time, so that the file that killed it is known for certain and all others get their report.
"""

from __future__ import annotations

import json
from collections import deque
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import TYPE_CHECKING, Any

from gltf_iri import __version__
from gltf_iri.errors import GltfIriError, MissingCapabilityError
from gltf_iri.validation.codes import add_codes, issue
from gltf_iri.validation.issue import ERROR
from gltf_iri.validation.options import Options
from gltf_iri.validation.report import Report
from gltf_iri.validation.validate import validate

if TYPE_CHECKING:
    from concurrent.futures import Future

    from gltf_iri.validation.many.crews import Crew

__all__ = ["FileResult", "validate_many"]

# Files that travel together: a trip costs about as much as one small file.
_BATCH_FILES = 32
# Batches that wait beside those at work, so that no worker ever waits for this process.
_BATCHES_PER_JOB = 3


# The machine may have killed the first for reasons of its own.
_DEATHS_ALLOWED = 2

# An error, though the file may be sound: without a verdict a run must not end as if all were well.
add_codes({"IRI_WORKER_DIED": (ERROR, "There is no verdict: {reason}.")})


class FileResult:
    """What came of one file.

    path : the file as it was named.
    line : its report as one line of JSON.
    failure : a sentence where the file could not be judged (it cannot be read, or its worker died); the
        report then has an error that says the same.
    """

    __slots__ = ("failure", "line", "path")

    def __init__(self, path: str, line: str, failure: str | None = None) -> None:
        self.path = path
        self.line = line
        self.failure = failure

    @property
    def report(self) -> dict[str, Any]:
        """The report as `Report.to_json` gives it."""
        told: dict[str, Any] = json.loads(self.line)
        return told


def validate_many(
    paths: Iterable[str], options: Options, *, jobs: int = 1, scheduler: str | None = None
) -> Iterator[FileResult]:
    """Yield the result of every file as soon as it is there: in the order of `paths` for one job only.

    jobs : local processes that work at once; 1 is this process.
    scheduler : address of a Dask scheduler, such as "tcp://host:8786", whose workers then do the work: they
        need this program, and the files under the same absolute paths.

    Raises MissingCapabilityError where Dask is not installed, UsageError where no scheduler answers. What is
    wrong with a file, or with a worker, is in the results.
    """
    if jobs == 1 and scheduler is None:
        for path in paths:
            yield _judged(path, path, options)
        return
    from gltf_iri.validation.many.crews import crew_of

    with crew_of(jobs, scheduler) as crew:
        yield from _spread(crew, iter(paths), options)


def _spread(crew: Crew, paths: Iterator[str], options: Options) -> Iterator[FileResult]:
    from concurrent.futures import FIRST_COMPLETED, wait

    at_work: dict[Future[list[FileResult]], list[str]] = {}
    suspects: deque[tuple[str, int]] = deque()  # and how often they died alone
    alone: tuple[str, int] | None = None
    while True:
        # Suspects go alone, when nothing else is at work: what dies then is guilty.
        if suspects and not at_work:
            alone = suspects.popleft()
            at_work[crew.submit(judge_batch, crew.as_seen([alone[0]]), options)] = [alone[0]]
        while not suspects and alone is None and len(at_work) < crew.size * _BATCHES_PER_JOB:
            batch = list(islice(paths, _BATCH_FILES))
            if not batch:
                break
            at_work[crew.submit(judge_batch, crew.as_seen(batch), options)] = batch
        if not at_work:
            return
        for future in wait(at_work, return_when=FIRST_COMPLETED).done:
            batch = at_work.pop(future)
            error = future.exception()
            if error is None:
                yield from future.result()
            elif isinstance(error, ImportError):
                raise MissingCapabilityError(
                    f"A worker cannot import this program ({error}); install gltf-iri {__version__} there."
                ) from error
            elif not crew.is_death(error):
                raise error
            elif alone is None:
                suspects.extend((path, 0) for path in batch)
            elif alone[1] + 1 < _DEATHS_ALLOWED:
                suspects.append((alone[0], alone[1] + 1))
            else:
                yield _died(alone[0])
        if not at_work:
            alone = None


def judge_batch(named: list[tuple[str, str]], options: Options) -> list[FileResult]:
    """Judge each (path, name); this is what runs in a worker."""
    return [_judged(path, name, options) for path, name in named]


def _judged(path: str, name: str, options: Options) -> FileResult:
    try:
        report = validate(path, uri=name, options=options)
    except (GltfIriError, OSError) as error:
        return _failed(name, "IO_ERROR", str(error).rstrip("."))
    except MemoryError:
        return _failed(name, "IO_ERROR", "the machine has too little memory for it")
    return FileResult(name, _line(report))


def _died(name: str) -> FileResult:
    return _failed(name, "IRI_WORKER_DIED", "the process that checked it ended without a word")


def _failed(name: str, code: str, reason: str) -> FileResult:
    report = Report(name, None, (issue(code, "", reason=reason),))
    return FileResult(name, _line(report), f"{name}: {reason}.")


def _line(report: Report) -> str:
    # ASCII: a lone surrogate in a name must not break the stream that it is written to.
    return json.dumps(report.to_json(), allow_nan=False)
