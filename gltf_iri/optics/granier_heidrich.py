"""The layered surface of Granier & Heidrich 2003, "A Simple Layered RGB BRDF Model".

A layer between two boundaries whose normals need not agree: light reflected by the outer one interferes with
light that enters, is reflected once by the inner one and leaves again, each a Phong lobe, at one wavelength a
channel. The object under the layer reflects all that reaches it and no phase jumps, as published.
Twin: shaders/optics/granier_heidrich.glsl.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.turns import sincos_turns

__all__ = ["WAVELENGTHS_NM", "inner_normal", "layered_diffuse", "layered_reflection"]

Float64 = NDArray[np.float64]

# Section 3.3: what stands for red, green and blue.
WAVELENGTHS_NM: Final = (645.0, 525.0, 445.0)


def layered_reflection(
    light: ArrayLike,
    view: ArrayLike,
    normal_0: ArrayLike,
    normal_1: ArrayLike,
    outside_ior: ArrayLike,
    layer_ior: ArrayLike,
    thickness_nm: ArrayLike,
    exponent_0: ArrayLike,
    exponent_1: ArrayLike,
) -> Float64:
    """Return ρ = R + T + 2 cos(2Φ) √(RT), (..., 3), one value a channel (Eq. 5); it may exceed 1.

    R = F(l·n₀) ⟨r, v⟩^e₀ (Eq. 6), T = (1 − F(l·n₀)) 𝒯(t_v) ⟨r_t, −t_v⟩^e₁ (Eq. 10),
    Φ = π n d ⟨t_l + t_v, −n₀⟩/λ (Eq. 3), with t the refracted directions and r_t what n₁ makes of t_l.

    light, view : (..., 3) unit vectors away from the surface.
    normal_0, normal_1 : (..., 3) unit normals of the outer and of the inner boundary.
    outside_ior, thickness_nm, exponent_0, exponent_1 : (...).
    layer_ior : (..., 3) index of the layer for red, green and blue.

    Where the layer lets no light in, all of it is reflected: the paper leaves this case to a test.
    """
    to_light, v, n0, n1 = (
        np.asarray(a, dtype=np.float64)[..., None, :] for a in (light, view, normal_0, normal_1)
    )
    r0, d_nm, e0, e1 = (
        np.asarray(a, dtype=np.float64)[..., None]
        for a in (outside_ior, thickness_nm, exponent_0, exponent_1)
    )
    r1 = np.asarray(layer_ior, dtype=np.float64)

    cos_l = _dot(to_light, n0)
    mirrored = 2.0 * cos_l[..., None] * n0 - to_light
    f = ((r0 - r1) / (r0 + r1)) ** 2
    F = f + (1.0 - f) * (1.0 - cos_l) ** 5
    R = F * np.maximum(_dot(mirrored, v), 0.0) ** e0

    t_l, l_enters = _refracted(to_light, n0, r0 / r1)
    t_v, v_leaves = _refracted(v, n0, r0 / r1)
    r_t = t_l - 2.0 * _dot(t_l, n1)[..., None] * n1
    lobe = -_dot(r_t, t_v)
    cos_v = -_dot(t_v, n0)
    # Eq. 11: rays that the inner boundary does not meet, or sends away from the viewer.
    meets = (_dot(t_l, n1) < 0.0) & (_dot(t_v, n1) < 0.0) & (lobe > 0.0)
    through = (1.0 - f) * (1.0 - (1.0 - cos_v) ** 5)  # Eq. 9
    T = np.where(meets, (1.0 - F) * through * np.where(meets, lobe, 1.0) ** e1, 0.0)

    # 2Φ in whole turns: π n d (cos_l' + cos_v)/λ is half a turn of each half path.
    turns = r1 * d_nm * (cos_v - _dot(t_l, n0)) / np.array(WAVELENGTHS_NM)
    _, fringe = sincos_turns(turns)
    colour = R + T + 2.0 * fringe * np.sqrt(R * T)
    return np.asarray(np.where(l_enters & v_leaves, colour, np.maximum(_dot(mirrored, v), 0.0) ** e0))


def layered_diffuse(outside_ior: ArrayLike, layer_ior: ArrayLike, thickness_nm: ArrayLike) -> Float64:
    """Return ρ_d = 1 + 2 cos(4π n d/λ) √(T_d (1 − T_d)); T_d = 80 r₀r₁ / 21 (r₁ + r₀)² (Eq. 15, 18).

    One value a channel, (..., 3).

    outside_ior, thickness_nm : (...); layer_ior : (..., 3).
    """
    r0, d_nm = (np.asarray(a, dtype=np.float64)[..., None] for a in (outside_ior, thickness_nm))
    r1 = np.asarray(layer_ior, dtype=np.float64)
    T_d = 80.0 / 21.0 * r0 * r1 / (r1 + r0) ** 2
    _, fringe = sincos_turns(2.0 * r1 * d_nm / np.array(WAVELENGTHS_NM))
    return np.asarray(1.0 + 2.0 * fringe * np.sqrt(T_d * (1.0 - T_d)))


def inner_normal(
    normal_0: ArrayLike, tangent: ArrayLike, bitangent: ArrayLike, slope_x: ArrayLike, slope_y: ArrayLike
) -> Float64:
    """Return the inner boundary's unit normal (..., 3) where it follows the layer's thickness (section 6).

    It lies `d` below the outer one, so that slopes ∂d/∂x along `tangent` and ∂d/∂y along `bitangent`
    (both dimensionless) lean it towards where the layer thickens.
    """
    n0, t, b = (np.asarray(a, dtype=np.float64) for a in (normal_0, tangent, bitangent))
    dx, dy = (np.asarray(a, dtype=np.float64)[..., None] for a in (slope_x, slope_y))
    leaning = n0 + dx * t + dy * b
    return np.asarray(leaning / np.sqrt(_dot(leaning, leaning))[..., None])


def _refracted(away: Float64, normal: Float64, ratio: Float64) -> tuple[Float64, NDArray[np.bool_]]:
    """Return the direction inside (..., 3, 3) of a ray that comes from `away`, and where there is one."""
    cosine = _dot(away, normal)
    squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine)
    inside = np.sqrt(np.maximum(squared, 0.0))  # the rest is told apart by the mask
    return -ratio[..., None] * away + (ratio * cosine - inside)[..., None] * normal, squared >= 0.0


def _dot(a: Any, b: Any) -> Float64:
    return np.asarray((a * b).sum(axis=-1))
