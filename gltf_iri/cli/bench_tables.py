"""How `gltf-iri bench` prints what was measured: one function for each kind of table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from gltf_iri.cli.common import print_table

if TYPE_CHECKING:
    from gltf_iri.bench.colour_rows import ColourRow
    from gltf_iri.bench.optics import OpticsRow

__all__ = ["figure", "print_colours", "print_optics"]


def print_colours(rows: Sequence[ColourRow], title: str) -> None:
    """Print rows that end in a colour: times, and errors against spectral truth."""
    figures = ("ns/eval", "ratio", "max abs", "ΔE mean", "ΔE p95", "ΔE max")
    cells = [
        (
            row.workload,
            row.label,
            row.backend,
            f"{row.ns_per_eval:,.0f}",
            figure(row.ratio, ".2f"),
            figure(row.max_abs, ".2g"),
            figure(row.delta_e_mean, ".3f"),
            figure(row.delta_e_p95, ".3f"),
            figure(row.delta_e_max, ".2f"),
        )
        for row in rows
    ]
    reference = " or ".join(dict.fromkeys(row.ratio_to for row in rows if row.ratio_to))
    whole = f"{title}, D65 white, CIEDE2000" + (
        f"; ratio of times to {reference} by the same backend" if reference else ""
    )
    print_table(("workload", "method", "backend", *figures), cells, title=whole)


def figure(value: float | None, form: str) -> str:
    """Return `value` in the format `form`; a dash where there is none."""
    return "-" if value is None else format(value, form)


def print_optics(rows: Sequence[OpticsRow], machine: Mapping[str, Any]) -> None:
    """Print rows of reflectances, each with its standing among the contestants."""
    columns = (
        "workload",
        "method",
        "backend",
        "version",
        "ns/eval",
        "max abs",
        "evals",
        "× peer",
        "target",
        "",
    )
    cells = [
        (
            row.workload,
            row.method,
            row.backend,
            row.version,
            figure(row.ns_per_eval, ",.4g"),
            figure(row.max_abs, ".1e"),
            f"{row.evaluations:,}",
            figure(row.speedup, ",.3g"),
            figure(row.target, ",.0f"),
            row.remark or _standing(row),
        )
        for row in rows
    ]
    vectors = {True: "with AVX-512", False: "without AVX-512", None: "AVX-512 unknown"}[machine["avx512"]]
    title = f"Reflectances against 50 digits, one thread; {machine['processor']}, {vectors}"
    print_table(columns, cells, title=title)


def _standing(row: OpticsRow) -> str:
    if not row.is_correct:
        return "wrong"
    return "the fastest correct peer" if row.is_fastest_correct_peer else ""
