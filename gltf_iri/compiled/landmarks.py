"""Compiled twin of gltf_iri/evaluation/landmark_boxes.py, with the sum over the boxes.

Bands, then boxes, of many mirrors are put side by side, so that searches and envelopes run in vector
instructions; only what sorts, and what looks up the table, goes one by one. Lanes are the rows of `Lanes` but
the last; where light does not run in both films the path is negative, and the lane has no box.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM
from gltf_iri.compiled.landmark_search import search_by_halving, search_by_newton
from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sincos import sincos_turns
from gltf_iri.optics.landmarks import MODES_MAX

__all__ = ["landmark_colours", "landmark_search"]

_BANDS_AT_ONCE = MODES_MAX + 8  # more than a lane ever has
_MIRRORS_AT_ONCE = 256
_BOXES_AT_ONCE = 256
_BOXES_PER_BAND = 3  # each in at most `subdivisions` parts
_SHORTEST_NM, _LONGEST_NM = WAVELENGTH_RANGE_NM
_TINY = 1e-150  # as in optics/landmarks.py
_LEAST_PATH_NM = 1e-12  # as in evaluation/landmark_boxes.py


@loop
def _fill_lanes(count: int, cell: Any, lanes: Any) -> None:
    """Fill lanes (6, ≥ 2 count), s before p, of the first `count` mirrors in cell (14, ≥ count).

    cell : the fields of `Cell`, then host, n1, n2 and cos θ_h.
    """
    for i in range(count):
        path = max(cell[0, i] + cell[1, i], _LEAST_PATH_NM)
        runs = cell[0, i] + cell[1, i] >= 0.0  # not where they are NaN
        lanes[0, i] = path if runs else -1.0
        lanes[1, i] = (cell[0, i] - cell[1, i]) / path if runs else 0.0
        n1, n2, cos_h = cell[11, i], cell[12, i], cell[13, i]
        contrast, bent = (n1 - n2) / (n1 + n2), cell[10, i] / n1
        at_normal = 0.735 * (contrast * contrast) + 0.532
        rest = 1.0 - np.sqrt(max(1.0 - bent * bent * ((1.0 - cos_h) * (1.0 + cos_h)), 0.0))
        lanes[3, i] = at_normal + (1.0 - at_normal) * (rest * rest)
        for k in (0, 1, 3):
            lanes[k, count + i] = lanes[k, i]
    for p in range(2):
        for i in range(count):
            j = p * count + i
            x = cell[2 + p, i]
            r = 2.0 * (x / (1.0 + x)) * (cell[4 + p, i] / (1.0 + x))
            lanes[2, j] = min(r * r, 1.0) if cell[0, i] > 0.0 and cell[1, i] > 0.0 else 0.0
            lanes[4, j] = cell[6 + p, i] * cell[6 + p, i]
            lanes[5, j] = cell[8 + p, i]


@loop
def _collect(lane: int, last_lane: int, lanes: Any, owner: Any, bands: Any) -> tuple[int, int]:
    """Fill the bands of the lanes from `lane` on, as many as fit; return the next lane and their number.

    owner : (b,) lane of each. bands : (4, b) mode, ρ, r₁₂² and how many bands it stands for.
    """
    count = 0
    while lane < last_lane:
        path_nm = lanes[0, lane]
        if path_nm > 0.0:
            first = np.floor(2.0 * path_nm / _LONGEST_NM)
            last = np.floor(2.0 * path_nm / _SHORTEST_NM)
            stride = 1.0 + np.floor((last - first) / MODES_MAX)
            more = 1 + int((last - first) / stride)
            if count + more > owner.shape[0]:
                break
            for place in range(more):
                owner[count] = lane
                bands[0, count] = first + stride * place
                bands[1, count] = lanes[1, lane]
                bands[2, count] = lanes[2, lane]
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
    lanes: Any,
    subdivisions: int,
    table_steps: int,
    box_lane: Any,
    box: Any,
) -> int:
    """Cut `count` bands into boxes, and return how many overlap the table.

    box_lane : (b,) the lane of each. box : (4, b), of which it fills the middle, and both ends in steps of
    the table.
    """
    boxes = 0
    steps_nm = table_steps / (1.0 / _SHORTEST_NM - 1.0 / _LONGEST_NM)
    offset = steps_nm / _LONGEST_NM
    for i in range(count):
        m, stride = bands[0, i], bands[3, i]
        # A landmark at t lies at slope · t + shift steps of the table.
        scale = 0.5 * steps_nm / lanes[0, owner[i]]
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
def _evaluate(boxes: int, box_lane: Any, lanes: Any, box: Any, copies: Any) -> None:
    """Fill the transmittances box[3] of `boxes` boxes; copies : scratch (5, _BOXES_AT_ONCE)."""
    for first in range(0, boxes, _BOXES_AT_ONCE):
        count = min(_BOXES_AT_ONCE, boxes - first)
        for i in range(count):  # side by side, for the vector instructions of the next loop
            for k in range(5):
                copies[k, i] = lanes[k + 1, box_lane[first + i]]
        middle, result = box[0, first : first + count], box[3, first : first + count]
        for i in range(count):
            result[i] = _transmittance(
                middle[i], copies[0, i], copies[1, i], copies[2, i], copies[3, i], copies[4, i]
            )


@loop
def landmark_colours(cell: Any, subdivisions: int, steps: int, table: Any, rgb: Any) -> None:
    """Fill rgb (n, 3) with the colours of the first n mirrors of `cell`, as `_fill_lanes` takes them.

    steps : Newton steps, 0 for ten halvings. table : C̄, (k + 1, 3).
    """
    # No array is so large that the system would hand out, and clear, new memory for it at every call.
    lanes, transmitted = np.zeros((6, 2 * _MIRRORS_AT_ONCE)), np.zeros((2 * _MIRRORS_AT_ONCE, 3))
    owner, bands = np.zeros(_BANDS_AT_ONCE, np.int64), np.zeros((4, _BANDS_AT_ONCE))
    found, root = np.zeros((3, _BANDS_AT_ONCE)), np.zeros((5, 3 * _BANDS_AT_ONCE))
    many = _BOXES_PER_BAND * max(subdivisions, 1) * _BANDS_AT_ONCE
    box_lane, box, copies = np.zeros(many, np.int64), np.zeros((4, many)), np.zeros((5, _BOXES_AT_ONCE))
    for first in range(0, rgb.shape[0], _MIRRORS_AT_ONCE):
        mirrors = min(_MIRRORS_AT_ONCE, rgb.shape[0] - first)
        _fill_lanes(mirrors, cell[:, first:], lanes)
        transmitted[:] = 0.0
        lane = 0
        while lane < 2 * mirrors:
            lane, count = _collect(lane, 2 * mirrors, lanes, owner, bands)
            _search(count, steps, bands, root, found)
            boxes = _cut(count, owner, bands, found, lanes, subdivisions, table.shape[0] - 1, box_lane, box)
            _evaluate(boxes, box_lane, lanes, box, copies)
            _sum(boxes, box_lane, box, table, transmitted)
        for i in range(mirrors):
            for k in range(3):
                rgb[first + i, k] = 1.0 - 0.5 * (transmitted[i, k] + transmitted[mirrors + i, k])


@loop
def landmark_search(count: int, cell: Any, steps: int) -> float:
    """Search as `landmark_colours` does, and no more; return the sum of all landmarks, for timing."""
    lanes = np.zeros((6, 2 * _MIRRORS_AT_ONCE))
    owner, bands = np.zeros(_BANDS_AT_ONCE, np.int64), np.zeros((4, _BANDS_AT_ONCE))
    found, root = np.zeros((3, _BANDS_AT_ONCE)), np.zeros((5, 3 * _BANDS_AT_ONCE))
    total = 0.0
    for first in range(0, count, _MIRRORS_AT_ONCE):
        mirrors = min(_MIRRORS_AT_ONCE, count - first)
        _fill_lanes(mirrors, cell[:, first:], lanes)
        lane = 0
        while lane < 2 * mirrors:
            lane, many = _collect(lane, 2 * mirrors, lanes, owner, bands)
            _search(many, steps, bands, root, found)
            for i in range(many):
                total += found[0, i] + found[1, i] + found[2, i]
    return total
