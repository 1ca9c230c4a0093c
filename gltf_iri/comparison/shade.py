"""Shades pixels a second time, in float64, from what the renderer wrote beside its picture.

The equations are the renderer's (glTF 2.0 Appendix B; KHR_materials_iridescence, Implementation Notes); the
code is not: it starts from each pixel's inputs and evaluates the film with any method, the truth included.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gltf_iri.comparison.image_light import image_light
from gltf_iri.comparison.pixels import ImageLight
from gltf_iri.evaluation.film import Evaluation, Film, base_from_f0
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layering import (
    Layer,
    iridescent_conductor_layer,
    iridescent_dielectric_layer,
    iridescent_dielectric_layer_specular,
)
from gltf_iri.optics.microfacet import d_ggx, v_smith_ggx_correlated
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.surface import Surface
from gltf_iri.scene.illuminance import arriving
from gltf_iri.scene.model import Light

__all__ = ["FilmMethod", "Shading", "shade"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]
FilmMethod = Callable[[Film], Evaluation]


@dataclass(slots=True)
class Shading:
    """Shaded pixels, and for each undefined case of the film's method the pixels (n,) it touched.

    rgb : (n, 3) linear colour.
    film : (n, 3) the film's own reflectance at N·V, strength 1, metal and dielectric mixed by metalness; 0
        where there is no film (`has_film` is False).
    white : the film's; empty where no film was evaluated.
    """

    rgb: Float64
    film: Float64
    has_film: Mask
    white: str = ""
    undefined: dict[str, Mask] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class _FilmAt:
    """The film of one material, evaluated on its pixels; keeps account of undefined cases in `shading`."""

    surface: Surface
    film_ior: float
    method: FilmMethod
    shading: Shading

    def __call__(self, base_f0: Float64, cos_theta: Float64, needed: Mask) -> Float64:
        """Return the film's reflectance (n, 3) over `base_f0`; 0 where there is no film or none is needed."""
        rgb = np.zeros_like(base_f0)
        rows = self.shading.has_film & needed
        if not rows.any():
            return rgb
        thickness = self.surface.iridescence_thickness_nm[rows]
        film = Film.of(cos_theta[rows], thickness, self.film_ior, base_from_f0(base_f0[rows]))
        evaluation = self.method(film)
        rgb[rows] = evaluation.rgb
        self.shading.white = evaluation.white
        for case, touched in evaluation.undefined.items():
            mask = self.shading.undefined.setdefault(case, np.zeros(rows.shape, dtype=np.bool_))
            mask[rows] |= np.broadcast_to(touched, film.shape)
        return rgb


def shade(
    surface: Surface,
    image: ImageLight,
    plan: MaterialPlan,
    film_ior: float,
    lights: Sequence[Light],
    method: FilmMethod,
) -> Shading:
    """Return the linear colour of each pixel of one material.

    Parameters
    ----------
    surface, image : what the renderer shaded the pixels with.
    plan : the material's plan; says whether it is unlit, has a film, and which layering applies.
    film_ior : the film's refractive index; not read where the plan has no film.
    lights : the scene's punctual lights.
    method : maps a `Film` to its reflectance colours.
    """
    nothing = np.zeros_like(surface.base_color)
    has_film = (surface.iridescence_factor > 0.0) & plan.calls_for(Effect.IRIDESCENCE)
    shading = Shading(nothing, nothing, has_film)
    if plan.calls_for(Effect.UNLIT):
        shading.rgb = surface.base_color
        return shading
    film = _FilmAt(surface, film_ior, method, shading)
    everywhere = np.ones(len(surface.alpha), dtype=np.bool_)
    filmed = _films(surface, plan, film, surface.n_dot_v, everywhere)
    shading.film = _by_metalness(surface, *filmed)

    def layers(a: Float64, b: Float64) -> tuple[Layer, Float64]:
        plain = (surface.dielectric_f0 * a + b, surface.base_color * a + b)
        return _layers(surface, plan, plain, ((a + b) * filmed[0], (a + b) * filmed[1]))

    rgb = surface.emission + image_light(surface, image, layers)
    for light in lights:
        rgb = rgb + _punctual_light(surface, plan, film, light)
    shading.rgb = rgb
    return shading


def _punctual_light(surface: Surface, plan: MaterialPlan, film: _FilmAt, light: Light) -> Float64:
    """E·(N·L)·f_r, with film and Schlick at V·H, f_r = base_weight·c/π + F·V·D (glTF 2.0 Appendix B.2)."""
    towards_light, illuminance = arriving(light, surface.position)
    n_dot_l = np.clip(np.sum(surface.normal * towards_light, axis=-1), 0.0, 1.0)
    half = surface.view + towards_light
    length = np.linalg.norm(half, axis=-1, keepdims=True)
    # A light exactly behind the surface has no half vector, and lights nothing (N·L = 0).
    half = half / np.where(length > 0.0, length, 1.0)
    v_dot_h = np.clip(np.sum(surface.view * half, axis=-1), 0.0, 1.0)
    n_cross_h = np.cross(surface.normal, half)
    lobe = d_ggx(np.sum(n_cross_h * n_cross_h, axis=-1), surface.alpha) * v_smith_ggx_correlated(
        n_dot_l, surface.n_dot_v, surface.alpha
    )
    cosine = v_dot_h[:, None]
    dielectric, metal = _layers(
        surface,
        plan,
        (f_schlick(surface.dielectric_f0, cosine), f_schlick(surface.base_color, cosine)),
        _films(surface, plan, film, v_dot_h, (illuminance.max(axis=-1) > 0.0) & (n_dot_l > 0.0)),
    )
    through = dielectric.base_weight[:, None] * surface.base_color / np.pi
    reflected = _by_metalness(surface, through + dielectric.specular * lobe[:, None], metal * lobe[:, None])
    return np.asarray(illuminance * n_dot_l[:, None] * reflected)


def _films(
    surface: Surface, plan: MaterialPlan, film: _FilmAt, cos_theta: Float64, needed: Mask
) -> tuple[Float64, Float64]:
    """Return the film's reflectances over the dielectric and over the metal."""
    # With KHR_materials_specular the reflection's weight belongs to the base under the film.
    weight = surface.specular_weight[:, None] if plan.layering == "specular" else 1.0
    return (
        film(weight * surface.dielectric_f0, cos_theta, needed & (surface.metallic < 1.0)),
        film(surface.base_color, cos_theta, needed & (surface.metallic > 0.0)),
    )


def _layers(
    surface: Surface, plan: MaterialPlan, plain: tuple[Float64, Float64], filmed: tuple[Float64, Float64]
) -> tuple[Layer, Float64]:
    """Return the dielectric's layer and the metal's reflectance, from those without and with film."""
    strength = surface.iridescence_factor * plan.calls_for(Effect.IRIDESCENCE)
    if plan.layering == "specular":
        layer = iridescent_dielectric_layer_specular(strength, surface.specular_weight, plain[0], filmed[0])
    else:
        layer = iridescent_dielectric_layer(strength, plain[0], filmed[0])
    return layer, iridescent_conductor_layer(strength, plain[1], filmed[1])


def _by_metalness(surface: Surface, dielectric: Float64, metal: Float64) -> Float64:
    share = surface.metallic[:, None]
    return np.asarray((1.0 - share) * dielectric + share * metal)
