"""`gltf-iri bench validator`: what is measured, and how it is printed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from gltf_iri.cli.bench_tables import figure
from gltf_iri.cli.common import note, print_table, progress

if TYPE_CHECKING:
    from gltf_iri.bench.validator import ManyRow, ProcessRow

__all__ = ["measure_validator"]

_JOBS = (1, 2)


def measure_validator(rounds: int | None) -> tuple[list[Any], Callable[[], None]]:
    """Return the rows of whole processes and of many files, and what prints them."""
    from gltf_iri.bench.validator import VALIDATOR_ROUNDS, measure_many, measure_processes

    turns = rounds or VALIDATOR_ROUNDS
    with progress("validator", 2 * turns + len(_JOBS)) as advance:
        rows, reason = measure_processes(turns, advance)
        many = []
        for jobs in _JOBS:
            many.append(measure_many(jobs))
            advance()
    if reason:
        note(f"The Khronos validator is left out: {reason}")
    return [*rows, *many], lambda: _print(rows, many)


def _print(rows: Sequence[ProcessRow], many: Sequence[ManyRow]) -> None:
    cells = [
        (
            row.file,
            f"{row.size_bytes:,}",
            f"{row.ms:.0f}",
            figure(row.khronos_ms, ".0f"),
            figure(row.ratio, ".2f"),
        )
        for row in rows
    ]
    print_table(("file", "bytes", "ms", "Khronos ms", "ratio"), cells, title="Whole processes")
    speeds = [(f"{row.files:,}", row.jobs, f"{row.files_per_s:,.0f}") for row in many]
    print_table(("small files", "jobs", "a second"), speeds)
