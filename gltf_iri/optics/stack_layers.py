"""A stack's media as the recursion of `gltf_iri.optics.stack` wants them: checked, refracted into."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.errors import UsageError
from gltf_iri.optics.blocks import blocks, part
from gltf_iri.optics.modulus import squared_modulus
from gltf_iri.optics.refraction import normal_index, normal_index_squared

__all__ = ["Layers"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]

_GRAZING: Final = 1e-150  # a smaller cosine is none: its square, and those of q, would lose their digits
_NO_NORMAL_INDEX: Final = 1e-280  # |q|², below which sin β/q is its limit to the last bit
_PIECE: Final = 8192  # complex numbers: a dozen arrays of so many fit into a second-level cache


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

    def pieces(self) -> Iterator[tuple[tuple[slice, ...], Layers]]:
        """Yield the stack in pieces of its shape that stay in the processor's cache, each with its place."""
        axes = len(self.shape)
        for piece in blocks(self.shape, _PIECE):
            index, q_squared, q = (part(table, piece, axes) for table in (self.index, self.q_squared, self.q))
            paths = [part(path[None], piece, axes)[0] for path in self.paths]
            transverse_squared = part(self.transverse_squared[None], piece, axes)[0]
            shape = np.broadcast_shapes(q.shape[1:], *(path.shape for path in paths))
            yield piece, Layers(index, q_squared, q, paths, transverse_squared, shape)

    def over_q(self) -> Complex128:
        """Return 1/q, or 0 where q is too small for sin β/q to differ from its limit 2πd/λ."""
        size = squared_modulus(self.q)
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
        return np.asarray(epsilon.conj() * (1.0 / squared_modulus(epsilon)))
