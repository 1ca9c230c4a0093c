"""Times that compare: every contestant once a round, the median of all rounds, on one thread of one core."""

from __future__ import annotations

import math
import os
import statistics
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Final

__all__ = ["interleaved_ns", "one_thread"]

# Shorter runs are repeated within a round, for about as long as the slower ones take: what the one before has
# left in the caches then weighs nothing, and nor does the clock.
_SHORTEST_NS: Final = 20_000_000

# What numba, OpenMP, and the BLAS libraries read when they are first loaded.
_THREAD_COUNTS: Final = (
    "OMP_NUM_THREADS",
    "OPENBLAS_NUM_THREADS",
    "MKL_NUM_THREADS",
    "NUMBA_NUM_THREADS",
)


def interleaved_ns(
    runs: Sequence[Callable[[], object]], rounds: int, after_round: Callable[[], None] = lambda: None
) -> list[float]:
    """Return the median time of each run in nanoseconds.

    Every round calls each in turn, so that what slows the machine down for a while slows all of them. Each
    has been called before, which compiled what is compiled at the first call.
    """
    repeats = [1] * len(runs)
    times: list[list[float]] = [[] for _ in runs]
    for k_round in range(rounds):
        for k, run in enumerate(runs):
            elapsed = _elapsed_ns(run, repeats[k])
            if k_round == 0 and elapsed < _SHORTEST_NS:
                repeats[k] = math.ceil(_SHORTEST_NS / max(1, elapsed))
                elapsed = _elapsed_ns(run, repeats[k])
            times[k].append(elapsed)
        after_round()
    return [statistics.median(each) for each in times]


def _elapsed_ns(run: Callable[[], object], repeats: int) -> float:
    """Return the median of `repeats` calls: those that the system interrupted then weigh nothing."""
    times = []
    for _ in range(repeats):
        start = time.perf_counter_ns()
        run()
        times.append(time.perf_counter_ns() - start)
    return statistics.median(times)


@contextmanager
def one_thread() -> Iterator[bool]:
    """Keep the block to one thread, and to one core where the system can; yields whether it can.

    Libraries that are loaded inside the block start one thread. Those loaded before share the one core.
    """
    before = {name: os.environ.get(name) for name in _THREAD_COUNTS}
    os.environ.update(dict.fromkeys(_THREAD_COUNTS, "1"))
    torch = sys.modules.get("torch")
    torch_threads = torch.get_num_threads() if torch is not None else 0
    if torch is not None:
        torch.set_num_threads(1)
    cores: set[int] = set()
    if sys.platform == "linux":
        cores = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {max(cores)})
    try:
        yield bool(cores)
    finally:
        if sys.platform == "linux":
            os.sched_setaffinity(0, cores)
        if torch is not None:
            torch.set_num_threads(torch_threads)
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value
