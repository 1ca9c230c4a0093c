"""`gltf-iri bench accuracy`: the map of cost and error, printed and written."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gltf_iri.cli.bench_tables import figure
from gltf_iri.cli.common import print_table, progress
from gltf_iri.errors import MissingCapabilityError, UsageError

if TYPE_CHECKING:
    from gltf_iri.bench.accuracy_row import AccuracyRow

__all__ = ["check_folder", "measure_accuracy", "print_accuracy", "write_accuracy"]

LeaveOut = Callable[[str, str], None]


def check_folder(folder: Path) -> None:
    """Refuse a place where no folder of results can be before minutes are spent on them."""
    existing = folder
    while not existing.exists() and existing != existing.parent:
        existing = existing.parent
    if not existing.is_dir():
        raise UsageError(f"'{existing}' is not a folder, so '{folder}' cannot be written into.")
    if not os.access(existing, os.W_OK | os.X_OK):
        raise UsageError(f"'{existing}' cannot be written to: name another folder.")


def measure_accuracy(
    files: Sequence[Path], leave_out: LeaveOut, rounds: int | None
) -> tuple[list[AccuracyRow], dict[str, Any]]:
    """Measure every set and return its rows, and the machine that they were measured on.

    rounds : of every timing, in place of as many as some seconds allow.
    """
    from gltf_iri.bench.timing import one_thread

    with one_thread() as is_pinned:
        # Imported here: what they load reads the number of threads when it is loaded.
        from gltf_iri.bench.accuracy import measure_set, subjects
        from gltf_iri.bench.machine import machine
        from gltf_iri.rendering.context import create_context, renderer_name

        about = {**machine(), "threads": 1, "is_pinned_to_one_core": is_pinned, "gl_renderer": None}
        context = None
        try:
            context = create_context()
            about["gl_renderer"] = renderer_name(context)
        except MissingCapabilityError as error:
            leave_out("glsl", str(error))
        sets = subjects(files)
        rows: list[AccuracyRow] = []
        with progress("accuracy", len(sets)) as advance:
            for name, build in sets.items():
                try:
                    rows += measure_set(name, build(), context, rounds)
                except UsageError as error:
                    if name.startswith("file-"):
                        leave_out(name, str(error))
                    else:
                        raise
                advance()
    return rows, about


def print_accuracy(rows: Sequence[AccuracyRow]) -> None:
    """Print every row, the cheapest of a set and device first."""
    columns = ("set", "device", "way", "ns", "filling, ms", "max abs", "ΔE mean", "ΔE p95", "ΔE max")
    cells = []
    for row in sorted(rows, key=lambda row: (row.workload, row.backend, row.ns)):
        filling = None if row.filling_ns is None else row.filling_ns / 1e6
        flat = row.to_json()
        cells.append(
            (
                row.workload,
                row.backend,
                row.label,
                f"{row.ns_per_eval:,.4g}",
                figure(filling, ".3g"),
                figure(flat["max_abs"], ".2g"),
                figure(flat["delta_e_mean"], ".2g"),
                figure(flat["delta_e_p95"], ".2g"),
                figure(flat["delta_e_max"], ".2g"),
            )
        )
    print_table(columns, cells, title="What accuracy costs: ns a colour on one core, D65 white, CIEDE2000")


def write_accuracy(
    folder: Path, rows: Sequence[AccuracyRow], machine: dict[str, Any], skipped: dict[str, str]
) -> None:
    """Write the report into `folder`; UsageError where it cannot be."""
    from gltf_iri.bench.accuracy_report import accuracy_files
    from gltf_iri.whole_files import write_or_refuse

    write_or_refuse(accuracy_files(folder, rows, machine, skipped), folder)
