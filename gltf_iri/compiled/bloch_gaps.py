"""Compiled twin of `gap_poles` in gltf_iri/optics/bloch.py and of its sum in gltf_iri/evaluation/bloch.py.

Gaps of many mirrors are gathered and treated side by side, in vector instructions.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gltf_iri.colour.wavenumber_rule import GAP_STEPS
from gltf_iri.compiled.loops import loop
from gltf_iri.compiled.sincos import sincos_turns

__all__ = ["GAPS", "add_gaps", "add_thick_gaps", "bit_count", "note_gap"]

# Treated at once. Rows of scratch have fixed lengths: the compiler then sees that they do not overlap.
GAPS = 1024


@loop
def bit_count(values: Any, count: int) -> int:
    """Return how many bits the largest of the first `count` values has."""
    most, bits = 0, 0
    for i in range(count):
        most = max(most, values[i])
    while most >> bits:
        bits += 1
    return bits


@loop
def note_gap(
    at: int,
    row: int,
    side: int,
    start: float,
    low: float,
    high: float,
    scan: float,
    paths: Any,
    constants: Any,
    gaps: Any,
) -> None:
    """Write gap `at` of `gaps`: its scan's start, its secant's place and its cell's constants."""
    gaps[at], gaps[GAPS + at], gaps[9 * GAPS + at] = start, scan * low / (low - high), scan
    gaps[2 * GAPS + at], gaps[3 * GAPS + at] = paths[0, row], paths[1, row]
    for j in range(5):  # ½Ω, Z, r, 1 − r², κ
        gaps[(4 + j) * GAPS + at] = constants[j, side, row]


@loop
def _find_poles(count: int, first: float, step: float, exponents: Any, gaps: Any) -> None:
    """From scans' starts (row 0) and secants' places (row 1) find the poles: places and strengths.

    Both in steps of the grid, into rows 0 and 1; the scan's length is in row 9.
    """
    for i in range(count):
        start, place, path_1, path_2 = gaps[i], gaps[GAPS + i], gaps[2 * GAPS + i], gaps[3 * GAPS + i]
        kappa, host_t = gaps[8 * GAPS + i], gaps[7 * GAPS + i]
        turn_1, turn_2 = 2.0 * np.pi * step * path_1, 2.0 * np.pi * step * path_2
        slope_cosines, slope_sines = turn_1 + kappa * turn_2, turn_2 + kappa * turn_1
        at = first + step * (start + place)
        sin_1, cos_1 = sincos_turns(path_1 * at)
        sin_2, cos_2 = sincos_turns(path_2 * at)
        value = sin_1 * cos_2 + kappa * (cos_1 * sin_2)
        slope = slope_cosines * (cos_1 * cos_2) - slope_sines * (sin_1 * sin_2)
        place = min(max(place - value / slope, 0.0), gaps[9 * GAPS + i])
        at = first + step * (start + place)
        sin_1, cos_1 = sincos_turns(path_1 * at)
        sin_2, cos_2 = sincos_turns(path_2 * at)
        slope = slope_cosines * (cos_1 * cos_2) - slope_sines * (sin_1 * sin_2)
        off, tilt = gaps[5 * GAPS + i] * sin_2, gaps[6 * GAPS + i] * sin_1
        sinh = abs(off) * np.sqrt(host_t + tilt * tilt)
        is_low = cos_1 * cos_2 - gaps[4 * GAPS + i] * (sin_1 * sin_2) < 0.0
        gaps[i], gaps[GAPS + i] = start + place, slope
        gaps[2 * GAPS + i], gaps[3 * GAPS + i] = 1.0 / (np.sqrt(1.0 + sinh * sinh) + sinh), 1.0
        gaps[4 * GAPS + i], gaps[5 * GAPS + i] = -sinh if is_low else sinh, tilt * off
        gaps[6 * GAPS + i] = tilt * tilt
    for bit in range(bit_count(exponents, count)):
        for i in range(count):
            base, z = gaps[2 * GAPS + i], gaps[3 * GAPS + i]
            gaps[3 * GAPS + i] = z * base if (exponents[i] >> bit) & 1 == 1 else z
            gaps[2 * GAPS + i] = base * base
    for i in range(count):
        z, host_t = gaps[3 * GAPS + i], gaps[7 * GAPS + i]
        tau = (1.0 - z) / (1.0 + z)
        sech_squared = 4.0 * z / ((1.0 + z) * (1.0 + z))
        signed = gaps[4 * GAPS + i] + gaps[5 * GAPS + i] * tau
        unsloped = host_t * host_t * tau * signed / (host_t + gaps[6 * GAPS + i] * sech_squared)
        gaps[GAPS + i] = unsloped / gaps[GAPS + i]


@loop
def add_gaps(count: int, grid: Any, rows: Any, exponents: Any, gaps: Any, gap_weights: Any, rgb: Any) -> None:
    """Add each gap, halved for its polarisation, to its mirror's row of rgb (n, 3)."""
    _find_poles(count, grid[0], grid[1], exponents, gaps)
    last = gap_weights.shape[0] - 2
    for i in range(count):
        place = float(GAP_STEPS) * gaps[i]
        entry = min(int(place), last)
        share, half = place - entry, 0.5 * gaps[GAPS + i]
        for c in range(3):
            weight = (1.0 - share) * gap_weights[entry, c] + share * gap_weights[entry + 1, c]
            rgb[rows[i], c] += half * weight


@loop
def add_thick_gaps(
    row: int,
    scans: int,
    samples: int,
    paths: Any,
    constants: Any,
    number: int,
    grid: Any,
    rows: Any,
    exponents: Any,
    gaps: Any,
    gap_weights: Any,
    rgb: Any,
) -> None:
    """Look for the gaps of one mirror by `scans` steps to one of the grid, and add them."""
    rows[:], exponents[:] = row, 2 * number
    for p in range(2):
        low, found = 0.0, 0
        for j in range((samples - 1) * scans + 1):
            at = grid[0] + grid[1] * (j / scans)
            sin_1, cos_1 = sincos_turns(paths[0, row] * at)
            sin_2, cos_2 = sincos_turns(paths[1, row] * at)
            high = sin_1 * cos_2 + constants[4, p, row] * (cos_1 * sin_2)
            if j > 0 and (low < 0.0) != (high < 0.0):
                note_gap(found, row, p, (j - 1) / scans, low, high, 1.0 / scans, paths, constants, gaps)
                found += 1
                if found == GAPS:
                    add_gaps(found, grid, rows, exponents, gaps, gap_weights, rgb)
                    found = 0
            low = high
        add_gaps(found, grid, rows, exponents, gaps, gap_weights, rgb)
