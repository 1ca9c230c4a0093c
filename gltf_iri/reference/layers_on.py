"""The Bragg layers of one material at many points: what they send on of light from one direction a point.

The stack stands in place of the base's interface: layers in a host over what lies below it, a Lambertian
share (1 − metallic)(1 − transmission)·colour and a metal of the material's own roughness. The sum is that of
`evaluation/layers.py`; here are the points that it is taken at. Light from behind crosses all layers once.
Twins: shaders/lighting/bragg_layers.glsl and bragg_through.glsl.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.layer_lookup import ImageColours
from gltf_iri.evaluation.layers import LayerBase, LayerColours, coating_reflectance, layer_terms
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.optics.layer_stack import Sight, coating_transmittance, cosine_in_host
from gltf_iri.optics.microfacet import ALPHA_MIN, d_ggx, v_smith_ggx_correlated
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.reference.points import unit
from gltf_iri.reference.surface import Surface

__all__ = ["ColoursAtPoints", "LayersMethod", "let_through", "sight_between", "stack_lobes"]

Float64 = NDArray[np.float64]


class ColoursAtPoints(LayerColours, Protocol):
    """The colours of one material's layers at n points, under image light too."""

    def image(self, n_dot_v: Float64, metal_roughness: Float64) -> ImageColours:
        """Return what image light becomes, seen at the cosine `n_dot_v` in the host; roughness perceptual."""
        ...


# The colours where the period texture reads (n,).
LayersMethod = Callable[[Float64], ColoursAtPoints]


def stack_lobes(
    surface: Surface,
    towards_light: Float64,
    plan: LayersPlan,
    method: LayersMethod,
    *,
    is_wall: bool = False,
) -> Float64:
    """Return f·|cosθ| of the stack, (n, 3), for light (n, 3) from the front, and through a thin wall.

    is_wall : the base transmits and has no volume; without, nothing of light from behind is sent.
    """
    cosine = np.sum(surface.normal * towards_light, axis=1)
    # Looking straight into a light there is no half vector, and no facet that could mirror it.
    is_lit = (cosine > 0.0) & np.any(surface.view + towards_light != 0.0, axis=1)
    sent = np.zeros_like(surface.base_color)
    rows = np.flatnonzero(is_lit)
    if len(rows):
        n_dot_l = np.minimum(cosine[rows], 1.0)
        sent[rows] = _from_the_front(surface.take(rows), towards_light[rows], n_dot_l, plan, method)
    rows = np.flatnonzero((cosine < 0.0) & (surface.transmission > 0.0) & is_wall)
    if len(rows):
        n_dot_l = np.minimum(-cosine[rows], 1.0)
        sent[rows] = _from_behind(surface.take(rows), towards_light[rows], n_dot_l, plan, method)
    return sent


def let_through(colours: ColoursAtPoints, host_ior: float, cosine: Float64) -> Float64:
    """Return (n, 3), what of light from below the layers leaves at `cosine` (n,) outside: T_c Π T_k, once."""
    entering = colours.entering(cosine_in_host(host_ior, cosine))
    return np.asarray(coating_transmittance(host_ior, cosine)[:, None] * entering)


def _from_the_front(
    surface: Surface, light: Float64, n_dot_l: Float64, plan: LayersPlan, method: LayersMethod
) -> Float64:
    base = None if plan.under == "nothing" else _base_of(surface)
    stack = planned_stack(plan, surface.bragg_period_texel, base)
    sight = sight_between(surface, light, n_dot_l, plan.host_ior)
    terms = layer_terms(stack, sight, method(surface.bragg_period_texel))
    below = sight.passage[:, None] * np.sum(terms, axis=0)
    if plan.host_ior != 1.0:
        below = below + _coating(surface, light, n_dot_l, plan.host_ior)[:, None]
    return np.asarray(n_dot_l[:, None] * below)


def _from_behind(
    surface: Surface, light: Float64, n_dot_l: Float64, plan: LayersPlan, method: LayersMethod
) -> Float64:
    """Return the lobe of the light mirrored to the front, as a thin wall without layers has it."""
    front = light + 2.0 * n_dot_l[:, None] * surface.normal
    seen = _facets(surface, front, n_dot_l, surface.alpha_roughness)
    # Looking straight into a light that grazes there is no half vector.
    seen = seen * np.any(surface.view + front != 0.0, axis=1)
    through = let_through(method(surface.bragg_period_texel), plan.host_ior, surface.n_dot_v)
    return np.asarray((n_dot_l * seen)[:, None] * surface.passing_share * through)


def sight_between(surface: Surface, towards_light: Float64, n_dot_l: Float64, host_ior: float) -> Sight:
    """Return how the layers see light and viewer, as `sight_of` by vectors.

    Bending divides by the host's index what of both lies in the surface.
    """
    cos_i, cos_o = cosine_in_host(host_ior, n_dot_l), cosine_in_host(host_ior, surface.n_dot_v)
    both = towards_light + surface.view
    level = (both - np.sum(both * surface.normal, axis=1, keepdims=True) * surface.normal) / host_ior
    level_squared = np.sum(level * level, axis=1)
    total = level_squared + (cos_i + cos_o) ** 2
    passage = np.ones(len(total))
    if host_ior != 1.0:
        passage = coating_transmittance(host_ior, n_dot_l) * coating_transmittance(host_ior, surface.n_dot_v)
        passage = passage / host_ior**2
    # Rounding, and a view from behind the normal, may make the two of them longer than 2.
    return Sight(cos_i, cos_o, np.minimum(0.5 * np.sqrt(total), 1.0), level_squared / total, passage)


def _coating(surface: Surface, towards_light: Float64, n_dot_l: Float64, host_ior: float) -> Float64:
    """Return f (n,) of the host's surface alone, drawn as the smoothest facets that are (`ALPHA_MIN`)."""
    half = unit(surface.view + towards_light)
    v_dot_h = np.clip(np.sum(surface.view * half, axis=1), 0.0, 1.0)
    facets = _facets(surface, towards_light, n_dot_l, ALPHA_MIN)
    return np.asarray(coating_reflectance(host_ior, v_dot_h) * facets)


def _facets(surface: Surface, towards_light: Float64, n_dot_l: Float64, alpha: float | Float64) -> Float64:
    """Return D·V (n,) of facets in air."""
    n_cross_h = np.cross(surface.normal, unit(surface.view + towards_light))
    density = d_ggx(np.sum(n_cross_h * n_cross_h, axis=1), alpha)
    return np.asarray(density * v_smith_ggx_correlated(n_dot_l, surface.n_dot_v, alpha))


def _base_of(surface: Surface) -> LayerBase:
    # Interpolated values may overshoot by a rounding; no reflectance exceeds 1.
    m = np.clip(surface.metallic, 0.0, 1.0)
    return LayerBase(
        ((1.0 - m) * (1.0 - np.clip(surface.transmission, 0.0, 1.0)))[:, None] * surface.base_color,
        surface.base_color,
        m,
        np.minimum(surface.alpha_roughness, 1.0),
    )
