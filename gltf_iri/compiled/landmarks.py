"""Compiled twin of gltf_iri/evaluation/landmark_boxes.py, with the sum over the boxes.

Bands, then boxes, of many mirrors are put side by side, so that searches and envelopes run in vector
instructions; only what sorts, and what looks up the table, goes one by one. `Lanes` describes the arrays.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gltf_iri.compiled.landmark_search import search_by_halving, search_by_newton
from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sincos import sincos_turns

__all__ = ["landmark_search", "landmark_transmittances"]

_BANDS_AT_ONCE = 264  # more than a lane ever has: MODES_MAX + 1 of optics/landmarks.py
_BOXES_PER_BAND = 3  # each in at most `subdivisions` parts
_TINY = 1e-150
_SHORTEST_NM = 360.0
_LONGEST_NM = 830.0


@loop
def _collect(
    lane: int, path_nm: Any, lean: Any, r_squared: Any, runs: Any, modes_max: int, owner: Any, bands: Any
) -> tuple[int, int]:
    """Fill the bands of the lanes from `lane` on, as many as fit; return the next lane and their number.

    owner : (b,) lane of each. bands : (4, b) mode, ρ, r₁₂² and how many bands it stands for.
    """
    count = 0
    while lane < path_nm.shape[0]:
        if runs[lane]:
            first = np.floor(2.0 * path_nm[lane] / _LONGEST_NM)
            last = np.floor(2.0 * path_nm[lane] / _SHORTEST_NM)
            stride = 1.0 + np.floor((last - first) / modes_max)
            more = 1 + int((last - first) / stride)
            if count + more > owner.shape[0]:
                break
            for place in range(more):
                owner[count] = lane
                bands[0, count] = first + stride * place
                bands[1, count] = lean[lane]
                bands[2, count] = r_squared[lane]
                bands[3, count] = stride
                count += 1
        lane += 1
    return lane, count


@loop
def _search(count: int, steps: int, bands: Any, root: Any, found: Any) -> None:
    if steps == 0:
        search_by_halving(count, bands[0], bands[1], bands[2], root, found)
    else:
        search_by_newton(count, steps, bands[0], bands[1], bands[2], root, found)


@loop
def _cut(
    count: int,
    owner: Any,
    bands: Any,
    found: Any,
    path_nm: Any,
    subdivisions: int,
    table_steps: int,
    box_lane: Any,
    box: Any,
) -> int:
    """Cut `count` bands into boxes, and return how many overlap the table.

    box_lane : (b,) the lane of each. box : (9, b), of which it fills the middle, and both ends in steps of
    the table.
    """
    boxes = 0
    steps_nm = table_steps / (1.0 / _SHORTEST_NM - 1.0 / _LONGEST_NM)
    offset = steps_nm / _LONGEST_NM
    for i in range(count):
        m, stride = bands[0, i], bands[3, i]
        # A landmark at t lies at slope · t + shift steps of the table.
        scale = 0.5 * steps_nm / path_nm[owner[i]]
        slope, shift = stride * scale, (m - stride * m) * scale - offset
        start, airy, end = found[0, i], found[1, i], found[2, i]
        share = max(1.0 - bands[1, i], _TINY)
        zero = np.floor(0.5 * share * end) * (2.0 / share)
        if not (start < zero and zero < end):
            zero = airy
        parts = max(1, subdivisions - int(m)) if m < subdivisions else 1
        low = start
        for piece in range(3):
            high = min(airy, zero) if piece == 0 else (max(airy, zero) if piece == 1 else end)
            if low < high:
                width = (high - low) / parts
                for part in range(parts):
                    part_low, part_high = low + width * part, low + width * (part + 1)
                    at_low, at_high = slope * part_low + shift, slope * part_high + shift
                    if at_high > 0.0 and at_low < table_steps:
                        box_lane[boxes] = owner[i]
                        box[0, boxes] = 0.5 * (part_low + part_high)
                        box[1, boxes] = max(at_low, 0.0)
                        box[2, boxes] = min(at_high, float(table_steps))
                        boxes += 1
            low = high
    return boxes


@inline
def _transmittance(t: float, rho: float, square: float, weight: float, host_r: float, host_t: float) -> float:
    sin_s, cos_s = sincos_turns(0.25 * t)
    sin_d, cos_d = sincos_turns(0.25 * (rho * t))
    product = (sin_s * sin_s - square * (sin_d * sin_d)) * (cos_s * cos_s - square * (cos_d * cos_d))
    mean = sin_s * cos_s - square * (sin_d * cos_d)
    envelope = min(max(product / max(mean * mean, _TINY), 0.0), 1.0)
    through = 1.0 - weight * (1.0 - envelope)
    total = host_t + host_r * through
    return float(host_t * through / (total if total > 0.0 else 1.0))


@loop
def _sum(boxes: int, box_lane: Any, box: Any, table: Any, transmitted: Any) -> None:
    """Add each box's transmittance box[3] times its share of the table, linear between its steps."""
    last = table.shape[0] - 2
    before = -1.0
    red_low, green_low, blue_low = 0.0, 0.0, 0.0
    for i in range(boxes):
        lane, through = box_lane[i], box[3, i]
        if box[1, i] != before:  # most boxes begin where the one before them ends
            at = min(int(box[1, i]), last)
            rest = box[1, i] - at
            red_low = table[at, 0] + rest * (table[at + 1, 0] - table[at, 0])
            green_low = table[at, 1] + rest * (table[at + 1, 1] - table[at, 1])
            blue_low = table[at, 2] + rest * (table[at + 1, 2] - table[at, 2])
        before = box[2, i]
        at = min(int(before), last)
        rest = before - at
        red = table[at, 0] + rest * (table[at + 1, 0] - table[at, 0])
        green = table[at, 1] + rest * (table[at + 1, 1] - table[at, 1])
        blue = table[at, 2] + rest * (table[at + 1, 2] - table[at, 2])
        transmitted[lane, 0] += through * (red - red_low)
        transmitted[lane, 1] += through * (green - green_low)
        transmitted[lane, 2] += through * (blue - blue_low)
        red_low, green_low, blue_low = red, green, blue


