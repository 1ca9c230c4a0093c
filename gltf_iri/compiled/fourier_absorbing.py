"""Method `fourier` in compiled loops, for films on bases that may absorb: phases are no longer 0 or π.

Twin: gltf_iri/evaluation/fourier.py and gltf_iri/optics/film_series.py, which derive formula and bound.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sensitivity_cells import cubic, envelope_at
from gltf_iri.optics.film_series import NEAR_ZERO

__all__ = ["sum_absorbing_series"]

Float64 = NDArray[np.float64]


@loop
def sum_absorbing_series(
    outside_ior: Float64,
    film_ior: Float64,
    base_index: NDArray[np.complex128],
    thickness_nm: Float64,
    cos_theta_1: Float64,
    real: Float64,
    imaginary: Float64,
    envelope: Float64,
    step_nm: float,
    thin_opd_nm: float,
    tolerance: float,
    max_orders: int,
    rgb: Float64,
    is_open: NDArray[np.bool_],
) -> None:
    """Write the colours of r films into `rgb` (3r,), and into `is_open` (r,) which the sum leaves open.

    All arrays are flat and contiguous; `real`, `imaginary` and `envelope` as in `gltf_iri.compiled.fourier`.
    """
    cells = float(len(envelope) // 2 - 1)
    for i in range(len(outside_ior)):
        n1, n2, n3 = outside_ior[i], film_ior[i], base_index[i]
        is_mirror = math.isinf(n3.real) or abs(n3) < NEAR_ZERO
        n3 = complex(1.0, 0.0) if is_mirror else n3
        q1 = n1 * max(cos_theta_1[i], NEAR_ZERO)
        q1_squared = q1 * q1
        q2_squared = (n2 - n1) * (n2 + n1) + q1_squared
        q2 = math.sqrt(q2_squared if q2_squared > 0.0 else 1.0)
        root = np.sqrt((n3 - n1) * (n3 + n1) + q1_squared)
        q3 = complex(abs(root.real), abs(root.imag))
        one, two = n1 * n1, n2 * n2
        share = 0.0 if is_mirror else 1.0
        in_s, z_s, tail_s = _polarisation(q1, q2, q3, share)
        in_p, z_p, tail_p = _polarisation(q1 * two, q2 * one, q3 * (one * two) / (n3 * n3), share)
        mean = 1.0 - (in_s + in_p)
        red, green, blue = mean, mean, mean
        step = 2.0 * thickness_nm[i] * q2 / step_nm
        is_open[i] = not (q2_squared > 0.0 and step > thin_opd_nm / step_nm)
        size_s, size_p = abs(z_s), abs(z_p)
        left_s, left_p = 2.0 / tolerance * tail_s, 2.0 / tolerance * tail_p
        power_s, power_p = 2.0 * in_s * z_s, 2.0 * in_p * z_p
        place = 0.0
        bound = 2.0
        order = 0
        while bound > 1.0 and order < max_orders and not is_open[i]:
            place = min(place + step, cells)
            whole = np.int64(place)
            t = place - whole
            left_s, left_p = left_s * size_s, left_p * size_p
            k = np.uint64(whole)
            bound = (left_s + left_p) * envelope_at(k, t, envelope)
            weight = (power_s + power_p) * max(0.0, min(1.0, bound - 1.0))
            r, g, b = cubic(k, t, real)
            red, green, blue = red - weight.real * r, green - weight.real * g, blue - weight.real * b
            r, g, b = cubic(k, t, imaginary)
            red, green, blue = red + weight.imag * r, green + weight.imag * g, blue + weight.imag * b
            power_s, power_p = power_s * z_s, power_p * z_p
            order += 1
        is_open[i] = is_open[i] or (order > 0 and bound > 1.0)
        rgb[3 * i] = red
        rgb[3 * i + 1] = green
        rgb[3 * i + 2] = blue


@inline
def _polarisation(y1: float, y2: float, y3: complex, share: float) -> tuple[float, complex, float]:
    """Return G/2, z and H of one polarisation."""
    into = share * y3.real
    first = y1 + y2
    second = y2 + y3
    second_squared = second.real * second.real + second.imag * second.imag
    contrast = y1 - y2
    inverse = 1.0 / (y1 * second_squared + contrast * contrast * y3.real)
    z = -contrast * (y2 - y3) / (first * second)
    tail = (1.0 + abs(z)) * (y1 * into) * (first * first * inverse) * (second_squared * inverse)
    return 2.0 * y1 * y2 * into * inverse, z, tail
