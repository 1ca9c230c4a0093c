"""The rough surface: GGX facets and their height-correlated masking, as functions of cosines and of α.

α is the perceptual roughness squared. Sources: glTF 2.0 Appendix B.3; Walter et al. 2007, "Microfacet Models
for Refraction through Rough Surfaces", Eq. 33; Heitz 2014, "Understanding the Masking-Shadowing Function in
Microfacet-Based BRDFs", Eq. 72 and 99. Twin: shaders/optics/microfacet.glsl.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["ALPHA_MIN", "N_DOT_V_MIN", "d_ggx", "v_smith_ggx_correlated"]

Float64 = NDArray[np.float64]

# Keeps the mirror image of a point light finite: at α = 0 the facets' distribution is a delta function.
ALPHA_MIN: Final = 1e-3

# Keeps the masking finite where interpolated normals lean past the silhouette (N·V ≤ 0 with N·L = 0 is 0/0).
N_DOT_V_MIN: Final = 1e-4


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
    (The core text prints the separable product; it leaves the choice of G to the implementation.)

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
