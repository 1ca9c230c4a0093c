"""What a material is at many points: every property after its textures, in float64, as flat arrays.

Twin: `Surface` in shaders/material/surface.glsl, where `alpha` is coverage (here `cutout.coverage`).
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

__all__ = ["Surface"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Surface:
    """n points of one material; colours and vectors (n, 3), everything else (n,).

    Roughnesses are perceptual, but for α; what the plan leaves out is 0 (occlusion and specular weight: 1).
    """

    position: Float64  # world, metres
    normal: Float64  # unit, turned towards the viewer
    view: Float64  # unit, towards the viewer
    n_dot_v: Float64  # in [N_DOT_V_MIN, 1]
    base_color: Float64
    metallic: Float64
    perceptual_roughness: Float64
    alpha_roughness: Float64  # `alpha_ggx` of it, the facets' width
    emission: Float64
    occlusion: Float64
    dielectric_f0: Float64  # before the specular weight
    specular_weight: Float64
    iridescence_factor: Float64
    iridescence_thickness_nm: Float64
    iridescence_thickness_std_nm: Float64  # within what the point stands for; a ray's point has no size
    bragg_factor: Float64
    bragg_period_texel: Float64  # along which the periods of all layers run
    anisotropy_strength: Float64
    anisotropy_tangent: Float64  # unit, in the surface; 0 where the mesh has neither tangents nor coordinates
    transmission: Float64
    volume_thickness_m: Float64  # in the mesh's own space
    sheen_color: Float64
    sheen_roughness: Float64
    clearcoat: Float64
    clearcoat_roughness: Float64
    clearcoat_normal: Float64  # unit, turned towards the viewer

    @property
    def passing_share(self) -> Float64:
        """Share (n, 3) of light that goes through, interface aside: (1 − metallic)·transmission·colour."""
        return np.asarray(((1.0 - self.metallic) * self.transmission)[:, None] * self.base_color)

    def take(self, rows: NDArray[np.int64]) -> Surface:
        """Return the points `rows` (k,), in that order."""
        return Surface(**{field.name: getattr(self, field.name)[rows] for field in fields(self)})
