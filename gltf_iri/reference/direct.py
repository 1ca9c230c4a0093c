"""One material's points under the scene's lights: what they send towards the viewer.

Punctual light casts no shadow here and image light is not occluded by the scene, as in the rasteriser.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.film_on import FilmOn
from gltf_iri.reference.layers import clearcoat_reflectance
from gltf_iri.reference.lobes import evaluate_lobes
from gltf_iri.reference.surface import Surface
from gltf_iri.scene.illuminance import arriving
from gltf_iri.scene.model import Light

__all__ = ["emitted", "punctual_lighting"]

Float64 = NDArray[np.float64]


def punctual_lighting(surface: Surface, lights: Sequence[Light], film: FilmOn, plan: MaterialPlan) -> Float64:
    """Return the radiance (n, 3) that the surface sends to the viewer of what `lights` send to it."""
    sent = np.zeros_like(surface.base_color)
    for light in lights:
        towards_light, illuminance = arriving(light, surface.position)
        sent += illuminance * evaluate_lobes(surface, towards_light, film, plan)
    return sent


def emitted(surface: Surface, plan: MaterialPlan) -> Float64:
    """Return the radiance (n, 3) that the surface sends by itself: from under the coat, past any fibres."""
    if not plan.calls_for(Effect.CLEARCOAT):
        return surface.emission
    return np.asarray((1.0 - clearcoat_reflectance(surface))[:, None] * surface.emission)
