"""Compiled twin of `gltf_iri.baking.lookup`: colours out of a table of one to four axes.

Multilinear in t·(nodes − 1), as OpenGL filters texels (OpenGL 4.6, 8.14.3). Block by block, a first loop in
vector instructions says where along each axis, and a second gathers texels.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gltf_iri.compiled.loops import inline, loop

__all__ = ["AXES_MAX", "look_up_rows"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]

AXES_MAX = 4

_BLOCK = 128  # what is kept between the two loops stays in the nearest cache


@loop
def look_up_rows(
    axes: int,
    has_base: bool,
    low: Float64,
    scale: Float64,
    cells: Float64,
    step: Int64,
    texels: Float32,
    first: Float64,
    second: Float64,
    third: Float64,
    fourth: Float64,
    rgb: Float64,
) -> None:
    """Write the colours of r rows into `rgb` (3r,). All arrays are flat and contiguous.

    axes : how many of the four there are, one whose values are colours not counted; the values of others (r,)
        are not read.
    has_base : whether the fourth axis' values are colours (3r,), by their root.
    low, scale, cells, step : (4,), for each axis its lowest value (its root where values are colours), cells
        in a unit of it, the number of its cells, and how far its next texel lies in `texels`.
    """
    place, t = np.zeros(_BLOCK, np.int64), np.zeros(4 * _BLOCK)
    base_place, base_t = np.zeros(3 * _BLOCK, np.int64), np.zeros(3 * _BLOCK)
    s0, s1, s2, s3 = step[0], step[1], step[2], step[3]
    for start in range(0, len(rgb) // 3, _BLOCK):
        count = min(_BLOCK, len(rgb) // 3 - start)
        for j in range(count):
            place[j], t[j] = _cell(first[start + j], low[0], scale[0], cells[0], s0)
        if axes > 1:
            for j in range(count):
                at, t[_BLOCK + j] = _cell(second[start + j], low[1], scale[1], cells[1], s1)
                place[j] += at
        if axes > 2:
            for j in range(count):
                at, t[2 * _BLOCK + j] = _cell(third[start + j], low[2], scale[2], cells[2], s2)
                place[j] += at
        if axes > 3:
            for j in range(count):
                at, t[3 * _BLOCK + j] = _cell(fourth[start + j], low[3], scale[3], cells[3], s3)
                place[j] += at
        if has_base:
            for j in range(3 * count):
                value = fourth[3 * start + j]
                root = 0.0 if value < 0.0 else math.sqrt(value)
                base_place[j], base_t[j] = _cell(root, low[3], scale[3], cells[3], s3)
        for j in range(count):
            a, b, c, d = t[j], t[_BLOCK + j], t[2 * _BLOCK + j], t[3 * _BLOCK + j]
            for channel in range(3):
                here = place[j] + channel
                k = 3 * j + channel
                if has_base:
                    here += base_place[k]
                    d = base_t[k]
                if axes == 1:
                    value = _line(texels, here, s0, a)
                    after = _line(texels, here + s3, s0, a) if has_base else value
                elif axes == 2:
                    value = _plane(texels, here, s0, a, s1, b)
                    after = _plane(texels, here + s3, s0, a, s1, b) if has_base else value
                else:
                    value = _cube(texels, here, s0, a, s1, b, s2, c)
                    has_fourth = has_base | (axes == 4)
                    after = _cube(texels, here + s3, s0, a, s1, b, s2, c) if has_fourth else value
                rgb[3 * start + k] = value + d * (after - value)


@inline
def _cell(value: float, low: float, scale: float, cells: float, step: int) -> tuple[int, float]:
    """Return where the texel before `value` lies, and how far on that is in texels: NaN where `value` is."""
    place = (value - low) * scale
    place = 0.0 if place < 0.0 else (cells if place > cells else place)
    # In numba math.floor makes integers, which NaN cannot be; here NaN reads the last cell.
    floor = np.floor(place)
    whole = floor if floor < cells - 1.0 else max(cells - 1.0, 0.0)
    return int(whole) * step, place - whole


@inline
def _line(texels: Float32, here: int, s0: int, a: float) -> float:
    low = np.float64(texels[here])
    return low + a * (np.float64(texels[here + s0]) - low)


@inline
def _plane(texels: Float32, here: int, s0: int, a: float, s1: int, b: float) -> float:
    low = _line(texels, here, s0, a)
    return low + b * (_line(texels, here + s1, s0, a) - low)


@inline
def _cube(texels: Float32, here: int, s0: int, a: float, s1: int, b: float, s2: int, c: float) -> float:
    low = _plane(texels, here, s0, a, s1, b)
    return low + c * (_plane(texels, here + s2, s0, a, s1, b) - low)
