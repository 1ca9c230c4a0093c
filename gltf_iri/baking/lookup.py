"""A colour out of a table: multilinear between texels, the same as OpenGL filters them.

Along an axis of n texels the coordinate t ∈ [0, 1] lies at texel t·(n − 1), so that the first and the last
centre stand for the ends of the axis (OpenGL 4.6, 8.14.3, with s = (t·(n − 1) + ½)/n and CLAMP_TO_EDGE).
Compiled twin: gltf_iri/compiled/table.py.
"""

from __future__ import annotations

import math
from itertools import product
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.backends import choose_backend
from gltf_iri.baking.baked import BakedTable
from gltf_iri.planning.film_table import FilmTable, Quantity, TableAxis

__all__ = ["axis_coordinate", "axis_values", "look_up"]

Float64 = NDArray[np.float64]

_ROWS_AT_ONCE: Final = 1 << 14  # keeps temporaries inside a core's cache


def look_up(
    baked: BakedTable,
    cos_theta: ArrayLike,
    thickness_nm: ArrayLike,
    base_f0: ArrayLike,
    *,
    roughness: ArrayLike = 0.0,
    spread_nm: ArrayLike = 0.0,
    backend: str = "auto",
) -> Float64:
    """Return the linear colours (..., 3), float64, of films out of a table. Arrays broadcast.

    What the table has no axis for is not read; beyond an axis' ends its ends count. NaN where a value is.

    Parameters
    ----------
    cos_theta : cosine outside; for a mean over facets (roughness > 0) N·V.
    base_f0 : (..., 3), channel by channel.
    roughness : perceptual; 0 for light from one direction.
    spread_nm : standard deviation of the thickness.
    backend : "auto", "numpy" or "numba"; raises UsageError for others, MissingCapabilityError without numba.
    """
    colour = np.asarray(base_f0, dtype=np.float64)
    given: dict[Quantity, Float64] = {
        "cos_theta": np.asarray(cos_theta, dtype=np.float64),
        "thickness_nm": np.asarray(thickness_nm, dtype=np.float64),
        "roughness": np.asarray(roughness, dtype=np.float64),
        "spread_nm": np.asarray(spread_nm, dtype=np.float64),
    }
    shape = np.broadcast_shapes(colour.shape[:-1], *(each.shape for each in given.values()))
    values = [
        np.broadcast_to(colour, (*shape, 3)).reshape(-1, 3)
        if axis.quantity == "base_f0"
        else np.broadcast_to(given[axis.quantity], shape).reshape(-1)
        for axis in baked.table.axes
    ]
    count = len(values[0])
    if choose_backend(backend, count, ("numpy", "numba"), "table") == "numba":
        return _compiled(baked.table, baked.texels, values).reshape(*shape, 3)
    rgb = np.zeros((count, 3))
    for start in range(0, count, _ROWS_AT_ONCE):
        rows = slice(start, start + _ROWS_AT_ONCE)
        rgb[rows] = _interpolated(baked.table, baked.texels, [each[rows] for each in values])
    return rgb.reshape(*shape, 3)


def axis_coordinate(axis: TableAxis, value: Float64) -> Float64:
    """Return t of `TableAxis`, in [0, 1]; values beyond the ends have theirs, as texture coordinates do."""
    low, high = _ends(axis)
    if axis.quantity == "base_f0":
        value = np.sqrt(np.maximum(value, 0.0))
    # An axis of one value has one texel only.
    return np.clip((value - low) / (high - low), 0.0, 1.0) if high > low else np.zeros_like(value)


def axis_values(axis: TableAxis) -> Float64:
    """Return the values (nodes,) that the texels of an axis stand for."""
    low, high = _ends(axis)
    value = low + (high - low) * np.linspace(0.0, 1.0, axis.nodes)
    value = value**2 if axis.quantity == "base_f0" else value
    # Exactly, for no F0 lies above 1.
    value[0], value[-1] = axis.span.low, axis.span.high
    return value


def _interpolated(table: FilmTable, texels: NDArray[np.floating[Any]], values: list[Float64]) -> Float64:
    """Return (r, 3): Σ over the 2ᵏ corners of a cell of weight times texel."""
    has_base = table.axis("base_f0") is not None
    flat = texels.reshape(-1) if has_base else texels.reshape(-1, 3)
    steps = np.cumprod((1, *table.shape[:0:-1]))[::-1]  # texels to the next one along each axis
    corners = [_cell(axis, value) for axis, value in zip(table.axes, values, strict=True)]
    rgb = np.zeros((len(values[0]), 3))
    for ends in product((0, 1), repeat=len(corners)):
        place: NDArray[np.intp] = np.zeros((1, 1), dtype=np.intp)
        weight = np.ones((1, 1))
        for (cell, t), end, step, axis in zip(corners, ends, steps, table.axes, strict=True):
            place = place + step * np.minimum(cell + end, axis.nodes - 1)
            weight = weight * (t if end else 1.0 - t)
        rgb += weight * (flat[3 * place + np.arange(3)] if has_base else flat[place[:, 0]])
    return rgb


def _compiled(table: FilmTable, texels: NDArray[np.floating[Any]], values: list[Float64]) -> Float64:
    """Return the same as `_interpolated`."""
    from gltf_iri.compiled.table import AXES_MAX, look_up_rows

    lows, scales, cells = np.zeros(AXES_MAX), np.zeros(AXES_MAX), np.zeros(AXES_MAX)
    steps = np.zeros(AXES_MAX, dtype=np.int64)
    columns = [np.zeros(1)] * AXES_MAX
    has_base = table.axis("base_f0") is not None
    # Colours come last.
    slot, step = len(values) - 1 - has_base, 3
    for axis, value in reversed(list(zip(table.axes, values, strict=True))):
        k = AXES_MAX - 1 if axis.quantity == "base_f0" else slot
        slot -= k == slot
        low, high = _ends(axis)
        lows[k], cells[k] = low, axis.nodes - 1
        scales[k] = (axis.nodes - 1) / (high - low) if high > low else 0.0
        # The only texel of an axis is its own next one.
        steps[k] = step if axis.nodes > 1 else 0
        columns[k] = np.ascontiguousarray(value).reshape(-1)
        step *= axis.nodes
    flat = np.ascontiguousarray(texels, dtype=np.float32).reshape(-1)
    rgb = np.zeros((len(values[0]), 3))
    rule = (len(values) - has_base, has_base, lows, scales, cells, steps)
    look_up_rows(*rule, flat, columns[0], columns[1], columns[2], columns[3], rgb.reshape(-1))
    return rgb


def _ends(axis: TableAxis) -> tuple[float, float]:
    """Return the ends of an axis in the measure in which its texels are evenly spaced."""
    low, high = axis.span.low, axis.span.high
    return (math.sqrt(low), math.sqrt(high)) if axis.quantity == "base_f0" else (low, high)


def _cell(axis: TableAxis, value: Float64) -> tuple[NDArray[np.intp], Float64]:
    """Return the texel before each value and how far on it lies, in texels: (r, 1), or (r, 3) of colours."""
    place = axis_coordinate(axis, value) * (axis.nodes - 1)
    # NaN, which no index can be, stays in the weight.
    cell = np.fmin(np.fmax(np.floor(place), 0.0), max(axis.nodes - 2, 0)).astype(np.intp)
    t: Float64 = place - cell
    return (cell, t) if cell.ndim == 2 else (cell[:, None], t[:, None])
