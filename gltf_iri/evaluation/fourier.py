"""Method `fourier`: the film's Fourier series, integrated over the spectrum term by term.

    R_j = 1 − Σ_{s,p} G/2 (1 + 2 Σ_{m ≥ 1} Re(z^m Ŝ_j(mD)))

Belcour & Barla 2017, Eq. 10, with G, z, H and D of `optics/film_series.py`: interfaces are exact, polarised
and with their phases; Ŝ is tabulated. How many terms a film gets follows from a bound of what is left out,

    Σ_{k ≥ m} |term k| ≤ b_m = Σ_{s,p} H |z|^m · sup_{D′ ≥ mD} |Ŝ(D′)|.

With τ half the tolerance, term m counts fully while b_m ≥ 2τ, fades linearly in b_m and is gone at b_m = τ:
what is missing stays below the tolerance, and no colour takes a step where a film gets a term more. On top
come the table's error, and for fringes beyond its end Σ H |z|^m · `SensitivityTable.beyond`.

Films that the series does not suit are integrated over wavelengths as the truth is, with the same indices:
those thinner than THIN_OPD_NM (every order is in phase), frustrated ones, and resonators of nearly perfect
mirrors whose bound asks for more than MAX_ORDERS terms.
"""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import Backend
from gltf_iri.colour.sensitivity_table import CELLS, STEP_NM, flat_sensitivity_table, sensitivity_table
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.dispersive import FilmBand, film_bands
from gltf_iri.evaluation.film import Base, Evaluation, Film, Float64
from gltf_iri.evaluation.spectral import evaluate_spectral
from gltf_iri.optics.film_series import film_series

__all__ = ["FOURIER_TOLERANCE", "MAX_ORDERS", "THIN_OPD_NM", "evaluate_fourier", "integrated_band"]

FOURIER_TOLERANCE: Final = 1e-4
MAX_ORDERS: Final = 64
THIN_OPD_NM: Final = 20.0

_ROWS_AT_ONCE: Final = 2048  # keeps a block's temporaries in a core's cache
_FIRST_ORDERS: Final = 3  # most films want no more


def evaluate_fourier(
    film: Film, white: White, *, tolerance: float = FOURIER_TOLERANCE, backend: Backend = "numpy"
) -> Evaluation:
    """Evaluate `fourier` under `white`.

    tolerance : how much the terms left out may add up to, > 0, in each channel of the colour.
    Where indices depend on the wavelength each channel takes its own (`gltf_iri.evaluation.dispersive`).
    """
    count = int(np.prod(film.shape, dtype=np.intp))
    rgb = np.zeros((count, 3))
    for band in film_bands(film, white):
        colour, is_open = (_compiled if backend == "numba" else _by_blocks)(band, white, tolerance)
        rgb[:, band.channels] = colour[:, band.channels]
        rest = np.flatnonzero(is_open)
        if len(rest) > 0:
            rgb[rest, band.channels] = integrated_band(band.rows(rest), white)[:, band.channels]
    return Evaluation(rgb.reshape(*film.shape, 3), "fourier", str(white))


def integrated_band(band: FilmBand, white: White) -> Float64:
    """Return the colours (r, 3) of a band's films by the truth's integration, at the band's own indices."""
    index = np.repeat(np.asarray(band.base_index, dtype=np.complex128)[:, None], 3, axis=-1)
    base = Base(np.zeros(index.shape), index)
    film = Film(band.cos_theta_1, band.thickness_nm, band.film_ior, base, band.outside_ior)
    return evaluate_spectral(film, white).rgb


@dataclass(frozen=True, slots=True)
class _Unfinished:
    """Films (r,) whose next term is still to be added; (2, r) for s and p."""

    row: NDArray[np.intp]
    step: Float64  # mD and D in cells of the table
    place: Float64
    ratio: NDArray[Any]
    size: Float64  # |z|
    power: NDArray[Any]  # G z^m
    left: Float64  # H |z|^m/τ

    def at(self, rows: NDArray[np.intp]) -> _Unfinished:
        return _Unfinished(*(getattr(self, each.name).take(rows, axis=-1) for each in fields(self)))


