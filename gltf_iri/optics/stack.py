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
from gltf_iri.errors import UsageError
from gltf_iri.optics.refraction import normal_index, normal_index_squared
from gltf_iri.optics.stack_absorption import absorbed_in_layer

__all__ = ["Layers", "StackPower", "StackResponse", "stack", "stack_power"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]

_GRAZING: Final = 1e-150  # a smaller cosine is none: its square, and those of q, would lose their digits
_NOTHING: Final = 1e-300  # fields at the top, smaller than any light and index gives
_NO_NORMAL_INDEX: Final = 1e-280  # |q|², below which sin β/q is its limit to the last bit

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


@dataclass(frozen=True, slots=True)
class Layers:
    """A stack's media along one first axis, the outside first; the other axes broadcast to `shape`.

    index, q_squared, q : (layers + 2, ...), n + ik and its part along the normal.
    paths : for each layer d/λ, (...).
    transverse_squared : n₁² sin²θ₁, (...).
    """

    index: Complex128
    q_squared: Complex128
    q: Complex128
    paths: list[Float64]
    transverse_squared: Float64
    shape: tuple[int, ...]

    @classmethod
    def of(
        cls,
        indices: Sequence[ArrayLike],
        thicknesses_nm: Sequence[ArrayLike],
        wavelength_nm: ArrayLike,
        cos_theta_1: ArrayLike,
    ) -> Layers:
        """Check that the numbers of media fit, and refract the light into each (see `stack_power`)."""
        if len(indices) != len(thicknesses_nm) + 2:
            raise UsageError(
                f"A stack of {len(thicknesses_nm)} layers wants {len(thicknesses_nm) + 2} indices, those of"
                f" outside and exit among them, not {len(indices)}."
            )
        media = [np.asarray(n, dtype=np.complex128) for n in indices]
        if np.any(media[0].imag != 0.0):
            raise UsageError("The light comes from a medium that absorbs nothing: its index must be real.")
        thick = [np.asarray(d, dtype=np.float64) for d in thicknesses_nm]
        wavelength, cosine = (np.asarray(a, dtype=np.float64) for a in (wavelength_nm, cos_theta_1))
        try:
            index_shape = np.broadcast_shapes(*(n.shape for n in media))
            shape = np.broadcast_shapes(
                index_shape, wavelength.shape, cosine.shape, *(d.shape for d in thick)
            )
        except ValueError:
            raise UsageError("Indices, thicknesses, wavelengths and cosines do not broadcast.") from None
        padded = (1,) * (len(shape) - len(index_shape)) + index_shape
        index = np.stack([np.broadcast_to(n, padded) for n in media])
        cosine = np.where(cosine < _GRAZING, 0.0, cosine)
        outside = index[0].real
        q_squared = normal_index_squared(index, outside, cosine)
        transverse_squared = outside * outside * ((1.0 - cosine) * (1.0 + cosine))
        paths = [d / wavelength for d in thick]
        return cls(index, q_squared, normal_index(q_squared), paths, transverse_squared, shape)

    def over_q(self) -> Complex128:
        """Return 1/q, or 0 where q is too small for sin β/q to differ from its limit 2πd/λ."""
        size = _squared(self.q)
        is_flat = size < _NO_NORMAL_INDEX
        inverse = self.q.conj() * (1.0 / np.where(is_flat, 1.0, size))
        # One rounding instead of three: in equal cells they add up.
        is_real = (self.q.imag == 0.0) & ~is_flat
        inverse = np.where(is_real, 1.0 / np.where(is_real, self.q.real, 1.0), inverse)
        return np.asarray(np.where(is_flat, 0.0, inverse))

    def epsilon(self) -> Complex128:
        """Return n²."""
        return np.asarray(self.index * self.index)

    def over_epsilon(self) -> Complex128:
        """Return 1/n²."""
        epsilon = self.epsilon()
        return np.asarray(epsilon.conj() * (1.0 / _squared(epsilon)))


