"""GGX facets drawn by the area that a viewer sees of them, and how densely they and their images lie.

Vectors are (n, 3) along axes of which +Z is the surface's normal; widths α along x and y are (n,). A viewer
sees facets of normal H in the density D(H) G₁(V) (V·H) / (N·V), which integrates to 1 (Heitz 2018, "Sampling
the GGX Distribution of Visible Normals", Eq. 1).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["draw_facet", "facet_density", "facet_slant", "mirror_density", "mirrored"]

Float64 = NDArray[np.float64]


def draw_facet(view: Float64, alpha_t: Float64, alpha_b: Float64, place: Float64) -> Float64:
    """Return the facets' normals that `place` (n, 2) in the unit square stands for, by their visible area.

    Density `facet_density`. Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps",
    listing 3: a facet of the unit sphere halfway between the viewer and an even point of a cap.

    view : unit, along the axes, z > 0; α = 0 in both widths gives the surface's own normal.
    place : in [0, 1).
    """
    stretch = np.column_stack([alpha_t, alpha_b, np.ones_like(alpha_t)])
    seen = _unit(view * stretch)
    turn = 2.0 * np.pi * place[:, 0]
    height = (1.0 - place[:, 1]) * (1.0 + seen[:, 2]) - seen[:, 2]
    sine = np.sqrt(np.clip(1.0 - height * height, 0.0, 1.0))
    cap = np.column_stack([sine * np.cos(turn), sine * np.sin(turn), height])
    return _unit((cap + seen) * stretch)


def facet_density(view: Float64, facet: Float64, alpha_t: Float64, alpha_b: Float64) -> Float64:
    """Return D(H) G₁(V) (V·H) / (N·V), (n,), per steradian of H; 0 for facets that face away.

    With Smith's G₁ = 2 N·V / (N·V + slant) it is 2 D(H) (V·H) / (N·V + slant), finite at grazing.

    view, facet : unit, along the axes; α in (0, 1].
    """
    seen = np.sum(view * facet, axis=1)
    faces = (seen > 0.0) & (facet[:, 2] > 0.0)
    seen_d = _facets(facet, alpha_t, alpha_b) * np.where(faces, seen, 0.0)
    return np.asarray(2.0 * seen_d / (view[:, 2] + facet_slant(view, alpha_t, alpha_b)))


def mirror_density(view: Float64, light: Float64, alpha_t: Float64, alpha_b: Float64) -> Float64:
    """Return how densely light directions mirrored at `draw_facet`'s normals lie, (n,), per steradian.

    D(H) G₁(V) / (4 N·V) = D(H) / (2 (N·V + slant)), Heitz 2018, Eq. 17 with Smith's G₁: facets within
    dω mirror into 4 (V·H) dω. 0 where `light` lies below the horizon, where the other facets mirror to:
    its integral is less than 1.
    """
    half = view + light
    is_above = (light[:, 2] > 0.0) & (half[:, 2] > 0.0)
    facets = _facets(np.where(is_above[:, None], half, [0.0, 0.0, 1.0]), alpha_t, alpha_b)
    return np.where(is_above, facets / (2.0 * (view[:, 2] + facet_slant(view, alpha_t, alpha_b))), 0.0)


def mirrored(view: Float64, facet: Float64) -> Float64:
    """Return the light direction that `facet` mirrors towards the viewer: 2 (V·H) H − V."""
    return np.asarray(2.0 * np.sum(view * facet, axis=1, keepdims=True) * facet - view)


def facet_slant(vector: Float64, alpha_t: Float64, alpha_b: Float64) -> Float64:
    """Return √((α_t x)² + (α_b y)² + z²), (n,): Smith's 2Λ + 1 times |z|; Heitz 2014, Eq. 72 and 86."""
    x, y, z = vector.T
    return np.asarray(np.sqrt((alpha_t * x) ** 2 + (alpha_b * y) ** 2 + z * z))


def _facets(half: Float64, alpha_t: Float64, alpha_b: Float64) -> Float64:
    """D (Heitz 2014, Eq. 85), homogeneous in H, so that H need not be of length 1."""
    squared = np.sum(half * half, axis=1)
    x, y, z = half.T
    spread = (x / alpha_t) ** 2 + (y / alpha_b) ** 2 + z * z
    return np.asarray(squared * squared / (np.pi * alpha_t * alpha_b * spread * spread))


def _unit(vector: Float64) -> Float64:
    return np.asarray(vector / np.linalg.norm(vector, axis=1, keepdims=True))
