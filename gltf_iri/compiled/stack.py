"""Reflected and transmitted power of any coherent stack, compiled: the loop of `gltf_iri.optics.stack`.

Up to 128 evaluations pass a layer side by side, in vector instructions: in real arithmetic where light runs
through a lossless layer, in complex where it fades.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.compiled.exponential import LN2_HIGH, LN2_LOW, LOG2_E, expm1_reduced
from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sincos import sincos_turns

if TYPE_CHECKING:
    from gltf_iri.optics.stack_layers import Layers

__all__ = ["stack_power_compiled"]

Float64 = NDArray[np.float64]

_L: Final = 128  # lanes: evaluations side by side
# As in optics/stack.py
_SCALE_EVERY: Final = 4
_NOTHING: Final = 1e-300

_FADED: Final = 708.0  # e^{−708} stands for anything less: beyond, float64 loses digits

# Rows of the table of media, for each layer: q, 1/q, n² and 1/n², each as real and imaginary part.
_Q, _OVER_Q, _EPSILON, _INVERSE, _MEDIA = 0, 2, 4, 6, 8
# Rows of the lanes: E and G of s, E and G of p, as real and imaginary parts; of both, |field below/above|².
_THROUGH, _FIELDS = 8, 10


def stack_power_compiled(layers: Layers) -> tuple[Float64, Float64, Float64, Float64]:
    """Return R_s, R_p, T_s, T_p, each of `layers.shape`."""
    if 0 in layers.shape:
        nothing = np.zeros(layers.shape)
        return nothing, nothing, nothing, nothing
    shape = (1,) * (3 - len(layers.shape)) + layers.shape
    longest = int(np.argmax(shape))  # is laid along the lanes
    moved = (*shape[:longest], *shape[longest + 1 :], shape[longest])
    parts = np.broadcast_arrays(layers.q, layers.over_q(), layers.epsilon(), layers.over_epsilon())
    media = np.stack([part for each in parts for part in (each.real, each.imag)], axis=1)
    paths = np.stack(np.broadcast_arrays(*layers.paths, np.zeros(()))[:-1] or [np.zeros(())])[:, None]
    fades = np.array([bool(np.any(q.imag != 0.0)) for q in layers.q])
    powers = np.zeros((4, int(np.prod(moved[:-2])), *moved[-2:]))
    _powers(_laid_out(media, longest, moved), _laid_out(paths, longest, moved), fades, powers)
    results = [np.moveaxis(each.reshape(moved), -1, longest).reshape(layers.shape) for each in powers]
    return results[0], results[1], results[2], results[3]


def _laid_out(table: Float64, longest: int, moved: tuple[int, ...]) -> Float64:
    """Return (layers, parts, ...) as (layers, parts, a, b, c), `longest` last; axes of 1 stay so."""
    dimensions = table.shape[2:]
    padded = table.reshape(*table.shape[:2], *(1,) * (len(moved) - len(dimensions)), *dimensions)
    padded = np.moveaxis(padded, 2 + longest, -1)
    first = padded.shape[2:-2]
    if max(first) > 1:
        padded = np.broadcast_to(padded, (*table.shape[:2], *moved[:-2], *padded.shape[-2:]))
    return np.ascontiguousarray(padded.reshape(*table.shape[:2], -1, *padded.shape[-2:]))


@loop
def _powers(media: Float64, paths: Float64, fades: NDArray[np.bool_], powers: Float64) -> None:
    fields = np.zeros(_FIELDS * _L)
    medium = np.zeros(_MEDIA * _L)
    outside = np.zeros(_MEDIA * _L)
    path = np.zeros(_L)
    wave = np.zeros(6 * _L)
    bits = np.zeros(_L, np.int64)
    last = media.shape[0] - 1
    for a in range(powers.shape[1]):
        for b in range(powers.shape[2]):
            for start in range(0, powers.shape[3], _L):
                count = min(_L, powers.shape[3] - start)
                _fill(outside, media, 0, 1, a, b, start, count)
                _fill(medium, media, last, 1, a, b, start, count)
                _start(fields, medium, count)
                for layer in range(last - 1, 0, -1):
                    _fill(path, paths, layer - 1, 1, a, b, start, count)
                    if fades[layer]:
                        _fill(medium, media, layer, 1, a, b, start, count)
                        _fading_wave(wave, bits, fields, medium, path, count)
                        _pass_fading(fields, medium, wave, count)
                    else:
                        _fill(medium, media, layer, 2, a, b, start, count)
                        _pass_running(fields, medium, path, count)
                    if layer % _SCALE_EVERY == 0:
                        _scale(fields, count)
                _fill(medium, media, last, 1, a, b, start, count)
                _finish(fields, outside, medium, count)
                _store(powers, fields, a, b, start, count)


@loop
def _fill(
    out: Float64, table: Float64, layer: int, step: int, a: int, b: int, start: int, count: int
) -> None:
    """Lay the parts of a layer, each `step`-th, along the lanes; axes of 1 stand for all."""
    a = a if table.shape[2] > 1 else 0
    b = b if table.shape[3] > 1 else 0
    for part in range(0, table.shape[1], step):
        lanes = out[part * _L : part * _L + count]
        row = table[layer, part, a, b]
        if row.size == 1:
            value = row[0]
            for i in range(count):
                lanes[i] = value
        else:
            row = row[start : start + count]
            for i in range(count):
                lanes[i] = row[i]


@loop
def _store(powers: Float64, fields: Float64, a: int, b: int, start: int, count: int) -> None:
    for which in range(powers.shape[0]):
        lanes = fields[which * _L : which * _L + count]
        row = powers[which, a, b, start : start + count]
        for i in range(count):
            row[i] = lanes[i]


@loop
def _start(fields: Float64, medium: Float64, count: int) -> None:
    for i in range(count):
        q_r, q_i, u_r, u_i = (
            medium[_Q * _L + i],
            medium[(_Q + 1) * _L + i],
            medium[_INVERSE * _L + i],
            medium[(_INVERSE + 1) * _L + i],
        )
        fields[i], fields[_L + i], fields[2 * _L + i], fields[3 * _L + i] = 1.0, 0.0, q_r, q_i
        fields[4 * _L + i], fields[5 * _L + i] = 1.0, 0.0
        fields[6 * _L + i], fields[7 * _L + i] = q_r * u_r - q_i * u_i, q_r * u_i + q_i * u_r
        fields[_THROUGH * _L + i], fields[(_THROUGH + 1) * _L + i] = 1.0, 1.0


@loop
def _pass_running(fields: Float64, medium: Float64, path: Float64, count: int) -> None:
    for i in range(count):
        sine, cosine = sincos_turns(path[i] * medium[_Q * _L + i])
        forward = sine * medium[_OVER_Q * _L + i] if medium[_Q * _L + i] != 0.0 else 2.0 * np.pi * path[i]
        backward = sine * medium[_Q * _L + i]
        E_r, E_i, G_r, G_i = fields[i], fields[_L + i], fields[2 * _L + i], fields[3 * _L + i]
        fields[i], fields[_L + i] = cosine * E_r + forward * G_i, cosine * E_i - forward * G_r
        fields[2 * _L + i], fields[3 * _L + i] = cosine * G_r + backward * E_i, cosine * G_i - backward * E_r
        forward, backward = forward * medium[_EPSILON * _L + i], backward * medium[_INVERSE * _L + i]
        E_r, E_i, G_r, G_i = fields[4 * _L + i], fields[5 * _L + i], fields[6 * _L + i], fields[7 * _L + i]
        fields[4 * _L + i], fields[5 * _L + i] = cosine * E_r + forward * G_i, cosine * E_i - forward * G_r
        fields[6 * _L + i], fields[7 * _L + i] = cosine * G_r + backward * E_i, cosine * G_i - backward * E_r


@loop
def _fading_wave(
    wave: Float64, bits: Any, fields: Float64, medium: Float64, path: Float64, count: int
) -> None:
    """Set cos β, −i sin β/q and −iq sin β, all times e^{−Im β}; take e^{−2 Im β} into what comes through."""
    for i in range(count):
        twice = 4.0 * np.pi * path[i] * medium[(_Q + 1) * _L + i]
        twice = _FADED if twice > _FADED else twice
        wave[i] = twice
        bits[i] = np.int64(1023.0 - np.rint(LOG2_E * twice)) << 52  # a power of two, by its exponent
    powers_of_two = bits.view(np.float64)
    for i in range(count):
        whole = np.rint(LOG2_E * wave[i])
        r = (whole * LN2_HIGH - wave[i]) + whole * LN2_LOW
        low = expm1_reduced(r)
        scale = powers_of_two[i]
        decay_squared = scale + scale * low
        odd = -0.5 * ((scale - 1.0) + scale * low)
        even = 0.5 * (1.0 + decay_squared)
        sine, cosine = sincos_turns(path[i] * medium[_Q * _L + i])
        wave[i], wave[_L + i] = cosine * even, -sine * odd
        s_r, s_i = sine * even, cosine * odd
        o_r, o_i = medium[_OVER_Q * _L + i], medium[(_OVER_Q + 1) * _L + i]
        is_flat = (o_r == 0.0) & (o_i == 0.0)
        wave[2 * _L + i] = s_r * o_i + s_i * o_r
        wave[3 * _L + i] = -2.0 * np.pi * path[i] if is_flat else s_i * o_i - s_r * o_r
        q_r, q_i = medium[_Q * _L + i], medium[(_Q + 1) * _L + i]
        wave[4 * _L + i], wave[5 * _L + i] = s_r * q_i + s_i * q_r, s_i * q_i - s_r * q_r
        fields[_THROUGH * _L + i] *= decay_squared
        fields[(_THROUGH + 1) * _L + i] *= decay_squared


@loop
def _pass_fading(fields: Float64, medium: Float64, wave: Float64, count: int) -> None:
    for i in range(count):
        c_r, c_i, f_r, f_i, b_r, b_i = (
            wave[i],
            wave[_L + i],
            wave[2 * _L + i],
            wave[3 * _L + i],
            wave[4 * _L + i],
            wave[5 * _L + i],
        )
        E_r, E_i, G_r, G_i = fields[i], fields[_L + i], fields[2 * _L + i], fields[3 * _L + i]
        fields[i] = (c_r * E_r - c_i * E_i) + (f_r * G_r - f_i * G_i)
        fields[_L + i] = (c_r * E_i + c_i * E_r) + (f_r * G_i + f_i * G_r)
        fields[2 * _L + i] = (c_r * G_r - c_i * G_i) + (b_r * E_r - b_i * E_i)
        fields[3 * _L + i] = (c_r * G_i + c_i * G_r) + (b_r * E_i + b_i * E_r)
        d_r, d_i = medium[_EPSILON * _L + i], medium[(_EPSILON + 1) * _L + i]
        u_r, u_i = medium[_INVERSE * _L + i], medium[(_INVERSE + 1) * _L + i]
        f_r, f_i = d_r * f_r - d_i * f_i, d_r * f_i + d_i * f_r
        b_r, b_i = u_r * b_r - u_i * b_i, u_r * b_i + u_i * b_r
        E_r, E_i, G_r, G_i = fields[4 * _L + i], fields[5 * _L + i], fields[6 * _L + i], fields[7 * _L + i]
        fields[4 * _L + i] = (c_r * E_r - c_i * E_i) + (f_r * G_r - f_i * G_i)
        fields[5 * _L + i] = (c_r * E_i + c_i * E_r) + (f_r * G_i + f_i * G_r)
        fields[6 * _L + i] = (c_r * G_r - c_i * G_i) + (b_r * E_r - b_i * E_i)
        fields[7 * _L + i] = (c_r * G_i + c_i * G_r) + (b_r * E_i + b_i * E_r)


@loop
def _scale(fields: Float64, count: int) -> None:
    for first in (0, 4):
        through = _THROUGH + first // 4
        for i in range(count):
            electric = max(abs(fields[first * _L + i]), abs(fields[(first + 1) * _L + i]))
            scale = 1.0 / max(
                electric, max(abs(fields[(first + 2) * _L + i]), abs(fields[(first + 3) * _L + i]))
            )
            for part in range(4):
                fields[(first + part) * _L + i] *= scale
            fields[through * _L + i] *= scale * scale


@loop
def _finish(fields: Float64, outside: Float64, medium: Float64, count: int) -> None:
    """Set R_s, R_p, T_s and T_p in place of the first fields."""
    for i in range(count):
        y_1, y_3 = outside[i], medium[i]
        R_s, T_s = _powers_of(
            y_1, y_3, fields[i], fields[_L + i], fields[2 * _L + i], fields[3 * _L + i], fields[8 * _L + i]
        )
        y_1 = y_1 * outside[_INVERSE * _L + i]
        y_3 = y_3 * medium[_INVERSE * _L + i] - medium[_L + i] * medium[(_INVERSE + 1) * _L + i]
        R_p, T_p = _powers_of(
            y_1,
            y_3,
            fields[4 * _L + i],
            fields[5 * _L + i],
            fields[6 * _L + i],
            fields[7 * _L + i],
            fields[9 * _L + i],
        )
        fields[i], fields[_L + i], fields[2 * _L + i], fields[3 * _L + i] = R_s, R_p, T_s, T_p


@inline
def _powers_of(
    y_1: float, y_3: float, E_r: float, E_i: float, G_r: float, G_i: float, through: float
) -> tuple[float, float]:
    t_r, t_i, o_r, o_i = y_1 * E_r + G_r, y_1 * E_i + G_i, y_1 * E_r - G_r, y_1 * E_i - G_i
    size = max(abs(t_r), abs(t_i))
    is_nothing = size < _NOTHING
    shrink = 1.0 / (1.0 if is_nothing else size)
    t_r, t_i, o_r, o_i = t_r * shrink, t_i * shrink, o_r * shrink, o_i * shrink
    share = 1.0 / (1.0 if is_nothing else t_r * t_r + t_i * t_i)
    R = (o_r * o_r + o_i * o_i) * share
    T = 4.0 * (y_1 * shrink) * share * shrink * through * y_3
    R = 1.0 if R > 1.0 else R
    return 0.0 if is_nothing else R, 1.0 if is_nothing else T