class _Fields:
    """The fields (E, G) of one polarisation on their way up, and what is kept of them."""

    def __init__(self, layers: Layers, *, is_p: bool, keep: bool) -> None:
        self._layers = layers
        # S = sin β/q and Y²S = q sin β for s; for p the first is times n², the second over n².
        self._down = layers.epsilon() if is_p else None
        self._up = layers.over_epsilon() if is_p else None
        self._keeps = keep
        self._kept: list[tuple[Complex128, Complex128, Any]] = []
        self._E: Complex128 = np.ones((), np.complex128)
        self._G = self._admittance(-1)
        self._through: Any = np.ones(())  # a field at the exit for one at the top, in size

    def _admittance(self, medium: int) -> Complex128:
        q = self._layers.q[medium]
        return q if self._up is None else np.asarray(q * self._up[medium])

    def pass_layer(
        self, layer: int, cosine: Any, forward: Complex128, backward: Complex128, fall: Any
    ) -> None:
        if self._down is not None and self._up is not None:
            forward, backward = self._down[layer] * forward, self._up[layer] * backward
        E, G = self._E, self._G
        self._E, self._G = cosine * E + forward * G, cosine * G + backward * E
        if layer % _SCALE_EVERY == 0:
            scale = 1.0 / _largest(self._E, self._G)
            self._E, self._G = self._E * scale, self._G * scale
            E, G, fall = E * scale, G * scale, fall * scale
        if self._keeps:  # the fields below, in the measure of those above
            self._kept.append((E, G, fall))
        self._through = self._through * fall

    def powers(self) -> tuple[Float64, Float64, Float64]:
        """Return R, T and the absorbed (layers, ...), empty where no fields were kept."""
        layers = self._layers
        R, share, is_nothing = _entry(self._admittance(0).real, self._E, self._G)
        T = np.where(is_nothing, 1.0, share * self._through**2 * self._admittance(-1).real)
        absorbed = np.zeros((len(self._kept), *layers.shape))
        # `share` makes |field|² a share of the incident power, from the top layer down.
        for layer, (E, G, fall) in enumerate(reversed(self._kept), start=1):
            is_p = self._down is not None
            absorbed[layer - 1] = share * absorbed_in_layer(layers, layer, E, G, is_p=is_p)
            share = share * fall**2
        return _filled(R, layers.shape), _filled(T, layers.shape), absorbed


def _both(layers: Layers, *, with_absorption: bool) -> list[tuple[Float64, Float64, Float64]]:
    """Return R, T and the absorbed power of s and of p."""
    fields = [_Fields(layers, is_p=is_p, keep=with_absorption) for is_p in (False, True)]
    over_q = layers.over_q()
    for layer in range(len(layers.paths), 0, -1):
        q, path = layers.q[layer], layers.paths[layer - 1]
        cosine, sine, fall = _characteristic(q, path)
        is_flat = over_q[layer] == 0.0
        sine_over_q = np.where(is_flat, (2.0 * np.pi) * path, sine * over_q[layer])
        for each in fields:
            each.pass_layer(layer, cosine, -1j * sine_over_q, -1j * (sine * q), fall)
    return [each.powers() for each in fields]


def _characteristic(q: Complex128, path: Float64) -> tuple[Any, Any, Any]:
    """Return cos β and sin β, both times e^{−Im β}, and e^{−Im β}; real where light runs without loss.

    Whole half turns come off first: they only change the fields' sign.
    """
    half_turns = 2.0 * path * q.real
    tangent = np.tan((0.5 * np.pi) * (half_turns - np.rint(half_turns)))
    shrink = 1.0 / (1.0 + tangent * tangent)
    cosine, sine = (1.0 - tangent * tangent) * shrink, 2.0 * tangent * shrink
    if not np.any(q.imag != 0.0):
        return cosine, sine, np.ones(())
    fall = (2.0 * np.pi) * path * q.imag
    decay = np.exp(-fall)
    even, odd = 0.5 * (1.0 + decay * decay), -0.5 * np.expm1(-2.0 * fall)
    return cosine * even - 1j * (sine * odd), sine * even + 1j * (cosine * odd), decay


def _entry(y_1: Float64, E: Complex128, G: Complex128) -> tuple[Float64, Float64, NDArray[np.bool_]]:
    """Return R, 4Y₁/|Y₁E + G|², and where there is nothing that could reflect.

    The second makes |field|² a share of the incident power. Nothing is there only for grazing light on media
    that all match, but for layers thinner than 1e-300 wavelengths.
    """
    total, other = y_1 * E + G, y_1 * E - G
    # Squares of the smallest fields would underflow: those of grazing light, and of hardly any layer.
    size = np.maximum(np.abs(total.real), np.abs(total.imag))
    is_nothing = size < _NOTHING
    shrink = 1.0 / np.where(is_nothing, 1.0, size)
    share = 1.0 / np.where(is_nothing, 1.0, _squared(total * shrink))
    # A last bit above 1 is rounding, where all is reflected.
    R = np.minimum(_squared(other * shrink) * share, 1.0)
    return np.where(is_nothing, 0.0, R), 4.0 * (y_1 * shrink) * share * shrink, is_nothing


def _largest(E: Complex128, G: Complex128) -> Float64:
    sizes = [np.abs(part) for field in (E, G) for part in (field.real, field.imag)]
    return np.asarray(np.maximum(np.maximum(sizes[0], sizes[1]), np.maximum(sizes[2], sizes[3])))


def _squared(z: Complex128) -> Float64:
    return np.asarray(z.real * z.real + z.imag * z.imag)


def _filled(values: Float64, shape: tuple[int, ...]) -> Float64:
    return np.array(np.broadcast_to(values, shape))
