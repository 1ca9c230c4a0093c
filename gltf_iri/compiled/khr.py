"""Method `khr` in compiled loops. Twin: gltf_iri/evaluation/khr.py, which states the text's formula."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.sensitivity import GAUSSIANS
from gltf_iri.colour.spaces import XYZ_TO_REC709
from gltf_iri.compiled.exponential import exp_negative
from gltf_iri.compiled.loops import inline, loop
from gltf_iri.compiled.sincos import sincos_turns

__all__ = ["iridescent_fresnel_khr"]

Float64 = NDArray[np.float64]

_AMPLITUDE = tuple(g.amplitude for g in GAUSSIANS)
_PER_WAVELENGTH = tuple(1.0 / g.wavelength_nm for g in GAUSSIANS)
_PER_LENGTH = tuple(1.0 / g.length_nm for g in GAUSSIANS)
_MATRIX = tuple(float(value) for value in XYZ_TO_REC709.ravel())
_F0_OFFSET = 0.0001
_R123_MIN, _R123_MAX = 1e-5, 0.9999


@loop
def iridescent_fresnel_khr(
    outside_ior: Float64,
    film_ior: Float64,
    base_f0: Float64,
    thickness_nm: Float64,
    cos_theta_1: Float64,
    rgb: Float64,
) -> None:
    """Write the text's reflectance of r films into `rgb` (3r,); base_f0 (3r,), all else (r,), contiguous."""
    # Flat arrays: the compiler finds no bounds for two-dimensional ones and then uses no vectors.
    for i in range(len(outside_ior)):
        n1 = outside_ior[i]
        n2 = film_ior[i]
        c1 = cos_theta_1[i]
        ratio = n1 / n2
        cos2_sq = 1.0 - ratio * ratio * (1.0 - c1 * c1)
        c2 = math.sqrt(0.0 if cos2_sq < 0.0 else cos2_sq)
        contrast = (n2 - n1) / (n2 + n1)
        f0 = contrast * contrast
        R12 = f0 + (1.0 - f0) * _fifth_power(1.0 - c1)
        T121 = 1.0 - R12
        opd_nm = 2.0 * n2 * thickness_nm[i] * c2
        grazing = _fifth_power(1.0 - c2)
        # cos(x + mφ) with φ a multiple of π: its sign.
        sign = 1.0 if n2 < n1 else -1.0
        r_mean, r_first, r_second, r_sign = _channel(base_f0[3 * i], n2, R12, T121, grazing, sign)
        g_mean, g_first, g_second, g_sign = _channel(base_f0[3 * i + 1], n2, R12, T121, grazing, sign)
        b_mean, b_first, b_second, b_sign = _channel(base_f0[3 * i + 2], n2, R12, T121, grazing, sign)
        x = r_sign * (_lobe(opd_nm, 0) + _lobe(opd_nm, 3))
        y = g_sign * _lobe(opd_nm, 1)
        z = b_sign * _lobe(opd_nm, 2)
        opd_nm = 2.0 * opd_nm
        x2 = _lobe(opd_nm, 0) + _lobe(opd_nm, 3)
        y2 = _lobe(opd_nm, 1)
        z2 = _lobe(opd_nm, 2)
        red = r_mean + r_first * (_MATRIX[0] * x + _MATRIX[1] * y + _MATRIX[2] * z)
        red += r_second * (_MATRIX[0] * x2 + _MATRIX[1] * y2 + _MATRIX[2] * z2)
        green = g_mean + g_first * (_MATRIX[3] * x + _MATRIX[4] * y + _MATRIX[5] * z)
        green += g_second * (_MATRIX[3] * x2 + _MATRIX[4] * y2 + _MATRIX[5] * z2)
        blue = b_mean + b_first * (_MATRIX[6] * x + _MATRIX[7] * y + _MATRIX[8] * z)
        blue += b_second * (_MATRIX[6] * x2 + _MATRIX[7] * y2 + _MATRIX[8] * z2)
        is_total = cos2_sq < 0.0
        rgb[3 * i] = 1.0 if is_total else (0.0 if red < 0.0 else red)
        rgb[3 * i + 1] = 1.0 if is_total else (0.0 if green < 0.0 else green)
        rgb[3 * i + 2] = 1.0 if is_total else (0.0 if blue < 0.0 else blue)


@inline
def _channel(
    base_f0: float, n2: float, R12: float, T121: float, grazing: float, sign: float
) -> tuple[float, float, float, float]:
    """Return C₀, 2C₁, 2C₂ and cos φ of one channel."""
    root = math.sqrt(base_f0 + _F0_OFFSET)
    base_ior = (1.0 + root) / (1.0 - root)
    contrast = (base_ior - n2) / (base_ior + n2)
    f0 = contrast * contrast
    R23 = f0 + (1.0 - f0) * grazing
    R123 = R12 * R23
    R123 = _R123_MIN if R123 < _R123_MIN else (_R123_MAX if R123 > _R123_MAX else R123)
    r123 = math.sqrt(R123)
    Rs = T121 * T121 * R23 / (1.0 - R123)
    first = 2.0 * (Rs - T121) * r123
    return R12 + Rs, first, first * r123, -sign if base_ior < n2 else sign


@inline
def _lobe(opd_nm: float, lobe: int) -> float:
    _, cosine = sincos_turns(opd_nm * _PER_WAVELENGTH[lobe])
    x = opd_nm * _PER_LENGTH[lobe]
    return _AMPLITUDE[lobe] * cosine * exp_negative(-(x * x))


@inline
def _fifth_power(x: float) -> float:
    square = x * x
    return square * square * x
