"""`gltf-iri bench layers`: Tables 1 and 2 of Fourneau et al. 2024, measured here beside what they print.

And `layers-agreement`: GLSL's colours of layers against Python's.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from gltf_iri.cli.bench_tables import figure
from gltf_iri.cli.common import note, print_table, progress
from gltf_iri.errors import MissingCapabilityError

if TYPE_CHECKING:
    from gltf_iri.bench.layers_agreement import AgreementRow
    from gltf_iri.bench.layers_rows import LayerRow

__all__ = ["measure_layers", "measure_layers_agreement"]


def measure_layers(rounds: int | None) -> tuple[list[LayerRow], Callable[[], None]]:
    """Return the rows of both tables, and what prints them; without OpenGL its rows are left out."""
    from gltf_iri.bench.timing import one_thread

    with one_thread():
        # Imported here: what they load reads the number of threads when it is loaded.
        from gltf_iri.bench.layers_table1 import ALPHAS, PERIODS_NM, TABLE1_ROUNDS, measure_table1
        from gltf_iri.bench.layers_table2 import CONFIGURATIONS, TABLE2_ROUNDS, measure_table2
        from gltf_iri.rendering.context import create_context

        context: Any = None
        try:
            context = create_context()
        except MissingCapabilityError as error:
            note(f"OpenGL's rows are left out: {error}")
        try:
            with progress("table 1", len(PERIODS_NM) * len(ALPHAS)) as advance:
                first = measure_table1(context, rounds or TABLE1_ROUNDS, advance)
        finally:
            if context is not None:
                context.release()
        with progress("table 2", len(CONFIGURATIONS)) as advance:
            second = measure_table2(rounds=rounds or TABLE2_ROUNDS, after_configuration=advance)

    def tables() -> None:
        _print_first(first)
        _print_second(second)

    return [*first, *second], tables


def measure_layers_agreement() -> tuple[list[AgreementRow], Callable[[], None]]:
    """Return how far GLSL's colours of layers are from Python's, and what prints it."""
    from gltf_iri.bench.layers_agreement import agreement_steps, measure_agreement
    from gltf_iri.rendering.context import create_context

    context = create_context()
    try:
        with progress("layers-agreement", agreement_steps()) as advance:
            rows = measure_agreement(context, after_chunk=advance)
    finally:
        context.release()
    return rows, lambda: _print_agreement(rows)


def _print_agreement(rows: Sequence[AgreementRow]) -> None:
    cells = [
        (
            f"{row.count:,} of {row.layers}",
            row.colour,
            f"{row.p99:.1e}",
            f"{row.p9999:.1e}",
            f"{row.max_abs:.1e}",
            f"{row.beyond:,}",
            f"{row.beyond_steps:,}",
        )
        for row in rows
    ]
    columns = ("layers", "colour", "p99", "p99.99", "max", f"beyond {rows[0].tolerance:g}", "not by steps")
    print_table(columns, cells, title=f"Colours by {rows[0].backend} against float64, the same rules")


def _print_first(rows: Sequence[LayerRow]) -> None:
    from gltf_iri.bench.layers_table1 import ALPHAS, PERIODS_NM, table1_name

    columns = ("Λ, nm", "backend", "method", *(f"× at α {a:g}" for a in ALPHAS), "printed ×", "ns")
    by_place = {(row.workload, row.backend, row.label): row for row in rows}
    cells = []
    for period_nm in PERIODS_NM:
        names = [table1_name(period_nm, alpha) for alpha in ALPHAS]
        for row in (each for each in rows if each.workload == names[0]):
            beside = [by_place[name, row.backend, row.label] for name in names]
            cells.append(
                (
                    f"{period_nm:g}",
                    row.backend,
                    row.label,
                    *(figure(each.speedup, ",.1f") for each in beside),
                    figure(row.printed.get("speedup"), ".1f"),
                    f"{row.ns_per_eval:,.0f}",
                    figure(row.delta_e_mean, ".2f"),
                    figure(row.delta_e_p95, ".2f"),
                )
            )
    title = f"One rough layer: times faster than {rows[0].label}, D65, CIEDE2000; ns and ΔE at the first α"
    print_table((*columns, "ΔE mean", "ΔE p95"), cells, title=title)


def _print_second(rows: Sequence[LayerRow]) -> None:
    columns = ("configuration", "method", "ns a sample", "SMAPE", "Eff.", "printed s", "SMAPE", "Eff.")
    cells = [
        (
            row.workload,
            row.label,
            f"{row.ns_per_eval:,.0f}",
            figure(row.smape, ".3f"),
            figure(row.efficiency, ",.0f"),
            figure(row.printed.get("time_s"), "g"),
            figure(row.printed.get("smape"), ".3f"),
            figure(row.printed.get("efficiency"), ",.0f"),
            row.remark,
        )
        for row in rows
    ]
    title = "A sphere under layers against the simulation of all reflections; numpy, one thread"
    print_table((*columns, ""), cells, title=title)
