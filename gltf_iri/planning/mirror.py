"""When a Bragg mirror is a film: one cell, seen from a host of the cell's own first index."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

__all__ = ["ONE_CELL", "FilmInMirror", "film_in_mirror"]

ONE_CELL: Final = "a mirror of one cell in a host of its own n1 is a film of n2"


@dataclass(frozen=True, slots=True)
class FilmInMirror:
    """The film that a mirror is; arrays of any shapes, as they came.

    outside_ior, base_ior : the n1 on both sides.
    """

    outside_ior: NDArray[np.float64]
    film_ior: NDArray[np.float64]
    thickness_nm: NDArray[np.float64]
    base_ior: NDArray[np.float64]


def film_in_mirror(
    n1: ArrayLike, n2: ArrayLike, d2_nm: ArrayLike, cells: ArrayLike, host_ior: ArrayLike | None = None
) -> FilmInMirror | None:
    """Return the film that a mirror is, None where any of the mirrors given is none or absorbs.

    Between a host of index n1 and the n1 beyond the last cell, the n1 film of a single cell has no interface:
    its thickness turns the phase of all that is reflected alike, which no reflectance shows. What is left is
    a film n2 of thickness d2 in a medium n1 (Fourneau et al. 2024, Appendix D, r_h1 = 0 and N = 1).

    n1, n2 : indices n + ik; d2_nm : thickness of the n2 film; cells : their number; host_ior : the index
        outside, None for n1. Shapes need only broadcast.
    """
    import numpy as np

    def real(values: ArrayLike) -> NDArray[np.float64] | None:
        index: NDArray[Any] = np.asarray(values, dtype=np.complex128)
        return None if index.imag.any() else np.asarray(index.real, dtype=np.float64)

    outside, inside = real(n1), real(n2)
    if outside is None or inside is None or not np.all(np.asarray(cells) == 1):
        return None
    if host_ior is not None and not np.all(np.asarray(host_ior) == outside):
        return None
    return FilmInMirror(outside, inside, np.asarray(d2_nm, dtype=np.float64), outside)
