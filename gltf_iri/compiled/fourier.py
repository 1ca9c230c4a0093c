"""Method `fourier` in compiled loops, for films on bases that absorb nothing.

Twin: gltf_iri/evaluation/fourier.py and gltf_iri/optics/film_series.py, which derive formula and bound.
A first loop, in vector instructions, prepares all that needs no table: for the three orders that most films
want, where they stand in it and how much they count. The second looks up Ŝ film by film, these three orders
without asking, for a wrongly foretold jump costs more than a term of weight 0.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sensitivity_cells import cubic, envelope_at
from gltf_iri.optics.film_series import NEAR_ZERO

__all__ = ["sum_series"]

Float64 = NDArray[np.float64]

_BLOCK = 128  # what is kept between the two loops stays in the nearest cache


@loop
def sum_series(
    outside_ior: Float64,
    film_ior: Float64,
    base_ior: Float64,
    thickness_nm: Float64,
    cos_theta_1: Float64,
    cubics: Float64,
    envelope: Float64,
    decay: float,
    step_nm: float,
    thin_opd_nm: float,
    tolerance: float,
    max_orders: int,
    rgb: Float64,
    is_open: NDArray[np.bool_],
) -> None:
    """Write the colours of r films into `rgb` (3r,), and into `is_open` (r,) which the sum leaves open.

    All arrays are flat and contiguous. cubics, envelope, decay : `real` and more of a `FlatTable`
    (gltf_iri/colour/sensitivity_table.py).
    """
    kept, cell = np.zeros(20 * _BLOCK), np.zeros(4 * _BLOCK, np.int64)
    cells = float(len(envelope) // 2 - 1)
    per_step, per_tau = 2.0 / step_nm, 2.0 / tolerance
    thin = thin_opd_nm / step_nm
    for start in range(0, len(outside_ior), _BLOCK):
        count = min(_BLOCK, len(outside_ior) - start)
        for j in range(count):
            i = start + j
            n1, n2, n3 = outside_ior[i], film_ior[i], base_ior[i]
            is_mirror = (n3 > 1e300) | (n3 < NEAR_ZERO)
            n3 = 1.0 if is_mirror else n3
            c1 = cos_theta_1[i]
            q1 = n1 * (NEAR_ZERO if c1 < NEAR_ZERO else c1)
            q1_squared = q1 * q1
            q2_squared = (n2 - n1) * (n2 + n1) + q1_squared
            q3_squared = (n3 - n1) * (n3 + n1) + q1_squared
            q2 = math.sqrt(q2_squared if q2_squared > 0.0 else 1.0)
            q3 = math.sqrt(0.0 if q3_squared < 0.0 else q3_squared)
            one, two, three = n1 * n1, n2 * n2, n3 * n3
            share = 0.0 if is_mirror else 1.0
            in_s, z_s, tail_s = _polarisation(q1, q2, q3, share)
            in_p, z_p, tail_p = _polarisation(q1 * two * three, q2 * one * three, q3 * one * two, share)
            step = thickness_nm[i] * q2 * per_step
            kept[j] = 1.0 - (in_s + in_p)
            kept[j + _BLOCK] = step if (q2_squared > 0.0) & (step > thin) else -1.0
            size_s, size_p = abs(z_s), abs(z_p)
            power_s, power_p = 2.0 * in_s * z_s, 2.0 * in_p * z_p
            left_s, left_p = tail_s * size_s * per_tau, tail_p * size_p * per_tau
            place = step
            cell[j], kept[j + 2 * _BLOCK] = _place(place, left_s + left_p, decay, cells)
            kept[j + 3 * _BLOCK], kept[j + 4 * _BLOCK] = power_s + power_p, left_s + left_p
            power_s, power_p = power_s * z_s, power_p * z_p
            left_s, left_p = left_s * size_s, left_p * size_p
            place = place + step
            cell[j + _BLOCK], kept[j + 5 * _BLOCK] = _place(place, left_s + left_p, decay, cells)
            kept[j + 6 * _BLOCK], kept[j + 7 * _BLOCK] = power_s + power_p, left_s + left_p
            power_s, power_p = power_s * z_s, power_p * z_p
            left_s, left_p = left_s * size_s, left_p * size_p
            place = place + step
            cell[j + 2 * _BLOCK], kept[j + 8 * _BLOCK] = _place(place, left_s + left_p, decay, cells)
            kept[j + 9 * _BLOCK], kept[j + 10 * _BLOCK] = power_s + power_p, left_s + left_p
            left_s, left_p = left_s * size_s, left_p * size_p
            place = place + step
            cell[j + 3 * _BLOCK], kept[j + 11 * _BLOCK] = _place(place, left_s + left_p, decay, cells)
            kept[j + 12 * _BLOCK], kept[j + 13 * _BLOCK] = left_s, left_p
            kept[j + 14 * _BLOCK], kept[j + 15 * _BLOCK] = power_s * z_s, power_p * z_p
            kept[j + 16 * _BLOCK], kept[j + 17 * _BLOCK] = z_s, z_p
            kept[j + 18 * _BLOCK] = place
        for j in range(count):
            i = start + j
            mean = kept[j]
            t, power, left = kept[j + 2 * _BLOCK], kept[j + 3 * _BLOCK], kept[j + 4 * _BLOCK]
            r, g, b, bound = _term(cell[j], t, power, left, cubics, envelope)
            red, green, blue = mean - r, mean - g, mean - b
            t, power, left = kept[j + 5 * _BLOCK], kept[j + 6 * _BLOCK], kept[j + 7 * _BLOCK]
            r, g, b, bound = _term(cell[j + _BLOCK], t, power, left, cubics, envelope)
            red, green, blue = red - r, green - g, blue - b
            t, power, left = kept[j + 8 * _BLOCK], kept[j + 9 * _BLOCK], kept[j + 10 * _BLOCK]
            r, g, b, bound = _term(cell[j + 2 * _BLOCK], t, power, left, cubics, envelope)
            red, green, blue = red - r, green - g, blue - b
            t, left = kept[j + 11 * _BLOCK], kept[j + 12 * _BLOCK] + kept[j + 13 * _BLOCK]
            k = np.uint64(cell[j + 3 * _BLOCK])
            bound = left * envelope_at(k, t, envelope)
            is_open[i] = kept[j + _BLOCK] < 0.0
            if bound > 1.0 and not is_open[i]:
                step, place = kept[j + _BLOCK], kept[j + 18 * _BLOCK]
                left_s, left_p = kept[j + 12 * _BLOCK], kept[j + 13 * _BLOCK]
                power_s, power_p = kept[j + 14 * _BLOCK], kept[j + 15 * _BLOCK]
                z_s, z_p = kept[j + 16 * _BLOCK], kept[j + 17 * _BLOCK]
                order = 3
                while bound > 1.0 and order < max_orders:
                    whole, t = _place(place, left_s + left_p, decay, cells)
                    r, g, b, bound = _term(whole, t, power_s + power_p, left_s + left_p, cubics, envelope)
                    red, green, blue = red - r, green - g, blue - b
                    power_s, power_p = power_s * z_s, power_p * z_p
                    left_s, left_p = left_s * abs(z_s), left_p * abs(z_p)
                    place = place + step
                    order += 1
                is_open[i] = bound > 1.0
            rgb[3 * i] = red
            rgb[3 * i + 1] = green
            rgb[3 * i + 2] = blue


@inline
def _polarisation(y1: float, y2: float, y3: float, share: float) -> tuple[float, float, float]:
    """Return G/2, z and H of one polarisation."""
    into = share * y3
    first = y1 + y2
    second = y2 + y3
    second_squared = second * second
    contrast = y1 - y2
    blocked = y1 * second_squared + contrast * contrast * y3
    # One division for both: in vectors, divisions are what the loop waits for.
    both = first * second
    inverse = 1.0 / (blocked * both)
    z = -contrast * (y2 - y3) * (inverse * blocked)
    inverse = inverse * both
    tail = (1.0 + abs(z)) * (y1 * into) * (first * first * inverse) * (second_squared * inverse)
    return 2.0 * y1 * y2 * into * inverse, z, tail


@inline
def _place(place: float, left: float, decay: float, cells: float) -> tuple[np.int64, float]:
    """Return the cell at `place` and how far in it; the cell of zeros where all that follows is below τ."""
    place = min(place if left * decay > place * place else cells, cells)
    whole = np.floor(place)
    return np.int64(whole), place - whole


@inline
def _term(
    cell: np.int64, t: float, power: float, left: float, cubics: Float64, envelope: Float64
) -> tuple[float, float, float, float]:
    """Return one order's share of the three channels, and what all from this on may add up to, per τ."""
    k = np.uint64(cell)
    bound = left * envelope_at(k, t, envelope)
    weight = power * max(0.0, min(1.0, bound - 1.0))
    red, green, blue = cubic(k, t, cubics)
    return weight * red, weight * green, weight * blue, bound
