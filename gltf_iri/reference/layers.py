"""What lies over the base: the fibres of a sheen, and over them the clearcoat.

Each layer sends light of its own and lets a share of what lies under it through, both ways in one factor.
Sources: KHR_materials_sheen, Albedo Scaling; KHR_materials_clearcoat, Layering.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layering import CLEARCOAT_F0
from gltf_iri.optics.microfacet import N_DOT_V_MIN, alpha_ggx, d_ggx, v_smith_ggx_correlated
from gltf_iri.optics.sheen import d_charlie, sheen_albedo, sheen_alpha, sheen_weight, v_sheen
from gltf_iri.reference.points import unit
from gltf_iri.reference.surface import Surface

__all__ = ["clearcoat_lobe", "clearcoat_reflectance", "fibre_lobe", "fibre_passage"]

Float64 = NDArray[np.float64]


def fibre_lobe(surface: Surface, towards_light: Float64) -> Float64:
    """Return f·cosθ of the fibres alone, (n, 3): sheen colour · D·V·(N·L), 0 for light from behind."""
    n_dot_l = np.clip(np.sum(surface.normal * towards_light, axis=1), 0.0, 1.0)
    half = unit(surface.view + towards_light)
    n_dot_h = np.clip(np.sum(surface.normal * half, axis=1), 0.0, 1.0)
    alpha = sheen_alpha(surface.sheen_roughness)
    # V holds 1 / N·L; where there is no light from the front, any divisor will do.
    visibility = v_sheen(np.where(n_dot_l > 0.0, n_dot_l, 1.0), surface.n_dot_v, alpha)
    return np.asarray(surface.sheen_color * (d_charlie(n_dot_h, alpha) * visibility * n_dot_l)[:, None])


def fibre_passage(surface: Surface, n_dot_l: Float64) -> Float64:
    """Return the share (n,) that passes the fibres: 1 − max(sheen colour)·E, the larger E of N·V and N·L."""
    albedo = np.maximum(
        sheen_albedo(surface.n_dot_v, surface.sheen_roughness), sheen_albedo(n_dot_l, surface.sheen_roughness)
    )
    return sheen_weight(surface.sheen_color, albedo)


def clearcoat_reflectance(surface: Surface) -> Float64:
    """Return what (n,) the coat reflects of light from all around: factor · (0.04·A + B) at Nc·V."""
    a, b = dfg_terms(_coat_n_dot_v(surface), surface.clearcoat_roughness)
    return np.asarray(surface.clearcoat * (CLEARCOAT_F0 * a + b))


def clearcoat_lobe(surface: Surface, towards_light: Float64) -> Float64:
    """Return f·cosθ of the coat alone, (n,): factor · F(0.04; V·H)·D·V·(Nc·L), facets about Nc."""
    normal = surface.clearcoat_normal
    n_dot_l = np.clip(np.sum(normal * towards_light, axis=1), 0.0, 1.0)
    half = unit(surface.view + towards_light)
    v_dot_h = np.clip(np.sum(surface.view * half, axis=1), 0.0, 1.0)
    n_cross_h = np.cross(normal, half)
    alpha = alpha_ggx(surface.clearcoat_roughness)
    facets = d_ggx(np.sum(n_cross_h * n_cross_h, axis=1), alpha) * v_smith_ggx_correlated(
        n_dot_l, _coat_n_dot_v(surface), alpha
    )
    # Looking straight into the light there is no facet that could mirror it.
    is_mirrored = np.any(half != 0.0, axis=1)
    return np.asarray(surface.clearcoat * f_schlick(CLEARCOAT_F0, v_dot_h) * facets * n_dot_l * is_mirrored)


def _coat_n_dot_v(surface: Surface) -> Float64:
    # As for the base: keeps the masking finite past the silhouette, and takes back rounding.
    return np.asarray(np.clip(np.sum(surface.clearcoat_normal * surface.view, axis=1), N_DOT_V_MIN, 1.0))
