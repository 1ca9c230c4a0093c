"""Reflectance of a Bragg mirror beside the real axis of wavenumbers, and the poles that its gaps have there.

With φ₁, φ₂ the phases k_z d of the cell's films, Ω = X + 1/X, Z = ½(X − 1/X) and r = r_h1, the transmittance
of N cells is T = (1 − r²)/|cos Nθ + (b_r − i b)U|², where (Yeh 1988; Fourneau et al. 2024, Eq. 8, Appendix D)

    cos θ = cos φ₁ cos φ₂ − ½Ω sin φ₁ sin φ₂,      U = sin Nθ / sin θ,
    b = sin φ₁ cos φ₂ + κ cos φ₁ sin φ₂,  κ = ½Ω − rZ,      b_r = −rZ sin φ₁ sin φ₂.

It is the real part, for real wavenumbers ν, of

    F = (1 − r²) [s(1 + z) + ((s² + b_r²)/b − i b_r)(1 − z)] / [s(1 + z) + (b + i b_r)(1 − z)]

with s = sin θ, z = e^{2iNθ}. F is even in θ, so that band edges are no special points of it, and above the
real axis, where Im θ > 0, it has no poles: its denominator is that of a causal amplitude. On the axis it has
one where b = 0, once in every gap. spec/decisions/bloch.md derives all this. Convention exp(−iωt).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.bragg_cell import Cell

__all__ = ["BlochCell", "gap_poles", "shifted_reflectance"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]

# Cells of no thickness at all have θ = 0 and F = 0/0; this much in the first film is none.
_THINNEST_NM: Final = 1e-9

# Light along the films of n1 (X → ∞) leaves no flux in the exit medium; beyond, products would overflow.
_CONTRAST_MAX: Final = 1e30

# From this |cos θ| on x + is is rounding alone, and |e^{iθ}|² < 1e-16.
_FADED: Final = 1e8

# Gaps are looked for by steps that turn θ by at most so much: then no two of them fall within one.
_SCAN_RAD: Final = 2.0

# At most so many of them to a step of the grid; there colours are means over all phases.
_SCANS_MAX: Final = 32

# e^{−2·20} of a wave that has faded so far is rounding, and no product of what grows overflows.
_FADE_MAX: Final = 20.0


@dataclass(frozen=True, slots=True)
class BlochCell:
    """One polarisation of cells, shape (rows, 1) each; phases are 2π·path·ν.

    omega_half, imbalance : ½Ω and Z. host_r, host_t : r and 1 − r². kappa : the coefficient in b.
    scans : into how many steps one of the grid is cut to look for gaps.
    """

    path_1_nm: Float64
    path_2_nm: Float64
    omega_half: Float64
    imbalance: Float64
    host_r: Float64
    host_t: Float64
    kappa: Float64
    is_opaque: NDArray[np.bool_]
    scans: NDArray[np.int64]

    @classmethod
    def of(cls, cell: Cell, polarisation: str, step_per_nm: float) -> BlochCell:
        """Return the polarisation "s" or "p" of `cell`, its arrays laid out as rows, for a grid of that step.

        Cells that turn θ by more than 64 rad from one wavenumber of the grid to the next are taken as
        thinner by a factor, both films alike: their colour is a mean over all phases. Cells in which light
        does not run (constants NaN) and cells along which it grazes are opaque.
        """
        path_1, path_2 = (path.reshape(-1, 1) for path in (cell.path_1_nm, cell.path_2_nm))
        x, imbalance, r, t = (
            getattr(cell, f"{name}_{polarisation}").reshape(-1, 1)
            for name in ("contrast", "imbalance", "host_r", "host_t")
        )
        is_opaque = ~((x < _CONTRAST_MAX) & (x > 1.0 / _CONTRAST_MAX))
        path_1, path_2, r = (np.where(is_opaque, 0.0, a) for a in (path_1, path_2, r))
        x, t = np.where(is_opaque, 1.0, x), np.where(is_opaque, 1.0, t)
        imbalance = np.where(is_opaque, 0.0, imbalance)
        scan_nm = _SCAN_RAD / (2.0 * np.pi * step_per_nm)
        shrink = _SCANS_MAX * scan_nm / np.maximum(path_1 + path_2, _SCANS_MAX * scan_nm)
        one_minus_r = np.where(r > 0.0, t / (1.0 + np.abs(r)), 1.0 - r)  # without cancellation at r → 1
        one_plus_r = np.where(r < 0.0, t / (1.0 + np.abs(r)), 1.0 + r)
        return cls(
            np.maximum(path_1 * shrink, _THINNEST_NM),
            path_2 * shrink,
            0.5 * (x + 1.0 / x),
            imbalance,
            r,
            t,
            0.5 * (x * one_minus_r + one_plus_r / x),
            is_opaque,
            np.ceil(shrink * np.maximum(path_1 + path_2, 0.5 * scan_nm) / scan_nm).astype(np.int64),
        )

    def at(self, rows: NDArray[np.intp]) -> BlochCell:
        """Return the cells of `rows` (g,), with shape (g, 1)."""
        return BlochCell(*(getattr(self, name)[rows] for name in self.__slots__))


def shifted_reflectance(
    cell: BlochCell, cells: NDArray[np.int64], wavenumber_per_nm: Float64, height_per_nm: float
) -> Complex128:
    """Return Q = 1 − F (rows, k) at ν + ia; for opaque cells, Q = 1.

    Re Q is the reflectance seen through a Lorentzian of half width a, less the Lorentzians of the poles.

    cells : (rows, 1), N. wavenumber_per_nm : (k,), ν. height_per_nm : a > 0.
    """
    sin_1, cos_1 = _sincos(cell.path_1_nm, wavenumber_per_nm, height_per_nm)
    sin_2, cos_2 = _sincos(cell.path_2_nm, wavenumber_per_nm, height_per_nm)
    mixed, both_sines = cos_1 * sin_2, sin_1 * sin_2
    first = sin_1 * cos_2
    x = cos_1 * cos_2 - cell.omega_half * both_sines
    b = first + cell.kappa * mixed
    b_r = (-cell.host_r * cell.imbalance) * both_sines
    # sin²θ = b₀² − (Z sin φ₂)²; 1 − cos²θ cancels for thin cells, the other for strong contrasts.
    b_0, off = first + cell.omega_half * mixed, cell.imbalance * sin_2
    s = np.sqrt(np.where(np.abs(off) < 1.0, (b_0 - off) * (b_0 + off), (1.0 - x) * (1.0 + x)))
    # Of ±θ the one that fades: |e^{iθ}| < 1.
    s = np.where(x.imag * s.real - x.real * s.imag > 0.0, -s, s)
    fading = np.where(np.abs(x) < _FADED, x + 1j * s, 0.0)
    z = _power(fading, 2 * cells)
    even, odd = s * (1.0 + z), 1.0 - z
    numerator = even * b + (s * s + b_r * b_r - 1j * b_r * b) * odd
    denominator = b * (even + (b + 1j * b_r) * odd)
    return np.asarray(np.where(cell.is_opaque, 1.0, 1.0 - cell.host_t * numerator / denominator))


def gap_poles(
    cell: BlochCell, cells: NDArray[np.int64], wavenumber_per_nm: Float64
) -> tuple[NDArray[np.intp], Float64, Float64]:
    """Return rows, places (ν_g − ν₀)/h and strengths ρ/h, (g,) each, of the poles iρ/(ν − ν_g).

    b is all but a straight line between two points of the scan: the secant and a step of Newton's find zeros.
    """
    step_per_nm = float(wavenumber_per_nm[-1] - wavenumber_per_nm[0]) / (len(wavenumber_per_nm) - 1)
    found = [
        _scan(cell, scans, wavenumber_per_nm[0], step_per_nm, len(wavenumber_per_nm) - 1)
        for scans in np.unique(cell.scans)
    ]
    rows, start, place = (np.concatenate(each) for each in zip(*found, strict=True))
    start, place, cell = start[:, None], place[:, None], cell.at(rows)
    for _ in range(2):
        at_per_nm = wavenumber_per_nm[0] + step_per_nm * (start + place)
        sin_1, cos_1 = _sincos(cell.path_1_nm, at_per_nm)
        sin_2, cos_2 = _sincos(cell.path_2_nm, at_per_nm)
        turn_1, turn_2 = (2.0 * np.pi * step_per_nm * path for path in (cell.path_1_nm, cell.path_2_nm))
        value = sin_1 * cos_2 + cell.kappa * (cos_1 * sin_2)
        slope = (turn_1 + cell.kappa * turn_2) * (cos_1 * cos_2) - (turn_2 + cell.kappa * turn_1) * (
            sin_1 * sin_2
        )
        last = place
        place = np.clip(place - value / slope, 0.0, 1.0 / cell.scans)
    x = cos_1 * cos_2 - cell.omega_half * (sin_1 * sin_2)
    return rows, (start + last)[:, 0], _strength(cell, cells[rows], sin_1, sin_2, x, slope)[:, 0]


def _scan(
    cell: BlochCell, scans: int, first_per_nm: float, step_per_nm: float, steps: int
) -> tuple[NDArray[np.intp], Float64, Float64]:
    """Return the rows with so many scans in which b changes sign, where, and how far on; in steps."""
    rows = np.flatnonzero(cell.scans[:, 0] == scans)
    scanned = cell.at(rows)
    at_per_nm = first_per_nm + step_per_nm * (np.arange(steps * scans + 1) / scans)
    sin_1, cos_1 = _sincos(scanned.path_1_nm, at_per_nm)
    sin_2, cos_2 = _sincos(scanned.path_2_nm, at_per_nm)
    b = sin_1 * cos_2 + scanned.kappa * (cos_1 * sin_2)
    is_change = (b[:, :-1] < 0.0) != (b[:, 1:] < 0.0)
    row, column = np.nonzero(is_change & ~scanned.is_opaque)
    before, after = b[row, column], b[row, column + 1]
    return rows[row], column / scans, before / (before - after) / scans


def _strength(
    cell: BlochCell, cells: NDArray[np.int64], sin_1: Float64, sin_2: Float64, x: Float64, slope: Float64
) -> Float64:
    """Return ρ = (1 − r²)² τ (σ sinh χ − b_r τ) / {[1 − r² + (r sin φ₁)²(1 − τ²)] b′}, τ = tanh Nχ.

    At b = 0, sinh²χ = (Z sin φ₂)²(1 − r² + (r sin φ₁)²) and σ is the sign of cos θ = ±cosh χ.
    """
    off, tilt = cell.imbalance * sin_2, (cell.host_r * sin_1) ** 2
    sinh = np.abs(off) * np.sqrt(cell.host_t + tilt)
    z = _power(1.0 / (np.sqrt(1.0 + sinh * sinh) + sinh), 2 * cells)  # e^{−2Nχ}
    tau = (1.0 - z) / (1.0 + z)
    signed = np.where(x < 0.0, -sinh, sinh) + cell.host_r * off * sin_1 * tau
    sech_squared = 4.0 * z / (1.0 + z) ** 2
    return np.asarray(cell.host_t**2 * tau * signed / ((cell.host_t + tilt * sech_squared) * slope))


def _sincos(path_nm: Float64, wavenumber_per_nm: Float64, height_per_nm: float = 0.0) -> tuple[Any, Any]:
    """Return sin φ and cos φ of φ = 2π path (ν + ia); whole turns come off before π is multiplied in."""
    turns = path_nm * wavenumber_per_nm
    phase = 2.0 * np.pi * (turns - np.rint(turns))
    sine, cosine = np.sin(phase), np.cos(phase)
    if height_per_nm == 0.0:
        return sine, cosine
    fade = np.minimum(2.0 * np.pi * height_per_nm * path_nm, _FADE_MAX)
    grown, odd = np.cosh(fade), np.sinh(fade)
    return sine * grown + 1j * (cosine * odd), cosine * grown - 1j * (sine * odd)


def _power(base: Any, exponent: NDArray[np.int64]) -> Any:
    """Return base**exponent by squarings: nothing overflows, for |base| ≤ 1."""
    result = np.ones_like(base)
    for bit in range(int(exponent.max(initial=1)).bit_length()):
        result = np.where((exponent >> bit) & 1 == 1, result * base, result)
        base = base * base
    return result
