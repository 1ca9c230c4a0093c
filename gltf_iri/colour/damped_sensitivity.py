"""The eye's sensitivities in Fourier space under a spread of path differences, at many spreads at once.

    Ŝ(D, s) = ∫ S(ν) exp(−2π²s²ν²) exp(2πi Dν) dν

is Ŝ averaged over a Gaussian of width s around D (Belcour & Barla 2017, section 5, Multi-scale Rendering).
Over all D it is one convolution, done by discrete Fourier transforms of the table of Ŝ.

Between two spreads s₀ < s₁ a line in u = s² is drawn through what is left after the typical damping of each
channel, exp(−κu) with κ = 2π²/λ² and λ of DAMPING_NM:

    Ŝ(D, s) ≈ (1 − t) exp(−κ(u − u₀)) Ŝ(D, s₀) + t exp(κ(u₁ − u)) Ŝ(D, s₁),   t = (u − u₀)/(u₁ − u₀),

which is exact for light of the wavelength λ. The spreads lie evenly in u/(u + SPREAD_SCALE_NM²), densest
where this errs most; it is never wrong by more than SPREAD_TABLE_ERROR (`gltf_iri.tolerances`).
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.sensitivity_table import END_NM, sensitivity_table
from gltf_iri.colour.spaces import White

__all__ = ["DAMPING_NM", "DAMPING_PER_NM2", "SPREADS", "SPREAD_END_NM", "SPREAD_PART_MAX", "SPREAD_SCALE_NM"]
__all__ += ["damped_sensitivity", "spread_bounds", "spreads_nm"]

Float64 = NDArray[np.float64]

DAMPING_NM: Final = (600.0, 545.0, 455.0)
SPREADS: Final = 26
SPREAD_SCALE_NM: Final = 205.0
SPREAD_END_NM: Final = 480.0  # leaves 2e-5 of the fringes

# u/(u + SPREAD_SCALE_NM²) at SPREAD_END_NM, and κ.
SPREAD_PART_MAX: Final = SPREAD_END_NM**2 / (SPREAD_END_NM**2 + SPREAD_SCALE_NM**2)
DAMPING_PER_NM2: Final = tuple(2.0 * (math.pi / nm) ** 2 for nm in DAMPING_NM)

_STEP_NM: Final = 0.5

# Room beyond the table's end, so that what a spread carries past it does not come back at the start.
_LENGTH: Final = 1 << 17


def spreads_nm() -> Float64:
    """Return (SPREADS,): 0 and the spreads that rows are kept for, up to SPREAD_END_NM."""
    part = np.linspace(0.0, SPREAD_PART_MAX, SPREADS)
    return np.asarray(SPREAD_SCALE_NM * np.sqrt(part / (1.0 - part)))


def damped_sensitivity(white: White) -> tuple[Float64, Float64]:
    """Return D (n,) from 0 to the table's end, half nanometres apart, and Re Ŝ(D, s) (SPREADS, n, 3)."""
    count = round(END_NM / _STEP_NM) + 1
    opd_nm = np.asarray(_STEP_NM * np.arange(count), dtype=np.float64)
    real = np.zeros((3, _LENGTH + 1))
    real[:, :count] = sensitivity_table(white).at(opd_nm).real.T
    # Re Ŝ is even in D: so continued, its transform is real, and so is what comes back.
    spectrum = np.fft.rfft(np.concatenate([real, real[:, -2:0:-1]], axis=1)).real
    wavenumber = np.fft.rfftfreq(2 * _LENGTH, _STEP_NM)
    damped = np.zeros((SPREADS, count, 3))
    damped[0] = real[:, :count].T
    for row, spread_nm in zip(damped[1:], spreads_nm()[1:], strict=True):
        faded = spectrum * np.exp(-2.0 * (np.pi * spread_nm * wavenumber) ** 2)
        row[:] = np.fft.irfft(faded, n=2 * _LENGTH)[:, :count].T
    return opd_nm, damped


def spread_bounds(damped: Float64) -> Float64:
    """Return (SPREADS, n): at least |Re Ŝ| of all channels at and beyond each D, for this spread and wider.

    Along u the bounds fall and are convex, so that a line between two rows is one, too.
    """
    size = np.abs(damped).max(axis=-1)
    farther = np.maximum.accumulate(size[:, ::-1], axis=1)[:, ::-1]
    wider = np.maximum.accumulate(farther[::-1], axis=0)[::-1]
    return np.asarray(1.001 * wider)  # a thousandth for what lies between
