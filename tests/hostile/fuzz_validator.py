"""Gives the validator broken files for as long as it is told to, and looks at every report.

`python tests/hostile/fuzz_validator.py built|bytes|guided MINUTES [FOLDER…] [--seed N] [--keep FOLDER]`

built: documents that hypothesis builds from the property tables. bytes: real assets below the folders with
one of their files broken. guided: bytes that atheris, where it is installed, finds by their coverage, from
the same assets. A traceback, a rule that failed, more than two seconds, a report that does not hold together,
or a process that keeps growing is a finding: its file is kept, and the exit code is 1. Linux only.
"""

from __future__ import annotations

import argparse
import collections
import json
import os
import random
import shutil
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

from soundness import faults
from victims import assets, breakage, resident, ring

from gltf_iri.validation.options import Options
from gltf_iri.validation.validate import validate

MOST_SECONDS = 2.0
HANG_SECONDS = 10
MOST_GROWTH = 300 * 2**20  # bytes
ALL = Options(max_issues=0)
USUAL = Options()


class Search:
    """What was tried, what was found, and how much the process holds."""

    def __init__(self, keep: Path) -> None:
        self.keep = keep
        self.counts: collections.Counter[str] = collections.Counter()
        self.slowest = 0.0
        self.settled = 0

    def trial(self, source: Path | bytes) -> None:
        """Judge one file; keep it where something is wrong with the judgement."""
        started = time.process_time()
        signal.alarm(HANG_SECONDS)
        try:
            report = validate(source, options=ALL if self.counts.total() % 2 else USUAL)
            finding = "; ".join(faults(report, source))
            self.counts["sound" if not report.has_errors else "with errors"] += 1
        except BaseException:  # whatever comes out is what is looked for
            if isinstance(sys.exception(), KeyboardInterrupt):
                raise
            finding = traceback.format_exc(limit=-4)
        finally:
            signal.alarm(0)
        seconds = time.process_time() - started
        self.slowest = max(self.slowest, seconds)
        if not finding and seconds > MOST_SECONDS:
            finding = f"took {seconds:.1f} s"
        if finding:
            self._keep(source, finding)

    def tell(self, way: str) -> int:
        """Print what was found and return the exit code."""
        grown = resident() - self.settled
        self.counts["findings"] += grown > MOST_GROWTH
        told = {"way": way, **self.counts, "slowest_s": round(self.slowest, 3), "grown_mib": grown >> 20}
        print(json.dumps(told), flush=True)  # noqa: T201
        return 1 if self.counts["findings"] else 0

    def _keep(self, source: Path | bytes, finding: str) -> None:
        kept = self.keep / f"{self.counts.total()}"
        kept.mkdir(parents=True, exist_ok=True)
        if isinstance(source, bytes):
            (kept / "found.gltf").write_bytes(source)
        else:
            shutil.copytree(source.parent, kept, dirs_exist_ok=True)
        self.counts["findings"] += 1
        print(f"{kept}: {finding}", flush=True)  # noqa: T201


def built(search: Search, is_time_left: Callable[[], bool], asked: argparse.Namespace) -> None:
    from built import documents
    from hypothesis import HealthCheck, Phase, Verbosity, given, seed, settings

    number = asked.seed
    while is_time_left():
        number += 1

        @seed(number)
        @settings(
            max_examples=400,
            deadline=None,
            database=None,
            phases=[Phase.generate],
            verbosity=Verbosity.quiet,
            suppress_health_check=list(HealthCheck),
        )
        @given(documents())
        def run(data: bytes) -> None:
            search.trial(data)

        run()


def broken(search: Search, is_time_left: Callable[[], bool], asked: argparse.Namespace) -> None:
    chance, files = random.Random(asked.seed), assets(asked.folders)
    while is_time_left():
        with tempfile.TemporaryDirectory() as folder:
            search.trial(breakage(chance.choice(files), Path(folder), chance))


def guided(search: Search, is_time_left: Callable[[], bool], asked: argparse.Namespace) -> None:
    import atheris  # type: ignore[import-not-found]

    with atheris.instrument_imports(include=["gltf_iri"]):
        for name in [name for name in sys.modules if name.startswith("gltf_iri.validation")]:
            del sys.modules[name]
        from gltf_iri.validation import validate as instrumented

        globals()["validate"] = instrumented.validate
    corpus = Path(tempfile.mkdtemp())
    for number, path in enumerate(assets(asked.folders)):
        shutil.copy(path, corpus / f"{number}{path.suffix}")

    def trial(data: bytes) -> None:
        if not is_time_left():
            # Atheris would end the process on the spot, whatever is left to be told.
            os._exit(search.tell(asked.way))
        search.trial(data)

    atheris.Setup([sys.argv[0], str(corpus), "-max_len=20000"], trial)
    atheris.Fuzz()


WAYS: dict[str, Callable[[Search, Callable[[], bool], argparse.Namespace], Any]] = {
    "built": built,
    "bytes": broken,
    "guided": guided,
}


def main() -> int:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("way", choices=list(WAYS))
    parser.add_argument("minutes", type=float)
    parser.add_argument("folders", type=Path, nargs="*")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--keep", type=Path, default=Path("fuzz-findings"))
    asked = parser.parse_args()
    warnings.simplefilter("error")
    signal.signal(signal.SIGALRM, ring)
    search = Search(asked.keep)
    started = time.monotonic()

    def is_time_left() -> bool:
        passed = (time.monotonic() - started) / 60.0
        # Caches settle in the first quarter; what is held beyond that may not grow for good.
        if passed < asked.minutes / 4.0:
            search.settled = max(search.settled, resident())
        return passed < asked.minutes

    WAYS[asked.way](search, is_time_left, asked)
    return search.tell(asked.way)


if __name__ == "__main__":
    sys.exit(main())
