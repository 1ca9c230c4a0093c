"""Light through a body: its indices by colour, where and how it leaves, how wide a rough surface spreads it.

Twin: shaders/optics/transmission.glsl.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["dispersed_iors", "exit_normal", "path_inside", "refraction_roughness"]

Float64 = NDArray[np.float64]

# Facets that turn a normal by δ bend light by (n − 1) δ at one side of a plate and mirror it by 2 δ. Entry
# and exit are rough: of GGX facets both together have 1.7 times the median of one (of Gaussian ones, 1.4).
_BOTH_SIDES: Final = 1.7


def refraction_roughness(perceptual_roughness: ArrayLike, ior: ArrayLike) -> Float64:
    """Return the perceptual roughness of a mirror that spreads light as wide as a body with rough sides does.

    α′ = 1.7 · ½ (n − 1) α, at most 1; figures in spec/renderer-notes.md, Transmission.
    """
    alpha = np.square(np.asarray(perceptual_roughness, dtype=np.float64))
    spread = _BOTH_SIDES * 0.5 * np.abs(np.asarray(ior, dtype=np.float64) - 1.0) * alpha
    return np.asarray(np.sqrt(np.minimum(spread, 1.0)))


def dispersed_iors(ior: ArrayLike, dispersion: ArrayLike) -> Float64:
    """Return the indices of red, green and blue, a last axis of 3: n − s, n, n + s.

    s = 0.025 (n − 1) dispersion; KHR_materials_dispersion. Never below 1, where light that enters could be
    totally reflected.
    """
    n = np.asarray(ior, dtype=np.float64)
    half_spread = 0.025 * (n - 1.0) * np.asarray(dispersion, dtype=np.float64)
    iors = np.stack(np.broadcast_arrays(n - half_spread, n, n + half_spread), axis=-1)
    return np.asarray(np.maximum(iors, 1.0))


def exit_normal(entry_normal: ArrayLike, inside: ArrayLike, roundness: ArrayLike) -> Float64:
    """Return the outward normal (…, 3) where light leaves a body that is known on one side only.

    entry_normal, inside : (…, 3), unit; the way inside points away from the normal.
    roundness : k in [0, 1]. 1: a ball as thick as the body; 0: a plate; ½ lets light leave straight.

    N (2k − 1) + 2k cosθ d, cosθ = −N·d, normalised. The angle inside is at most that of the entry, so that
    nothing is totally reflected.
    """
    n, d = np.asarray(entry_normal, dtype=np.float64), np.asarray(inside, dtype=np.float64)
    k = np.asarray(roundness, dtype=np.float64)[..., None]
    cos_theta = -np.sum(n * d, axis=-1, keepdims=True)
    normal = n * (2.0 * k - 1.0) + 2.0 * k * cos_theta * d
    return np.asarray(normal / np.linalg.norm(normal, axis=-1, keepdims=True))


def path_inside(thickness: ArrayLike, cos_theta: ArrayLike, roundness: ArrayLike) -> Float64:
    """Return the way through a body, thickness · cosθ^(2k − 1): a ball's chord, the slanted way of a plate.

    cos_theta : of the angle inside to the normal, in (0, 1].
    """
    exponent = 2.0 * np.asarray(roundness, dtype=np.float64) - 1.0
    return np.asarray(np.asarray(thickness, dtype=np.float64) * np.asarray(cos_theta) ** exponent)
