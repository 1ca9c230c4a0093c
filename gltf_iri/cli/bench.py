"""`gltf-iri bench`: time and error of every method."""

from __future__ import annotations

import click

from gltf_iri.cli.common import json_option, print_json, print_table, progress

__all__ = ["command"]

_WORKLOADS = ("films",)


@click.command(name="bench")
@click.argument("names", metavar="[NAME]...", nargs=-1, type=click.Choice(_WORKLOADS))
@json_option
def command(names: tuple[str, ...], as_json: bool) -> None:
    """Measure the workloads called NAME; without a name, all of them.

    films: 1,200 random dielectric films, each method against the converged spectral truth under D65.
    """
    from gltf_iri.bench.films import CONTENDERS, measure_films

    # "films" is the only workload so far: naming it once, twice or not at all asks for the same.
    rows = []
    with progress("films", len(CONTENDERS)) as advance:
        for row in measure_films():
            rows.append(row)
            advance()
    if as_json:
        print_json({"white": "D65", "rows": [row.to_json() for row in rows]})
        return
    print_table(
        ("workload", "method", "backend", "ns/eval", "max abs", "ΔE mean", "ΔE p95", "ΔE max"),
        [
            (
                row.workload,
                row.method,
                row.backend,
                f"{row.ns_per_eval:,.0f}",
                f"{row.max_abs:.2g}",
                f"{row.delta_e_mean:.3f}",
                f"{row.delta_e_p95:.3f}",
                f"{row.delta_e_max:.2f}",
            )
            for row in rows
        ],
        title="Against spectral truth, D65 white, CIEDE2000",
    )
