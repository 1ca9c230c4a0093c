"""Pareto fronts of time and error, and by how much a row is beaten by those on the front."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

from gltf_iri.bench.accuracy_row import AccuracyRow

__all__ = [
    "BEATEN",
    "LEAST",
    "MOST",
    "OURS",
    "Standing",
    "by_set_and_device",
    "error_of",
    "front",
    "is_ours",
    "standing",
    "standings",
]

# The errors between which fronts are drawn: clearly seen, and far below what anybody sees (CIEDE2000, p95).
MOST: Final = 3.0
LEAST: Final = 1e-3

# How many times slower, or further off, a row is that counts as beaten.
BEATEN: Final = 3.0

# What the front is meant to consist of, tables and the truths beside them; all others are judged.
# `incoherent` is the constant term of fourier's series.
OURS: Final = frozenset({"fourier", "incoherent", "bloch", "layers-bands"})


@dataclass(frozen=True, slots=True)
class Standing:
    """How a row stands against ours, of the same set and device.

    slower : its time over that of the cheapest of ours that errs no more; below `LEAST` errors count as it.
    further : its error over the least error of ours that takes no longer.
    Each is None where ours has no such row.
    """

    row: AccuracyRow
    slower: float | None
    further: float | None

    @property
    def is_beaten(self) -> bool:
        """True where one of both is at least `BEATEN`."""
        return max(self.slower or 0.0, self.further or 0.0) >= BEATEN

    def to_json(self) -> dict[str, Any]:
        """Return how accuracy.json tells it."""
        names = {"workload": self.row.workload, "backend": self.row.backend, "label": self.row.label}
        factors = {"times_slower": self.slower, "times_the_error": self.further}
        return {**names, **factors, "is_dominated": self.is_beaten}


def error_of(row: AccuracyRow) -> float:
    """Return the p95 of CIEDE2000; infinite where there is none."""
    error = math.nan if row.errors is None else row.errors.delta_e_p95
    return math.inf if math.isnan(error) else error


def is_ours(row: AccuracyRow) -> bool:
    """True for what fronts are meant to consist of: fourier, bloch, tables, and the truth itself."""
    return row.method is None or row.method in OURS or row.is_truth


def front(rows: Sequence[AccuracyRow], least: float = LEAST, most: float = MOST) -> list[AccuracyRow]:
    """Return for every error from `most` down to `least` the cheapest row that errs no more, cheapest first.

    Rows of one set and device; where several cost the same, the one that errs least.
    """
    found: list[AccuracyRow] = []
    allowed = most
    while True:
        able = [row for row in rows if error_of(row) <= allowed]
        if not able:
            return found
        best = min(able, key=lambda row: (row.ns, error_of(row)))
        found.append(best)
        if error_of(best) <= least:
            return found
        # The next must err less.
        allowed = math.nextafter(error_of(best), 0.0)


def by_set_and_device(rows: Sequence[AccuracyRow]) -> dict[tuple[str, str], list[AccuracyRow]]:
    """Return the rows of each set and device, in their order."""
    found: dict[tuple[str, str], list[AccuracyRow]] = {}
    for row in rows:
        found.setdefault((row.workload, row.backend), []).append(row)
    return found


def standing(row: AccuracyRow, rows: Sequence[AccuracyRow]) -> Standing:
    """Return how `row` stands against ours among `rows`, of the same set and device."""
    own = error_of(row)
    able = [each.ns for each in rows if is_ours(each) and error_of(each) <= max(own, LEAST)]
    quick = [error_of(each) for each in rows if is_ours(each) and each.ns <= row.ns]
    further = None
    if quick and math.isfinite(own):
        further = max(own, LEAST) / max(min(quick), LEAST)
    return Standing(row, row.ns / min(able) if able else None, further)


def standings(rows: Sequence[AccuracyRow]) -> list[Standing]:
    """Return the standing of every row that is not ours, within its own set and device."""
    return [
        standing(row, group)
        for group in by_set_and_device(rows).values()
        for row in group
        if not is_ours(row) and row.errors is not None
    ]
