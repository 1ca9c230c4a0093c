"""One interface: exact amplitudes, powers and phases, and the approximation that glTF's text is written in.

Wave convention exp(−iωt), index n + ik with k ≥ 0. q = n cos θ is the component of the index along the normal
(`gltf_iri.optics.refraction`).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.modulus import squared_modulus

__all__ = ["InterfacePower", "amplitude_p", "amplitude_s", "f_schlick", "interface_power", "phase_rad"]
__all__ += ["transmission_p", "transmission_s"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]


def f_schlick(f0: ArrayLike, cos_theta: ArrayLike) -> Float64:
    """Return F₀ + (1 − F₀)(1 − cos θ)⁵ (Schlick 1994, Eq. 15; glTF 2.0 §B.3.4)."""
    f0 = np.asarray(f0, dtype=np.float64)
    return np.asarray(f0 + (1.0 - f0) * _fifth_power(1.0 - np.asarray(cos_theta, dtype=np.float64)))


def amplitude_s(q_1: ArrayLike, q_2: ArrayLike) -> Complex128:
    """Return r_s = (q₁ − q₂)/(q₁ + q₂), electric field perpendicular to the plane of incidence.

    q₁ = q₂ = 0 (grazing light on a matched interface) reflects nothing: r = 0.
    """
    return _contrast(np.asarray(q_1, dtype=np.complex128), np.asarray(q_2, dtype=np.complex128))


def amplitude_p(n_1: ArrayLike, q_1: ArrayLike, n_2: ArrayLike, q_2: ArrayLike) -> Complex128:
    """Return r_p = (n₂²q₁ − n₁²q₂)/(n₂²q₁ + n₁²q₂), magnetic field perpendicular to the plane of incidence.

    At normal incidence r_p = −r_s (the magnetic field's convention); reflectances do not depend on it.
    """
    n_1 = np.asarray(n_1, dtype=np.complex128)
    n_2 = np.asarray(n_2, dtype=np.complex128)
    first = n_2 * n_2 * np.asarray(q_1, dtype=np.complex128)
    second = n_1 * n_1 * np.asarray(q_2, dtype=np.complex128)
    return _contrast(first, second)


def transmission_s(q_1: ArrayLike, q_2: ArrayLike) -> Complex128:
    """Return t_s = 2q₁/(q₁ + q₂), the electric field behind the interface; 1 for q₁ = q₂ = 0."""
    first, second = np.asarray(q_1, dtype=np.complex128), np.asarray(q_2, dtype=np.complex128)
    return _share(2.0 * first, first + second)


def transmission_p(n_1: ArrayLike, q_1: ArrayLike, n_2: ArrayLike, q_2: ArrayLike) -> Complex128:
    """Return t_p = 2n₁n₂q₁/(n₂²q₁ + n₁²q₂), the electric field behind (Born & Wolf, §1.5.2, Eq. 20a)."""
    n_1, q_1, n_2, q_2 = (np.asarray(a, dtype=np.complex128) for a in (n_1, q_1, n_2, q_2))
    return _share(2.0 * n_1 * n_2 * q_1, n_2 * n_2 * q_1 + n_1 * n_1 * q_2)


class InterfacePower(NamedTuple):
    """Shares of the incident power, each (...): what returns, and what enters the second medium."""

    R_s: Float64
    R_p: Float64
    T_s: Float64
    T_p: Float64


def interface_power(n_1: ArrayLike, q_1: ArrayLike, n_2: ArrayLike, q_2: ArrayLike) -> InterfacePower:
    """Return R and T, the normal components of the energy flux, for light from a medium that absorbs nothing.

    q > 0 in the first medium, since at q = 0 no light arrives. With a second medium that absorbs, T is the
    flux just behind the interface: T_s = (Re q₂/q₁)|t_s|², T_p = (Re(n₂* cosθ₂)/(n₁ cosθ₁))|t_p|².
    """
    n1, q1 = np.asarray(n_1, dtype=np.float64), np.asarray(q_1, dtype=np.float64)
    n2, q2 = np.asarray(n_2, dtype=np.complex128), np.asarray(q_2, dtype=np.complex128)
    s, p = amplitude_s(q1, q2), amplitude_p(n1, q1, n2, q2)
    t_s, t_p = transmission_s(q1, q2), transmission_p(n1, q1, n2, q2)
    # n₂* cosθ₂ = n₂* q₂/n₂
    into_p = (n2.conj() * q2 / n2).real
    return InterfacePower(
        squared_modulus(s),
        squared_modulus(p),
        q2.real / q1 * squared_modulus(t_s),
        into_p / q1 * squared_modulus(t_p),
    )


def phase_rad(amplitude: ArrayLike) -> Float64:
    """Return the phase, in (−π, π], that an amplitude of reflection or transmission adds to exp(−iωt).

    Positive where the wave lags. Beyond total reflection δ_s = −2 arctan(√(sin²θ − n²)/cos θ) (Born & Wolf,
    §1.5.4, Eq. 60); at a metal between −π and 0 for s, since k > 0.
    """
    return np.asarray(np.angle(np.asarray(amplitude, dtype=np.complex128)))


def _contrast(a: Complex128, b: Complex128) -> Complex128:
    total = a + b
    is_empty = total == 0.0
    return np.asarray(np.where(is_empty, 0.0, (a - b) / np.where(is_empty, 1.0, total)))


def _share(a: Any, total: Any) -> Complex128:
    is_empty = total == 0.0
    return np.asarray(np.where(is_empty, 1.0, a / np.where(is_empty, 1.0, total)))


def _fifth_power(x: Float64) -> Float64:
    square = x * x
    return np.asarray(square * square * x)
