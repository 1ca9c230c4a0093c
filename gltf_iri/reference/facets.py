"""GGX facets drawn as a viewer sees them, and the axes that they are drawn along.

Vectors are (n, 3), widths α along tangent and bitangent (n,). Along the axes the surface's normal is +Z.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.microfacet import N_DOT_V_MIN

__all__ = ["Axes", "draw_facet", "mirror_density", "mirrored", "refracted", "shadowing_ratio"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Axes:
    """Orthonormal axes at n points, in world space."""

    tangent: Float64
    bitangent: Float64
    normal: Float64

    @classmethod
    def around(cls, normal: Float64, tangent: Float64 | None = None) -> Axes:
        """Return axes around the unit `normal`; x along `tangent` where there is one, else anywhere."""
        axis = np.eye(3)[np.argmin(np.abs(normal), axis=1)]
        across = np.cross(axis, normal)
        if tangent is not None:
            level = tangent - np.sum(tangent * normal, axis=1, keepdims=True) * normal
            says = np.linalg.norm(level, axis=1, keepdims=True) > 1e-6
            across = np.where(says, level, across)
        across = across / np.linalg.norm(across, axis=1, keepdims=True)
        return cls(across, np.cross(normal, across), normal)

    def to_local(self, vector: Float64) -> Float64:
        """Return world vectors along the axes."""
        axes = (self.tangent, self.bitangent, self.normal)
        return np.stack([np.sum(vector * axis, axis=1) for axis in axes], axis=1)

    def to_viewer(self, view: Float64) -> Float64:
        """Return `view` along the axes, lifted above the horizon where normals lean past the silhouette."""
        local = self.to_local(view)
        local[:, 2] = np.maximum(local[:, 2], N_DOT_V_MIN)
        return _unit(local)

    def to_world(self, local: Float64) -> Float64:
        """Return vectors along the axes in world space."""
        x, y, z = local[:, :1], local[:, 1:2], local[:, 2:]
        return np.asarray(x * self.tangent + y * self.bitangent + z * self.normal)


def draw_facet(view: Float64, alpha_t: Float64, alpha_b: Float64, place: Float64) -> Float64:
    """Return the facets' normals that `place` (n, 2) in the unit square stands for, by their visible area.

    Density D(H) G₁(V) (V·H) / (N·V). Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical
    Caps", listing 3: a facet of the unit sphere halfway between the viewer and an even point of a cap.

    view : unit, along the axes, z > 0.
    """
    stretch = np.column_stack([alpha_t, alpha_b, np.ones_like(alpha_t)])
    seen = _unit(view * stretch)
    turn = 2.0 * np.pi * place[:, 0]
    height = (1.0 - place[:, 1]) * (1.0 + seen[:, 2]) - seen[:, 2]
    sine = np.sqrt(np.clip(1.0 - height * height, 0.0, 1.0))
    cap = np.column_stack([sine * np.cos(turn), sine * np.sin(turn), height])
    return _unit((cap + seen) * stretch)


def mirror_density(view: Float64, light: Float64, alpha_t: Float64, alpha_b: Float64) -> Float64:
    """Return how densely light directions mirrored at `draw_facet`'s normals lie, (n,), per steradian.

    D(H) G₁(V) / (4 N·V) = D(H) / (2 (N·V + √((α_t V·T)² + (α_b V·B)² + (N·V)²))); Heitz 2018, "Sampling the
    GGX Distribution of Visible Normals", Eq. 17 with Smith's G₁. 0 where `light` lies below the horizon.
    """
    half = view + light
    squared = np.sum(half * half, axis=1)
    x, y, z = half.T
    # D (Heitz 2014, Eq. 85), homogeneous in H, so that H need not be of length 1.
    spread = (x / alpha_t) ** 2 + (y / alpha_b) ** 2 + z * z
    is_above = (light[:, 2] > 0.0) & (z > 0.0)
    facets = squared * squared / (np.pi * alpha_t * alpha_b * np.where(is_above, spread, 1.0) ** 2)
    return np.where(is_above, facets / (2.0 * (view[:, 2] + _slant(view, alpha_t, alpha_b))), 0.0)


def shadowing_ratio(
    view: Float64, light: Float64, alpha_t: Float64, alpha_b: Float64, *, is_mirrored: bool
) -> Float64:
    """Return (n,): what share of the light along drawn facets other facets let pass, G₂(V, L) / G₁(V).

    Mirrored light shares its facets' height with the viewer: G₂ = 1 / (1 + Λ(V) + Λ(L)) (Heitz 2014, Eq. 99).
    Refracted light runs on the other side, where Walter et al. 2007 take both apart: G₁(L).
    Both with 2Λ + 1 = √((α_t x)² + (α_b y)² + z²) / |z|.
    """
    light_z, view_z = np.abs(light[:, 2]), view[:, 2]
    light_slant, view_slant = _slant(light, alpha_t, alpha_b), _slant(view, alpha_t, alpha_b)
    if not is_mirrored:
        return np.asarray(2.0 * light_z / (light_z + light_slant))
    masked = light_z * view_slant + view_z * light_slant
    return np.asarray(light_z * (view_z + view_slant) / np.where(masked != 0.0, masked, 1.0))


def mirrored(view: Float64, facet: Float64) -> Float64:
    """Return the light direction that `facet` mirrors towards the viewer: 2 (V·H) H − V."""
    return np.asarray(2.0 * np.sum(view * facet, axis=1, keepdims=True) * facet - view)


def refracted(view: Float64, facet: Float64, ratio: Float64) -> tuple[Float64, Float64]:
    """Return the direction (n, 3) into which `facet` bends light from V, and cos²θ (n,) behind the facet.

    Snell in vectors: −ηV + (η V·H − √(1 − η²(1 − (V·H)²))) H, η = `ratio` (n,) of the index on the viewer's
    side to the other. Where cos²θ < 0 all light is reflected; the direction then runs along the surface.
    """
    cosine = np.sum(view * facet, axis=1)
    squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine)
    along = ratio * cosine - np.sqrt(np.maximum(squared, 0.0))
    return _unit(along[:, None] * facet - ratio[:, None] * view), squared


def _slant(vector: Float64, alpha_t: Float64, alpha_b: Float64) -> Float64:
    x, y, z = vector.T
    return np.asarray(np.sqrt((alpha_t * x) ** 2 + (alpha_b * y) ** 2 + z * z))


def _unit(vector: Float64) -> Float64:
    return np.asarray(vector / np.linalg.norm(vector, axis=1, keepdims=True))
