"""How light and viewer see the layers of a stack: through its smooth coating, where the host is not air.

Layers lie in a host medium. Where its index is not 1, its surface is a smooth coating that bends light and
viewer towards the normal and mirrors part of either; directions at the layers are those inside (Fourneau et
al. 2024, §4.1 and Eq. 34).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.refraction import normal_index_squared_real

__all__ = ["Sight", "coating_transmittance", "cosine_in_host", "half_vector", "sight_of"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Sight:
    """What a stack's layers see of a light and a viewer outside; arrays broadcast.

    cos_i, cos_o : cosines of light and viewer at the layers, in the host.
    cos_h : cosine of light (and viewer) and half vector, there; the angle that facets are met at.
    n_cross_h_squared : sin²θ_h of that half vector.
    passage : T(i) T(o) / n_h², what the coating leaves of a BRDF below it; 1 without a coating.
    """

    cos_i: Float64
    cos_o: Float64
    cos_h: Float64
    n_cross_h_squared: Float64
    passage: Float64


def cosine_in_host(host_ior: ArrayLike, cos_theta: ArrayLike) -> Float64:
    """cosθ' = √(1 − (1 − c²)/n_h²), Snell's law from air; `cos_theta` itself where the host is air."""
    n, c = np.asarray(host_ior, np.float64), np.asarray(cos_theta, np.float64)
    inside = np.sqrt(normal_index_squared_real(n, 1.0, c)) / n
    # One rounding above 1 has no sine.
    return np.asarray(np.where(n == 1.0, c, np.minimum(inside, 1.0)))


def coating_transmittance(host_ior: ArrayLike, cos_theta: ArrayLike) -> Float64:
    """T = ½(T_s + T_p) of the step from air into the host, T = 4Y₁Y₂/(Y₁ + Y₂)², Y = q (s) and q/n² (p).

    host_ior : real, ≥ 1; cos_theta : outside, in [0, 1]; arrays broadcast.
    """
    n, c = np.asarray(host_ior, np.float64), np.asarray(cos_theta, np.float64)
    inside = n * cosine_in_host(n, c)
    # Along a surface without a step nothing is mirrored: 0/0 there.
    t_s, t_p = (
        np.divide(
            4.0 * a * inside, (a + inside) ** 2, out=np.ones(np.shape(a + inside)), where=a + inside > 0.0
        )
        for a in (c, n * n * c)
    )
    return np.asarray(0.5 * (t_s + t_p))


def half_vector(
    cos_i: ArrayLike, cos_o: ArrayLike, turn: ArrayLike, sines: tuple[Float64, Float64] | None = None
) -> tuple[Float64, Float64]:
    """Return i·h and |n×h|² of the half vector h; arrays broadcast.

    i·o = c_i c_o + s_i s_o cosφ, i·h = √(½(1 + i·o)) and |n×h|² = |s_i + s_o e^{iφ}|² / (2(1 + i·o)).

    cos_i, cos_o : in [0, 1]; turn : 1 + cosφ of the turn between them, in [0, 2], 0 in the mirror direction.
    sines : of the same angles, where they are known better than the cosines know them: near the normal.
    """
    i, o, t = (np.asarray(x, np.float64) for x in (cos_i, cos_o, turn))
    sin_i, sin_o = sines or (_sine(i), _sine(o))
    product = sin_i * sin_o
    # 1 + i·o = 1 + cos(θ_i + θ_o) + s_i s_o (1 + cosφ); the first two are (c_i + c_o)²/(1 + cos(θ_i − θ_o)).
    total = (i + o) ** 2 / (1.0 + i * o + product) + product * t
    tilt = (sin_i - sin_o) ** 2 + 2.0 * product * t
    # 0/0 where both graze from opposite sides: no facet is met.
    sine_squared = np.divide(tilt, 2.0 * total, out=np.zeros(np.shape(total)), where=total > 0.0)
    return np.asarray(np.sqrt(0.5 * total)), np.asarray(np.minimum(sine_squared, 1.0))


def sight_of(
    host_ior: ArrayLike, cos_theta_i: ArrayLike, cos_theta_o: ArrayLike, cos_phi: ArrayLike
) -> Sight:
    """Return how the layers are seen; arrays broadcast.

    host_ior : real index, ≥ 1.
    cos_theta_i, cos_theta_o : of light and viewer outside, in [0, 1]; cos_phi : of the turn between them
        about the normal, −1 where the viewer stands in the plane and on the side of the mirrored light.
    """
    cos_i, cos_o = cosine_in_host(host_ior, cos_theta_i), cosine_in_host(host_ior, cos_theta_o)
    n = np.asarray(host_ior, np.float64)
    # Snell's law for sines: near the normal a cosine inside has lost the angle's digits.
    sines = _sine(cos_theta_i) / n, _sine(cos_theta_o) / n
    cos_h, n_cross_h_squared = half_vector(cos_i, cos_o, 1.0 + np.asarray(cos_phi, np.float64), sines)
    outside = coating_transmittance(n, cos_theta_i) * coating_transmittance(n, cos_theta_o) / (n * n)
    return Sight(
        cos_i,
        cos_o,
        cos_h,
        n_cross_h_squared,
        np.asarray(np.where(n == 1.0, 1.0, outside)),
    )


def _sine(cosine: ArrayLike) -> Float64:
    c = np.asarray(cosine, np.float64)
    return np.asarray(np.sqrt((1.0 - c) * (1.0 + c)))
