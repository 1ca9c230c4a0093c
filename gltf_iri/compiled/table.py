"""Compiled twin of `gltf_iri.baking.lookup`: colours out of a table of one to four axes.

Multilinear in t·(nodes − 1), as OpenGL filters texels (OpenGL 4.6, 8.14.3).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gltf_iri.compiled.loops import inline, loop

__all__ = ["AXES_MAX", "look_up_rows"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]

AXES_MAX = 4


@loop
def look_up_rows(
    axes: int,
    base_axis: int,
    rules: Float64,
    texels: Float32,
    first: Float64,
    second: Float64,
    third: Float64,
    fourth: Float64,
    rgb: Float64,
) -> None:
    """Write the colours of r rows into `rgb` (3r,). All arrays are flat and contiguous.

    axes : how many of the four there are; the values of the others are not read.
    base_axis : the one whose values are colours (3r,), by their root; −1 where none is.
    rules : for each of four axes its lowest value (its root where values are colours), cells in a unit of it,
        the number of its cells, and how far its next texel lies.
    """
    for i in range(len(rgb) // 3):
        at, a = _cell(first[i], rules[0], rules[1], rules[2])
        place = at * int(rules[3])
        b, c, d = 0.0, 0.0, 0.0
        if axes > 1 and base_axis != 1:
            at, b = _cell(second[i], rules[4], rules[5], rules[6])
            place += at * int(rules[7])
        if axes > 2 and base_axis != 2:
            at, c = _cell(third[i], rules[8], rules[9], rules[10])
            place += at * int(rules[11])
        if axes > 3 and base_axis != 3:
            at, d = _cell(fourth[i], rules[12], rules[13], rules[14])
            place += at * int(rules[15])
        for channel in range(3):
            here = place + channel
            if base_axis == 1:
                at, b = _cell(_root(second[3 * i + channel]), rules[4], rules[5], rules[6])
                here += at * int(rules[7])
            elif base_axis == 2:
                at, c = _cell(_root(third[3 * i + channel]), rules[8], rules[9], rules[10])
                here += at * int(rules[11])
            elif base_axis == 3:
                at, d = _cell(_root(fourth[3 * i + channel]), rules[12], rules[13], rules[14])
                here += at * int(rules[15])
            if axes == 1:
                value = _line(texels, here, rules, a)
            elif axes == 2:
                value = _plane(texels, here, rules, a, b)
            elif axes == 3:
                value = _cube(texels, here, rules, a, b, c)
            else:
                low = _cube(texels, here, rules, a, b, c)
                value = low + d * (_cube(texels, here + int(rules[15]), rules, a, b, c) - low)
            rgb[3 * i + channel] = value


@inline
def _cell(value: float, low: float, scale: float, cells: float) -> tuple[int, float]:
    """Return the texel before `value` and how far it lies towards the next one; NaN stays in the latter."""
    place = (value - low) * scale
    place = 0.0 if place < 0.0 else (cells if place > cells else place)
    cell = int(place) if place < cells else max(int(cells) - 1, 0)
    return (0, place) if math.isnan(place) else (cell, place - cell)


@inline
def _root(value: float) -> float:
    return 0.0 if value < 0.0 else math.sqrt(value)


@inline
def _line(texels: Float32, here: int, rules: Float64, a: float) -> float:
    low = np.float64(texels[here])
    return low + a * (np.float64(texels[here + int(rules[3])]) - low)


@inline
def _plane(texels: Float32, here: int, rules: Float64, a: float, b: float) -> float:
    low = _line(texels, here, rules, a)
    return low + b * (_line(texels, here + int(rules[7]), rules, a) - low)


@inline
def _cube(texels: Float32, here: int, rules: Float64, a: float, b: float, c: float) -> float:
    low = _plane(texels, here, rules, a, b)
    return low + c * (_plane(texels, here + int(rules[11]), rules, a, b) - low)
