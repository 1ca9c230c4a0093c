"""What one layer of a stack absorbs: the fall of the Poynting vector through it.

With tangential fields (E, G) of `gltf_iri.optics.stack` and x = 2πz/λ, the power that falls is

    s:  −dS/dx = Im(n²) |E|²        p:  −dS/dx = Im(n²) (|G|² + n₁² sin²θ₁ |E|²/|n²|²)

(Poynting's theorem; for p, E and G stand for the magnetic and the electric field along the layer). Every term
is positive, so small losses keep their digits, where the flux above less the flux below would lose them.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.stack_layers import Layers

__all__ = ["absorbed_in_layer"]

_NO_DIGITS: Final = 1e-290  # a divisor so small stands for 0, at which the quotient has its limit

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]


def absorbed_in_layer(layers: Layers, layer: int, E: Complex128, G: Complex128, *, is_p: bool) -> Float64:
    """Return e^{−2 Im β} ∫ −dS/dx over the layer (...), for the fields E, G (...) at its lower face.

    layer : its number among all media, the outside being 0.
    """
    index, q_squared = layers.index[layer], layers.q_squared[layer]
    epsilon = index * index
    loss = epsilon.imag
    if not np.any(loss != 0.0):
        return np.zeros(())
    squares = _MeanSquare(layers.q[layer], layers.paths[layer - 1])
    if not is_p:
        return np.asarray(loss * squares(E, G))
    size = epsilon.real * epsilon.real + loss * loss
    along = squares(G, (q_squared * epsilon.conj() * (1.0 / size)) * E)
    normal = squares(E, epsilon * G)
    return np.asarray(loss * (along + (layers.transverse_squared / size) * normal))


class _MeanSquare:
    """e^{−2 Im β} ∫ |A cos(qx) − iB sin(qx)/q|² dx from x = 0 to X = 2πd/λ."""

    def __init__(self, q: Complex128, path: Float64) -> None:
        x = (2.0 * np.pi) * path
        half_turns = 2.0 * path * q.real
        turned_rad = np.pi * (half_turns - np.rint(half_turns))
        sine = np.sin(turned_rad)
        fall = x * q.imag
        decay_squared = np.exp(-2.0 * fall)
        # ∫ cosh(2 Im q x), ∫ cos(2 Re q x) and, of the same, ∫ sinh and ∫ sin
        cosh = _over(-0.25 * np.expm1(-4.0 * fall), q.imag, x)
        cos = _over(decay_squared * sine * np.cos(turned_rad), q.real, decay_squared * x)
        sinh = _over(0.25 * np.expm1(-2.0 * fall) ** 2, q.imag, np.zeros(()))
        sin = _over(decay_squared * sine * sine, q.real, np.zeros(()))
        # Where |q|² has no digits left, so has the loss that is below it: only |A|² is kept.
        over_q = q.conj() * _over(1.0, q.real * q.real + q.imag * q.imag, np.zeros(()))
        self._of_A = 0.5 * (cosh + cos)
        self._of_B = 0.5 * (cosh - cos) * (over_q.real**2 + over_q.imag**2)
        self._of_both = -1j * (sin + 1j * sinh) * over_q  # twice ½

    def __call__(self, A: Complex128, B: Complex128) -> Float64:
        squares = self._of_A * (A.real**2 + A.imag**2) + self._of_B * (B.real**2 + B.imag**2)
        # Where the two waves all but cancel, rounding may leave a last bit below 0.
        return np.asarray(np.maximum(squares + (A.conj() * B * self._of_both).real, 0.0))


def _over(a: Any, b: Float64, limit: Any) -> Any:
    is_none = b < _NO_DIGITS
    return np.where(is_none, limit, a / np.where(is_none, 1.0, b))
