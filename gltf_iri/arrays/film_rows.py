"""Films of many rows in a .npy file: opened without reading it, its columns named, its values checked."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import INDEX_MAX, THICKNESS_MAX_NM
from gltf_iri.planning.reach import Span

__all__ = ["CHANNELS", "COLUMNS", "ROWS_AT_ONCE", "column_spans", "open_rows", "span_steps"]

Rows = NDArray[np.floating[Any]]

# A coloured base.
CHANNELS: Final = ("base_r", "base_g", "base_b")

# What a column may be called, and what its numbers may be.
COLUMNS: Final[Mapping[str, Span]] = MappingProxyType(
    {
        "cos": Span(0.0, 1.0),
        "thickness": Span(0.0, THICKNESS_MAX_NM),
        "film_ior": Span(1.0 / INDEX_MAX, INDEX_MAX),
        "outside_ior": Span(1.0 / INDEX_MAX, INDEX_MAX),
        "base_f0": Span(0.0, 1.0),
        **dict.fromkeys(CHANNELS, Span(0.0, 1.0)),
    }
)

# At a time: a method's temporaries, some hundred numbers a row, then take a tenth of a gigabyte a thread.
ROWS_AT_ONCE: Final = 1 << 17


def open_rows(path: str | os.PathLike[str], columns: Sequence[str]) -> Rows:
    """Return the array (n, k) of a .npy file, mapped and not read; k is the number of `columns`.

    float32 or float64 in either byte order, in C or Fortran order. Pickled objects are refused, not loaded.
    Raises UsageError where columns do not go together or the file is no such array.
    """
    _check_names(columns)
    place = Path(path)
    if not place.is_file():
        raise UsageError(f"There is no file '{place}' to read films from.")
    try:
        rows = np.lib.format.open_memmap(place, mode="r")
    except Exception as error:  # what reads numpy's headers has no list of what it raises
        # Numpy's words may be lines about pickles that are allowed: not here.
        reason = str(error).splitlines()[0].rstrip(".") if str(error) else type(error).__name__
        raise UsageError(f"'{place}' is no .npy array of plain numbers ({reason}).") from error
    if rows.dtype.kind != "f" or rows.dtype.itemsize not in (4, 8):
        raise UsageError(f"'{place}' holds {rows.dtype}; films are float32 or float64.")
    if rows.ndim != 2 or rows.shape[1] != len(columns):
        raise UsageError(
            f"'{place}' has the shape {rows.shape}, not (n, {len(columns)}) as its columns say: "
            f"{', '.join(columns)}."
        )
    if len(rows) == 0:
        raise UsageError(f"'{place}' has no rows.")
    return rows


def span_steps(rows: Rows) -> int:
    """Return how often `column_spans` advances."""
    return -(-len(rows) // ROWS_AT_ONCE)


def column_spans(
    rows: Rows, columns: Sequence[str], *, advance: Callable[[], None] = lambda: None
) -> dict[str, Span]:
    """Return the least and the greatest number of each column, block by block; one pass over the file.

    Raises UsageError that names the first row with a number out of range, NaN included, as COLUMNS says.
    """
    lows, highs = np.full(len(columns), np.inf), np.full(len(columns), -np.inf)
    for start in range(0, len(rows), ROWS_AT_ONCE):
        block = rows[start : start + ROWS_AT_ONCE]
        low = np.array([block[:, c].min() for c in range(len(columns))])
        high = np.array([block[:, c].max() for c in range(len(columns))])
        for c, name in enumerate(columns):
            allowed = COLUMNS[name]
            # Not "low < …": a NaN must not count as allowed.
            if not (low[c] >= allowed.low and high[c] <= allowed.high):
                column = block[:, c]
                at = int(np.argmin((column >= allowed.low) & (column <= allowed.high)))
                raise UsageError(
                    f"Row {start + at} (the first is 0) has {name} = {column[at]:g}; it must lie in "
                    f"[{allowed.low:g}, {allowed.high:g}]."
                )
        lows, highs = np.minimum(lows, low), np.maximum(highs, high)
        advance()
    return {name: Span(float(low), float(high)) for name, low, high in zip(columns, lows, highs, strict=True)}


def _check_names(columns: Sequence[str]) -> None:
    for name in columns:
        if name not in COLUMNS:
            raise UsageError(f"There is no column '{name}'; choose among: {', '.join(COLUMNS)}.")
    if len(set(columns)) < len(columns):
        raise UsageError("A column is named twice; name each once.")
    if "cos" not in columns:
        raise UsageError("One of the columns must be cos, the cosine of the angle outside.")
    channels = [name for name in CHANNELS if name in columns]
    if 0 < len(channels) < 3 or (channels and "base_f0" in columns):
        raise UsageError("A base is one column, base_f0, or three: base_r, base_g and base_b.")
