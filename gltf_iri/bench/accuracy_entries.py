"""What is timed for the map of cost and error: methods and tables of one set, on numpy or compiled."""

from __future__ import annotations

import functools
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import Backend, has_numba
from gltf_iri.bench.accuracy_row import AccuracyRow, Errors, errors_of
from gltf_iri.bench.accuracy_tables import Tables
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.bench.timing import interleaved_ns
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import METHODS, method_names, truth_of
from gltf_iri.planning.settings import ACCURACY_SETTINGS, Settings, settings_of, with_defaults
from gltf_iri.planning.way import Way

__all__ = [
    "Entry",
    "Tables",
    "Truth",
    "backends",
    "measured",
    "method_entries",
    "table_entries",
    "true_colours",
]

Float64 = NDArray[np.float64]

# A run is repeated within a round until it has lasted so long (bench/timing.py).
_SHORTEST_S: Final = 0.02
_MOST_ROUNDS: Final = 9
_SLOW_S: Final = 1.0


@dataclass(frozen=True, slots=True)
class Truth:
    """The true colours (n, 3) of a set, by which method, and how long they took when they were evaluated."""

    method: str
    rgb: Float64
    seconds: float


@dataclass(frozen=True, slots=True)
class Entry:
    """One way on one backend, judged and ready to be timed.

    run : computes `count` colours; first_s : what its first timed call took.
    """

    backend: Backend
    label: str
    way: str
    method: str | None
    errors: Errors | None
    run: Callable[[], Any]
    count: int
    first_s: float
    parameters: Settings = field(default_factory=dict)
    filling_ns: float | None = None


def backends() -> tuple[Backend, ...]:
    """Return numpy, and numba where it is installed."""
    return ("numpy", "numba") if has_numba() else ("numpy",)


def true_colours(subject: Film | Mirror) -> Truth:
    """Return the truth of `subject`, evaluated once."""
    name = truth_of("mirror" if isinstance(subject, Mirror) else "film")
    start = time.perf_counter()
    rgb = evaluate(name, subject, white=WHITE, backend="numpy").rgb
    return Truth(name, rgb, time.perf_counter() - start)


def method_entries(subject: Film | Mirror, truth: Truth) -> Iterator[Entry]:
    """Yield every method with all its settings, on every installed backend that it has.

    A truth that took seconds is not asked again.
    """
    for name in method_names(METHODS[truth.method].domain):
        is_slow = name == truth.method and truth.seconds > _SLOW_S
        for backend in () if is_slow else METHODS[name].backends:
            for chosen in settings_of(name, ACCURACY_SETTINGS) if backend in backends() else ():
                values = with_defaults(name, chosen)
                run = functools.partial(
                    evaluate, name, subject, white=WHITE, backend=backend, parameters=values
                )
                errors = errors_of(run().rgb, truth.rgb)  # the first call compiles
                way = Way(name, values).label
                yield Entry(
                    backend, way, way, name, errors, run, len(truth.rgb), _seconds(run), parameters=values
                )


def table_entries(tables: Tables) -> Iterator[Entry]:
    """Yield the look-ups of tables of one size on every backend."""
    for backend in backends():
        errors = tables.errors(tables.colours(backend))
        run = functools.partial(tables.timed, backend)
        yield Entry(
            backend,
            tables.label,
            tables.way,
            None,
            errors,
            run,
            len(run()),
            _seconds(run),
            filling_ns=tables.filling_ns,
        )


def measured(
    workload: str, entries: Sequence[Entry], limit_s: float, rounds: int | None = None
) -> list[AccuracyRow]:
    """Return the rows of `entries`, timed in turn: `rounds` times, else for about `limit_s` seconds."""
    round_s = sum(entry.first_s + _SHORTEST_S for entry in entries)
    count = rounds or min(_MOST_ROUNDS, max(2, int(limit_s / round_s)))
    times_ns = interleaved_ns([entry.run for entry in entries], count)
    return [
        AccuracyRow(
            workload,
            entry.backend,
            entry.label,
            entry.way,
            entry.method,
            time_ns / entry.count,
            entry.errors,
            parameters=entry.parameters,
            filling_ns=entry.filling_ns,
        )
        for entry, time_ns in zip(entries, times_ns, strict=True)
    ]


def _seconds(run: Callable[[], Any]) -> float:
    start = time.perf_counter()
    run()
    return time.perf_counter() - start
