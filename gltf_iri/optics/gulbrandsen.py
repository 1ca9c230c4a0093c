"""A metal's complex index from two colours: what it reflects straight on, and its tint towards the edge.

Gulbrandsen 2014, "Artist friendly metallic Fresnel", JCGT 3(4): for a reflectivity r an index n between
n_min = (1 − r)/(1 + r) and n_max = (1 + √r)/(1 − √r) has an extinction k that gives r; the edge tint g runs
from n_max (g = 0, a dielectric, k = 0) to n_min (g = 1). Both colours are taken channel by channel.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["index_from_edge_tint"]


def index_from_edge_tint(reflectivity: ArrayLike, edge_tint: ArrayLike) -> NDArray[np.complex128]:
    """Return n + ik under air for r and g in [0, 1], which broadcast; r = 1 gives ∞, the perfect mirror.

    n = g n_min + (1 − g) n_max. The paper's k² = (r(n + 1)² − (n − 1)²)/(1 − r) is here the product
    g(n_max − n_min)(n − 1/n_max), in which nothing cancels for dielectrics, where k → 0.
    """
    r, g = np.asarray(reflectivity, dtype=np.float64), np.asarray(edge_tint, dtype=np.float64)
    is_mirror = r == 1.0
    root = np.sqrt(np.where(is_mirror, 0.0, r))
    n_min = (1.0 - root * root) / (1.0 + root * root)
    n_max = (1.0 + root) / (1.0 - root)
    n = g * n_min + (1.0 - g) * n_max
    # A last bit below 0 is rounding, at r = 0, where all three indices are 1.
    k = np.sqrt(g * np.maximum((n_max - n_min) * (n - 1.0 / n_max), 0.0))
    return np.asarray(np.where(is_mirror, np.inf, n + 1j * k), dtype=np.complex128)
