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

from gltf_iri.optics.bragg_cell import Films, Host
from gltf_iri.optics.turns import sincos_turns

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
    """Cells of both polarisations, in rows; phases are 2π·path·ν.

    paths_nm : (2, rows), of the first film and of the second.
    constants : (6, 2, rows): ½Ω, Z, r, 1 − r², κ, and 1 where the cell is opaque; s and p.
    scans : (rows,), into how many steps one of the grid is cut to look for gaps.
    """

    paths_nm: Float64
    constants: Float64
    scans: NDArray[np.int64]

    @classmethod
    def of(cls, films: Films, host: Host, shape: tuple[int, ...], step_per_nm: float) -> BlochCell:
        """Return the cells, broadcast to `shape` and laid out in rows, for a grid of that step.

        Cells that turn θ by more than 64 rad from one wavenumber of the grid to the next are taken as
        thinner by a factor, both films alike: their colour is a mean over all phases. Cells in whose n1 light
        does not run and cells along which it grazes are opaque; where it fades in n2 alone, the result means
        nothing.
        """
        constants, ratio, paths_nm = np.zeros((6, 2, *shape)), np.zeros((2, *shape)), np.zeros((2, *shape))
        ratio[0], ratio[1], paths_nm[0], paths_nm[1] = films[2], films[3], films[0], films[1]
        constants[1, 0], constants[1, 1] = films.imbalance_s, films.imbalance_p
        constants[2, 0], constants[2, 1], constants[3, 0], constants[3, 1] = host
        is_single = films.path_2_nm == 0.0
        if is_single.any():  # without a second film there is no contrast, at whatever angle
            ratio, constants[1] = np.where(is_single, 1.0, ratio), np.where(is_single, 0.0, constants[1])
        is_opaque = films.fades_in_1 | ~((ratio < _CONTRAST_MAX) & (ratio > 1.0 / _CONTRAST_MAX))
        constants, ratio, paths_nm = (
            constants.reshape(6, 2, -1),
            ratio.reshape(2, -1),
            paths_nm.reshape(2, -1),
        )
        is_opaque = is_opaque.reshape(2, -1)
        if is_opaque.any():  # stand-ins: no NaN and no overflow
            ratio = np.where(is_opaque, 1.0, ratio)
            constants[1:4] = np.where(is_opaque, np.array([0.0, 0.0, 1.0])[:, None, None], constants[1:4])
            constants[5] = is_opaque
            paths_nm = np.where(is_opaque.any(axis=0), 0.0, paths_nm)
        _, _, r, t, _, _ = constants
        tilt = t / (1.0 + np.abs(r))  # 1 − |r|, without cancellation
        inverse = 1.0 / ratio
        constants[0] = 0.5 * (ratio + inverse)
        one_plus_r = np.where(r > 0.0, 1.0 + r, tilt)
        constants[4] = 0.5 * (ratio * np.where(r > 0.0, tilt, 1.0 - r) + inverse * one_plus_r)
        scan_nm = _SCAN_RAD / (2.0 * np.pi * step_per_nm)
        path_nm = paths_nm[0] + paths_nm[1]
        if path_nm.max(initial=0.0) > _SCANS_MAX * scan_nm:
            paths_nm *= _SCANS_MAX * scan_nm / np.maximum(path_nm, _SCANS_MAX * scan_nm)
            path_nm = np.minimum(path_nm, _SCANS_MAX * scan_nm)
        np.maximum(paths_nm[0], _THINNEST_NM, out=paths_nm[0])
        return cls(paths_nm, constants, np.maximum(np.ceil(path_nm / scan_nm), 1.0).astype(np.int64))

    def part(self, rows: slice) -> BlochCell:
        """Return some of the rows."""
        return BlochCell(self.paths_nm[:, rows], self.constants[..., rows], self.scans[rows])


def shifted_reflectance(
    cell: BlochCell, cells: NDArray[np.int64], wavenumber_per_nm: Float64, height_per_nm: float
) -> Complex128:
    """Return Q = 1 − F (2, rows, k) of s and p at ν + ia; for opaque cells, Q = 1.

    Re Q is the reflectance seen through a Lorentzian of half width a, less the Lorentzians of the poles.
    cells : (rows,), N. wavenumber_per_nm : (k,), ν. height_per_nm : a > 0.
    """
    (sin_1, sin_2), (cos_1, cos_2) = _sincos(cell.paths_nm[..., None], wavenumber_per_nm, height_per_nm)
    omega_half, imbalance, r, t, kappa, is_opaque = cell.constants[..., None]
    first, mixed, both_sines = sin_1 * cos_2, cos_1 * sin_2, sin_1 * sin_2
    x = cos_1 * cos_2 - omega_half * both_sines
    b = first + kappa * mixed
    b_r = (-r * imbalance) * both_sines
    # sin²θ = b₀² − (Z sin φ₂)²; 1 − cos²θ cancels for thin cells, the other for strong contrasts.
    b_0, off = first + omega_half * mixed, imbalance * sin_2
    s = np.sqrt(np.where(np.abs(off) < 1.0, (b_0 - off) * (b_0 + off), (1.0 - x) * (1.0 + x)))
    # Of ±θ the one that fades: |e^{iθ}| < 1.
    s = np.where(x.imag * s.real - x.real * s.imag > 0.0, -s, s)
    fading = np.where(np.abs(x) < _FADED, x + 1j * s, 0.0)
    z = _power(fading, 2 * cells[:, None])
    even, odd = s * (1.0 + z), 1.0 - z
    numerator = even * b + (s * s + b_r * b_r - 1j * b_r * b) * odd
    denominator = b * (even + (b + 1j * b_r) * odd)
    return np.asarray(np.where(is_opaque > 0.0, 1.0, 1.0 - t * numerator / denominator))


