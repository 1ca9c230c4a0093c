"""Where the reflectance of a Bragg mirror of many cells turns: modes, band-gap edges, Airy and zero points.

Fourneau et al. 2024, §3.2.1 and Appendix A. Frequencies are stated as t = ω (q₁d₁ + q₂d₂)/π, so that spectral
modes (Eq. 13) are whole numbers. With lean ρ = (q₁d₁ − q₂d₂)/(q₁d₁ + q₂d₂) and r = r₁₂ of one polarisation,
Eq. 36 reads (1 − r²) cos KΛ = cos πt − r² cos ρπt, and its edges |cos KΛ| = 1 near the mode m, t = m + δ, are

    sin ½πδ = ± r sin(½ρπt)  for even m,    sin ½πδ = ± r cos(½ρπt)  for odd m,

simple roots even where a gap closes. They and the Airy points are roots of sin x = κ sin(ρx + φ), κ < 1.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.turns import sincos_turns

__all__ = ["MODES_MAX", "ROOT_FINDERS", "Band", "RootFinder", "band", "band_gap_function"]
__all__ += ["envelope_transmittance", "newton_steps", "zero_point"]

Float64 = NDArray[np.float64]

# "newton-k": a closed-form guess and k Newton steps on the edges' factors. "bisect-10": ten halvings on
# cos KΛ, between modes for the Airy point and from it to either mode for the edges, as published.
RootFinder = Literal["newton-2", "newton-1", "bisect-10"]
ROOT_FINDERS: Final[tuple[RootFinder, ...]] = get_args(RootFinder)

# More gaps are visible in cells of some 80 µm and beyond: of their bands every k-th is searched.
MODES_MAX: Final = 256

_HALVINGS: Final = 10
_TINY: Final = 1e-150  # keeps 0/0 at closed gaps and at r = 1 from being NaN, and its square from underflow
_LEAST_SLOPE: Final = 0.05  # keeps a step off a flat slope (grazing light only) from leaving the bracket


def newton_steps(root_finder: RootFinder) -> int:
    """Return the number of Newton steps of a root finder, 0 for ten halvings."""
    return 0 if root_finder == "bisect-10" else int(root_finder.removeprefix("newton-"))


@dataclass(frozen=True, slots=True)
class Band:
    """The pass band between two modes, each (...): from one gap over the Airy point to the next gap."""

    start: Float64
    airy: Float64
    end: Float64


def band(mode: ArrayLike, lean: ArrayLike, r_squared: ArrayLike, root_finder: RootFinder) -> Band:
    """Return the landmarks in [mode, mode + 1]; start ≤ airy ≤ end.

    mode : m ≥ 0, whole. lean : ρ in [−1, 1]. r_squared : r₁₂² of one polarisation, in [0, 1].
    """
    m, rho, square = (np.asarray(a, dtype=np.float64) for a in (mode, lean, r_squared))
    if root_finder == "bisect-10":
        return _band_by_halving(m, rho, square)
    steps = newton_steps(root_finder)
    amplitude = np.sqrt(square)
    start = m + _offset(amplitude, *_edge_phase(m, rho), rho, steps)
    end = m + 1.0 - _offset(amplitude, *_edge_phase(m + 1.0, rho), -rho, steps)
    # Airy point: cos πt = r² cos ρπt, t = m + ½ + x/π.
    sine, cosine = sincos_turns(0.25 * (rho * (2.0 * m + 1.0)))
    sign = np.where(_is_odd(m), 1.0, -1.0)
    airy = m + 0.5 + 0.5 * _offset(square, sign * cosine, -sign * sine, rho, steps)
    airy = np.clip(airy, m, m + 1.0)
    return Band(np.minimum(start, airy), airy, np.maximum(end, airy))


def zero_point(found: Band, lean: ArrayLike) -> Float64:
    """Return where the band's R^e is 0 (Eq. 12: q₂d₂ω = zπ), or its Airy point where that lies in a gap.

    Zero points are at least one mode apart, so that a band holds one or none.
    """
    share = np.maximum(1.0 - np.asarray(lean, dtype=np.float64), _TINY)
    zero = np.floor(0.5 * share * found.end) * (2.0 / share)
    is_inside = (found.start < zero) & (zero < found.end)
    return np.asarray(np.where(is_inside, zero, found.airy))


def envelope_transmittance(t: ArrayLike, lean: ArrayLike, r_squared: ArrayLike) -> Float64:
    """Return 1 − R^e (Eq. 11) at t, 0 inside gaps, with half the angles S = πt and D = ρπt:

    (sin² ½S − r² sin² ½D)(cos² ½S − r² cos² ½D) / (sin ½S cos ½S − r² sin ½D cos ½D)²
    """
    t, rho, square = (np.asarray(a, dtype=np.float64) for a in (t, lean, r_squared))
    sin_s, cos_s = sincos_turns(0.25 * t)
    sin_d, cos_d = sincos_turns(0.25 * (rho * t))
    product = (sin_s * sin_s - square * (sin_d * sin_d)) * (cos_s * cos_s - square * (cos_d * cos_d))
    mean = sin_s * cos_s - square * (sin_d * cos_d)
    # The clip keeps rounding at the edges, and 0/0 at closed gaps, from leaving [0, 1].
    return np.asarray(np.clip(product / np.maximum(mean * mean, _TINY), 0.0, 1.0))


def band_gap_function(t: ArrayLike, lean: ArrayLike, r_squared: ArrayLike) -> Float64:
    """Return (1 − r²) cos KΛ at t (Eq. 8 and 36); it does not overflow at r = 1."""
    t, rho, square = (np.asarray(a, dtype=np.float64) for a in (t, lean, r_squared))
    _, cos_s = sincos_turns(0.5 * t)
    _, cos_d = sincos_turns(0.5 * (rho * t))
    return np.asarray(cos_s - square * cos_d)


def _offset(kappa: Any, sine: Any, cosine: Any, rho: Any, steps: int) -> Float64:
    """Return 2x/π of the root x of sin x = κ (sine cos ρx + cosine sin ρx), after `steps` Newton steps."""
    drive = kappa * sine
    # tan x in closed form; exact at ρ = 0 and ρ = ±1.
    root = np.sqrt(np.maximum(1.0 - drive * drive * (1.0 - rho * rho), 0.0))
    tangent = drive / np.maximum(root - kappa * rho * cosine, _TINY)
    x = _coarse_arctan(tangent)
    for _ in range(steps):
        sin_x, cos_x = np.sin(x), np.cos(x)
        sin_r, cos_r = np.sin(rho * x), np.cos(rho * x)
        value = sin_x - kappa * (sine * cos_r + cosine * sin_r)
        slope = cos_x - kappa * rho * (cosine * cos_r - sine * sin_r)
        x = x - value / np.maximum(slope, _LEAST_SLOPE)
        x = np.clip(x, -0.5 * np.pi, 0.5 * np.pi)
    return np.asarray(x * (2.0 / np.pi))


def _coarse_arctan(y: Float64) -> Float64:
    """Return arctan y to 0.005: a Newton step squares what is missing."""
    size = np.abs(y)
    small = size / (1.0 + 0.28 * size * size)
    large = 0.5 * np.pi - size / (size * size + 0.28)
    return np.copysign(np.where(size <= 1.0, small, large), y)


def _edge_phase(mode: Float64, rho: Float64) -> tuple[Float64, Float64]:
    """Return sine and cosine of φ for the edges of a mode, turned so that the root is positive."""
    sine, cosine = sincos_turns(0.25 * (rho * mode))
    is_odd = _is_odd(mode)
    g, h = np.where(is_odd, cosine, sine), np.where(is_odd, -sine, cosine)
    return np.abs(g), np.copysign(1.0, g) * h


def _band_by_halving(m: Float64, rho: Float64, square: Float64) -> Band:
    shape = np.broadcast_shapes(m.shape, rho.shape, square.shape)
    sign = np.where(_is_odd(m), -1.0, 1.0)
    low, high = np.broadcast_to(m, shape), np.broadcast_to(m + 1.0, shape)
    airy = _halve(low, high, sign, 0.0, rho, square)
    start = _halve(low, airy, sign, 1.0 - square, rho, square)
    end = _halve(airy, high, sign, square - 1.0, rho, square)
    # No gap is at ω = 0, and none anywhere in a cell of equal media: there nothing is left to be halved.
    is_matched = square == 0.0
    return Band(np.where(is_matched | (low == 0.0), low, start), airy, np.where(is_matched, high, end))


def _halve(low: Float64, high: Float64, sign: Any, level: Any, rho: Any, square: Any) -> Float64:
    """Return where the falling sign · cos KΛ (1 − r²) passes `level`."""
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        is_before = sign * band_gap_function(middle, rho, square) > level
        low, high = np.where(is_before, middle, low), np.where(is_before, high, middle)
    return np.asarray(0.5 * (low + high))


def _is_odd(mode: Float64) -> NDArray[np.bool_]:
    return np.asarray(np.fmod(mode, 2.0) == 1.0)
