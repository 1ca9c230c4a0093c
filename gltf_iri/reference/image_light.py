"""Image light on a surface by Monte-Carlo: ∫ L f |cos θ| dω over the front, unoccluded, for the whole of f.

The rasteriser splits this integral into a prefiltered map and tables; here light, facets and Fresnel stay
together, direction by direction. Directions are drawn by the environment's brightness, by the facets of base,
coat and layers, and by the cosine (`techniques.py`); each weighs as the balance heuristic says (Veach &
Guibas 1995, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", §3.3):
L f |cos θ| / Σ count·density.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.film_on import FilmOn
from gltf_iri.reference.lobes import evaluate_lobes
from gltf_iri.reference.low_discrepancy import net, shifted, standard_error
from gltf_iri.reference.surface import Surface
from gltf_iri.reference.techniques import count_techniques, techniques

__all__ = ["Lobes", "estimate", "reflected"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]
Lobes = Callable[[Surface, Float64, FilmOn, MaterialPlan], Float64]

# Independent estimates whose spread tells the error: seven degrees of freedom.
_COPIES: Final = 8

# Directions at once: some 200 MB of arrays.
_CHUNK: Final = 1 << 17


def reflected(
    surface: Surface,
    plan: MaterialPlan,
    environment: EnvironmentMap,
    film: FilmOn,
    *,
    samples: int,
    rng: np.random.Generator,
) -> tuple[Float64, Float64]:
    """Return what the surface sends on of the environment, (n, 3), occlusion included, and standard errors.

    Parameters
    ----------
    film : on the same surface.
    samples : directions a point, rounded up so that each way of drawing them gets 8 nets of 2ᵏ points.
    """
    estimates = estimate(surface, plan, environment, film, samples=samples, rng=rng, copies=_COPIES)
    return standard_error(estimates)


def estimate(
    surface: Surface,
    plan: MaterialPlan,
    environment: EnvironmentMap,
    film: FilmOn,
    *,
    samples: int,
    rng: np.random.Generator,
    copies: int,
    lobes: Lobes = evaluate_lobes,
) -> Float64:
    """Return `copies` independent estimates of `reflected`'s integral, (copies, n, 3), `samples` in all.

    lobes : f |cos θ| in the integral, called as `evaluate_lobes` is.
    """
    count = len(surface.position)
    estimates = np.zeros((copies, count, 3))
    if plan.calls_for(Effect.UNLIT) or not count:
        return estimates
    ways = count_techniques(plan)
    points = net(_power_of_two(samples / (copies * ways)))
    step = max(_CHUNK // (len(points) * ways), 1)
    for start in range(0, count, step):
        rows = np.arange(start, min(start + step, count))
        here = surface.take(rows)
        for copy in range(copies):
            sent = _sent(here, plan, environment, film, points, rng, lobes)
            estimates[copy, rows] = here.occlusion[:, None] * sent
    return estimates


def _sent(
    surface: Surface,
    plan: MaterialPlan,
    environment: EnvironmentMap,
    film: FilmOn,
    points: NDArray[np.uint32],
    rng: np.random.Generator,
    lobes: Lobes,
) -> Float64:
    """Return one estimate (n, 3), each technique drawing one net of `points` (k, 2) a surface point."""
    count, per_point = len(surface.position), len(points)
    rows = np.repeat(np.arange(count), per_point)
    repeated = surface.take(rows)
    ways = list(techniques(repeated, plan, environment))
    total = np.zeros((count, 3))
    for technique in ways:
        place = shifted(points, rng, count).reshape(-1, 2)
        direction = technique.sample(place)
        density = per_point * np.sum([each.density(direction) for each in ways], axis=0)
        is_lit = (np.sum(repeated.normal * direction, axis=1) > 0.0) & (density > 0.0)
        if plan.calls_for(Effect.CLEARCOAT):
            is_lit |= np.sum(repeated.clearcoat_normal * direction, axis=1) > 0.0
        lit = np.flatnonzero(is_lit)
        here = repeated.take(lit)
        towards_light = direction[lit]
        f = lobes(here, towards_light, film.at(here), plan)
        value = f * environment.radiance(towards_light) / density[lit, None]
        for channel in range(3):
            total[:, channel] += np.bincount(rows[lit], value[:, channel], count)
    return total


def _power_of_two(number: float) -> int:
    """Return the least power of two that is at least `number`, and at least 1."""
    return 1 << max(int(np.ceil(np.log2(max(number, 1.0)))), 0)
