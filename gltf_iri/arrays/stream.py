"""Colours of more films than memory holds: from a mapped .npy file to another, block by block."""

from __future__ import annotations

import os
import shutil
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.arrays.film_rows import ROWS_AT_ONCE
from gltf_iri.errors import UsageError
from gltf_iri.whole_files import write_or_refuse

__all__ = ["THREADS", "check_out", "stream_colours", "stream_steps"]

Rows = NDArray[np.floating[Any]]
Float64 = NDArray[np.float64]

# Numpy and compiled look-ups let go of Python's lock; more threads would each want memory of their own.
THREADS: Final = 2

_CHANNELS: Final = 3


def check_out(out: Path, source: Path) -> None:
    """Raise UsageError where no colours can be written to `out`, before anything is computed."""
    if out.suffix.lower() != ".npy":
        raise UsageError(f"Colours are written to a .npy file; '{out.name}' is none.")
    if not out.parent.is_dir():
        raise UsageError(f"There is no folder '{out.parent}' to write '{out.name}' into; make it first.")
    if out.is_dir():
        raise UsageError(f"'{out}' is a folder; name a file to write.")
    if out.exists() and out.samefile(source):
        raise UsageError(f"'{out}' is the file that the films are read from; name another one.")
    if not os.access(out.parent, os.W_OK):
        raise UsageError(f"'{out}' cannot be written: choose a file in a folder that you may write to.")


def stream_steps(rows: Rows, rows_at_once: int = ROWS_AT_ONCE) -> int:
    """Return how often `stream_colours` advances."""
    return -(-len(rows) // rows_at_once)


def stream_colours(
    rows: Rows,
    out: Path,
    colours: Callable[[Float64], Float64],
    *,
    threads: int = THREADS,
    rows_at_once: int = ROWS_AT_ONCE,
    advance: Callable[[], None] = lambda: None,
) -> None:
    """Write `colours` of all `rows` (n, k) to the .npy file `out`, (n, 3), whole or not at all.

    colours : maps a block (m, k) of float64 to its colours (m, 3); called by several threads at a time.
    rows : stay mapped; only blocks of them are in memory, `threads` at a time. `out` has their precision.

    Raises UsageError where the disk has no room or `out` cannot be written, and what `colours` raises.
    """
    dtype = rows.dtype.newbyteorder("=")
    needed = _CHANNELS * len(rows) * dtype.itemsize
    free = shutil.disk_usage(out.parent).free
    if needed > free:
        raise UsageError(f"'{out}' takes {needed:,} bytes, and its disk has {free:,} left.")

    def write(unfinished: Path) -> None:
        filled = np.lib.format.open_memmap(unfinished, mode="w+", dtype=dtype, shape=(len(rows), _CHANNELS))
        _take_space(unfinished)

        def fill(start: int) -> None:
            block = slice(start, start + rows_at_once)
            filled[block] = colours(np.asarray(rows[block], dtype=np.float64))

        # Not flushed: the system writes when it likes, and would keep the caller waiting for seconds.
        _in_threads(fill, range(0, len(rows), rows_at_once), threads, advance)

    write_or_refuse({out: write})


def _take_space(path: Path) -> None:
    """Have the disk keep room for all of a mapped file: a page without room would end the process."""
    if hasattr(os, "posix_fallocate"):
        with path.open("r+b") as file:
            os.posix_fallocate(file.fileno(), 0, path.stat().st_size)


def _in_threads(
    work: Callable[[int], None], starts: range, threads: int, advance: Callable[[], None]
) -> None:
    """Do `work` for all `starts`; few wait at a time, so that an error or Ctrl-C ends it within a block."""
    running: deque[Future[None]] = deque()
    with ThreadPoolExecutor(threads) as pool:
        try:
            for start in starts:
                if len(running) == 2 * threads:
                    running.popleft().result()
                    advance()
                running.append(pool.submit(work, start))
            while running:
                running.popleft().result()
                advance()
        finally:
            for each in running:
                each.cancel()
