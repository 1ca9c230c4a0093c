"""Writes the test vectors: `python -m gltf_iri.conformance [FOLDER] [--rows N] [--processes N]`."""

from __future__ import annotations

import argparse
import multiprocessing
import sys
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path

from gltf_iri.conformance.rows import Drawn
from gltf_iri.conformance.vectors import ROWS, VECTORS, drawn_line, file_text
from gltf_iri.errors import GltfIriError
from gltf_iri.whole_files import write_or_refuse

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Draw all rows, write both files, say how many rows were drawn again; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m gltf_iri.conformance", description=__doc__)
    parser.add_argument("folder", nargs="?", type=Path, default=Path("spec/vectors"))
    parser.add_argument("--rows", type=int, default=ROWS, help="only so many, from the first on")
    parser.add_argument("--processes", type=int, default=2, help="rows are drawn apart: any number will do")
    given = parser.parse_args(arguments)
    if given.rows < 1 or given.processes < 1:
        parser.error("rows and processes want a number of at least 1.")
    contents: dict[Path, bytes] = {}
    try:
        for name in VECTORS:
            drawn = _drawn(name, given.rows, given.processes)
            contents[given.folder / name] = file_text(name, [row.line for row in drawn]).encode()
            unsettled, tied = sum(row.unsettled for row in drawn), sum(row.tied for row in drawn)
            sys.stdout.write(f"{name}: {len(drawn)} rows; drawn again: {unsettled} unsettled, {tied} tied.\n")
            sys.stdout.flush()
        write_or_refuse(dict(contents), given.folder)
    except GltfIriError as error:
        sys.stderr.write(f"{error}\n")
        return 2
    except KeyboardInterrupt:
        sys.stderr.write("Interrupted; nothing is written.\n")
        return 130
    return 0


def _drawn(name: str, rows: int, processes: int) -> list[Drawn]:
    # Spawned: what this process has started (threads of compiled loops) does not survive a fork.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(processes, context) as pool:
        return list(pool.map(partial(drawn_line, name), range(rows), chunksize=4))


if __name__ == "__main__":
    sys.exit(main())
