"""How a surface sends light on: its lobes, mixed and layered, for light from one direction a point.

The one statement in Python of what shaders/lighting/lobes.glsl does. Sources: glTF 2.0 Appendix B; the
texts of KHR_materials_iridescence, _specular, _transmission, _anisotropy, _sheen and _clearcoat.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layering import (
    Layer,
    iridescent_conductor_layer,
    iridescent_dielectric_layer,
    iridescent_dielectric_layer_specular,
    transmitted_share,
)
from gltf_iri.optics.microfacet import (
    anisotropic_alphas,
    d_ggx,
    d_ggx_anisotropic,
    v_smith_ggx_anisotropic,
    v_smith_ggx_correlated,
)
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.film_on import Facets, FilmOn
from gltf_iri.reference.layers import clearcoat_lobe, clearcoat_reflectance, fibre_lobe, fibre_passage
from gltf_iri.reference.layers_on import stack_lobes
from gltf_iri.reference.points import unit
from gltf_iri.reference.surface import Surface

__all__ = ["Reflectances", "evaluate_lobes", "film_reflectances", "layered_reflectances"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Reflectances:
    """What the interface reflects: the dielectric's layer over its base, and the metal's (n, 3)."""

    dielectric: Layer
    metal: Float64


def evaluate_lobes(surface: Surface, towards_light: Float64, film: FilmOn, plan: MaterialPlan) -> Float64:
    """Return f·|cosθ|, (n, 3): what the surface sends towards the viewer per illuminance from one direction.

    The base or, by their factor, Bragg layers in its place, under the fibres of a sheen, under a clearcoat.
    Emission is not in it.

    Parameters
    ----------
    towards_light : (n, 3), unit.
    film : on the same surface.
    """
    sent = _base_lobes(surface, towards_light, film, plan)
    if plan.layers is not None and film.layers is not None:
        share = surface.bragg_factor[:, None]
        stack = stack_lobes(surface, towards_light, plan.layers, film.layers, is_wall=_is_wall(plan))
        sent = (1.0 - share) * sent + share * stack
    if plan.calls_for(Effect.SHEEN):
        n_dot_l = np.clip(np.abs(np.sum(surface.normal * towards_light, axis=1)), 0.0, 1.0)
        sent = fibre_lobe(surface, towards_light) + fibre_passage(surface, n_dot_l)[:, None] * sent
    if plan.calls_for(Effect.CLEARCOAT):
        passage = 1.0 - clearcoat_reflectance(surface)
        sent = passage[:, None] * sent + clearcoat_lobe(surface, towards_light)[:, None]
    return sent


def film_reflectances(
    surface: Surface,
    plan: MaterialPlan,
    film: FilmOn,
    cos_theta: Float64,
    needed: Mask,
    facets: Facets | None = None,
) -> tuple[Float64, Float64]:
    """Return the film's reflectances over dielectric and metal, (n, 3) each; 0 where not needed.

    facets : those that send image light; `cos_theta` is then N·V.
    """
    # With KHR_materials_specular the reflection's weight belongs to the base under the film.
    weight = surface.specular_weight[:, None] if plan.layering == "specular" else 1.0
    return (
        film(
            "dielectric", weight * surface.dielectric_f0, cos_theta, needed & (surface.metallic < 1.0), facets
        ),
        film("metal", surface.base_color, cos_theta, needed & (surface.metallic > 0.0), facets),
    )


def layered_reflectances(
    surface: Surface, plan: MaterialPlan, plain: tuple[Float64, Float64], filmed: tuple[Float64, Float64]
) -> Reflectances:
    """Mix the reflectances (n, 3) without and with film, each over the dielectric and over the metal."""
    strength, weight = surface.iridescence_factor, surface.specular_weight
    if plan.layering == "specular":
        layer = iridescent_dielectric_layer_specular(strength, weight, plain[0], filmed[0])
    else:
        layer = iridescent_dielectric_layer(strength, plain[0], filmed[0])
    return Reflectances(layer, iridescent_conductor_layer(strength, plain[1], filmed[1]))


def _base_lobes(surface: Surface, towards_light: Float64, film: FilmOn, plan: MaterialPlan) -> Float64:
    """Return f·|cosθ| of metal and dielectric.

    In front, base_weight·c/π + F·V·D, film and Schlick at V·H (glTF 2.0 Appendix B.2). Behind a wall without
    volume, transmitted light: the lobe of the light mirrored to the front, (1 − m)·t·c·T·V·D, with T = 1 − R
    of each channel. Nothing passes through a volume here: bent light of a point source would be a caustic.
    """
    cosine = np.sum(surface.normal * towards_light, axis=1)
    is_through = (cosine < 0.0) & (surface.transmission > 0.0) & _is_wall(plan)
    # A thin wall bends nothing: its facets see light from behind as if it came mirrored, from the front.
    light = towards_light - 2.0 * np.minimum(cosine, 0.0)[:, None] * surface.normal
    n_dot_l = np.clip(np.abs(cosine), 0.0, 1.0)
    half = unit(surface.view + light)
    # Looking straight into a light there is no half vector, and no facet that could mirror it.
    is_lit = ((cosine > 0.0) | is_through) & np.any(half != 0.0, axis=1)
    v_dot_h = np.clip(np.sum(surface.view * half, axis=1), 0.0, 1.0)
    lobe = _facets(surface, plan, light, half, n_dot_l)[:, None]
    c = v_dot_h[:, None]
    layers = layered_reflectances(
        surface,
        plan,
        (f_schlick(surface.dielectric_f0, c), f_schlick(surface.base_color, c)),
        film_reflectances(surface, plan, film, v_dot_h, is_lit),
    )
    m, t = surface.metallic[:, None], surface.transmission[:, None]
    diffuse = layers.dielectric.base_weight[:, None] * surface.base_color / np.pi
    in_front = (1.0 - m) * ((1.0 - t) * diffuse + layers.dielectric.specular * lobe) + m * layers.metal * lobe
    through = (1.0 - m) * t * surface.base_color * transmitted_share(layers.dielectric.specular) * lobe
    sent = np.where(is_through[:, None], through, in_front)
    return np.asarray(np.where(is_lit[:, None], n_dot_l[:, None] * sent, 0.0))


def _is_wall(plan: MaterialPlan) -> bool:
    """True where light passes without being bent."""
    return plan.calls_for(Effect.TRANSMISSION) and not plan.calls_for(Effect.VOLUME)


def _facets(surface: Surface, plan: MaterialPlan, light: Float64, half: Float64, n_dot_l: Float64) -> Float64:
    """Return D·V, (n,), for light (n, 3) from the front."""
    normal, view = surface.normal, surface.view
    n_cross_h = np.cross(normal, half)
    even = d_ggx(np.sum(n_cross_h * n_cross_h, axis=1), surface.alpha_roughness) * v_smith_ggx_correlated(
        n_dot_l, surface.n_dot_v, surface.alpha_roughness
    )
    if not plan.calls_for(Effect.ANISOTROPY):
        return even
    tangent, bitangent = surface.anisotropy_tangent, np.cross(normal, surface.anisotropy_tangent)
    widths = anisotropic_alphas(surface.alpha_roughness, surface.anisotropy_strength)

    def along(vectors: Float64) -> tuple[Float64, Float64]:
        return np.sum(tangent * vectors, axis=1), np.sum(bitangent * vectors, axis=1)

    drawn_out = d_ggx_anisotropic(*along(half), *widths) * v_smith_ggx_anisotropic(
        n_dot_l, surface.n_dot_v, *along(light), *along(view), *widths
    )
    # Without a tangent there is no direction to draw the highlight out in.
    return np.where(np.any(tangent != 0.0, axis=1), drawn_out, even)
