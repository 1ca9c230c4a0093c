"""Ŝ(D, s), the eye's sensitivities under a spread of path differences, at any D and s and to TABLE_ERROR.

`gltf_iri.colour.damped_sensitivity` has the equation, and a coarser table for graphics cards. Here each of
some spreads has the cubics of `SensitivityTable`, made by discrete Fourier transforms of it; between spreads
the cubic through four of them is drawn, in s, through Ŝ(D, s) exp(κs²): what is left after each channel's
typical damping. Ŝ is even in s. This errs by 2e-6; what is left at the last spread, 1e-8 of the fringes, and
beyond counts as none.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.damped_sensitivity import DAMPING_PER_NM2
from gltf_iri.colour.sensitivity_table import CELLS, END_NM, STEP_NM, sensitivity_table
from gltf_iri.colour.spaces import White

__all__ = ["SpreadTable", "spread_table"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]

_ROW_NM: Final = 12.5
_ROWS: Final = 53  # up to 650 nm

# The transforms' grid, four steps a cell, with room for what a spread carries past the table's end.
_PER_CELL: Final = 4
_ROOM: Final = 200
_POINTS: Final = np.array([0.0, 0.25, 0.75, 1.0])

_DAMPING: Final = np.array(DAMPING_PER_NM2)


@dataclass(frozen=True, slots=True)
class SpreadTable:
    """Arrays are read-only.

    real, imaginary : (_ROWS · CELLS, 12), of Ŝ(D, s) exp(κs²): four powers of three channels a cell, as in
    `SensitivityTable`.
    envelope : (_ROWS, CELLS + 1), at least |Ŝ| of every channel for this D and s and all greater.
    """

    real: Float64
    imaginary: Float64
    envelope: Float64

    def at(self, opd_nm: Float64, spread_nm: Float64, *, real_only: bool = False) -> Complex128 | Float64:
        """Return Ŝ (r, 3) at D = `opd_nm` ≥ 0 (r,) and s = `spread_nm` (r,); its real part if `real_only`."""
        place = np.minimum(opd_nm / STEP_NM, np.nextafter(CELLS, 0.0))
        cell = place.astype(np.intp)
        t = (place - cell.astype(np.float64))[:, None]
        row = np.minimum(spread_nm / _ROW_NM, _ROWS - 2.5)
        first = row.astype(np.intp) - 1
        rows = [np.abs(first + k) * CELLS + cell for k in range(4)]
        weights = _lagrange(row - first)
        damping: Float64 = np.exp(-np.square(row * _ROW_NM)[:, None] * _DAMPING)
        real = _cubic(self.real, rows, weights, t) * damping
        if real_only:
            return np.asarray(real)
        return np.asarray(real + 1j * (_cubic(self.imaginary, rows, weights, t) * damping))

    def bound(self, opd_nm: Float64, spread_nm: Float64) -> Float64:
        """Return (r,): at least |Ŝ| of every channel for these D and s and all greater."""
        place = np.minimum(opd_nm / STEP_NM, np.nextafter(CELLS, 0.0))
        cell = place.astype(np.intp)
        t = place - cell
        row = np.minimum(spread_nm / _ROW_NM, np.nextafter(_ROWS - 1, 0.0))
        first = row.astype(np.intp)
        # The bound is convex in s², so that a line between two rows is one, too.
        u = (row * row - first * first) / (2.0 * first + 1.0)
        narrower, wider = (
            self.envelope[i, cell] + t * (self.envelope[i, cell + 1] - self.envelope[i, cell])
            for i in (first, first + 1)
        )
        return np.asarray(np.where(opd_nm < END_NM, narrower + u * (wider - narrower), 0.0))


@cache
def spread_table(white: White) -> SpreadTable:
    """Return the table of the RGB space of `white`, made once; 33 MB."""
    plain = sensitivity_table(white)
    count = _PER_CELL * CELLS + 1
    half = count + _ROOM
    step_nm = STEP_NM / _PER_CELL
    values = np.zeros((3, 2 * half), dtype=np.complex128)
    values[:, :count] = plain.at(step_nm * np.arange(count)).T
    values[:, -1:-count:-1] = values[:, 1:count].conj()  # Ŝ(−D)
    spectrum = np.fft.fft(values).real
    wavenumber = np.fft.fftfreq(2 * half, step_nm)

    coefficients = np.zeros((_ROWS, CELLS, 2, 4, 3))
    coefficients[0] = plain.coefficients
    envelope = np.zeros((_ROWS, CELLS + 1))
    envelope[0] = plain.envelope
    powers = np.linalg.inv(_POINTS[:, None] ** np.arange(4))
    for i in range(1, _ROWS):
        spread_nm = i * _ROW_NM
        damped = np.fft.ifft(spectrum * np.exp(-2.0 * (np.pi * spread_nm * wavenumber) ** 2))[:, :count]
        envelope[i] = _envelope(np.abs(damped).max(axis=0))
        damped *= np.exp(_DAMPING * spread_nm**2)[:, None]
        starts = _PER_CELL * np.arange(CELLS)[:, None]
        nodes = damped[:, starts + np.rint(_PER_CELL * _POINTS).astype(np.intp)]
        cubics = np.einsum("pn,ckn->kpc", powers, nodes)
        coefficients[i, :, 0], coefficients[i, :, 1] = cubics.real, cubics.imag
    envelope = np.maximum.accumulate(envelope[::-1], axis=0)[::-1]
    envelope[-1] = 0.0
    real, imaginary = (np.ascontiguousarray(coefficients[:, :, part]).reshape(-1, 12) for part in (0, 1))
    for array in (real, imaginary, envelope):
        array.setflags(write=False)
    return SpreadTable(real, imaginary, envelope)


def _lagrange(t: Float64) -> tuple[Float64, ...]:
    """Return the weights of the cubic through 0, 1, 2 and 3 at `t`."""
    a, b, c, d = t, t - 1.0, t - 2.0, t - 3.0
    return -b * c * d / 6.0, a * c * d / 2.0, -a * b * d / 2.0, a * b * c / 6.0


def _cubic(
    coefficients: Float64, rows: list[NDArray[np.intp]], weights: tuple[Float64, ...], t: Float64
) -> Float64:
    """Return (r, 3): the weighted cubics of four cells each at `t` (r, 1)."""
    c = np.zeros((len(t), 12))
    for row, weight in zip(rows, weights, strict=True):
        c += weight[:, None] * coefficients.take(row, axis=0)
    return np.asarray(c[:, :3] + t * (c[:, 3:6] + t * (c[:, 6:9] + t * c[:, 9:])))


def _envelope(sizes: Float64) -> Float64:
    """Return (CELLS + 1,) of the sizes on the transforms' grid: never rising, one cell late."""
    # Samples 5 nm apart miss a maximum by less than this share of it.
    from_here_on = 1.001 * np.maximum.accumulate(sizes[::-1])[::-1]
    late = np.concatenate([from_here_on[:1], from_here_on[:-1:_PER_CELL]])
    late[-1] = 0.0
    return late
