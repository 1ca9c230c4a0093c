"""A picture of `bench optics`: time of an evaluation against error, a panel a workload."""

from __future__ import annotations

import io
from collections.abc import Sequence
from itertools import groupby
from typing import Any, Final

from gltf_iri.bench.optics import WRONG, OpticsRow

__all__ = ["plot_optics"]

_PANEL_IN: Final = (4.6, 3.8)
_COLUMNS: Final = 3
_COLOURS: Final = {"numpy": "tab:blue", "numba": "tab:red", "peer": "tab:gray"}

# An answer right to the last bit has no place on a logarithmic axis; a tenth of a rounding has.
_LEAST_ERROR: Final = 1e-17


def plot_optics(rows: Sequence[OpticsRow]) -> bytes:
    """Return a PNG of all rows that have figures; those whose answers hold NaN stand at the right edge."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    panels = [(name, list(group)) for name, group in groupby(rows, key=lambda row: row.workload)]
    columns = min(_COLUMNS, len(panels))
    lines = -(-len(panels) // columns)
    figure = Figure(figsize=(_PANEL_IN[0] * columns, _PANEL_IN[1] * lines), dpi=110, layout="constrained")
    FigureCanvasAgg(figure)
    grid = figure.subplots(lines, columns, squeeze=False)
    for axes in grid.flat[len(panels) :]:
        axes.set_axis_off()
    for axes, (name, group) in zip(grid.flat, panels, strict=False):
        _panel(axes, name, group)
    stream = io.BytesIO()
    figure.savefig(stream, format="png")
    return stream.getvalue()


def _panel(axes: Any, name: str, rows: list[OpticsRow]) -> None:
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(_LEAST_ERROR, 10.0)
    axes.axvline(WRONG, color="tab:orange", linewidth=0.8, linestyle=":")
    for row in rows:
        if row.ns_per_eval is None or row.max_abs is None:
            continue
        is_number = row.max_abs == row.max_abs
        error = min(max(row.max_abs, _LEAST_ERROR), 1.0) if is_number else 1.0
        label = row.method if row.backend == "peer" else f"{row.method}, {row.backend}"
        label += "" if is_number else " (NaN)"
        axes.plot(error, row.ns_per_eval, "o", color=_COLOURS[row.backend], markersize=5)
        axes.annotate(label, (error, row.ns_per_eval), (4, 3), textcoords="offset points", fontsize=7)
    axes.set_title(name, fontsize=10)
    axes.set_xlabel("max |R − 50 digits|", fontsize=8)
    axes.set_ylabel("ns an evaluation", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.grid(visible=True, linewidth=0.3)
