"""Cells of Ŝ's table, laid flat. Twin: `SensitivityTable` in gltf_iri/colour/sensitivity_table.py."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.compiled.loops import inline

__all__ = ["cubic", "envelope_at"]

Float64 = NDArray[np.float64]

# Unsigned, or each of a cell's numbers would first be asked whether it counts from the array's end.
_U1, _U2, _U3, _U4, _U5, _U6 = (np.uint64(i) for i in range(1, 7))
_U7, _U8, _U9, _U10, _U11, _U12 = (np.uint64(i) for i in range(7, 13))


@inline
def cubic(cell: np.uint64, t: float, cubics: Float64) -> tuple[float, float, float]:
    """Return one part of Ŝ of R, G, B at t in [0, 1] of a cell: 12 numbers, by power, then channel."""
    i = _U12 * cell
    red = cubics[i] + t * (cubics[i + _U3] + t * (cubics[i + _U6] + t * cubics[i + _U9]))
    green = cubics[i + _U1] + t * (cubics[i + _U4] + t * (cubics[i + _U7] + t * cubics[i + _U10]))
    blue = cubics[i + _U2] + t * (cubics[i + _U5] + t * (cubics[i + _U8] + t * cubics[i + _U11]))
    return red, green, blue


@inline
def envelope_at(cell: np.uint64, t: float, envelope: Float64) -> float:
    """Return the bound of |Ŝ| at t of a cell and beyond; for each cell its start and how it changes."""
    return float(envelope[_U2 * cell] + t * envelope[_U2 * cell + _U1])
