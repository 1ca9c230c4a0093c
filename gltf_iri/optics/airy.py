"""One film that may absorb, and where all light goes: reflected, into the base, absorbed within.

The Airy sum (Belcour & Barla 2017, Eq. 2–3; Born & Wolf, §1.6.4 and §14.4) over the phase β = 2πd q₂/λ is,
all times e^{iβ} so that nothing overflows, and without the interfaces' amplitudes, which cancel near grazing,

    D = (Y₁ + Y₃) cos β − i(Y₂² + Y₁Y₃) sin β/Y₂,    t = 2Y₁/D,
    r = ((Y₁ − Y₃) cos β + i(Y₂² − Y₁Y₃) sin β/Y₂)/D.

In the film a wave of amplitude f runs down from its top and one of amplitude b up from its bottom. The fall
of the Poynting vector between both faces is what the film absorbs,

    A Y₁ = Re Y₂ (|f|² + |b|²)(1 − e^{−2β″}) + 4 Im Y₂ sin β′ e^{−β″} Re(f b*),    β = β′ + iβ″,

which is computed apart from R and T. Admittances Y = q (s) and q/n² (p); exp(−iωt), n + ik, k ≥ 0.
`gltf_iri.optics.film` is faster where the film absorbs nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.modulus import squared_modulus
from gltf_iri.optics.refraction import normal_index, normal_index_squared, normal_index_squared_exact
from gltf_iri.optics.two_floats import exact_product, reciprocal, square_root

__all__ = ["FilmPower", "film_power"]

Float64 = NDArray[np.float64]

# Flatter light than this is at its limit to the last bit; no square of it underflows.
_GRAZING = 1e-40


@dataclass(frozen=True, slots=True)
class FilmPower:
    """Shares of the incident power, each (...): reflected R, entering the base T, absorbed in the film A."""

    R_s: Float64
    R_p: Float64
    T_s: Float64
    T_p: Float64
    A_s: Float64
    A_p: Float64


def film_power(
    outside_ior: ArrayLike,
    film_index: ArrayLike,
    base_index: ArrayLike,
    thickness_nm: ArrayLike,
    wavelength_nm: ArrayLike,
    cos_theta_1: ArrayLike,
) -> FilmPower:
    """Return where the light goes; all arguments broadcast.

    outside_ior : real; film_index, base_index : n + ik, k ≥ 0, finite and not 0.
    """
    n1 = np.asarray(outside_ior, dtype=np.float64)
    n2, n3 = (np.asarray(a, dtype=np.complex128) for a in (film_index, base_index))
    c1 = np.maximum(np.asarray(cos_theta_1, dtype=np.float64), _GRAZING)
    twice_nm = 2.0 * np.asarray(thickness_nm, dtype=np.float64)
    wavelength = np.asarray(wavelength_nm, dtype=np.float64)
    q2, q3 = (normal_index(normal_index_squared(n, n1, c1)) for n in (n2, n3))
    q2 = np.where(np.abs(q2) < _GRAZING, _GRAZING, q2)
    phase = np.pi * (
        _half_turns(n2, q2, n1, c1, twice_nm, wavelength) + 1j * (twice_nm / wavelength * q2.imag)
    )
    y1 = n1 * c1
    with np.errstate(invalid="ignore"):  # numpy warns where NaN divides complex numbers: NaN in is NaN out
        s = _shares(y1, q2, q3, phase)
        p = _shares(y1 / (n1 * n1), q2 / (n2 * n2), q3 / (n3 * n3), phase)
    return FilmPower(s[0], p[0], s[1], p[1], s[2], p[2])


def _half_turns(n2: Any, q2: Any, n1: Any, c1: Any, twice_nm: Any, wavelength: Any) -> Any:
    """Return β′/π less the whole half turns, which only change the sign of the waves inside.

    With twice float64's digits where the film absorbs nothing: there thick films have resonances as narrow as
    the last bit of so many turns.
    """
    squared, squared_low = normal_index_squared_exact(n2.real, n1, c1)
    root, root_low = square_root(np.maximum(squared, _GRAZING**2), squared_low)
    is_running = (n2.imag == 0.0) & (squared > 0.0)
    q, q_low = np.where(is_running, root, q2.real), np.where(is_running, root_low, 0.0)
    per_nm, per_nm_low = reciprocal(wavelength)
    path, path_low = exact_product(twice_nm, per_nm)
    turns, low = exact_product(q, path)
    return (turns - np.rint(turns)) + (low + (q * (path_low + twice_nm * per_nm_low) + q_low * path))


def _shares(y1: Any, y2: Any, y3: Any, phase: Any) -> tuple[Float64, Float64, Float64]:
    """Return R, T and A of one polarisation, from the amplitude 1 that falls on the film."""
    wave = np.exp(1j * phase)
    cosine = 0.5 + 0.5 * wave * wave  # times e^{iβ}, as is the sine over Y₂
    sine = -0.5j * np.expm1(2j * phase) / y2
    D = (y1 + y3) * cosine - 1j * (y2 * y2 + y1 * y3) * sine
    r = ((y1 - y3) * cosine + 1j * (y2 * y2 - y1 * y3) * sine) / D
    t = 2.0 * y1 * wave / D
    f, b = y1 * (y2 + y3) / (y2 * D), y1 * (y2 - y3) * wave / (y2 * D)
    fading = phase.imag
    absorbed = y2.real * (squared_modulus(f) + squared_modulus(b)) * -np.expm1(-2.0 * fading)
    absorbed = absorbed + 4.0 * y2.imag * np.sin(phase.real) * np.exp(-fading) * (f * b.conj()).real
    # A last bit above 1 is rounding, where all is reflected; one below 0, where nothing enters.
    R = np.minimum(squared_modulus(r), 1.0)
    return R, np.maximum(y3.real, 0.0) / y1 * squared_modulus(t), np.maximum(absorbed / y1, 0.0)
