"""Quadrature rules for colour: which wavelengths to ask for, and with what weights.

The integrand is a smooth reflectance times colour weights that are only piecewise smooth. So the reflectance
alone is interpolated, by the polynomial through Chebyshev–Lobatto nodes in wavenumber ν = 1/λ (in which film
fringes are plain cosines), and the weights are the exact integrals of its Chebyshev terms against observer
and illuminant (product integration; Sloan & Smith 1978). A rule of twice the degree keeps every node.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.gauss import gauss_panels
from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM, colour_matching, illuminant, observer_table
from gltf_iri.colour.spaces import White, rgb_matrix
from gltf_iri.errors import UsageError

__all__ = ["HALF_BANDWIDTH_PER_NM", "SPECTRAL_DEGREE", "ColourRule", "colour_density", "colour_rule"]
__all__ += ["resolved_opd_nm"]

Float64 = NDArray[np.float64]

_SHORTEST_NM, _LONGEST_NM = WAVELENGTH_RANGE_NM
_MIDDLE_PER_NM: Final = 0.5 * (1.0 / _SHORTEST_NM + 1.0 / _LONGEST_NM)

# Half the range of ν: cos(2πDν) turns through D·2π·this on [−1, 1], and needs a degree beyond that.
HALF_BANDWIDTH_PER_NM: Final = 0.5 * (1.0 / _SHORTEST_NM - 1.0 / _LONGEST_NM)

# Of the rule that travels to OpenGL; it resolves path differences of some 100 µm.
SPECTRAL_DEGREE: Final = 512

# Gauss points per panel of at most _PANEL_RAD of the fastest term's phase: 8 points integrate it to 1e-16.
_GAUSS_POINTS: Final = 8
_PANEL_RAD: Final = 2.0


@dataclass(frozen=True, slots=True)
class ColourRule:
    """rgb = Σ reflectance(wavelength_nm[i]) · weights[i]; nodes run from short to long wavelengths."""

    wavelength_nm: Float64  # (degree + 1,)
    weights: Float64  # (degree + 1, 3); each column sums to 1


def resolved_opd_nm(degree: int) -> float:
    """Return the longest path difference whose fringes a rule of `degree` can resolve, in nm."""
    return degree / (2.0 * math.pi * HALF_BANDWIDTH_PER_NM)


@cache
def colour_rule(degree: int, white: White) -> ColourRule:
    """Return the rule of an even `degree`; its even-numbered nodes are those of half the degree."""
    j = np.arange(degree + 1)
    # sin form: symmetric to the last bit, so that doubled rules repeat their nodes exactly.
    x = np.sin(0.5 * np.pi * (degree - 2 * j) / degree)
    wavelength_nm = 1.0 / (_MIDDLE_PER_NM + HALF_BANDWIDTH_PER_NM * x)
    moments = _moments(degree, white)
    # Type-I cosine transform of the moments, end terms halved, gives the interpolant's weights.
    halved = moments.copy()
    halved[[0, -1]] *= 0.5
    mirrored = np.concatenate([halved, halved[-2:0:-1]])
    mirrored[[0, degree]] *= 2.0
    weights = np.fft.rfft(mirrored, axis=0).real / degree
    weights[[0, -1]] *= 0.5
    weights /= weights.sum(axis=0)
    for array in (wavelength_nm, weights):
        array.setflags(write=False)
    return ColourRule(wavelength_nm, weights)


def colour_density(wavelength_nm: Float64, white: White) -> Float64:
    """Return the density (..., 3) with rgb = ∫ R(λ) density(λ) dλ; each channel integrates to 1."""
    return _density(wavelength_nm, white) / _white_integral(white)


def _moments(degree: int, white: White) -> Float64:
    """Return ∫ density(λ) T_k(x(λ)) dλ for k = 0 … degree, shape (degree + 1, 3)."""
    theta, weighted = _panels(degree, white)
    # cos((s i + j)θ) = cos(s i θ) cos(jθ) − sin(s i θ) sin(jθ): two small tables and a matrix product.
    stride = int(np.sqrt(degree)) + 1
    fine = np.arange(stride)[:, None] * theta
    coarse = stride * np.arange(stride)[:, None] * theta
    cos_fine, sin_fine = np.cos(fine), np.sin(fine)
    cos_coarse, sin_coarse = np.cos(coarse), np.sin(coarse)
    columns = [
        ((cos_coarse * w) @ cos_fine.T - (sin_coarse * w) @ sin_fine.T).reshape(-1)[: degree + 1]
        for w in weighted.T
    ]
    return np.stack(columns, axis=-1)


def _panels(degree: int, white: White) -> tuple[Float64, Float64]:
    """Return Gauss points θ = arccos x and the colour density times their weights, panel by panel.

    Panels end at every kink of the density and are short against the fastest Chebyshev term cos(degree·θ).
    """
    steps = int(np.ceil(degree * np.pi / _PANEL_RAD))
    x = np.cos(np.linspace(0.0, np.pi, steps + 1)[1:-1])
    edges_nm = np.union1d(observer_table()[:, 0], 1.0 / (_MIDDLE_PER_NM + HALF_BANDWIDTH_PER_NM * x))
    wavelength_nm, gauss = gauss_panels(edges_nm, _GAUSS_POINTS)
    density = colour_density(wavelength_nm, white) * gauss[:, None]
    x = (1.0 / wavelength_nm - _MIDDLE_PER_NM) / HALF_BANDWIDTH_PER_NM
    return np.arccos(np.clip(x, -1.0, 1.0)), density  # rounding may put an end outside [−1, 1]


def _density(wavelength_nm: Float64, white: White) -> Float64:
    power = illuminant(wavelength_nm, white)[..., None]
    return np.asarray((colour_matching(wavelength_nm) * power) @ rgb_matrix(white).T)


@cache
def _white_integral(white: White) -> Float64:
    """Return ∫ density dλ (3,) before normalisation; UsageError where a channel has no white."""
    wavelength_nm, gauss = gauss_panels(observer_table()[:, 0], _GAUSS_POINTS)
    total = (_density(wavelength_nm, white) * gauss[:, None]).sum(axis=0)
    if not np.all(total > 0.0):
        raise UsageError("A channel of this RGB space sees nothing of this light: it has no white.")
    return np.asarray(total)
