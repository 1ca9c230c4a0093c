"""Pictures of the map of cost and error: time against ΔE, a panel a device, the Pareto front drawn."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final

from gltf_iri.bench.accuracy_row import SHADINGS, AccuracyRow
from gltf_iri.bench.pareto import LEAST, MOST, error_of, front, is_ours
from gltf_iri.bench.plot import apart, png_bytes

__all__ = ["plot_accuracy"]

_PANEL_IN: Final = (6.4, 6.8)
_DEVICES: Final[Mapping[str, str]] = {"numpy": "numpy", "numba": "compiled (numba)", "glsl": "OpenGL"}

# An error of 0 has no place on a logarithmic axis; no eye tells this one from it.
_FLOOR: Final = 1e-5
_CEILING: Final = 200.0

_LABEL_HEIGHT: Final = 0.034  # of a panel
_LABELS_AT: Final = 1.04  # beyond the panel's right edge, in its widths
_STYLES: Final = ("o", "s", "^", "D", "v", "P", "X", "<", ">", "*")


def plot_accuracy(workload: str, rows: Sequence[AccuracyRow], renderer: str | None) -> bytes:
    """Return a PNG of the rows of one set: a colour and a marker a method, settings joined by a line.

    Times hold a share of the filling of tables. Errors below 1e-5, 0 among them, stand at 1e-5.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    shown = [row for row in rows if row.errors is not None]
    devices = [name for name in _DEVICES if any(row.backend == name for row in shown)]
    size = (_PANEL_IN[0] * len(devices), _PANEL_IN[1])
    figure = Figure(figsize=size, dpi=110, layout="constrained")
    FigureCanvasAgg(figure)
    names = list(dict.fromkeys(_series(row) for row in shown))
    panels = figure.subplots(1, len(devices), squeeze=False)
    for axes, device in zip(panels.flat, devices, strict=True):
        of_device = [row for row in shown if row.backend == device]
        _panel(axes, of_device, {name: (f"C{k % 10}", _STYLES[k % 10]) for k, name in enumerate(names)})
        title = _DEVICES[device] + (f": {renderer}" if device == "glsl" and renderer else "")
        axes.set_title(title, fontsize=9)
    figure.suptitle(
        f"{workload}: time against error; tables with their filling spread over {SHADINGS:,} shadings",
        fontsize=11,
    )
    return png_bytes(figure)


def _series(row: AccuracyRow) -> str:
    """Return what its points are joined by: a method, or tables of so many axes and such texels."""
    if row.method is not None:
        return row.method
    texel = row.label.rsplit(", ", 1)[-1]
    return f"{row.way}, {texel.removeprefix('RGBA').lower()}"


def _setting(row: AccuracyRow) -> str:
    """Return a point's own short name: the number that tells it from others of its series."""
    if row.method is None:
        return row.label.removeprefix("table: ").split(",")[0].rsplit(" ", 1)[-1]
    numbers = [f"{value:g}" for value in row.parameters.values() if not isinstance(value, str)]
    return numbers[0] if len(numbers) == 1 else ""


def _panel(axes: Any, rows: Sequence[AccuracyRow], styles: Mapping[str, tuple[str, str]]) -> None:
    from matplotlib.ticker import NullFormatter

    place = {row.label: (min(max(error_of(row), _FLOOR), _CEILING), row.ns) for row in rows}
    heights = [math.log10(ns) for _, ns in place.values()]
    # At least two of the powers of ten that bear a number.
    bottom, top = (
        min(math.floor(min(heights)), min(heights) - 0.25),
        max(math.ceil(max(heights)), max(heights) + 0.25),
    )
    axes.set(xscale="log", yscale="log", xlim=(_FLOOR / 2.0, _CEILING * 1.5), ylim=(10.0**bottom, 10.0**top))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.axvspan(LEAST, MOST, color="0.95", zorder=0)
    series: dict[str, list[AccuracyRow]] = {}
    for row in sorted(rows, key=lambda row: (row.ns, error_of(row))):
        series.setdefault(_series(row), []).append(row)
    for name, group in series.items():
        colour, marker = styles[name]
        points = sorted(place[row.label] for row in group)
        line = "-" if is_ours(group[0]) else ":"
        axes.plot(*zip(*points, strict=True), line, color=colour, marker=marker, markersize=5, linewidth=0.9)
        _name_ends(axes, group, place, colour)
    _draw_front(axes, front(rows), place)
    _name_series(axes, series, place, styles, (bottom, top))
    axes.set_xlabel("ΔE2000, 95th percentile (D65); grey: where fronts are judged", fontsize=8)
    axes.set_ylabel("ns a colour, one core", fontsize=8)
    axes.tick_params(labelsize=7)
    axes.grid(visible=True, linewidth=0.3)


def _draw_front(axes: Any, rows: Sequence[AccuracyRow], place: Mapping[str, tuple[float, float]]) -> None:
    points = [place[row.label] for row in rows]
    if not points:
        return
    corners = [(MOST, points[0][1])]
    for error, ns in points:
        corners += [(corners[-1][0], ns), (max(error, LEAST), ns)]
    axes.plot(*zip(*corners, strict=True), color="black", linewidth=2.4, alpha=0.75, zorder=1)


def _name_ends(
    axes: Any, group: Sequence[AccuracyRow], place: Mapping[str, tuple[float, float]], colour: str
) -> None:
    """Write the setting beside the first and the last point of a series."""
    ends = sorted(group, key=lambda row: place[row.label])
    for row in dict.fromkeys((ends[0].label, ends[-1].label)) if len(group) > 1 else ():
        text = next(_setting(each) for each in group if each.label == row)
        axes.annotate(
            text,
            place[row],
            (0, 5),
            textcoords="offset points",
            fontsize=6,
            color=colour,
            horizontalalignment="center",
        )


def _name_series(
    axes: Any,
    series: Mapping[str, Sequence[AccuracyRow]],
    place: Mapping[str, tuple[float, float]],
    styles: Mapping[str, tuple[str, str]],
    limits: tuple[float, float],
) -> None:
    """Write the names in a column right of the panel, each with a line to its series' rightmost point."""
    bottom, top = limits
    anchors = {name: max(place[row.label] for row in group) for name, group in series.items()}
    order = sorted(anchors, key=lambda name: anchors[name][1])
    wanted = [(math.log10(anchors[name][1]) - bottom) / (top - bottom) for name in order]
    heights = apart(wanted, _LABEL_HEIGHT)
    over = max(0.0, heights[-1] - 1.0)
    # Where the column runs over the top, all of it that is crowded moves down.
    heights = [
        max(min(height, 1.0 - _LABEL_HEIGHT * (len(order) - 1 - k)), 0.0) if over else height
        for k, height in enumerate(heights)
    ]
    for name, height in zip(order, heights, strict=True):
        axes.annotate(
            name,
            anchors[name],
            (_LABELS_AT, height),
            textcoords="axes fraction",
            fontsize=7.5,
            color=styles[name][0],
            verticalalignment="center",
            annotation_clip=False,
            arrowprops={
                "arrowstyle": "-",
                "linewidth": 0.4,
                "color": styles[name][0],
                "shrinkA": 1,
                "shrinkB": 3,
            },
        )
