"""Blocks of a picture's rows over processes; what comes out does not depend on how many there are."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from multiprocessing.context import SpawnContext
from typing import Final

from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.interrupts import interrupts_held
from gltf_iri.reference.paint import Job, Painter, Tile

__all__ = ["count_tiles", "paint_tiles", "tile_rows"]

# Large enough that numpy does the work, small enough for a progress bar that moves.
_PIXELS_A_TILE: Final = 4096

# Far more than handing over a finished tile takes.
_HAND_OVER_S: Final = 1.0

# What this process paints and with what; a worker makes its painter when its first tile comes.
_job: Job | None = None
_painter: Painter | None = None
_is_painting = False


def count_tiles(size: tuple[int, int]) -> int:
    """Return how many tiles a picture of this width and height is painted in."""
    return len(tile_rows(size))


def tile_rows(size: tuple[int, int]) -> list[tuple[int, int]]:
    """Return the first row of each tile and the one past its last, from the top."""
    width, height = size
    step = max(1, _PIXELS_A_TILE // max(width, 1))
    return [(first, min(first + step, height)) for first in range(0, height, step)]


def paint_tiles(job: Job, processes: int | None) -> Iterator[tuple[int, Tile]]:
    """Yield (index, tile) of every tile, in the order in which they are done.

    processes : how many; None for one a processor. One process, or one tile, needs no other than this one.

    Raises UsageError for fewer than one process, what a painter raises, and MissingCapabilityError where a
    process dies. With more than one, a script needs the usual ``if __name__ == "__main__":`` around its call.
    """
    if processes is not None and processes < 1:
        raise UsageError(f"{processes} processes paint nothing; ask for at least one.")
    tiles = list(enumerate(tile_rows(job.size)))
    workers = min(processes or os.cpu_count() or 1, len(tiles))
    if workers <= 1:
        painter = Painter(job)
        for index, rows in tiles:
            yield index, painter.paint(index, rows)
        return
    # A fresh interpreter each: a fork would copy OpenGL's threads and locks in whatever state they are.
    context = multiprocessing.get_context("spawn")
    _check_that_processes_start(context)
    others = set(multiprocessing.active_children())
    with ProcessPoolExecutor(workers, context, initializer=_receive, initargs=(job,)) as pool:
        try:
            with interrupts_held():
                pending = {pool.submit(_paint, index, rows): index for index, rows in tiles}
            for done in as_completed(pending):
                yield pending[done], done.result()
        except BrokenProcessPool as error:
            raise MissingCapabilityError(
                f"One of {workers} processes died, most likely for want of memory; ask for fewer of them."
            ) from error
        except BaseException:
            # Whoever stops waits for no tile: one may take minutes.
            for process in set(multiprocessing.active_children()) - others:
                process.terminate()
            raise
        finally:
            pool.shutdown(wait=True, cancel_futures=True)


def _check_that_processes_start(context: SpawnContext) -> None:
    """Start one without a job: handing a large one to a process that ends early would block for ever."""
    try:
        with ProcessPoolExecutor(1, context) as pool:
            with interrupts_held():
                started = pool.submit(os.getpid)
            started.result()
    except OSError as error:
        raise MissingCapabilityError(
            f"This machine starts no processes that share memory ({error.strerror}); ask for one process."
        ) from error
    except BrokenProcessPool as error:
        raise UsageError(
            'A script that paints with several processes calls this under `if __name__ == "__main__":`, for '
            "each of them reads it again; or ask for one process."
        ) from error


def _receive(job: Job) -> None:
    global _job
    _job = job
    if sys.platform != "win32":  # where a process that is ended cannot have a say
        signal.signal(signal.SIGTERM, _leave)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """End this process when the one that started it is gone: a killed one leaves it waiting for ever."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


def _leave(number: int, frame: object) -> None:
    """End this worker, but not while it hands a tile over: the reader would wait for the rest for ever."""
    if _is_painting:
        os._exit(1)
    signal.setitimer(signal.ITIMER_REAL, _HAND_OVER_S)  # SIGALRM ends it


def _paint(index: int, rows: tuple[int, int]) -> Tile:
    global _painter, _is_painting
    if _job is None:
        raise UsageError("Tiles are painted by `paint_tiles` only.")
    _is_painting = True
    try:
        if _painter is None:
            _painter = Painter(_job)
        return _painter.paint(index, rows)
    finally:
        _is_painting = False
