"""Compiled twin of `gltf_iri.optics.bragg_cell`: the constants of lossless mirrors, all rows at once."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.refraction import normal_index_squared

__all__ = ["CONSTANTS", "FADES_IN_1", "FADES_IN_2", "HOST", "write_constants"]

Float64 = NDArray[np.float64]

# Rows of the table: the first six of `bragg_cell.Films`, `bragg_cell.Host` from HOST on, and where light
# fades, 0.0 or 1.0.
HOST = 6
FADES_IN_1 = 10
FADES_IN_2 = 11
CONSTANTS = 12

_NO_NORMAL_INDEX = 1e-75  # that of optics/bragg_cell.py


@loop
def write_constants(given: Float64, constants: Float64) -> bool:
    """Fill `constants` (CONSTANTS, rows); return whether anywhere a host is not n1, or light fades in a film.

    given : (6, rows), n_h, n1, n2, d1 and d2 in nm, cos θ_h, the indices real.
    The host's constants are written only where True is returned.
    """
    count, is_general = given.shape[1], False
    for i in range(count):
        host, n1, n2, c = given[0, i], given[1, i], given[2, i], given[5, i]
        q_1, fades_in_1 = _along_normal(n1, host, c)
        q_2, fades_in_2 = _along_normal(n2, host, c)
        constants[0, i], constants[1, i] = q_1 * given[3, i], q_2 * given[4, i]
        constants[2, i], constants[3, i], constants[4, i], constants[5, i] = _steps(host, n1, n2, q_1, q_2, c)
        constants[FADES_IN_1, i], constants[FADES_IN_2, i] = fades_in_1, fades_in_2
        is_general |= host != n1 or fades_in_1 + fades_in_2 > 0.0
    for i in range(count if is_general else 0):
        host, n1, c = given[0, i], given[1, i], given[5, i]
        q_1, _ = _along_normal(n1, host, c)
        r_s, r_p, through_s, through_p = _step_from_host(host, n1, q_1, c)
        constants[HOST, i], constants[HOST + 1, i] = r_s, r_p
        constants[HOST + 2, i], constants[HOST + 3, i] = through_s, through_p
    return is_general


@inline
def _steps(
    host: float, n1: float, n2: float, q_1: float, q_2: float, c: float
) -> tuple[float, float, float, float]:
    """Return the contrast of s and p, and the imbalance of s and p."""
    n1n1, n2n2 = n1 * n1, n2 * n2
    tangential = host * host * ((1.0 - c) * (1.0 + c))
    contrast, imbalance_s = q_2 / q_1, (0.5 * (n2 - n1) * (n2 + n1)) / (q_1 * q_2)
    brewster = tangential * ((n1n1 + n2n2) / (n1n1 * n2n2)) - 1.0
    return contrast, contrast * (n1n1 / n2n2), imbalance_s, imbalance_s * brewster


@inline
def _step_from_host(host: float, n1: float, q_1: float, c: float) -> tuple[float, float, float, float]:
    """Return r_h1 of s and p, and 1 − r_h1² of s and p."""
    q_h = host * c
    q_h = _NO_NORMAL_INDEX if q_h < _NO_NORMAL_INDEX else q_h
    hh, n1n1 = host * host, n1 * n1
    tangential = hh * ((1.0 - c) * (1.0 + c))
    sum_s, sum_p = q_h + q_1, n1n1 * q_h + hh * q_1
    step = (host - n1) * (host + n1)
    return (
        step / (sum_s * sum_s),
        step * (tangential * (n1n1 + hh) - n1n1 * hh) / (sum_p * sum_p),
        4.0 * q_h * q_1 / (sum_s * sum_s),
        4.0 * (n1n1 * q_h) * (hh * q_1) / (sum_p * sum_p),
    )


@inline
def _along_normal(index: float, host_ior: float, c: float) -> tuple[float, float]:
    """Return |q| of a film, never 0, and 1.0 where light fades in it."""
    squared, _ = normal_index_squared(index, 0.0, host_ior, c)
    q = math.sqrt(abs(squared))
    return (_NO_NORMAL_INDEX if q < _NO_NORMAL_INDEX else q), (1.0 if squared < 0.0 else 0.0)
