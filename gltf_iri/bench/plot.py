"""A picture of `bench optics`: time of an evaluation against error, a panel a workload."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from itertools import groupby
from typing import Any, Final

from gltf_iri.bench.optics import WRONG, OpticsRow

__all__ = ["apart", "plot_optics", "png_bytes"]

_PANEL_IN: Final = (4.6, 3.8)
_COLUMNS: Final = 3
_COLOURS: Final = {"numpy": "tab:blue", "numba": "tab:red", "peer": "tab:gray"}

# An answer right to the last bit has no place on a logarithmic axis; a tenth of a rounding has.
_LEAST_ERROR: Final = 1e-17
_WORST: Final = 1.0  # where NaN stands, too
_MOST_ERROR: Final = 10.0

_LABEL_HEIGHT: Final = 0.045  # of a panel


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
    return png_bytes(figure)


def png_bytes(figure: Any) -> bytes:
    """Return a figure as a PNG file."""
    stream = io.BytesIO()
    figure.savefig(stream, format="png")
    return stream.getvalue()


def _panel(axes: Any, name: str, rows: list[OpticsRow]) -> None:
    shown = sorted((row for row in rows if row.ns_per_eval), key=lambda row: row.ns_per_eval or 0.0)
    heights = [math.log10(row.ns_per_eval or 1.0) for row in shown]
    bottom, top = min(heights, default=0.0) - 0.3, max(heights, default=1.0) + 0.3
    axes.set_xscale("log")
    axes.set_xlim(_LEAST_ERROR, _MOST_ERROR)
    axes.axvline(WRONG, color="tab:orange", linewidth=0.8, linestyle=":")
    places = apart(heights, _LABEL_HEIGHT * (top - bottom))
    for row, height, place in zip(shown, heights, places, strict=True):
        max_abs = row.max_abs if row.max_abs is not None else math.nan
        is_right = max_abs > WRONG or math.isnan(max_abs)
        error = _WORST if math.isnan(max_abs) else min(max(max_abs, 10.0 * _LEAST_ERROR), _WORST)
        label = row.method if row.backend == "peer" else f"{row.method}, {row.backend}"
        label += " (NaN)" if math.isnan(max_abs) else ""
        axes.plot(error, 10.0**height, "o", color=_COLOURS[row.backend], markersize=5)
        axes.annotate(
            label,
            (error, 10.0**height),
            (error / 30.0 if is_right else error * 30.0, 10.0**place),
            horizontalalignment="right" if is_right else "left",
            verticalalignment="center",
            fontsize=7,
            arrowprops={"arrowstyle": "-", "linewidth": 0.4, "color": "tab:gray"},
        )
    axes.set_yscale("log")
    axes.set_ylim(10.0**bottom, 10.0 ** max([top, *(place + 0.3 for place in places)]))
    axes.set_title(name, fontsize=10)
    axes.set_xlabel("max |R − 50 digits|", fontsize=8)
    axes.set_ylabel("ns an evaluation", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.grid(visible=True, linewidth=0.3)


def apart(heights: Sequence[float], least: float) -> list[float]:
    """Return rising `heights`, moved up where two are nearer than `least`, so that labels stay legible."""
    places: list[float] = []
    for height in heights:
        places.append(max(height, places[-1] + least) if places else height)
    return places