def gap_poles(
    cell: BlochCell, cells: NDArray[np.int64], wavenumber_per_nm: Float64
) -> tuple[NDArray[np.intp], Float64, Float64]:
    """Return rows, places (ν_g − ν₀)/h and strengths ρ/h of the poles iρ/(ν − ν_g), (g,) each, s and p alike.

    b is all but a straight line between two points of the scan: the secant and a step of Newton's find zeros.
    """
    first_per_nm, steps = float(wavenumber_per_nm[0]), len(wavenumber_per_nm) - 1
    step_per_nm = float(wavenumber_per_nm[-1] - wavenumber_per_nm[0]) / steps
    found = [_scan(cell, scans, first_per_nm, step_per_nm, steps) for scans in np.unique(cell.scans)]
    side, rows, start, place = (np.concatenate(each) for each in zip(*found, strict=True))
    paths_nm, constants = cell.paths_nm[:, rows], cell.constants[:, side, rows]
    omega_half, _, _, _, kappa, _ = constants
    turn_1, turn_2 = 2.0 * np.pi * step_per_nm * paths_nm
    for _ in range(2):
        (sin_1, sin_2), (cos_1, cos_2) = _sincos(paths_nm, first_per_nm + step_per_nm * (start + place))
        value = sin_1 * cos_2 + kappa * (cos_1 * sin_2)
        slope = (turn_1 + kappa * turn_2) * (cos_1 * cos_2) - (turn_2 + kappa * turn_1) * (sin_1 * sin_2)
        last = place
        place = np.clip(place - value / slope, 0.0, 1.0 / cell.scans[rows])
    x = cos_1 * cos_2 - omega_half * (sin_1 * sin_2)
    return rows, start + last, _strength(constants, cells[rows], sin_1, sin_2, x) / slope


def _scan(
    cell: BlochCell, scans: int, first_per_nm: float, step_per_nm: float, steps: int
) -> tuple[NDArray[np.intp], NDArray[np.intp], Float64, Float64]:
    """Return polarisation and row, among those with so many scans, where b changes sign, and where."""
    rows = np.flatnonzero(cell.scans == scans)
    at_per_nm = first_per_nm + step_per_nm * (np.arange(steps * scans + 1) / scans)
    (sin_1, sin_2), (cos_1, cos_2) = _sincos(cell.paths_nm[:, rows, None], at_per_nm)
    b = sin_1 * cos_2 + cell.constants[4][:, rows, None] * (cos_1 * sin_2)
    is_change = (b[..., :-1] < 0.0) != (b[..., 1:] < 0.0)
    side, row, column = np.nonzero(is_change & (cell.constants[5][:, rows, None] == 0.0))
    before, after = b[side, row, column], b[side, row, column + 1]
    return side, rows[row], column / scans, before / (before - after) / scans


def _strength(
    constants: Float64, cells: NDArray[np.int64], sin_1: Float64, sin_2: Float64, x: Float64
) -> Float64:
    """Return ρ b′ = (1 − r²)² τ (σ sinh χ − b_r τ) / [1 − r² + (r sin φ₁)²(1 − τ²)], τ = tanh Nχ.

    At b = 0, sinh²χ = (Z sin φ₂)²(1 − r² + (r sin φ₁)²) and σ is the sign of cos θ = ±cosh χ.
    """
    _, imbalance, r, t, _, _ = constants
    off, tilt = imbalance * sin_2, r * sin_1
    sinh = np.abs(off) * np.sqrt(t + tilt * tilt)
    z = _power(1.0 / (np.sqrt(1.0 + sinh * sinh) + sinh), 2 * cells)  # e^{−2Nχ}
    tau = (1.0 - z) / (1.0 + z)
    signed = np.where(x < 0.0, -sinh, sinh) + off * tilt * tau
    sech_squared = 4.0 * z / ((1.0 + z) * (1.0 + z))
    return np.asarray(t * t * tau * signed / (t + tilt * tilt * sech_squared))


def _sincos(path_nm: Float64, wavenumber_per_nm: Float64, height_per_nm: float = 0.0) -> tuple[Any, Any]:
    """Return sin φ and cos φ of φ = 2π path (ν + ia)."""
    sine, cosine = sincos_turns(path_nm * wavenumber_per_nm)
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
