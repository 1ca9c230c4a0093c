"""Tables of mirrors: each one's colour over the cosine, filled from the truth.

Bragg's edges move with the angle, and many cells make them steep: these want many nodes.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.yeh_spectral import evaluate_yeh_spectral
from gltf_iri.planning.film_table import Texel, texel_bytes

__all__ = ["BakedMirrors", "MirrorTable", "bake_mirrors"]

Float64 = NDArray[np.float64]

_MIRRORS_AT_ONCE: Final = 64  # an interrupt waits for so many rows at most


@dataclass(frozen=True, slots=True)
class MirrorTable:
    """`nodes` cosines outside, evenly spaced over [0, 1], two at least; linear between them."""

    nodes: int
    texel: Texel = "f4"

    @property
    def bytes(self) -> int:
        """Memory of one mirror's texels."""
        return self.nodes * texel_bytes(self.texel)


@dataclass(frozen=True, slots=True)
class BakedMirrors:
    """A table of each of m mirrors.

    texels : (m, nodes, 3), float16 or float32.
    """

    table: MirrorTable
    texels: NDArray[np.floating[Any]]
    white: str

    def look_up(self, cos_theta: ArrayLike) -> Float64:
        """Return the colours (m, ..., 3) of each mirror at the cosines outside (m, ...); NaN where one is."""
        cosine = np.asarray(cos_theta, dtype=np.float64)
        cells = self.table.nodes - 1
        place = np.clip(cosine, 0.0, 1.0) * cells
        # NaN, which no index can be, stays in the weight.
        first = np.fmin(np.fmax(np.floor(place), 0.0), cells - 1).astype(np.intp)
        t = (place - first)[..., None]
        # One flat array of texels: an index a colour, and no copy of a mirror's row.
        mirror = np.arange(len(self.texels)).reshape(-1, *(1,) * (cosine.ndim - 1)) * self.table.nodes
        flat = self.texels.reshape(-1, 3)
        below = flat.take(mirror + first, axis=0).astype(np.float64)
        return np.asarray(below + t * (flat.take(mirror + first + 1, axis=0) - below))


def bake_mirrors(table: MirrorTable, mirrors: Mirror, white: White = "D65") -> BakedMirrors:
    """Return `mirrors` (m,) filled at every node; their own cosine is not read.

    Raises UsageError for fewer than two nodes, and where a spectrum is too fine for the truth.
    """
    if table.nodes < 2:
        raise UsageError("A table of mirrors wants two nodes at least.")
    rows = [
        np.broadcast_to(each, mirrors.shape).reshape(-1, 1)
        for each in (mirrors.n1, mirrors.n2, mirrors.d1_nm, mirrors.d2_nm, mirrors.cells, mirrors.host_ior)
    ]
    cosine = np.linspace(0.0, 1.0, table.nodes)
    texels = np.zeros((len(rows[0]), table.nodes, 3), dtype=table.texel)
    for start in range(0, len(texels), _MIRRORS_AT_ONCE):
        part = slice(start, start + _MIRRORS_AT_ONCE)
        block = Mirror.of(cosine, *(each[part] for each in rows))
        texels[part] = evaluate_yeh_spectral(block, white).rgb
    return BakedMirrors(table, texels, str(white))
