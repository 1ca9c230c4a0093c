"""`fourier` averaged over a Gaussian spread of thickness: a film whose thickness varies within a pixel.

A spread of d with standard deviation σ spreads the m-th path difference by s = 2mq₂σ, and the average of Ŝ
over that is the transform of S(ν) exp(−2π²s²ν²) (Belcour & Barla 2017, section 5, Multi-scale Rendering),
which `gltf_iri.colour.spread_table` has. Twin: shaders/optics/fourier_spread.glsl.

Films that the series does not suit are integrated over wavelengths at 33 thicknesses 0.35 σ apart.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.spaces import White
from gltf_iri.colour.spread_table import spread_table
from gltf_iri.evaluation.dispersive import FilmBand, film_bands
from gltf_iri.evaluation.film import Film, Float64
from gltf_iri.evaluation.fourier import FOURIER_TOLERANCE, MAX_ORDERS, THIN_OPD_NM, integrated_band
from gltf_iri.optics.film_series import film_series

__all__ = ["prefiltered_fourier"]

# A trapezoidal rule over the Gaussian, which errs by erfc(5.6/√2) = 2e-8 where it is cut.
_STEPS = np.linspace(-5.6, 5.6, 33)
_WEIGHTS = np.exp(-0.5 * _STEPS**2) / np.exp(-0.5 * _STEPS**2).sum()

_ROWS_AT_ONCE: Final = 2048  # keeps a block's temporaries in a core's cache
_AVERAGED_AT_ONCE: Final = 512


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
    table = spread_table(white)
    series = film_series(band.outside_ior, band.film_ior, band.base_index, band.cos_theta_1)
    path = 2.0 * np.sqrt(np.maximum(series.q2_squared, 0.0))
    widest = np.maximum(band.thickness_nm, thickness_std_nm)
    is_open = ~(series.q2_squared > 0.0) | ~(path * widest > THIN_OPD_NM)
    rgb = np.repeat((1.0 - (series.entering[0] + series.entering[1]))[:, None], 3, axis=-1)
    opd_nm, std_nm = path * band.thickness_nm, path * thickness_std_nm

    row = np.flatnonzero(~is_open)
    z: NDArray[Any] = series.ratio[:, row]
    real_only = not np.iscomplexobj(z)
    power = 2.0 * series.entering[:, row] * z
    left = series.tail[:, row] * np.abs(z) * (2.0 / tolerance)
    for m in range(1, MAX_ORDERS + 1):
        mean, spread = m * opd_nm[row], m * std_nm[row]
        bound = (left[0] + left[1]) * table.bound(mean, spread)
        counts = bound > 1.0
        row, mean, spread, bound = row[counts], mean[counts], spread[counts], bound[counts]
        z, power, left = z[:, counts], power[:, counts], left[:, counts]
        if len(row) == 0:
            break
        sensitivity = table.at(mean, spread, real_only=real_only)
        weight = (power[0] + power[1]) * np.minimum(1.0, bound - 1.0)
        rgb[row] -= (weight[:, None] * sensitivity).real
        power = power * z
        left = left * np.abs(z)
    is_open[row] = True
    rest = np.flatnonzero(is_open)
    for start in range(0, len(rest), _AVERAGED_AT_ONCE):
        rows = rest[start : start + _AVERAGED_AT_ONCE]
        rgb[rows] = _averaged(band.rows(rows), thickness_std_nm[rows], white)
    return rgb


def _averaged(band: FilmBand, thickness_std_nm: Float64, white: White) -> Float64:
    """Return the colours (r, 3) of films integrated over wavelengths at every thickness of the rule."""
    thickness_nm = np.abs(band.thickness_nm[:, None] + thickness_std_nm[:, None] * _STEPS)
    films = band.rows(np.repeat(np.arange(len(thickness_nm)), len(_STEPS)))
    rgb = integrated_band(films.of_thickness(thickness_nm.reshape(-1)), white)
    return np.asarray(np.einsum("k,rkc->rc", _WEIGHTS, rgb.reshape(*thickness_nm.shape, 3)))
