"""`gltf-iri bench budgets`: whether budgets are kept, and by the cheapest way."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from gltf_iri.cli.common import note, print_table, progress

if TYPE_CHECKING:
    from gltf_iri.bench.budgets import BudgetRow

__all__ = ["measure_ways"]


def measure_ways(files: Sequence[Path], count: int | None) -> tuple[list[BudgetRow], Callable[[], None]]:
    """Return the rows of so many random materials, or of those of `files`, and what prints their sums."""
    from gltf_iri.bench import budgets

    if files:
        reaches = [each for file in files for each in budgets.reaches_of_file(file)]
    else:
        reaches = list(budgets.random_reaches(count or budgets.MATERIALS))
    with progress("budgets", len(reaches)) as advance:
        rows = list(budgets.measure_budgets(reaches, after_material=advance))
    return rows, lambda: _print(rows)


def _print(rows: Sequence[BudgetRow]) -> None:
    from gltf_iri.bench.budgets import summary

    cells = [
        (f"{told.budget:g}", told.materials, f"{told.kept:.1%}", f"{told.cheapest:.1%}", f"{told.worst:.2f}")
        for told in summary(rows)
    ]
    columns = ("budget ΔE", "materials", "kept", "cheapest", "worst error / budget")
    print_table(
        columns, cells, title="What budgets choose, measured at other points, D65 white, CIEDE2000 p95"
    )
    for row in rows:
        if not row.holds:
            note(f"{row.material}: {row.way} errs by ΔE {row.measured:.3g}, not within {row.budget:g}.")
