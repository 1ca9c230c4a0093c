"""The text's analytic sensitivities: the Fourier transforms of Gaussian fits to the CIE 1931 observer.

The text states them in SI units, whose constants (10⁻¹³, 10⁹) half precision cannot hold. One Gaussian
val · √(2π var) · cos(pos · φ + shift) · exp(−var φ²), φ = 2π · OPD · 10⁻⁹, is the same as the unit-free

    A · cos(2π OPD/λ + shift) · exp(−(OPD/L)²),   A = val √(2π var) / norm,  λ = 10⁹/pos,  L = 10⁹/(2π √var)

with OPD, λ and L in nm. The literal table below is the one source of both.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.spaces import xyz_to_rec709

__all__ = ["GAUSSIANS", "NORMALISATION", "SENSITIVITY_WHITE", "Gaussian", "eval_sensitivity"]
__all__ += ["gaussian_transform"]

# Divides every lobe: the integral of the fitted ȳ (KHR_materials_iridescence, evalSensitivity).
NORMALISATION: Final = 1.0685e-7


@dataclass(frozen=True, slots=True)
class Gaussian:
    """One lobe of the observer as the text states it, and its unit-free form."""

    channel: int  # 0, 1, 2 for X, Y, Z
    val: float
    pos: float  # 1/m
    var: float  # 1/m²

    @property
    def amplitude(self) -> float:
        """A: what the lobe adds at zero path difference."""
        return self.val * math.sqrt(2.0 * math.pi * self.var) / NORMALISATION

    @property
    def wavelength_nm(self) -> float:
        """λ: one fringe's path difference."""
        return 1e9 / self.pos

    @property
    def length_nm(self) -> float:
        """L: the path difference at which fringes have faded to 1/e."""
        return 1e9 / (2.0 * math.pi * math.sqrt(self.var))


# KHR_materials_iridescence, evalSensitivity: val, pos, var; the last row is X's second lobe.
GAUSSIANS: Final[tuple[Gaussian, ...]] = (
    Gaussian(0, 5.4856e-13, 1.6810e06, 4.3278e09),
    Gaussian(1, 4.4201e-13, 1.7953e06, 9.3046e09),
    Gaussian(2, 5.2481e-13, 2.2084e06, 6.6121e09),
    Gaussian(0, 9.7470e-14, 2.2399e06, 4.5282e09),
)


def eval_sensitivity(opd_nm: ArrayLike, shift: ArrayLike) -> NDArray[np.float64]:
    """Return the linear Rec.709 weight of a fringe of path difference `opd_nm` (...), phase `shift` (..., 3).

    Channel c of `shift` belongs to the c-th of X, Y, Z before the matrix, as the text has it.
    """
    opd = np.asarray(opd_nm, dtype=np.float64)
    phase = np.asarray(shift, dtype=np.float64)
    xyz = np.zeros((*np.broadcast_shapes(opd.shape, phase.shape[:-1]), 3))
    for lobe in GAUSSIANS:
        fringe = np.cos(2.0 * math.pi * opd / lobe.wavelength_nm + phase[..., lobe.channel])
        xyz[..., lobe.channel] += lobe.amplitude * fringe * np.exp(-((opd / lobe.length_nm) ** 2))
    return xyz_to_rec709(xyz)


def gaussian_transform(opd_nm: ArrayLike, opd_std_nm: ArrayLike = 0.0) -> NDArray[np.complex128]:
    """Return the fits' Ŝ (..., 3) of X, Y and Z at `opd_nm` (...), averaged over a spread of paths.

    A Gaussian spread of width σ multiplies the density over wavenumber by exp(−2π²σ²ν²); with
    g = 1 + 2(σ/L)² a lobe A exp(2πi D/λ − (D/L)²) becomes

        A/√g · exp((2πi D/λ − (D/L)² − 2(πσ/λ)²)/g)

    (Belcour & Barla 2017, section 5, Multi-scale Rendering; the product of two Gaussians).
    """
    opd, spread = np.asarray(opd_nm, dtype=np.float64), np.asarray(opd_std_nm, dtype=np.float64)
    xyz = np.zeros((*np.broadcast_shapes(opd.shape, spread.shape), 3), dtype=np.complex128)
    for lobe in GAUSSIANS:
        g = 1.0 + 2.0 * (spread / lobe.length_nm) ** 2
        fading = (opd / lobe.length_nm) ** 2 + 2.0 * (math.pi * spread / lobe.wavelength_nm) ** 2
        turning = 2.0 * math.pi * opd / lobe.wavelength_nm
        xyz[..., lobe.channel] += lobe.amplitude / np.sqrt(g) * np.exp((1j * turning - fading) / g)
    return xyz


# The colour of "all fringes in phase", (1.205, 0.948, 0.910): equal-energy XYZ put through a D65 matrix, so
# it is not the (1, 1, 1) that the text's constant term has.
SENSITIVITY_WHITE: Final[NDArray[np.float64]] = eval_sensitivity(0.0, np.zeros(3))
SENSITIVITY_WHITE.setflags(write=False)
