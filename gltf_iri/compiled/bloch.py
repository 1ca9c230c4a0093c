"""Compiled twin of gltf_iri/optics/bloch.py and of the sums in gltf_iri/evaluation/bloch.py.

Many mirrors stand side by side for each wavenumber, so that all but the search for signs runs in vector
instructions; compiled/bloch_gaps.py treats the gaps found.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from gltf_iri.compiled.bloch_gaps import GAPS, add_gaps, add_thick_gaps, bit_count, note_gap
from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sincos import sincos_turns

__all__ = ["bloch_colours"]

# Scratch is laid out by rows of fixed length: the compiler then sees that they do not overlap. That for so
# many mirrors stays in a core's first cache.
LANES = 128

_FADED = 1e8  # as in optics/bloch.py
_FADE_MAX = 20.0
_NOTHING = 1e-72


@inline
def _root(re: float, im: float) -> tuple[float, float]:
    """Return a square root; either will do."""
    large = np.sqrt(0.5 * (np.sqrt(re * re + im * im) + abs(re)))
    small = 0.5 * im / large
    return large if re >= 0.0 else small, small if re >= 0.0 else large


@loop
def _films(count: int, at_per_nm: float, shared: Any, films: Any) -> None:
    """Fill films (12, lanes): sin φ₁ cos φ₂, cos φ₁ sin φ₂, the sines', the cosines' product and sin φ₂ above
    the real axis, real and imaginary parts; then the first two on it.

    shared : (8, lanes): the films' paths, then cosh and sinh of their fading.
    """
    for i in range(count):
        sin_1, cos_1 = sincos_turns(shared[i] * at_per_nm)
        sin_2, cos_2 = sincos_turns(shared[1 * LANES + i] * at_per_nm)
        grown_1, odd_1, grown_2, odd_2 = (
            shared[2 * LANES + i],
            shared[3 * LANES + i],
            shared[4 * LANES + i],
            shared[5 * LANES + i],
        )
        s1r, s1i, c1r, c1i = sin_1 * grown_1, cos_1 * odd_1, cos_1 * grown_1, -sin_1 * odd_1
        s2r, s2i, c2r, c2i = sin_2 * grown_2, cos_2 * odd_2, cos_2 * grown_2, -sin_2 * odd_2
        films[i], films[1 * LANES + i] = s1r * c2r - s1i * c2i, s1r * c2i + s1i * c2r
        films[2 * LANES + i], films[3 * LANES + i] = c1r * s2r - c1i * s2i, c1r * s2i + c1i * s2r
        films[4 * LANES + i], films[5 * LANES + i] = s1r * s2r - s1i * s2i, s1r * s2i + s1i * s2r
        films[6 * LANES + i], films[7 * LANES + i] = c1r * c2r - c1i * c2i, c1r * c2i + c1i * c2r
        films[8 * LANES + i], films[9 * LANES + i] = s2r, s2i
        films[10 * LANES + i], films[11 * LANES + i] = sin_1 * cos_2, cos_1 * sin_2


@loop
def _angles(count: int, cells: Any, films: Any, work: Any, signs: Any) -> None:
    """Fill work (2, 8, lanes): s, e^{2iθ}, b and b_r of both polarisations; signs (2, lanes): b on the axis.

    cells : (2, 6, lanes): ½Ω, Z, r, 1 − r², κ, whether opaque.
    """
    for p in range(2):
        for i in range(count):
            omega_half, imbalance, kappa = (
                cells[(6 * p + 0) * LANES + i],
                cells[(6 * p + 1) * LANES + i],
                cells[(6 * p + 4) * LANES + i],
            )
            mixed_r, mixed_i, sines_r, sines_i = (
                films[2 * LANES + i],
                films[3 * LANES + i],
                films[4 * LANES + i],
                films[5 * LANES + i],
            )
            x_r, x_i = (
                films[6 * LANES + i] - omega_half * sines_r,
                films[7 * LANES + i] - omega_half * sines_i,
            )
            off_r, off_i = imbalance * films[8 * LANES + i], imbalance * films[9 * LANES + i]
            sum_r, sum_i = films[i] + omega_half * mixed_r, films[1 * LANES + i] + omega_half * mixed_i
            is_weak = off_r * off_r + off_i * off_i < 1.0
            low_r = sum_r - off_r if is_weak else 1.0 - x_r
            low_i = sum_i - off_i if is_weak else -x_i
            high_r = sum_r + off_r if is_weak else 1.0 + x_r
            high_i = sum_i + off_i if is_weak else x_i
            s_r, s_i = _root(low_r * high_r - low_i * high_i, low_r * high_i + low_i * high_r)
            turn = -1.0 if x_i * s_r - x_r * s_i > 0.0 else 1.0
            s_r, s_i = turn * s_r, turn * s_i
            fading = 1.0 if x_r * x_r + x_i * x_i < _FADED * _FADED else 0.0
            off = -cells[(6 * p + 2) * LANES + i] * imbalance
            work[(8 * p + 0) * LANES + i], work[(8 * p + 1) * LANES + i] = s_r, s_i
            root_r, root_i = fading * (x_r - s_i), fading * (x_i + s_r)
            work[(8 * p + 2) * LANES + i] = root_r * root_r - root_i * root_i
            work[(8 * p + 3) * LANES + i] = 2.0 * root_r * root_i
            work[(8 * p + 4) * LANES + i], work[(8 * p + 5) * LANES + i] = (
                films[i] + kappa * mixed_r,
                films[1 * LANES + i] + kappa * mixed_i,
            )
            work[(8 * p + 6) * LANES + i], work[(8 * p + 7) * LANES + i] = off * sines_r, off * sines_i
            signs[p * LANES + i] = films[10 * LANES + i] + kappa * films[11 * LANES + i]


@inline
def _bit_of_power(
    exponent: int, bit: int, base_r: float, base_i: float, z_r: float, z_i: float
) -> tuple[float, float, float, float]:
    """Return base² and z, times the base where the exponent has that bit."""
    is_set = (exponent >> bit) & 1 == 1
    new_r = z_r * base_r - z_i * base_i if is_set else z_r
    new_i = z_r * base_i + z_i * base_r if is_set else z_i
    return base_r * base_r - base_i * base_i, 2.0 * base_r * base_i, new_r, new_i


@loop
def _powers(count: int, bits: int, exponents: Any, shared: Any, work: Any, z: Any) -> None:
    """Fill z (2, 2, lanes) with e^{2iNθ}; shared[6] is 0 where it has faded, else 1."""
    for p in range(2):
        for i in range(count):
            z[2 * p * LANES + i], z[(2 * p + 1) * LANES + i] = shared[6 * LANES + i], 0.0
        for bit in range(0, bits, 2):
            for i in range(count):
                b_r, b_i = work[(8 * p + 2) * LANES + i], work[(8 * p + 3) * LANES + i]
                # What has faded becomes 0 before its squares become denormal, and slow.
                stays = 1.0 if b_r * b_r + b_i * b_i > _NOTHING else 0.0
                b_r, b_i = stays * b_r, stays * b_i
                z_r, z_i = z[2 * p * LANES + i], z[(2 * p + 1) * LANES + i]
                b_r, b_i, z_r, z_i = _bit_of_power(exponents[i], bit, b_r, b_i, z_r, z_i)
                b_r, b_i, z_r, z_i = _bit_of_power(exponents[i], bit + 1, b_r, b_i, z_r, z_i)
                work[(8 * p + 2) * LANES + i], work[(8 * p + 3) * LANES + i] = b_r, b_i
                z[2 * p * LANES + i], z[(2 * p + 1) * LANES + i] = z_r, z_i


@loop
def _add_samples(count: int, weights: Any, cells: Any, work: Any, z: Any, rgb: Any) -> None:
    """Add Q = 1 − F of one wavenumber to rgb (3, lanes); weights (2, 3) of Re Q and Im Q."""
    for p in range(2):
        for i in range(count):
            s_r, s_i, b_r, b_i = (
                work[(8 * p + 0) * LANES + i],
                work[(8 * p + 1) * LANES + i],
                work[(8 * p + 4) * LANES + i],
                work[(8 * p + 5) * LANES + i],
            )
            h_r, h_i, z_r, z_i = (
                work[(8 * p + 6) * LANES + i],
                work[(8 * p + 7) * LANES + i],
                z[(2 * p + 0) * LANES + i],
                z[(2 * p + 1) * LANES + i],
            )
            even_r, even_i = s_r * (1.0 + z_r) - s_i * z_i, s_r * z_i + s_i * (1.0 + z_r)
            odd_r, odd_i = 1.0 - z_r, -z_i
            # s² + b_r² − i b_r b
            k_r = s_r * s_r - s_i * s_i + h_r * h_r - h_i * h_i + (h_r * b_i + h_i * b_r)
            k_i = 2.0 * (s_r * s_i + h_r * h_i) - (h_r * b_r - h_i * b_i)
            n_r = even_r * b_r - even_i * b_i + k_r * odd_r - k_i * odd_i
            n_i = even_r * b_i + even_i * b_r + k_r * odd_i + k_i * odd_r
            w_r, w_i = b_r - h_i, b_i + h_r
            t_r = even_r + w_r * odd_r - w_i * odd_i
            t_i = even_i + w_r * odd_i + w_i * odd_r
            d_r, d_i = b_r * t_r - b_i * t_i, b_r * t_i + b_i * t_r
            share = cells[(6 * p + 3) * LANES + i] / (d_r * d_r + d_i * d_i)
            is_opaque = cells[(6 * p + 5) * LANES + i] > 0.0
            q_r = 1.0 if is_opaque else 1.0 - share * (n_r * d_r + n_i * d_i)
            q_i = 0.0 if is_opaque else -share * (n_i * d_r - n_r * d_i)
            rgb[i] += weights[0, 0] * q_r + weights[1, 0] * q_i
            rgb[1 * LANES + i] += weights[0, 1] * q_r + weights[1, 1] * q_i
            rgb[2 * LANES + i] += weights[0, 2] * q_r + weights[1, 2] * q_i


@loop
def _add_samples_of(
    begin: int,
    lanes: int,
    paths: Any,
    cells: Any,
    numbers: Any,
    grid: Any,
    weights: Any,
    signs: Any,
    rgb: Any,
) -> None:
    """Add the samples of `lanes` mirrors from `begin` on; fill signs (k, 2 LANES) with b on the axis."""
    first, step, height = grid
    shared, films, constants = np.zeros(7 * LANES), np.zeros(12 * LANES), np.zeros(12 * LANES)
    work, z, colour = np.zeros(16 * LANES), np.zeros(4 * LANES), np.zeros(3 * LANES)
    exponents = np.zeros(LANES, np.int64)
    for p in range(2):
        for j in range(6):
            for i in range(lanes):
                constants[(6 * p + j) * LANES + i] = cells[j, p, begin + i]
    for i in range(lanes):
        path_1, path_2, number = paths[0, begin + i], paths[1, begin + i], numbers[begin + i]
        fade_1, fade_2 = 2.0 * np.pi * height * path_1, 2.0 * np.pi * height * path_2
        stays = number * (fade_1 + fade_2) < _FADE_MAX
        grown_1, grown_2 = np.exp(min(fade_1, _FADE_MAX)), np.exp(min(fade_2, _FADE_MAX))
        exponents[i] = number if stays else 0
        shared[i], shared[LANES + i], shared[6 * LANES + i] = path_1, path_2, 1.0 if stays else 0.0
        shared[2 * LANES + i], shared[3 * LANES + i] = (
            0.5 * (grown_1 + 1.0 / grown_1),
            0.5 * (grown_1 - 1.0 / grown_1),
        )
        shared[4 * LANES + i], shared[5 * LANES + i] = (
            0.5 * (grown_2 + 1.0 / grown_2),
            0.5 * (grown_2 - 1.0 / grown_2),
        )
    bits = bit_count(exponents, lanes)
    for k in range(weights.shape[0]):
        _films(lanes, first + step * k, shared, films)
        _angles(lanes, constants, films, work, signs[k])
        _powers(lanes, bits, exponents, shared, work, z)
        _add_samples(lanes, weights[k], constants, work, z, colour)
    for i in range(lanes):
        for c in range(3):
            rgb[begin + i, c] += 0.5 * colour[c * LANES + i]


@loop
def bloch_colours(
    paths: Any, scans: Any, cells: Any, numbers: Any, grid: Any, weights: Any, gap_weights: Any, rgb: Any
) -> None:
    """Add to rgb (n, 3) the colours of n mirrors, s and p averaged.

    paths : (2, n) in nm. scans : (n,), steps of the scan to one of the grid. cells : (6, 2, n) as in
    optics/bloch.py. numbers : (n,), N. grid : first 1/λ, step and height, 1/nm. weights : (k, 2, 3) and
    gap_weights : (m, 3) of gltf_iri/colour/wavenumber_rule.py.
    """
    samples, count = weights.shape[0], numbers.shape[0]
    signs, changes = np.zeros((samples, 2 * LANES)), np.zeros(2 * LANES * samples + 1, np.int64)
    rows, exponents, gaps = np.zeros(GAPS, np.int64), np.zeros(GAPS, np.int64), np.zeros(10 * GAPS)
    for begin in range(0, count, LANES):
        lanes = min(LANES, count - begin)
        _add_samples_of(begin, lanes, paths, cells, numbers, grid, weights, signs, rgb)
        changed = 0
        for p in range(2):
            for k in range(samples - 1):
                for i in range(p * LANES, p * LANES + lanes):
                    changes[changed] = k * 2 * LANES + i
                    changed += (signs[k, i] < 0.0) != (signs[k + 1, i] < 0.0)
        found = 0
        for j in range(changed):
            k, i = divmod(changes[j], 2 * LANES)
            p, lane = divmod(i, LANES)
            row = begin + lane
            if scans[row] > 1:
                continue
            note_gap(found, row, p, float(k), signs[k, i], signs[k + 1, i], 1.0, paths, cells, gaps)
            rows[found], exponents[found] = row, 2 * numbers[row]
            found += 1
            if found == GAPS:
                add_gaps(found, grid, rows, exponents, gaps, gap_weights, rgb)
                found = 0
        add_gaps(found, grid, rows, exponents, gaps, gap_weights, rgb)
        for row in range(begin, begin + lanes):
            if scans[row] > 1:
                add_thick_gaps(
                    row,
                    scans[row],
                    samples,
                    paths,
                    cells,
                    numbers[row],
                    grid,
                    rows,
                    exponents,
                    gaps,
                    gap_weights,
                    rgb,
                )
