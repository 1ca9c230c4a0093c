"""The map of cost and error in Markdown: the README's table, the fronts, who is not beaten, all rows."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Final

from gltf_iri.bench.accuracy_layers import LAYERS
from gltf_iri.bench.accuracy_row import SHADINGS, AccuracyRow
from gltf_iri.bench.pareto import BEATEN, LEAST, MOST, Standing, by_set_and_device, front, is_ours, standings
from gltf_iri.planning.method import METHODS
from gltf_iri.planning.settings import with_defaults

__all__ = ["BEGIN", "END", "accuracy_block", "accuracy_text"]

BEGIN: Final = "<!-- accuracy -->"
END: Final = "<!-- /accuracy -->"

_DEVICES: Final = ("numpy", "numba", "glsl")

# What stands in the README: the films, mirrors and layers that the methods' descriptors state errors of.
_SHOWN: Final[Mapping[str, str]] = {
    "films": "1,200 dielectric films",
    "mirrors-20": "300 mirrors of 20 cells",
    LAYERS: "4 stacks of two rough layers, and what passes both",
}
_TABLES_SHOWN: Final = (
    *("table: cos_theta 64, RGBA16F", "table: cos_theta 256, RGBA32F"),
    "table: cos_theta 64, thickness_nm 128, RGBA16F",
    *(f"table of {held}: cos_theta 256, RGBA32F" for held in ("colours", "16 bands")),
)


def accuracy_text(rows: Sequence[AccuracyRow], machine: Mapping[str, Any], skipped: Mapping[str, str]) -> str:
    """Return accuracy.md."""
    lines = ["# What accuracy costs in time", "", "Written by `gltf-iri bench accuracy`; do not edit.", ""]
    lines += [f"{_machine(machine)}.", ""]
    lines += [f"Left out: {name}, {reason}." for name, reason in skipped.items()]
    lines += [accuracy_block(rows), "", *_fronts(rows), *_standings(standings(rows))]
    for (workload, backend), group in by_set_and_device(rows).items():
        lines += [f"## {workload}, {backend}", "", *_all(group), ""]
    return "\n".join(lines).rstrip() + "\n"


def accuracy_block(rows: Sequence[AccuracyRow]) -> str:
    """Return the README's table, between its markers: every shipped method with its defaults, and tables."""
    lines = [BEGIN]
    for workload, what in _SHOWN.items():
        of_set = [row for row in rows if row.workload == workload]
        if not of_set:
            continue
        lines += [
            "",
            f"| {what} | ΔE2000 mean | p95 | numpy, ns | compiled, ns | OpenGL, ns |",
            "|---|---|---|---|---|---|",
        ]
        for label in dict.fromkeys(row.label for row in of_set if _is_shown(row)):
            by_device = {row.backend: row for row in of_set if row.label == label}
            first = next(iter(by_device.values()))
            times = [_ns(by_device[d].ns_per_eval) if d in by_device else "–" for d in _DEVICES]
            lines.append(f"| {' | '.join((_shown_name(first), *_errors(first)[1:3], *times))} |")
    return "\n".join([*lines, "", END])


def _is_shown(row: AccuracyRow) -> bool:
    if row.errors is None:
        return False
    if row.method is None:
        return row.label in _TABLES_SHOWN
    return dict(row.parameters) == with_defaults(row.method, {}) or row.is_truth


def _shown_name(row: AccuracyRow) -> str:
    return f"`{row.method}`" if row.method in METHODS else row.label


def _fronts(rows: Sequence[AccuracyRow]) -> Iterator[str]:
    yield f"## The Pareto fronts from ΔE {MOST:g} down to {LEAST:g}"
    yield ""
    yield f"ΔE: the 95th percentile of CIEDE2000. The filling of tables is spread over {SHADINGS:,} shadings."
    yield (
        "A table holds one film at every angle, and with more axes at every thickness or base: several films"
        " of a set have tables, each asked at points of its own."
    )
    yield ""
    yield "| set | device | way | ns | of it filling | ΔE p95 | meant |"
    yield "|---|---|---|---|---|---|---|"
    for (workload, backend), group in by_set_and_device(rows).items():
        for row in front(group):
            meant = "" if is_ours(row) and not row.is_truth else "the truth" if row.is_truth else "**no**"
            filling = _ns(row.ns - row.ns_per_eval) if row.filling_ns else ""
            cells = (workload, backend, row.label, _ns(row.ns), filling, _errors(row)[2], meant)
            yield f"| {' | '.join(cells)} |"
    yield ""


def _standings(found: Sequence[Standing]) -> Iterator[str]:
    yield "## How the others stand against fourier, bloch and tables"
    yield ""
    yield (
        "Slower: than the cheapest that errs no more (errors below "
        f"{LEAST:g} count as it). Further: its error over the least at no more time. "
        f"Dominated: one of both is {BEATEN:g} or more."
    )
    for title, kept in (("Not dominated", False), ("Dominated", True)):
        chosen = [each for each in found if each.is_beaten is kept]
        yield from ("", f"### {title}", "")
        if not chosen:
            yield "None."
            continue
        yield "| set | device | method | ns | ΔE p95 | slower | further |"
        yield "|---|---|---|---|---|---|---|"
        for each in chosen:
            row = each.row
            factors = (_times(each.slower), _times(each.further))
            cells = (row.workload, row.backend, row.label, _ns(row.ns), _errors(row)[2], *factors)
            yield f"| {' | '.join(cells)} |"
    yield ""


def _all(rows: Sequence[AccuracyRow]) -> Iterator[str]:
    yield "| way | ns a colour | ns a pixel | filling, ms | max abs | ΔE mean | ΔE p95 | ΔE max | undefined |"
    yield "|---|---|---|---|---|---|---|---|---|"
    for row in sorted(rows, key=lambda row: row.ns):
        pixel = "" if row.ns_per_pixel is None else _ns(row.ns_per_pixel)
        filling = "" if row.filling_ns is None else f"{row.filling_ns / 1e6:.3g}"
        undefined = str(row.errors.undefined or "") if row.errors else ""
        cells = (row.label, _ns(row.ns_per_eval), pixel, filling, *_errors(row), undefined)
        yield f"| {' | '.join(cells)} |"


def _errors(row: AccuracyRow) -> tuple[str, str, str, str]:
    """Return max abs, and ΔE mean, p95 and max; p95 third."""
    if row.errors is None:
        return "", "", "", ""
    e = row.errors
    return f"{e.max_abs:.2g}", f"{e.delta_e_mean:.2g}", f"{e.delta_e_p95:.2g}", f"{e.delta_e_max:.2g}"


def _machine(machine: Mapping[str, Any]) -> str:
    return ", ".join(f"{name} {value}" for name, value in machine.items() if value is not None)


def _ns(value: float) -> str:
    return f"{value:,.0f}" if value >= 100.0 else f"{value:.3g}"


def _times(value: float | None) -> str:
    return "–" if value is None else f"{value:.3g}×"