def _by_blocks(band: FilmBand, white: White, tolerance: float) -> tuple[Float64, NDArray[np.bool_]]:
    """Return the colours (r, 3) of a band's films and which of them are still open (r,)."""
    count = len(band.cos_theta_1)
    rgb, is_open = np.zeros((count, 3)), np.zeros(count, dtype=np.bool_)
    rest = []
    for start in range(0, count, _ROWS_AT_ONCE):
        rows = np.arange(start, min(start + _ROWS_AT_ONCE, count))
        rgb[rows], is_open[rows], unfinished = _prepare(band.rows(rows), rows, tolerance)
        rest.append(_add_orders(unfinished, _FIRST_ORDERS, rgb, white))
    if not rest:
        return rgb, is_open
    # The few films with many terms, of all blocks together: else each block would run to its own worst film.
    parts = zip(*([getattr(part, each.name) for each in fields(part)] for part in rest), strict=True)
    unfinished = _Unfinished(*(np.concatenate(part, axis=-1) for part in parts))
    for start in range(0, len(unfinished.row), _ROWS_AT_ONCE):
        block = unfinished.at(np.arange(start, min(start + _ROWS_AT_ONCE, len(unfinished.row))))
        is_open[_add_orders(block, MAX_ORDERS - _FIRST_ORDERS, rgb, white).row] = True
    return rgb, is_open


def _prepare(
    band: FilmBand, rows: NDArray[np.intp], tolerance: float
) -> tuple[Float64, NDArray[np.bool_], _Unfinished]:
    """Return the means (r, 3) of all fringes, which films have no series, and the others' first term."""
    series = film_series(band.outside_ior, band.film_ior, band.base_index, band.cos_theta_1)
    step = 2.0 * band.thickness_nm * np.sqrt(np.maximum(series.q2_squared, 0.0)) / STEP_NM
    is_open = ~(series.q2_squared > 0.0) | ~(step > THIN_OPD_NM / STEP_NM)
    rgb = np.repeat((1.0 - (series.entering[0] + series.entering[1]))[:, None], 3, axis=-1)
    size = np.abs(series.ratio)
    power = 2.0 * series.entering * series.ratio
    left = series.tail * size * (2.0 / tolerance)
    films = _Unfinished(rows, step, step, series.ratio, size, power, left)
    return rgb, is_open, films.at(np.flatnonzero(~is_open)) if is_open.any() else films


def _add_orders(films: _Unfinished, orders: int, rgb: Float64, white: White) -> _Unfinished:
    """Add up to so many further terms to `rgb`; return the films that are then not finished yet.

    Only what still counts is carried from order to order, so that cost follows need.
    """
    table = sensitivity_table(white)
    for _ in range(orders):
        # What lies beyond the table reads its end, where the bound is 0.
        place = np.minimum(films.place, np.nextafter(CELLS, 0.0))
        cell = place.astype(np.intp)
        t: Float64 = place - cell
        low, high = table.envelope.take(cell), table.envelope.take(cell + 1)
        bound = (films.left[0] + films.left[1]) * (low + t * (high - low))
        counts = np.flatnonzero(bound > 1.0)
        if len(counts) < len(bound):
            films, cell, t, bound = films.at(counts), cell[counts], t[counts], bound[counts]
        if len(films.row) == 0:
            return films
        weight = (films.power[0] + films.power[1]) * np.minimum(1.0, bound - 1.0)
        change = -weight.real[:, None] * _cubic(table.coefficients[cell, 0], t)
        if np.iscomplexobj(weight):
            change += weight.imag[:, None] * _cubic(table.coefficients[cell, 1], t)
        rgb[films.row] += change
        films = replace(
            films,
            place=films.place + films.step,
            power=films.power * films.ratio,
            left=films.left * films.size,
        )
    return films


def _compiled(band: FilmBand, white: White, tolerance: float) -> tuple[Float64, NDArray[np.bool_]]:
    """Return the same as `_by_blocks`."""
    from gltf_iri.compiled.fourier import sum_series
    from gltf_iri.compiled.fourier_absorbing import sum_absorbing_series

    real, imaginary, envelope, decay = flat_sensitivity_table(white)
    count = len(band.cos_theta_1)
    rgb, is_open = np.zeros(3 * count), np.zeros(count, dtype=np.bool_)
    film = (band.outside_ior, band.film_ior, band.base_index, band.thickness_nm, band.cos_theta_1)
    rule = (STEP_NM, THIN_OPD_NM, tolerance, MAX_ORDERS)
    if np.iscomplexobj(band.base_index):
        sum_absorbing_series(*film, real, imaginary, envelope, *rule, rgb, is_open)
    else:
        sum_series(*film, real, envelope, decay, *rule, rgb, is_open)
    return rgb.reshape(-1, 3), is_open


def _cubic(c: Float64, t: Float64) -> Float64:
    t = t[:, None]
    return np.asarray(c[:, 0] + t * (c[:, 1] + t * (c[:, 2] + t * c[:, 3])))
