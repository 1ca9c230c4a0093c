"""The rough surface: GGX facets and their height-correlated masking, as functions of cosines and of α.

α is the perceptual roughness squared. Sources: glTF 2.0 Appendix B.3; Walter et al. 2007, "Microfacet Models
for Refraction through Rough Surfaces", Eq. 33; Heitz 2014, "Understanding the Masking-Shadowing Function in
Microfacet-Based BRDFs", Eq. 72 and 99. Twin: shaders/optics/microfacet.glsl.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = [
    "ALPHA_MIN",
    "N_DOT_V_MIN",
    "alpha_ggx",
    "anisotropic_alphas",
    "d_ggx",
    "d_ggx_anisotropic",
    "v_smith_ggx_anisotropic",
    "v_smith_ggx_correlated",
]

Float64 = NDArray[np.float64]

# Keeps the mirror image of a point light finite: at α = 0 the facets' distribution is a delta function.
ALPHA_MIN: Final = 1e-3

# Keeps the masking finite where interpolated normals lean past the silhouette (N·V ≤ 0 with N·L = 0 is 0/0).
N_DOT_V_MIN: Final = 1e-4


def alpha_ggx(perceptual_roughness: ArrayLike) -> Float64:
    """α = max(perceptual_roughness², ALPHA_MIN), glTF 2.0 Appendix B.3."""
    return np.asarray(np.maximum(np.asarray(perceptual_roughness, np.float64) ** 2, ALPHA_MIN))


def d_ggx(n_cross_h_squared: ArrayLike, alpha: ArrayLike) -> Float64:
    """Density of facets whose normal is H, per steradian.

    D = α² / (π (sin²θ_h + α² cos²θ_h)²), glTF 2.0 Appendix B.3, with sin²θ_h = |N×H|² in place of 1 − (N·H)²:
    near the highlight's centre the latter cancels, and float32 keeps only three digits of it at α = 0.01.

    Parameters
    ----------
    n_cross_h_squared : |N×H|², in [0, 1]; H on the lit side of the surface.
    alpha : perceptual roughness squared, in (0, 1].
    """
    sine_squared, a = np.asarray(n_cross_h_squared, np.float64), np.asarray(alpha, np.float64)
    a2 = a * a
    spread = sine_squared + a2 * (1.0 - sine_squared)
    return np.asarray(a2 / (np.pi * spread * spread))


def v_smith_ggx_correlated(n_dot_l: ArrayLike, n_dot_v: ArrayLike, alpha: ArrayLike) -> Float64:
    """Visibility G / (4 N·L N·V), with shadowing and masking correlated through the facets' height.

    V = ½ / (N·L √(α² + (1 − α²)(N·V)²) + N·V √(α² + (1 − α²)(N·L)²)), Heitz 2014 Eq. 99 with Eq. 72's Λ.
    glTF 2.0 Appendix B.3.2 prints the same; its earlier revisions had the separable product.

    Parameters
    ----------
    n_dot_l, n_dot_v : cosines of the light's and the viewer's angle, in [0, 1], not both 0.
    alpha : perceptual roughness squared, in (0, 1].
    """
    light, view = np.asarray(n_dot_l, np.float64), np.asarray(n_dot_v, np.float64)
    a2 = np.asarray(alpha, np.float64) ** 2
    light_term = light * np.sqrt(a2 + (1.0 - a2) * view * view)
    view_term = view * np.sqrt(a2 + (1.0 - a2) * light * light)
    return np.asarray(0.5 / (light_term + view_term))


def anisotropic_alphas(alpha: ArrayLike, strength: ArrayLike) -> tuple[Float64, Float64]:
    """α_t = mix(α, 1, strength²) along the tangent and α_b = α across it, KHR_materials_anisotropy."""
    a, share = np.asarray(alpha, np.float64), np.asarray(strength, np.float64) ** 2
    return np.asarray(a * (1.0 - share) + share), np.asarray(a + 0.0 * share)


def d_ggx_anisotropic(
    t_dot_h: ArrayLike, b_dot_h: ArrayLike, alpha_t: ArrayLike, alpha_b: ArrayLike
) -> Float64:
    """Density of facets whose normal is H, per steradian, of different roughness along T and B.

    D = 1 / (π α_t α_b ((T·H)²/α_t² + (B·H)²/α_b² + (N·H)²)²), Burley 2012, "Physically Based Shading at
    Disney", Eq. 13, written as α_t α_b / (π (…)²) with (N·H)² = 1 − (T·H)² − (B·H)²: at α_t = α_b it is
    `d_ggx`.

    Parameters
    ----------
    t_dot_h, b_dot_h : components of H along tangent and bitangent, in [−1, 1]; H on the lit side.
    alpha_t, alpha_b : roughness along the tangent and across it, in (0, 1].
    """
    along, across = np.asarray(t_dot_h, np.float64) ** 2, np.asarray(b_dot_h, np.float64) ** 2
    a_t, a_b = np.asarray(alpha_t, np.float64), np.asarray(alpha_b, np.float64)
    area = a_t * a_b
    spread = along * (a_b / a_t) + across * (a_t / a_b) + area * (1.0 - (along + across))
    return np.asarray(area / (np.pi * spread * spread))


def v_smith_ggx_anisotropic(
    n_dot_l: ArrayLike,
    n_dot_v: ArrayLike,
    t_dot_l: ArrayLike,
    b_dot_l: ArrayLike,
    t_dot_v: ArrayLike,
    b_dot_v: ArrayLike,
    alpha_t: ArrayLike,
    alpha_b: ArrayLike,
) -> Float64:
    """Visibility G / (4 N·L N·V) of facets of different roughness along T and B, height-correlated.

    V = ½ / (N·L √((α_t T·V)² + (α_b B·V)² + (N·V)²) + N·V √((α_t T·L)² + (α_b B·L)² + (N·L)²)), Heitz 2014
    Eq. 99 with Eq. 86's Λ; at α_t = α_b it is `v_smith_ggx_correlated`.

    Parameters
    ----------
    n_dot_l, n_dot_v : cosines of the light's and the viewer's angle, in [0, 1], not both 0.
    t_dot_l, b_dot_l, t_dot_v, b_dot_v : components of L and V along tangent and bitangent.
    alpha_t, alpha_b : roughness along the tangent and across it, in (0, 1].
    """
    light, view = np.asarray(n_dot_l, np.float64), np.asarray(n_dot_v, np.float64)
    a_t, a_b = np.asarray(alpha_t, np.float64), np.asarray(alpha_b, np.float64)
    along_l, across_l = a_t * np.asarray(t_dot_l, np.float64), a_b * np.asarray(b_dot_l, np.float64)
    along_v, across_v = a_t * np.asarray(t_dot_v, np.float64), a_b * np.asarray(b_dot_v, np.float64)
    light_term = light * np.sqrt(along_v * along_v + across_v * across_v + view * view)
    view_term = view * np.sqrt(along_l * along_l + across_l * across_l + light * light)
    return np.asarray(0.5 / (light_term + view_term))
