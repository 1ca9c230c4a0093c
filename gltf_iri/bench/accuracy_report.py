"""What `gltf-iri bench accuracy -o FOLDER` writes: figures, tables for people, plots, the map of costs."""

from __future__ import annotations

import csv
import io
import json
import math
import statistics
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from gltf_iri.bench.accuracy_layers import LAYERS
from gltf_iri.bench.accuracy_plot import plot_accuracy
from gltf_iri.bench.accuracy_row import AccuracyRow
from gltf_iri.bench.accuracy_sets import ACCURACY_SETS
from gltf_iri.bench.accuracy_text import accuracy_text
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.bench.pareto import by_set_and_device, front, standings
from gltf_iri.planning.method import parameters_text
from gltf_iri.planning.way import NO_FILM

__all__ = ["accuracy_files", "accuracy_json", "costs_json"]

_COLUMNS: Final = (
    *("workload", "backend", "label", "way", "method", "parameters", "ns_per_eval", "ns_per_pixel"),
    *("filling_ns", "ns_with_filling", "max_abs", "delta_e_mean", "delta_e_p95", "delta_e_max", "undefined"),
)


def accuracy_files(
    folder: Path, rows: Sequence[AccuracyRow], machine: Mapping[str, Any], skipped: Mapping[str, str]
) -> dict[Path, bytes]:
    """Return every file below `folder` → content: JSON, CSV, Markdown, costs.json, and a PNG a set."""
    plots = {
        folder / f"{name}.png": plot_accuracy(
            name, [row for row in rows if row.workload == name], machine.get("gl_renderer")
        )
        for name in dict.fromkeys(row.workload for row in rows)
    }
    return {
        folder / "accuracy.json": _encoded(accuracy_json(rows, machine, skipped)),
        folder / "accuracy.csv": _csv(rows),
        folder / "accuracy.md": accuracy_text(rows, machine, skipped).encode(),
        folder / "costs.json": _encoded(costs_json(rows, machine)),
        **plots,
    }


def accuracy_json(
    rows: Sequence[AccuracyRow], machine: Mapping[str, Any], skipped: Mapping[str, str]
) -> dict[str, Any]:
    """Return all that was measured, with the fronts and how all others stand against them."""
    fronts: dict[str, dict[str, list[str]]] = {}
    for (workload, backend), group in by_set_and_device(rows).items():
        fronts.setdefault(workload, {})[backend] = [row.label for row in front(group)]
    return {
        "white": WHITE,
        "machine": dict(machine),
        "skipped": dict(skipped),
        "fronts": fronts,
        "standings": [each.to_json() for each in standings(rows)],
        "rows": [row.to_json() for row in rows],
    }


def costs_json(rows: Sequence[AccuracyRow], machine: Mapping[str, Any]) -> dict[str, Any]:
    """Return the map of costs that planning/costs.py reads: of the fixed sets, by device, set and way.

    Tables of as many axes cost about the same whatever their size: the median over the sizes.
    """
    times: dict[tuple[str, str, str], list[float]] = {}
    for row in rows:
        if row.workload in ACCURACY_SETS or row.workload == LAYERS:
            times.setdefault((row.backend, row.workload, row.way), []).append(row.ns_per_eval)
    ns: dict[str, dict[str, dict[str, float]]] = {}
    for (backend, workload, way), each in times.items():
        without = {} if workload == LAYERS else {NO_FILM: 0.0}
        of_set = ns.setdefault(backend, {}).setdefault(workload, without)
        of_set[way] = float(f"{statistics.median(each):.4g}")
    return {"machine": dict(machine), "ns": ns}


def _csv(rows: Sequence[AccuracyRow]) -> bytes:
    stream = io.StringIO(newline="")
    writer = csv.DictWriter(stream, _COLUMNS, lineterminator="\n")
    writer.writeheader()
    for row in rows:
        writer.writerow({**_plain(row.to_json()), "parameters": parameters_text(row.parameters)})
    return stream.getvalue().encode()


def _encoded(value: Mapping[str, Any]) -> bytes:
    return (json.dumps(_plain(value), indent=1, ensure_ascii=False, allow_nan=False) + "\n").encode()


def _plain(value: Any) -> Any:
    """Return `value` with null in place of what JSON has no number for."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    return value
