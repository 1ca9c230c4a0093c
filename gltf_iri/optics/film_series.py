"""The reflectance of a film as a Fourier series in wavenumber: what all its orders are made of.

Belcour & Barla 2017, Eq. 5–6: R = C₀ + 2 Σ C_m cos(mΦ) with C_m = (R_* − T₁₂₁)|z|^m. As C₀ = 1 + (R_* − T₁₂₁)
where the film absorbs nothing (what is not reflected enters the base), one number G = T₁₂₁ − R_* is enough:

    R(ν) = 1 − G (1 + 2 Σ_{m ≥ 1} Re(z^m exp(2πi mDν))),   z = r₂₁ r₂₃,   D = 2 d q₂,
    G = T₁₂T₂₃/(1 − R₁₂R₂₃) = 4 Y₁Y₂ Re Y₃ / W,   W = Y₁ |Y₂ + Y₃|² + (Y₁ − Y₂)² Re Y₃

with the admittances Y = q (s) and Y ∝ q/n² (p), q = n cos θ. All orders from m on add up to 2 H |z|^m at
most, H = G/(1 − |z|) = (1 + |z|) Y₁ Re Y₃ (Y₁ + Y₂)² |Y₂ + Y₃|²/W², in which nothing cancels. Waves are
exp(−iωt), indices n + ik. Twins: `gltf_iri.compiled.fourier` and `gltf_iri.compiled.fourier_absorbing`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.refraction import normal_index

__all__ = ["NEAR_ZERO", "FilmSeries", "film_series"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]

# What is nearer to 0 is at its limit to the last bit: grazing light, which all is reflected, and a base
# without index. No quotient below is then 0/0.
NEAR_ZERO: Final = 1e-20


@dataclass(frozen=True, slots=True)
class FilmSeries:
    """A film's series; arrays (...) for the path, (2, ...) for s and p.

    q2_squared : (n₂ cos θ₂)²; where it is not positive nothing oscillates, and the series does not hold.
    entering : G/2; ratio : z, real where the base is; tail : H.
    """

    q2_squared: Float64
    entering: Float64
    ratio: Float64 | Complex128
    tail: Float64


def film_series(n1: Float64, n2: Float64, n3: Float64 | Complex128, cos_theta_1: Float64) -> FilmSeries:
    """Return the series of films of index `n2` between `n1` and the bases `n3`, all (...).

    Bases of index ∞ and 0 let nothing enter: G = 0.
    """
    is_mirror = np.isinf(n3) | (np.abs(n3) < NEAR_ZERO)
    n3 = np.where(is_mirror, 1.0, n3)
    q1 = n1 * np.maximum(cos_theta_1, NEAR_ZERO)
    q1_squared = q1 * q1
    q2_squared = (n2 - n1) * (n2 + n1) + q1_squared
    # Where no wave runs in the film there is no series; 1 keeps what no one asks for finite.
    q2 = np.sqrt(np.where(q2_squared > 0.0, q2_squared, 1.0))
    q3_squared = (n3 - n1) * (n3 + n1) + q1_squared
    # The light that a real base reflects in total enters it nowhere, whatever its phase: Re q₃ = 0 says so.
    q3 = normal_index(q3_squared) if np.iscomplexobj(n3) else np.sqrt(np.maximum(q3_squared, 0.0))
    one, two, three = n1 * n1, n2 * n2, n3 * n3
    s = _polarisation(q1, q2, q3, is_mirror)
    # Common factors of the three admittances cancel; so written, no index is divided by.
    p = _polarisation(q1 * two, q2 * one, q3 * one * two / three, is_mirror)
    return FilmSeries(q2_squared, *(np.stack(pair) for pair in zip(s, p, strict=True)))


def _polarisation(y1: Any, y2: Any, y3: Any, is_mirror: NDArray[np.bool_]) -> tuple[Any, Any, Any]:
    """Return G/2, z and H of one polarisation."""
    into = np.where(is_mirror, 0.0, y3.real)
    first, second = y1 + y2, y2 + y3
    second_squared = second.real * second.real + second.imag * second.imag
    contrast = y1 - y2
    inverse = 1.0 / (y1 * second_squared + contrast * contrast * y3.real)
    z = -contrast * (y2 - y3) / (first * second)
    tail = (1.0 + np.abs(z)) * (y1 * into) * (first * first * inverse) * (second_squared * inverse)
    return 2.0 * y1 * y2 * into * inverse, z, tail
