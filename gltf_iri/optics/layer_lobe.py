"""What a rough Bragg layer sends back of light: an integral over all directions out, exact to rounding.

The layer's facets mask light and viewer apart, G = G₁(i) G₁(o) (Fourneau et al. 2024, Eq. 19), so that its
albedo is not that of the other lobes of glTF, whose masking knows of both (`optics/facet_mean.py`).

A lobe is narrow, but where its integrand ceases to be smooth is known in closed form, off the real axis. Over
the turn ψ from the mirror direction the facets' density is (2 sin²½ψ + t)⁻² but for smooth factors, with
2 s_i s_o t = (s_i − s_o)² + α²(c_i + c_o)²: double poles at ψ = ±iq, sinh²½q = ½t. What is left over θ_o
branches where t = 0, at θ_o = θ_i ± 2i artanh α, and near the horizon where G₁ does, at c_o = ±iα/√(1 − α²).
With x = p + q sinh v for such a point p + iq (Johnston & Elliott 2005, "A sinh transformation for evaluating
nearly singular boundary element integrals") Gauss points over v settle as fast for any roughness.
"""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.optics.layer_stack import cosine_in_host, half_vector
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.optics.rough_bragg import facet_weight

__all__ = ["LobeNodes", "layer_lobe", "lobe_nodes"]

Float64 = NDArray[np.float64]

# Gauss points over θ_o, for each of three panels, and over half a turn: 5e-6 of the sum of a reflectance with
# two fringes, for α from 0.002 and any cosine; 16 and 20 leave 1e-7, 24 and 24 leave 5e-9, 32 and 32 1e-12.
_ANGLES: Final = 16
_TURNS: Final = 16

# The widest lobe's singular points lie at infinity: that of 0.99 is wide already.
_WIDEST: Final = 0.99

_MOST: Final = 1e12  # of t, which is infinite where light or viewer stands straight above: any ψ counts alike


class LobeNodes(NamedTuple):
    """Directions o that a layer sends light to, (..., q) each.

    cos_h : of the angle that facets are met at; cos_o : at the layer, in the host; cos_outside : beyond the
    host's surface. weights : Σ weights·f = ∫ f w cosθ_o dω_o, w = `rough_bragg.facet_weight`.
    """

    cos_h: Float64
    cos_o: Float64
    cos_outside: Float64
    weights: Float64


def layer_lobe(
    cos_theta_o: ArrayLike, alpha: ArrayLike, *, angles: int = _ANGLES, turns: int = _TURNS
) -> tuple[Float64, Float64]:
    """Return cosines cosθ_h and weights (..., 3·angles·turns): ∫ R(θ_h) w cosθ_i dω_i = Σ weights R(cosines).

    w is `rough_bragg.facet_weight`, D G₁(i) G₁(o) / (4 cosθ_i cosθ_o); with R = 1 the sum is at most 1.

    cos_theta_o : of the viewer in the host, in [0, 1]; alpha : in (0, 1]; both broadcast.
    """
    nodes = lobe_nodes(cos_theta_o, alpha, angles=angles, turns=turns)
    return nodes.cos_h, nodes.weights


def lobe_nodes(
    cos_theta: ArrayLike,
    alpha: ArrayLike,
    host_ior: float = 1.0,
    *,
    angles: int = _ANGLES,
    turns: int = _TURNS,
) -> LobeNodes:
    """Return the directions (..., 3·angles·turns) that light at `cos_theta` outside the host is sent to.

    Of directions in the host those that leave it, given by where they go outside: so nothing bends at the
    critical angle, cosθ_o dω_o = cosθ dω/n_h². The host's surface itself takes nothing here.

    cos_theta : outside, in [0, 1]; alpha : in (0, 1]; both broadcast. host_ior : real, ≥ 1; 1 for a layer in
    a medium that is its host all along.
    """
    cosine, a = np.broadcast_arrays(np.asarray(cos_theta, np.float64), np.asarray(alpha, np.float64))
    shape, n = cosine.shape, float(host_ior)
    # (..., panel, angle, turn)
    cosine, a = cosine[..., None, None, None], a[..., None, None, None]
    theta, over_theta = _outside(cosine, a, n, angles)
    cos_outside = np.cos(theta)
    cos_i, cos_o = cosine_in_host(n, cosine), cosine_in_host(n, cos_outside)
    sin_i, sin_o = np.sqrt((1.0 - cosine) * (1.0 + cosine)) / n, np.sin(theta) / n
    with np.errstate(divide="ignore"):
        t = 0.5 * ((sin_i - sin_o) ** 2 + (a * (cos_i + cos_o)) ** 2) / (sin_i * sin_o)
    turn, turn_weights = gauss_unit(turns)
    psi, over_psi = _towards(0.0, 2.0 * np.arcsinh(np.sqrt(0.5 * np.minimum(t, _MOST))), np.pi, turn)
    cos_h, sine_squared = half_vector(cos_i, cos_o, 2.0 * np.sin(0.5 * psi) ** 2)
    sent = facet_weight(sine_squared, cos_i, cos_o, a) * cos_outside * np.sin(theta) / (n * n)
    weights = 2.0 * sent * over_theta * over_psi * turn_weights
    values = (cos_h, cos_o, cos_outside, weights)
    return LobeNodes(*(np.broadcast_to(v, weights.shape).reshape(*shape, -1) for v in values))


def _outside(cosine: Float64, a: Float64, n: float, count: int) -> tuple[Float64, Float64]:
    """Return θ and dθ outside (..., 3, count, 1): peak to 0, peak to halfway up, and 90° to there."""
    rough = np.minimum(a, _WIDEST)
    theta_i = np.arcsin(np.sqrt((1.0 - cosine) * (1.0 + cosine)) / n)
    peak = theta_i + 2.0j * np.arctanh(rough)
    if n > 1.0:
        peak = np.arcsin(n * np.sin(peak))
        # Where what the host's surface lets out branches: at grazing light within, nearer than G₁ does.
        horizon = np.full_like(rough, np.arccosh(n))
    else:
        horizon = np.arctanh(rough)
    end = np.full_like(rough, 0.5 * np.pi)
    halfway = 0.5 * (peak.real + end)
    centre, width, stop = (
        np.concatenate(parts, axis=-3)
        for parts in (
            (peak.real, peak.real, end),
            (peak.imag, peak.imag, horizon),
            (np.zeros_like(end), halfway, halfway),
        )
    )
    nodes, weights = gauss_unit(count)
    theta, over = _towards(centre, width, stop, nodes[:, None])
    return np.clip(theta, 0.0, 0.5 * np.pi), np.abs(over) * weights[:, None]


def _towards(centre: ArrayLike, width: Float64, stop: ArrayLike, share: Float64) -> tuple[Float64, Float64]:
    """Return x = p + q sinh v and dx at `share` in [0, 1] of the way from p to `stop`, v being even."""
    p, end = np.asarray(centre, np.float64), np.asarray(stop, np.float64)
    length = np.arcsinh((end - p) / width)
    v = length * share
    return np.asarray(p + width * np.sinh(v)), np.asarray(width * np.cosh(v) * length)
