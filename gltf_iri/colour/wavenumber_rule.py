"""Colour from samples of a spectrum beside the real axis: at wavenumbers ν + ia on a uniform grid.

A lossless structure's transmittance is T(ν) = ∫ c(D) cos(2πDν) dD, a sum of fringes of path differences D.
F(ν) = ∫ c(D) e^{2πiDν} dD has T as its real part, and at the height a every fringe is damped by e^{−2πaD}:
on a grid of step h what is too fine for the grid is gone. The damping is known, so that weights can undo it
as far as the eye resolves fringes at all. Those here minimise the expected square of the colour's error
over random c with variance 1/(1 + (D/D₀)²) (kriging, in other words: Gaussian-process quadrature).

F also has poles, one in each gap of a mirror (gltf_iri/optics/bloch.py). `gap_weights` is what the same
weights make of one such pole within the grid; poles beyond its ends take part in the minimisation.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.gauss import gauss_panels
from gltf_iri.colour.observer import observer_table
from gltf_iri.colour.quadrature import colour_density
from gltf_iri.colour.spaces import White

__all__ = ["GAP_STEPS", "HEIGHT_STEPS", "SAMPLES_MAX", "SAMPLES_MIN", "WavenumberRule", "wavenumber_rule"]

Float64 = NDArray[np.float64]

SAMPLES_MIN: Final = 8
SAMPLES_MAX: Final = 128

# The grid's ends: wider grids spend samples where the eye sees little, narrower ones guess at what it sees.
_LONGEST_NM: Final = 780.0
_SHORTEST_NM: Final = 380.0

# a/h. Fringes of D = 1/h look like none at all; there the damping is e^{−2π·0.9} = 0.0035.
HEIGHT_STEPS: Final = 0.9

# Entries of `gap_weights` in a step of the grid; a line between them is off by some 1e-4 of the largest.
GAP_STEPS: Final = 16

# The prior: D₀, how far fringes are followed, and how finely; the square of a pole's usual strength, in steps
# of the grid, for every quarter of a step; the square of what rounding adds to a sample.
_TYPICAL_OPD_NM: Final = 4_000.0
_OPD_STEP_NM: Final = 20.0
_OPD_MAX_STEPS: Final = 4.0  # in units of 1/h; damped to e^{−22}
_POLE_STRENGTH: Final = 10.0
_POLES_PER_STEP: Final = 4
_POLES_UP_TO_NM: Final = 170.0
_NOISE: Final = 1e-7

_GAUSS_POINTS: Final = 6


@dataclass(frozen=True, slots=True)
class WavenumberRule:
    """rgb = Σ Re Q · weights[0] + Σ Im Q · weights[1] + Σ ρ · gap_weights, with Q = 1 − F at ν + ia.

    wavenumber_per_nm : (k,) the grid, real and uniform.
    step_per_nm, height_per_nm : h and a.
    weights : (2, k, 3); weights[0] sums to 1 in each channel, weights[1] to anything.
    gap_weights : (GAP_STEPS (k − 1) + 1, 3), for a pole iρ h/(ν − ν_g) of F, by (ν_g − ν₀) GAP_STEPS/h.
    """

    wavenumber_per_nm: Float64
    step_per_nm: float
    height_per_nm: float
    weights: Float64
    gap_weights: Float64


@cache
def wavenumber_rule(samples: int, white: White) -> WavenumberRule:
    """Return the rule of `samples` wavenumbers, SAMPLES_MIN to SAMPLES_MAX."""
    grid = np.linspace(1.0 / _LONGEST_NM, 1.0 / _SHORTEST_NM, samples)
    step = float(grid[-1] - grid[0]) / (samples - 1)
    height = HEIGHT_STEPS * step

    opd_nm = np.arange(0.0, _OPD_MAX_STEPS / step, _OPD_STEP_NM)
    variance = 1.0 / (1.0 + (opd_nm / _TYPICAL_OPD_NM) ** 2)
    variance[0] *= 0.5  # the trapezoidal rule
    variance /= variance.sum()
    phase = 2.0 * np.pi * np.outer(grid, opd_nm)
    damping = np.exp(-2.0 * np.pi * height * opd_nm)
    fringes = np.concatenate([np.cos(phase) * damping, np.sin(phase) * damping])  # Re F, then Im F

    beyond = np.concatenate(
        [
            np.arange(0.5, grid[0] / step * _POLES_PER_STEP) * step / _POLES_PER_STEP,
            np.arange(grid[-1], 1.0 / _POLES_UP_TO_NM, step / _POLES_PER_STEP) + 0.5 * step / _POLES_PER_STEP,
        ]
    )
    # T is even in ν: what has a pole at ν_g has one at −ν_g.
    poles = sum(step * 1j / (grid[:, None] + 1j * height - sign * beyond) for sign in (1.0, -1.0))
    poles = np.concatenate([np.real(poles), np.imag(poles)])

    covariance = (fringes * variance) @ fringes.T + _POLE_STRENGTH * (poles @ poles.T)
    covariance += _NOISE * np.eye(2 * samples)
    wanted = (fringes * variance) @ _fringe_colours(opd_nm, white)
    one = np.repeat([1.0, 0.0], samples)  # the samples of T = 1, whose colour is (1, 1, 1)
    solved = np.linalg.solve(covariance, np.column_stack([wanted, one]))
    weights, correction = solved[:, :3], solved[:, 3:]
    weights = weights + correction * (1.0 - one @ weights) / (one @ correction)
    weights = weights.reshape(2, samples, 3)

    positions = np.arange(-1, GAP_STEPS * (samples - 1) + 2) / GAP_STEPS
    pole = 1j / (np.arange(samples) + 1j * HEIGHT_STEPS - positions[:, None])
    exact = pole.real @ weights[0] + pole.imag @ weights[1]
    # Lines between exact values lie outside what is curved; between these they are right on average.
    gap_weights = exact[1:-1] - (exact[2:] - 2.0 * exact[1:-1] + exact[:-2]) / 12.0
    for array in (grid, weights, gap_weights):
        array.setflags(write=False)
    return WavenumberRule(grid, step, height, weights, gap_weights)


def _fringe_colours(opd_nm: Float64, white: White) -> Float64:
    """Return the colour (d, 3) of cos(2πDν) for each D in `opd_nm` (d,)."""
    wavelength_nm, gauss = gauss_panels(observer_table()[:, 0], _GAUSS_POINTS)
    density = colour_density(wavelength_nm, white) * gauss[:, None]
    turns = 2.0 * np.pi / wavelength_nm
    return np.concatenate([np.cos(np.outer(d, turns)) @ density for d in np.array_split(opd_nm, 16)])