@loop
def landmark_transmittances(
    path_nm: Any,
    lean: Any,
    r_squared: Any,
    weight: Any,
    host_r: Any,
    host_t: Any,
    runs: Any,
    subdivisions: int,
    steps: int,
    modes_max: int,
    table: Any,
    transmitted: Any,
) -> None:
    """Add to transmitted (2n, 3) what the boxes of each lane let through.

    steps : Newton steps, 0 for ten halvings. modes_max : MODES_MAX. table : C̄, (k + 1, 3).
    """
    capacity = _BANDS_AT_ONCE
    owner = np.zeros(capacity, np.int64)
    bands, found, root = np.zeros((4, capacity)), np.zeros((3, capacity)), np.zeros((5, 3 * capacity))
    many = _BOXES_PER_BAND * max(subdivisions, 1) * capacity
    box_lane, box = np.zeros(many, np.int64), np.zeros((9, many))
    lane = 0
    while lane < path_nm.shape[0]:
        lane, count = _collect(lane, path_nm, lean, r_squared, runs, modes_max, owner, bands)
        _search(count, steps, bands, root, found)
        boxes = _cut(count, owner, bands, found, path_nm, subdivisions, table.shape[0] - 1, box_lane, box)
        for i in range(boxes):  # side by side, for the vector instructions of the next loop
            k = box_lane[i]
            box[4, i], box[5, i], box[6, i] = lean[k], r_squared[k], weight[k]
            box[7, i], box[8, i] = host_r[k], host_t[k]
        for i in range(boxes):
            box[3, i] = _transmittance(box[0, i], box[4, i], box[5, i], box[6, i], box[7, i], box[8, i])
        _sum(boxes, box_lane, box, table, transmitted)


@loop
def landmark_search(path_nm: Any, lean: Any, r_squared: Any, runs: Any, steps: int, modes_max: int) -> float:
    """Search as `landmark_transmittances` does, and no more; return the sum of all landmarks, for timing."""
    capacity = _BANDS_AT_ONCE
    owner = np.zeros(capacity, np.int64)
    bands, found, root = np.zeros((4, capacity)), np.zeros((3, capacity)), np.zeros((5, 3 * capacity))
    total = 0.0
    lane = 0
    while lane < path_nm.shape[0]:
        lane, count = _collect(lane, path_nm, lean, r_squared, runs, modes_max, owner, bands)
        _search(count, steps, bands, root, found)
        for i in range(count):
            total += found[0, i] + found[1, i] + found[2, i]
    return total
