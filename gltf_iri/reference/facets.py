"""GGX facets drawn as a viewer sees them, and the axes that they are drawn along.

Vectors are (n, 3), widths α along tangent and bitangent (n,). Along the axes the surface's normal is +Z.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.microfacet import N_DOT_V_MIN
from gltf_iri.optics.visible_normals import draw_facet, facet_slant, mirror_density, mirrored

__all__ = [
    "TO_OTHER_SIDE",
    "Axes",
    "draw_facet",
    "mirror_density",
    "mirrored",
    "refracted",
    "shadowing_ratio",
]

Float64 = NDArray[np.float64]

# Between the axes of both sides of a surface, each with +Z away from it.
TO_OTHER_SIDE: Final = np.array([1.0, 1.0, -1.0])


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


def shadowing_ratio(
    view: Float64, light: Float64, alpha_t: Float64, alpha_b: Float64, *, is_mirrored: bool
) -> Float64:
    """Return (n,): what share of the light along drawn facets other facets let pass, G₂(V, L) / G₁(V).

    Mirrored light shares its facets' height with the viewer: G₂ = 1 / (1 + Λ(V) + Λ(L)) (Heitz 2014, Eq. 99).
    Refracted light runs on the other side, where Walter et al. 2007 take both apart: G₁(L).
    Both with 2Λ + 1 = √((α_t x)² + (α_b y)² + z²) / |z|.
    """
    light_z, view_z = np.abs(light[:, 2]), view[:, 2]
    light_slant, view_slant = facet_slant(light, alpha_t, alpha_b), facet_slant(view, alpha_t, alpha_b)
    if not is_mirrored:
        return np.asarray(2.0 * light_z / (light_z + light_slant))
    masked = light_z * view_slant + view_z * light_slant
    return np.asarray(light_z * (view_z + view_slant) / np.where(masked != 0.0, masked, 1.0))


def refracted(view: Float64, facet: Float64, ratio: Float64) -> tuple[Float64, Float64]:
    """Return the direction (n, 3) into which `facet` bends light from V, and cos²θ (n,) behind the facet.

    Snell in vectors: −ηV + (η V·H − √(1 − η²(1 − (V·H)²))) H, η = `ratio` (n,) of the index on the viewer's
    side to the other. Where cos²θ < 0 all light is reflected; the direction then runs along the surface.
    """
    cosine = np.sum(view * facet, axis=1)
    squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine)
    along = ratio * cosine - np.sqrt(np.maximum(squared, 0.0))
    return _unit(along[:, None] * facet - ratio[:, None] * view), squared


def _unit(vector: Float64) -> Float64:
    return np.asarray(vector / np.linalg.norm(vector, axis=1, keepdims=True))
