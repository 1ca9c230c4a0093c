"""Shades pixels a second time, in float64, from what the renderer wrote beside its picture.

The equations are the renderer's; the code is not: it starts from each pixel's inputs and evaluates the film
with any method, the truth included. Punctual light takes the road of the CPU reference
(gltf_iri/reference/direct.py); image light, which the renderer approximates, is put together here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.comparison.image_light import image_light, under_clearcoat
from gltf_iri.comparison.layer_light import seen_layers
from gltf_iri.comparison.pixels import ImageLight
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.direct import punctual_lighting
from gltf_iri.reference.film_on import Facets, FilmMethod, FilmOn
from gltf_iri.reference.layers_on import LayersMethod
from gltf_iri.reference.lobes import film_reflectances
from gltf_iri.reference.surface import Surface
from gltf_iri.scene.model import Light

__all__ = ["Shading", "shade"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Shading:
    """Shaded pixels, and for each undefined case of the film's method the pixels (n,) it touched.

    rgb : (n, 3) linear colour.
    film : (n, k, 3) the film's own reflectance at N·V, strength 1, metal and dielectric mixed by metalness,
        k = 1; or the colours of Bragg layers (`SeenLayers.colours`). 0 where there is neither (`has_film` is
        False).
    white : the film's; empty where no film was evaluated.
    """

    rgb: Float64
    film: Float64
    has_film: Mask
    white: str
    undefined: Mapping[str, Mask]


def shade(
    surface: Surface,
    image: ImageLight,
    plan: MaterialPlan,
    film_ior: float,
    lights: Sequence[Light],
    method: FilmMethod,
    layers: LayersMethod | None = None,
) -> Shading:
    """Return the linear colour of each pixel of one material.

    Parameters
    ----------
    surface, image : what the renderer shaded the pixels with.
    plan : the material's plan; says whether it is unlit and thin, and which layering applies.
    film_ior : the film's refractive index; not read where the surface has no film.
    lights : the scene's punctual lights.
    method : maps a `Film` and how it is seen to its reflectance colours; of a plan with a way, image light is
        seen by facets.
    layers : the colours of the Bragg layers; not read where the plan has none.
    """
    film = FilmOn(surface, film_ior, method, layers)
    facets = None if plan.way is None else Facets(surface.perceptual_roughness, image.facet_cosine)
    if plan.calls_for(Effect.UNLIT):
        return Shading(surface.base_color, np.zeros((len(film.has_film), 1, 3)), film.has_film, "", {})
    everywhere = np.ones(len(surface.alpha_roughness), dtype=np.bool_)
    own_film = film_reflectances(surface, plan, film, surface.n_dot_v, everywhere)
    filmed = own_film
    if facets is not None:
        filmed = film_reflectances(surface, plan, film, surface.n_dot_v, image.is_there, facets)
    seen = None if layers is None else seen_layers(surface, plan, layers)
    sent = surface.emission + image_light(surface, image, plan, filmed, seen)
    rgb = under_clearcoat(surface, image, sent)
    rgb += punctual_lighting(surface, lights, film, plan)
    share = surface.metallic[:, None]
    own = (1.0 - share) * own_film[0] + share * own_film[1]
    if seen is not None:
        return Shading(rgb, seen.colours, surface.bragg_factor > 0.0, "", {})
    return Shading(rgb, own[:, None], film.has_film, film.white, film.undefined)
