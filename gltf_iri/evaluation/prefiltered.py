"""`fourier` averaged over a Gaussian spread of thickness: a film whose thickness varies within a pixel.

A spread of d with standard deviation σ spreads the m-th path difference by s = 2mq₂σ, and the average of Ŝ
over that is the transform of S(ν) exp(−2π²s²ν²) (Belcour & Barla 2017, section 5, Multi-scale Rendering).
They keep it in mip-maps; here the table is read at 33 places 0.35 s apart, and their average is taken. This
trapezoidal rule errs by erfc(5.6/√2) = 2e-8 where it is cut, and at a wavenumber ν by
2 exp(−(2π/0.35 − 2πsν)²/2): below 1e-10 while sν < 1.7, and no order whose average comes near 1e-7 spreads
wider.
"""

from __future__ import annotations

from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.observer import observer_table
from gltf_iri.colour.quadrature import colour_density
from gltf_iri.colour.sensitivity_table import sensitivity_table
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.dispersive import FilmBand, film_bands
from gltf_iri.evaluation.film import Film, Float64
from gltf_iri.evaluation.fourier import FOURIER_TOLERANCE, MAX_ORDERS, THIN_OPD_NM, integrated_band
from gltf_iri.optics.film_series import film_series

__all__ = ["prefiltered_fourier"]

_REACH: Final = 5.6  # standard deviations on either side
_NODES: Final = 33
_STEPS = np.linspace(-_REACH, _REACH, _NODES)
_WEIGHTS = np.exp(-0.5 * _STEPS**2) / np.exp(-0.5 * _STEPS**2).sum()

_DAMPING_STEP_NM: Final = 5.0
_DAMPING_END_NM: Final = 800.0  # 1e-12 of the fringes is left of such a spread

_ROWS_AT_ONCE: Final = 512


def prefiltered_fourier(
    film: Film, thickness_std_nm: ArrayLike, white: White, tolerance: float = FOURIER_TOLERANCE
) -> Float64:
    """Return (..., 3): `fourier` averaged over a Gaussian spread of thickness around the film's own.

    thickness_std_nm : (...), small against the thickness: what the spread puts below 0 is counted as the
    formula has it there.
    """
    spread = np.broadcast_to(np.asarray(thickness_std_nm, dtype=np.float64), film.shape).reshape(-1)
    rgb = np.zeros((spread.size, 3))
    for band in film_bands(film, white):
        for start in range(0, spread.size, _ROWS_AT_ONCE):
            rows = slice(start, start + _ROWS_AT_ONCE)
            colour = _sum_series(band.rows(rows), spread[rows], white, tolerance)
            rgb[rows, band.channels] = colour[:, band.channels]
    return rgb.reshape(*film.shape, 3)


def _sum_series(band: FilmBand, thickness_std_nm: Float64, white: White, tolerance: float) -> Float64:
    table = sensitivity_table(white)
    series = film_series(band.outside_ior, band.film_ior, band.base_index, band.cos_theta_1)
    path = 2.0 * np.sqrt(np.maximum(series.q2_squared, 0.0))
    widest = np.maximum(band.thickness_nm, thickness_std_nm)
    is_open = ~(series.q2_squared > 0.0) | ~(path * widest > THIN_OPD_NM)
    rgb = np.repeat((1.0 - (series.entering[0] + series.entering[1]))[:, None], 3, axis=-1)
    opd_nm, std_nm = path * band.thickness_nm, path * thickness_std_nm

    row = np.flatnonzero(~is_open)
    z: NDArray[Any] = series.ratio[:, row]
    power = 2.0 * series.entering[:, row] * z
    left = series.tail[:, row] * np.abs(z) * (2.0 / tolerance)
    for m in range(1, MAX_ORDERS + 1):
        mean, spread = m * opd_nm[row], m * std_nm[row]
        nearest = np.maximum(mean - _REACH * spread, 0.0)
        bound = (left[0] + left[1]) * np.minimum(table.bound(nearest), _damping(spread, white))
        counts = bound > 1.0
        row, mean, spread, bound = row[counts], mean[counts], spread[counts], bound[counts]
        z, power, left = z[:, counts], power[:, counts], left[:, counts]
        if len(row) == 0:
            break
        sensitivity = np.einsum("k,rkc->rc", _WEIGHTS, table.at(mean[:, None] + spread[:, None] * _STEPS))
        weight = (power[0] + power[1]) * np.minimum(1.0, bound - 1.0)
        rgb[row] -= (weight[:, None] * sensitivity).real
        power = power * z
        left = left * np.abs(z)
    is_open[row] = True
    for r in np.flatnonzero(is_open):
        rgb[r] = _averaged(band.rows(slice(r, r + 1)), float(thickness_std_nm[r]), white)
    return rgb


def _averaged(band: FilmBand, thickness_std_nm: float, white: White) -> Float64:
    """Return the colour (3,) of one film, integrated over wavelengths at every thickness of the rule."""
    thickness_nm = np.abs(band.thickness_nm + thickness_std_nm * _STEPS)
    films = band.rows(np.zeros(_NODES, dtype=np.intp))
    return np.asarray(_WEIGHTS @ integrated_band(films.of_thickness(thickness_nm), white))


def _damping(spread_nm: Float64, white: White) -> Float64:
    """Return at least what a spread of path differences (...) leaves of |Ŝ|, at any path difference."""
    at = np.minimum(spread_nm / _DAMPING_STEP_NM, len(_damping_table(white)) - 1.0)
    return np.asarray(_damping_table(white)[at.astype(np.intp)])


@cache
def _damping_table(white: White) -> Float64:
    """Return max over the channels of ∫ |S| exp(−2π²s²ν²) dν at s = 0, 5, … nm; it falls with s."""
    wavelength_nm = observer_table()[:, 0]
    density = np.abs(colour_density(wavelength_nm, white))
    spread = np.arange(0.0, _DAMPING_END_NM, _DAMPING_STEP_NM)[:, None]
    # Sums over whole nanometres, and a thousandth for what lies between.
    return np.asarray(1.001 * (np.exp(-2.0 * (np.pi * spread / wavelength_nm) ** 2) @ density).max(axis=1))
