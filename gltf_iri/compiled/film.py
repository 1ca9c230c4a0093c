"""Compiled twin of `gltf_iri.optics.film`: the reflectance of one film that absorbs nothing.

The same κ, g and h for each angle; sines and cosines of the phase stand for its tangent, so that one
polynomial or two serve both polarisations, and one division.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.refraction import normal_index, normal_index_squared
from gltf_iri.compiled.sincos import sine_of_half_turns, sine_of_octant
from gltf_iri.compiled.two_floats import exact_product, ratio, split, square_root

__all__ = ["film_reflectance"]

Float64 = NDArray[np.float64]

# As in optics/film.py
_NO_INDEX = 1e-150
_GRAZING = 1e-40
_MANY_HALF_TURNS = 4.0
_SHARP = 0.05**2

_VECTOR = 8  # numbers that the widest vector instructions take at once; rows are padded to full vectors


def film_reflectance(
    outside_ior: ArrayLike,
    film_ior: ArrayLike,
    base_index: ArrayLike,
    thickness_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta_1: ArrayLike,
) -> Float64:
    """Return the mean of R_s and R_p of a film that absorbs nothing; all arguments broadcast.

    Where only the wavelength or only the thickness runs along the last axis, what depends on the angle is
    computed once for it.
    """
    n1, n2, thickness, wavelength, c1 = (
        np.asarray(a, dtype=np.float64)
        for a in (outside_ior, film_ior, thickness_nm, wavelength_nm, cos_theta_1)
    )
    n3 = np.asarray(base_index, dtype=np.complex128)
    inputs = [n1, n2, n3.real, n3.imag, c1, thickness, wavelength]
    shape = np.broadcast(*inputs).shape
    one = np.ones(1)
    columns = [one, one]
    for which in (6, 5):
        along = inputs[which]
        others = [a for k, a in enumerate(inputs) if k != which]
        if (
            along.ndim
            and along.size == along.shape[-1]
            and all(not a.ndim or a.shape[-1] == 1 for a in others)
        ):
            columns[6 - which] = along
            inputs[which] = one
            break
    count = columns[0].size * columns[1].size
    rows_shape = (*shape[:-1], 1) if count > 1 else shape
    rows = np.zeros((7, *rows_shape))
    for k, each in enumerate(inputs):
        rows[k] = each
    reflectance = np.zeros(shape)
    lengths = np.zeros((2, count))
    lengths[0], lengths[1] = columns[1], columns[0]
    _write(rows.reshape(7, -1), lengths, reflectance.reshape(rows[0].size, count))
    return reflectance


@loop
def _write(rows: Float64, columns: Float64, reflectance: Float64) -> None:
    count = columns.shape[1]
    padded = -(-count // _VECTOR) * _VECTOR if count > 1 else count
    first, second, whole, line = np.zeros(padded), np.zeros(padded), np.zeros(padded), np.zeros(padded)
    for j in range(count):
        value, low = ratio(columns[0, j], columns[1, j])
        high, rest = split(value)
        first[j], second[j], whole[j] = high, rest + low, value
    most = np.max(whole)
    for i in range(rows.shape[1]):
        n1, n2, n3_real, n3_imag = rows[0, i], rows[1, i], rows[2, i], rows[3, i]
        c1, d, wavelength = rows[4, i], rows[5, i], rows[6, i]
        c1 = _GRAZING if c1 < _GRAZING else c1
        size = math.hypot(n3_real, n3_imag)
        share = 2.0
        if size < _NO_INDEX or math.isinf(size):
            n3_real, n3_imag, size, share = 1.0, 0.0, 1.0, 0.0
        squared, squared_low = normal_index_squared(n2, 0.0, n1, c1)
        sign = -1.0 if squared < 0.0 else 1.0
        if abs(squared) < _GRAZING**2:
            squared, squared_low = _GRAZING**2, 0.0
        q2, q2_low = square_root(abs(squared), sign * squared_low)
        q3_real, q3_imag = normal_index(
            normal_index_squared(n3_real, n3_imag, n1, c1)[0], 2.0 * n3_real * n3_imag
        )
        k_s, h_s, g_s = _coefficients(share, n1 * c1, sign, q2, q3_real, q3_imag)
        # 1/n₃², whose square of the size might underflow
        u, v = n3_real / size / size, -n3_imag / size / size
        u, v = u * u - v * v, 2.0 * u * v
        y3_real, y3_imag = q3_real * u - q3_imag * v, q3_real * v + q3_imag * u
        k_p, h_p, g_p = _coefficients(share, c1 / n1, sign, q2 / (n2 * n2), y3_real, y3_imag)
        twice, twice_low = ratio(2.0 * d, wavelength)
        value, low = exact_product(q2, twice)
        high, rest = split(value)
        rest += low + (q2_low * twice + q2 * twice_low)
        # As there: plain phases are exact enough for few half turns, unless a resonance magnifies them.
        is_short = value * most <= _MANY_HALF_TURNS and not (_is_sharp(h_s, g_s) or _is_sharp(h_p, g_p))
        if sign < 0.0:
            for j in range(padded):
                t = math.tanh(math.pi * (value * whole[j]))
                inside = 1.0 - t * t
                d_s, d_p = (1.0 + g_s * t) ** 2 + h_s * t * t, (1.0 + g_p * t) ** 2 + h_p * t * t
                line[j] = _without(k_s * inside / d_s + k_p * inside / d_p)
        elif g_s == 0.0 and g_p == 0.0:
            for j in range(padded):
                if is_short:  # of the whole row, so that no vector does both
                    near = _less_whole(value * whole[j])
                    far = 0.5 - abs(near)
                else:
                    near, far = _phase(high * first[j], high * second[j] + rest * whole[j])
                sine = sine_of_octant(0.5 * min(abs(near), far))
                small = sine * sine
                large = 1.0 - small
                is_steep = far < 0.25
                sine_squared = large if is_steep else small
                cosine_squared = small if is_steep else large
                d_s, d_p = cosine_squared + h_s * sine_squared, cosine_squared + h_p * sine_squared
                line[j] = _without((k_s * d_p + k_p * d_s) / (d_s * d_p))
        else:
            for j in range(padded):
                if is_short:
                    near = _less_whole(value * whole[j])
                    far = 0.5 - abs(near)
                else:
                    near, far = _phase(high * first[j], high * second[j] + rest * whole[j])
                sine, cosine = sine_of_half_turns(near), sine_of_half_turns(far)
                through_s, through_p = cosine + g_s * sine, cosine + g_p * sine
                d_s = through_s * through_s + h_s * (sine * sine)
                d_p = through_p * through_p + h_p * (sine * sine)
                line[j] = _without((k_s * d_p + k_p * d_s) / (d_s * d_p))
        for j in range(count):
            reflectance[i, j] = line[j]


@inline
def _phase(half_turns: float, more: float) -> tuple[float, float]:
    """Return t = `half_turns` + `more` less whole ones, and ½ − |t|, which keeps its digits at the pole."""
    part = _less_whole(half_turns)
    return part + more, (0.5 - abs(part)) - (-more if part < 0.0 else more)


@inline
def _less_whole(half_turns: float) -> float:
    return float(half_turns - np.rint(half_turns))


@inline
def _is_sharp(h_squared: float, g: float) -> bool:
    """As in optics/film.py: whether a resonance magnifies what rounds the phase."""
    wide = 1.0 + g * g
    return h_squared < _SHARP * (wide * wide) or h_squared * _SHARP > 1.0


@inline
def _without(entering: float) -> float:
    left = 1.0 - entering
    return 0.0 if left < 0.0 else left


@inline
def _coefficients(
    share: float, y1: float, sign: float, y2: float, y3_real: float, y3_imag: float
) -> tuple[float, float, float]:
    """Return share·κ/4, h² and g."""
    # A last bit below 0 would be light from inside; what a real base reflects in total enters it nowhere.
    x3 = y3_real if y3_real > 0.0 else 0.0 * y3_imag
    total, absorbed, inside = y1 + x3, y3_imag * y3_imag, sign * (y2 * y2)
    size = total * total + absorbed
    scale = 1.0 / (y2 * size)
    h = ((inside + y1 * x3) * total + y1 * absorbed) * scale
    return share * y1 * x3 / size, h * h, (y1 * y1 - inside) * y3_imag * scale
