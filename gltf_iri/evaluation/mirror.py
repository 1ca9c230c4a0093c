"""The input that every mirror method shares: a Bragg mirror seen from outside."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import INDEX_MAX

__all__ = ["Mirror"]

Float64 = NDArray[np.float64]
Complex128 = NDArray[np.complex128]

# Beyond any matter and any mirror, yet so small that no square, product or ratio of two overflows.
_THICKNESS_MAX_NM: Final = 1e9
_CELLS_MAX: Final = 10**6


@dataclass(frozen=True, slots=True)
class Mirror:
    """`cells` equal cells of two films, n1 of d1_nm first; beyond the last cell n1 again. Arrays broadcast.

    cos_theta_h : cosine of the angle outside, in the host, in [0, 1].
    n1, n2 : indices n + ik, k ≥ 0; complex where the cells absorb.
    d1_nm, d2_nm : thicknesses, ≥ 0.
    cells : whole numbers from 1 to 10⁶.
    host_ior : real index of what the light comes from.
    """

    cos_theta_h: Float64
    n1: Complex128
    n2: Complex128
    d1_nm: Float64
    d2_nm: Float64
    cells: NDArray[np.int64]
    host_ior: Float64

    @classmethod
    def of(
        cls,
        cos_theta_h: ArrayLike,
        n1: ArrayLike,
        n2: ArrayLike,
        d1_nm: ArrayLike,
        d2_nm: ArrayLike,
        cells: ArrayLike,
        host_ior: ArrayLike | None = None,
    ) -> Mirror:
        """Check ranges and shapes and return the mirror; without `host_ior` the host is n1's real part.

        Raises UsageError for values out of range, NaN, and shapes that do not broadcast.
        """
        first, second = (np.asarray(n, dtype=np.complex128) for n in (n1, n2))
        host = first.real if host_ior is None else np.asarray(host_ior, dtype=np.float64)
        cosine, d1, d2, count = (np.asarray(a, dtype=np.float64) for a in (cos_theta_h, d1_nm, d2_nm, cells))
        if not np.all((cosine >= 0.0) & (cosine <= 1.0)):
            raise UsageError("The cosine of the outside angle must lie in [0, 1].")
        for index in (first, second):
            in_range = (index.real >= 1.0 / INDEX_MAX) & (index.imag >= 0.0) & (np.abs(index) <= INDEX_MAX)
            if not np.all(in_range):
                raise UsageError(
                    f"A cell's index n + ik wants n in [{1.0 / INDEX_MAX:g}, {INDEX_MAX:g}] and k ≥ 0"
                    " (waves are exp(−iωt))."
                )
        if not np.all((host >= 1.0 / INDEX_MAX) & (host <= INDEX_MAX)):
            raise UsageError(f"The host's index must lie in [{1.0 / INDEX_MAX:g}, {INDEX_MAX:g}].")
        if not all(np.all((d >= 0.0) & (d <= _THICKNESS_MAX_NM)) for d in (d1, d2)):
            raise UsageError(f"A cell's thicknesses must lie in [0, {_THICKNESS_MAX_NM:g}] nanometres.")
        if not np.all((count >= 1.0) & (count <= _CELLS_MAX) & (count == np.rint(count))):
            raise UsageError(f"The number of cells must be a whole number from 1 to {_CELLS_MAX}.")
        checked = cls(cosine, first, second, d1, d2, count.astype(np.int64), host)
        try:
            _ = checked.shape
        except ValueError:
            raise UsageError(
                "Cosine, indices, thicknesses, cells and host do not broadcast: "
                + ", ".join(str(a.shape) for a in (cosine, first, second, d1, d2, count, host))
                + "."
            ) from None
        return checked

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the result without its channel axis."""
        return np.broadcast_shapes(
            self.cos_theta_h.shape,
            self.n1.shape,
            self.n2.shape,
            self.d1_nm.shape,
            self.d2_nm.shape,
            self.cells.shape,
            self.host_ior.shape,
        )

    @property
    def is_lossless(self) -> bool:
        """True where no cell absorbs."""
        return not (self.n1.imag.any() or self.n2.imag.any())
