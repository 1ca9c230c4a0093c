"""Light through a body whose surface is rough: its indices by colour, and how wide the way through spreads it.

Twin: shaders/optics/transmission.glsl.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["dispersed_iors", "refraction_roughness"]

Float64 = NDArray[np.float64]

# Facets that turn a normal by δ bend light by (n − 1) δ at one side of a plate and mirror it by 2 δ. Entry and
# exit are rough: of GGX facets the median of both together is 1.7 times that of one (1.4 would be a Gaussian's).
_BOTH_SIDES: Final = 1.7


def refraction_roughness(perceptual_roughness: ArrayLike, ior: ArrayLike) -> Float64:
    """Return the perceptual roughness of a mirror that spreads light as wide as a body with rough sides does.

    α′ = 1.7 · ½ (n − 1) α, at most 1; figures in spec/renderer-notes.md, Transmission.
    """
    alpha = np.square(np.asarray(perceptual_roughness, dtype=np.float64))
    spread = _BOTH_SIDES * 0.5 * np.abs(np.asarray(ior, dtype=np.float64) - 1.0) * alpha
    return np.asarray(np.sqrt(np.minimum(spread, 1.0)))


def dispersed_iors(ior: ArrayLike, dispersion: ArrayLike) -> Float64:
    """Return the indices of red, green and blue, a last axis of 3: n − s, n, n + s, s = 0.025 (n − 1) dispersion.

    KHR_materials_dispersion, Implementation. Never below 1, where light that enters could be totally reflected.
    """
    n = np.asarray(ior, dtype=np.float64)
    half_spread = 0.025 * (n - 1.0) * np.asarray(dispersion, dtype=np.float64)
    iors = np.stack(np.broadcast_arrays(n - half_spread, n, n + half_spread), axis=-1)
    return np.asarray(np.maximum(iors, 1.0))
