"""Any coherent stack of plane layers: what it reflects, lets through and absorbs, layer by layer.

From the exit medium upward the tangential fields (E, G) pass a layer by its characteristic matrix (Abelès
1950; Born & Wolf, §1.6), written for exp(−iωt) and n + ik:

    E ← C E − iS G,   G ← C G − iY²S E,   C = cos β,   S = sin β/Y,   β = 2πqd/λ

with Y = q (s) and q/n² (p), q = n cos θ. A passive stack's wave grows on this way up, so nothing cancels; the
matrix is scaled by e^{−Im β}, so nothing overflows; it holds no ratio of fields, so no node of a standing
wave divides by zero, and none of reflection amplitudes, which near grazing cancel. At the top
r = (Y₁E − G)/(Y₁E + G). `gltf_iri.compiled.stack` is the same loop compiled.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.backends import Backend
from gltf_iri.optics.modulus import squared_modulus
from gltf_iri.optics.stack_absorption import absorbed_in_layer
from gltf_iri.optics.stack_layers import Layers

__all__ = ["StackPower", "StackResponse", "stack", "stack_power"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]

_NOTHING: Final = 1e-300  # fields at the top, smaller than any light and index gives

# Layers between two scalings of the fields, which a layer of an index up to 1e6 raises by 1e22 at most.
_SCALE_EVERY: Final = 4


@dataclass(frozen=True, slots=True)
class StackPower:
    """Shares of the incident power: reflected, and carried into the exit medium at its face; each (...)."""

    R_s: Float64
    R_p: Float64
    T_s: Float64
    T_p: Float64


@dataclass(frozen=True, slots=True)
class StackResponse(StackPower):
    """With what each layer absorbs, (layers, ...): R + T + Σ absorbed = 1 for either polarisation."""

    absorbed_s: Float64
    absorbed_p: Float64


def stack_power(
    indices: Sequence[ArrayLike],
    thicknesses_nm: Sequence[ArrayLike],
    wavelength_nm: ArrayLike,
    cos_theta_1: ArrayLike,
    *,
    backend: Backend = "numpy",
) -> StackPower:
    """Return R and T of both polarisations; the result's shape (...) is that of all arrays broadcast.

    indices : the outside, real; each layer from the outside in; the exit medium. Each is a number or an array
        (...) of n + ik, k ≥ 0, |n + ik| in [1e-6, 1e6]; along the wavelengths' axis where it is dispersive.
    thicknesses_nm : of the layers alone, each a number or an array (...), ≥ 0; none for a bare interface.
    wavelength_nm, cos_theta_1 : (...); the cosine is taken outside, in [0, 1].

    NaN anywhere gives NaN there. Raises UsageError where the numbers of indices and thicknesses do not fit or
    the outside absorbs.
    """
    layers = Layers.of(indices, thicknesses_nm, wavelength_nm, cos_theta_1)
    if backend == "numba":
        from gltf_iri.compiled.stack import stack_power_compiled

        return StackPower(*stack_power_compiled(layers))
    (R_s, T_s, _), (R_p, T_p, _) = _both(layers, with_absorption=False)
    return StackPower(R_s, R_p, T_s, T_p)


def stack(
    indices: Sequence[ArrayLike],
    thicknesses_nm: Sequence[ArrayLike],
    wavelength_nm: ArrayLike,
    cos_theta_1: ArrayLike,
) -> StackResponse:
    """Return what `stack_power` does, and the power that each layer absorbs, (layers, ...).

    That is the fall of the Poynting vector through the layer, as the integral of its divergence: a lossless
    layer absorbs exactly nothing, and R + T + Σ absorbed = 1 is a check of the numbers, not their definition.
    """
    layers = Layers.of(indices, thicknesses_nm, wavelength_nm, cos_theta_1)
    (R_s, T_s, absorbed_s), (R_p, T_p, absorbed_p) = _both(layers, with_absorption=True)
    return StackResponse(R_s, R_p, T_s, T_p, absorbed_s, absorbed_p)


class _Fields:
    """The fields (E, H) of one polarisation on their way up, and what is kept of them.

    H = −iG turns the matrix into C and ±S, which are real where light runs without loss.
    """

    def __init__(self, layers: Layers, *, is_p: bool, keep: bool) -> None:
        self._layers = layers
        # S = sin β/q and Y²S = q sin β for s; for p the first is times n², the second over n².
        self._down = layers.epsilon() if is_p else None
        self._up = layers.over_epsilon() if is_p else None
        self._keeps = keep
        self._kept: list[tuple[Complex128, Complex128, Any]] = []
        self._E: Complex128 = np.ones((), np.complex128)
        self._H: Complex128 = -1j * self._admittance(-1)
        self._through: Any = np.ones(())  # a field at the exit for one at the top, in size

    def _admittance(self, medium: int) -> Complex128:
        q = self._layers.q[medium]
        return q if self._up is None else np.asarray(q * self._up[medium])

    def pass_layer(self, layer: int, cosine: Any, forward: Any, backward: Any, fall: Any) -> None:
        """Cross a layer of C = `cosine`, and of S and Y²S as for s, all times `fall` = e^{−Im β}."""
        if self._down is not None and self._up is not None:
            down, up = self._down[layer], self._up[layer]
            is_real = not (np.iscomplexobj(forward) or np.any(down.imag != 0.0))
            down, up = (down.real, up.real) if is_real else (down, up)
            forward, backward = down * forward, up * backward
        E, H = self._E, self._H
        self._E, self._H = cosine * E + forward * H, cosine * H - backward * E
        if layer % _SCALE_EVERY == 0:
            scale = 1.0 / np.maximum(_largest(self._E), _largest(self._H))
            self._E, self._H = self._E * scale, self._H * scale
            E, H, fall = E * scale, H * scale, fall * scale
        if self._keeps:  # the fields below, in the measure of those above
            self._kept.append((E, 1j * H, fall))
        self._through = self._through * fall

    def powers(self) -> tuple[Float64, Float64, Float64]:
        """Return R, T and the absorbed (layers, ...), empty where no fields were kept."""
        layers = self._layers
        R, share, is_nothing = _entry(self._admittance(0).real, self._E, self._H)
        T = np.where(is_nothing, 1.0, share * self._through**2 * self._admittance(-1).real)
        absorbed = np.zeros((len(self._kept), *layers.shape))
        # `share` makes |field|² a share of the incident power, from the top layer down.
        for layer, (E, G, fall) in enumerate(reversed(self._kept), start=1):
            is_p = self._down is not None
            absorbed[layer - 1] = share * absorbed_in_layer(layers, layer, E, G, is_p=is_p)
            share = share * fall**2
        return R, T, absorbed


def _both(layers: Layers, *, with_absorption: bool) -> list[tuple[Float64, Float64, Float64]]:
    """Return R, T and the absorbed power of s and of p, the last empty unless asked for."""
    count = len(layers.paths) if with_absorption else 0
    shape = layers.shape
    results = [(np.zeros(shape), np.zeros(shape), np.zeros((count, *shape))) for _ in range(2)]
    for piece, some in layers.pieces():
        for (R, T, absorbed), fields in zip(results, _climb(some, keep=with_absorption), strict=True):
            R[piece], T[piece], absorbed[:, *piece] = fields.powers()
    return results


def _climb(layers: Layers, *, keep: bool) -> list[_Fields]:
    """Return the fields of s and of p at the top."""
    fields = [_Fields(layers, is_p=is_p, keep=keep) for is_p in (False, True)]
    over_q = layers.over_q()
    for layer in range(len(layers.paths), 0, -1):
        q, inverse, path = layers.q[layer], over_q[layer], layers.paths[layer - 1]
        cosine, sine, fall = _characteristic(q, path)
        if not np.iscomplexobj(sine):
            q, inverse = q.real, inverse.real
        sine_over_q = sine * inverse
        is_flat = inverse == 0.0
        if np.any(is_flat):
            sine_over_q = np.where(is_flat, (2.0 * np.pi) * path, sine_over_q)
        for each in fields:
            each.pass_layer(layer, cosine, sine_over_q, sine * q, fall)
    return fields


def _characteristic(q: Complex128, path: Float64) -> tuple[Any, Any, Any]:
    """Return cos β and sin β, both times e^{−Im β}, and e^{−Im β}; real where light runs without loss.

    Whole half turns come off first: they only change the fields' sign.
    """
    half_turns = (2.0 * path) * q.real
    half_turns = half_turns - np.rint(half_turns)
    tangent = np.tan((0.5 * np.pi) * half_turns)
    square = tangent * tangent
    shrink = 1.0 / (1.0 + square)
    cosine, sine = (1.0 - square) * shrink, (2.0 * tangent) * shrink
    if not np.any(q.imag != 0.0):
        return cosine, sine, np.ones(())
    fall = (2.0 * np.pi) * path * q.imag
    decay = np.exp(-fall)
    even, odd = 0.5 * (1.0 + decay * decay), -0.5 * np.expm1(-2.0 * fall)
    return cosine * even - 1j * (sine * odd), sine * even + 1j * (cosine * odd), decay


def _entry(y_1: Float64, E: Complex128, H: Complex128) -> tuple[Float64, Float64, NDArray[np.bool_]]:
    """Return R, 4Y₁/|Y₁E + G|², and where there is nothing that could reflect.

    The second makes |field|² a share of the incident power. Nothing is there only for grazing light on media
    that all match, but for layers thinner than 1e-300 wavelengths.
    """
    total, other = y_1 * E + 1j * H, y_1 * E - 1j * H
    # Squares of the smallest fields would underflow: those of grazing light, and of hardly any layer.
    size = _largest(total)
    is_nothing = size < _NOTHING
    shrink = 1.0 / np.where(is_nothing, 1.0, size)
    share = 1.0 / np.where(is_nothing, 1.0, squared_modulus(total * shrink))
    # A last bit above 1 is rounding, where all is reflected.
    R = np.minimum(squared_modulus(other * shrink) * share, 1.0)
    return np.where(is_nothing, 0.0, R), 4.0 * (y_1 * shrink) * share * shrink, is_nothing


def _largest(z: Complex128) -> Float64:
    return np.asarray(np.maximum(np.abs(z.real), np.abs(z.imag)))
