"""What surfaces send to a path by themselves: emission, punctual light, image light; none of it shadowed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.direct import emitted, punctual_lighting
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.film_on import FilmOn
from gltf_iri.reference.image_light import Lobes, estimate
from gltf_iri.reference.layers import clearcoat_reflectance, fibre_lobe
from gltf_iri.reference.lobes import evaluate_lobes
from gltf_iri.reference.stage import Stage
from gltf_iri.reference.surface import Surface
from gltf_iri.reference.tracer import Tracer
from gltf_iri.scene.model import Light

__all__ = ["Scenery", "sent", "unmirrored"]

Float64 = NDArray[np.float64]

# Directions of image light on each point that a path meets; the mean is over many paths.
_SAMPLES: Final = 4


@dataclass(frozen=True, slots=True)
class Scenery:
    """What paths run through.

    environment : image light, also behind the scene; None: darkness.
    backdrop : what light that was never bent or mirrored sees behind the scene; None: the environment.
    film_on : makes the film on points of the material at a place among the stage's plans.
    is_blending : False lets blended materials stop paths as if opaque.
    """

    tracer: Tracer
    stage: Stage
    environment: EnvironmentMap | None
    backdrop: tuple[float, float, float] | None
    lights: Sequence[Light]
    film_on: Callable[[int, Surface], FilmOn]
    is_blending: bool = True


def sent(
    scenery: Scenery, surface: Surface, plan: MaterialPlan, film: FilmOn, rng: np.random.Generator
) -> Float64:
    """Return emission, punctual and image light (n, 3) of a surface that nothing passes through."""
    light = emitted(surface, plan) + punctual_lighting(surface, scenery.lights, film, plan)
    return light + _image_light(scenery, surface, plan, film, rng, evaluate_lobes)


def unmirrored(
    scenery: Scenery, surface: Surface, plan: MaterialPlan, film: FilmOn, rng: np.random.Generator
) -> Float64:
    """Return the same of a transmitting surface, but image light on its diffuse base and fibres only.

    The rest of the image light is what its facets mirror and let through.
    """
    light = emitted(surface, plan) + punctual_lighting(surface, scenery.lights, film, plan)
    has_diffuse = bool(np.any((surface.transmission < 1.0) & (surface.metallic < 1.0)))
    if has_diffuse or plan.calls_for(Effect.SHEEN):
        light = light + _image_light(scenery, surface, plan, film, rng, _wide_lobes)
    return light


def _image_light(
    scenery: Scenery,
    surface: Surface,
    plan: MaterialPlan,
    film: FilmOn,
    rng: np.random.Generator,
    lobes: Lobes,
) -> Float64:
    if scenery.environment is None:
        return np.zeros_like(surface.base_color)
    estimates = estimate(
        surface, plan, scenery.environment, film, samples=_SAMPLES, rng=rng, copies=1, lobes=lobes
    )
    return np.asarray(estimates[0])


def _wide_lobes(surface: Surface, towards_light: Float64, film: FilmOn, plan: MaterialPlan) -> Float64:
    """Return f·|cosθ| without mirrors: f is linear in the transmission, and its slope is the diffuse part."""
    opaque, clear = (
        evaluate_lobes(_with_transmission(surface, share), towards_light, film, plan) for share in (0.0, 1.0)
    )
    wide = np.asarray((1.0 - surface.transmission)[:, None] * (opaque - clear))
    if not plan.calls_for(Effect.SHEEN):
        return wide
    fibres = fibre_lobe(surface, towards_light)
    if plan.calls_for(Effect.CLEARCOAT):
        fibres = (1.0 - clearcoat_reflectance(surface))[:, None] * fibres
    return np.asarray(wide + fibres)


def _with_transmission(surface: Surface, share: float) -> Surface:
    return replace(surface, transmission=np.full(len(surface.transmission), share))
