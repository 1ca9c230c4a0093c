"""What becomes of a path that meets a transmitting surface: mirrored, or let through and bent.

A facet is drawn as the path sees it, and chance decides between mirror and passage by their brightness; the
weights make the mean right. Where other facets stand in the way out (Smith's shadowing) the path meets one of
them next: without that, the roughest glass would swallow more than half of the light. The rules, beside those
of gltf_iri/reference/lobes.py:

- T = 1 − R of each channel, so that R + T = 1 at every facet.
- base_color and the transmission's share are paid on entering a body or passing a wall, not on leaving.
- From inside, R is that of the outside at the refracted angle: a lossless surface, film or none, reflects
  alike from both sides. Beyond the critical angle R = 1.
- Radiance is carried divided by n²; what it gains on entering a body it loses on leaving.
- The coat reflects on the outside only; every surface borders on air, also inside of another body.
- By their factor Bragg layers stand in place of all this but coat and fibres (`glass_layers.py`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.optics.layering import CLEARCOAT_F0, transmitted_share
from gltf_iri.optics.microfacet import alpha_ggx, anisotropic_alphas
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.facets import TO_OTHER_SIDE, Axes, draw_facet, mirrored, refracted, shadowing_ratio
from gltf_iri.reference.film_on import FilmOn
from gltf_iri.reference.glass_layers import LocalCrossing, cross_layers
from gltf_iri.reference.layers import clearcoat_reflectance, fibre_passage
from gltf_iri.reference.lobes import film_reflectances, layered_reflectances
from gltf_iri.reference.surface import Surface

__all__ = ["Crossing", "cross"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Facets in a row that a path may meet on one surface; of the roughest glass's light 1e-5 would meet more.
_FACETS: Final = 24


@dataclass(frozen=True, slots=True)
class Crossing:
    """Where n paths go on, and with what weight; a weight of 0 ends a path."""

    direction: Float64  # (n, 3), unit
    weight: Float64  # (n, 3)
    passes: Mask  # (n,), to the other side


def cross(
    surface: Surface,
    plan: MaterialPlan,
    film: FilmOn,
    ior: Float64,
    leaves: Mask,
    rng: np.random.Generator,
) -> Crossing:
    """Return where paths that meet `surface` along −V go on.

    Parameters
    ----------
    film : on the same surface.
    ior : (n,), of the body; not read for walls without volume.
    leaves : (n,), the viewer's side of the surface is inside of the body.
    """
    axes = Axes.around(surface.normal, surface.anisotropy_tangent)
    back = axes.to_viewer(surface.view)
    local = _cross_base(surface, plan, film, ior, leaves, back, rng)
    weight = local.weight
    if plan.calls_for(Effect.SHEEN):
        weight = weight * np.where(leaves, 1.0, fibre_passage(surface, surface.n_dot_v))[:, None]
    direction = local.direction * np.where(local.passes[:, None], TO_OTHER_SIDE, 1.0)
    crossing = Crossing(axes.to_world(direction), weight, local.passes)
    return _under_coat(crossing, surface, leaves, rng) if plan.calls_for(Effect.CLEARCOAT) else crossing


def _cross_base(
    surface: Surface,
    plan: MaterialPlan,
    film: FilmOn,
    ior: Float64,
    leaves: Mask,
    back: Float64,
    rng: np.random.Generator,
) -> LocalCrossing:
    """Let chance decide by their factor between Bragg layers and the base's own interface."""
    if plan.layers is None or film.layers is None:
        return _cross_interface(surface, plan, film, ior, leaves, back, rng)
    is_stack = rng.random(len(ior)) < surface.bragg_factor
    crossing = LocalCrossing(back.copy(), np.zeros((len(ior), 3)), np.zeros(len(ior), np.bool_))
    for rows, is_covered in ((np.flatnonzero(is_stack), True), (np.flatnonzero(~is_stack), False)):
        if not len(rows):
            continue
        here, inside, come = surface.take(rows), leaves[rows], back[rows]
        if is_covered:
            index = ior[rows] if plan.calls_for(Effect.VOLUME) else None
            some = cross_layers(here, plan.layers, film.layers, index, inside, come, rng)
        else:
            some = _cross_interface(here, plan, film.at(here), ior[rows], inside, come, rng)
        crossing.direction[rows], crossing.weight[rows] = some.direction, some.weight
        crossing.passes[rows] = some.passes
    return crossing


def _cross_interface(
    surface: Surface,
    plan: MaterialPlan,
    film: FilmOn,
    ior: Float64,
    leaves: Mask,
    back: Float64,
    rng: np.random.Generator,
) -> LocalCrossing:
    count = len(ior)
    # Along the axes of the side that a path is on, where +Z points away from the surface.
    back = back.copy()
    passes = np.zeros(count, np.bool_)
    weight = np.ones((count, 3))
    rows = np.arange(count)
    for met in range(_FACETS):
        step = _meet_facet(
            surface.take(rows), plan, film, ior[rows], leaves[rows] ^ passes[rows], back[rows], rng
        )
        weight[rows] *= step.weight
        passes[rows] ^= step.passes
        escape = step.escape if met == 0 else step.escape_unseen
        back[rows] = -step.direction
        rows = rows[(rng.random(len(rows)) >= escape) & (step.weight.max(axis=1) > 0.0)]
        if not len(rows):
            break
    weight[rows] = 0.0
    return LocalCrossing(-back, weight, passes)


@dataclass(frozen=True, slots=True)
class _Step:
    """From one facet on: direction along the axes of the side it goes to, and the chance to meet no other."""

    direction: Float64
    weight: Float64
    passes: Mask
    escape: Float64  # for a path whose first facet this is: it is known that the viewer sees it
    escape_unseen: Float64


def _meet_facet(
    surface: Surface,
    plan: MaterialPlan,
    film: FilmOn,
    ior: Float64,
    is_inside: Mask,
    back: Float64,
    rng: np.random.Generator,
) -> _Step:
    count = len(ior)
    widths = anisotropic_alphas(surface.alpha_roughness, surface.anisotropy_strength)
    facet = draw_facet(back, *widths, rng.random((count, 2)))
    cosine = np.clip(np.sum(back * facet, axis=1), 0.0, 1.0)
    reflection = mirrored(back, facet)
    is_thick = plan.calls_for(Effect.VOLUME)
    if is_thick:
        bent, squared = refracted(back, facet, np.where(is_inside, ior, 1.0 / ior))
        passage = bent * TO_OTHER_SIDE
        outside = np.where(is_inside, np.sqrt(np.clip(squared, 0.0, 1.0)), cosine)
        is_total = is_inside & (squared <= 0.0)
    else:
        # A thin wall's lobe is its mirror's, on the other side.
        passage, outside, is_total = reflection, cosine, np.zeros(count, np.bool_)
    sent_back, sent_on = _shares(surface, plan, film, outside, is_inside & is_thick)
    sent_back = np.where(is_total[:, None], 1.0, sent_back)
    sent_on = np.where(is_total[:, None], 0.0, sent_on)

    chance = _chance(sent_on, sent_back)
    passes = rng.random(count) < chance
    weight = np.where(passes[:, None], sent_on, sent_back)
    weight /= np.where(passes, chance, 1.0 - chance)[:, None]
    direction = np.where(passes[:, None], passage, reflection)
    rises = direction[:, 2] > 0.0
    alone = rises * shadowing_ratio(back, direction, *widths, is_mirrored=False)
    together = rises * shadowing_ratio(back, direction, *widths, is_mirrored=True)
    return _Step(direction, weight, passes, np.where(passes & is_thick, alone, together), alone)


def _shares(
    surface: Surface, plan: MaterialPlan, film: FilmOn, cos_theta: Float64, is_inside: Mask
) -> tuple[Float64, Float64]:
    """Return what facets mirror and what they let through, (n, 3) each, at the outside angle `cos_theta`."""
    c = cos_theta[:, None]
    found = layered_reflectances(
        surface,
        plan,
        (f_schlick(surface.dielectric_f0, c), f_schlick(surface.base_color, c)),
        film_reflectances(
            surface,
            plan,
            film.at(surface),
            cos_theta,
            np.ones(len(cos_theta), np.bool_),
        ),
    )
    m, inside = surface.metallic[:, None], is_inside[:, None]
    glass = found.dielectric.specular
    sent_back = np.where(inside, glass, (1.0 - m) * glass + m * found.metal)
    entry = np.where(inside, 1.0, (1.0 - m) * surface.transmission[:, None] * surface.base_color)
    # A film's text may reflect less than nothing or more than all.
    return np.clip(sent_back, 0.0, 1.0), np.asarray(entry * transmitted_share(np.maximum(glass, 0.0)))


def _under_coat(below: Crossing, surface: Surface, leaves: Mask, rng: np.random.Generator) -> Crossing:
    """Let chance decide between the coat's mirror and what lies below it."""
    count = len(leaves)
    axes = Axes.around(surface.clearcoat_normal)
    view = axes.to_viewer(surface.view)
    alpha = alpha_ggx(surface.clearcoat_roughness)
    facet = draw_facet(view, alpha, alpha, rng.random((count, 2)))
    reflection = mirrored(view, facet)
    share = np.where(leaves, 0.0, clearcoat_reflectance(surface))
    chance = np.where(share > 0.0, np.clip(share, 0.05, 0.95), 0.0)
    is_coat = rng.random(count) < chance
    fresnel = f_schlick(CLEARCOAT_F0, np.clip(np.sum(view * facet, axis=1), 0.0, 1.0))
    shadowing = shadowing_ratio(view, reflection, alpha, alpha, is_mirrored=True) * (reflection[:, 2] > 0.0)
    # Where the coat cannot be chosen, any divisor will do.
    own = surface.clearcoat * fresnel * shadowing / np.where(chance > 0.0, chance, 1.0)
    weight = np.where(
        is_coat[:, None], own[:, None], below.weight * ((1.0 - share) / (1.0 - chance))[:, None]
    )
    direction = np.where(is_coat[:, None], axes.to_world(reflection), below.direction)
    return Crossing(direction, weight, below.passes & ~is_coat)


def _chance(chosen: Float64, other: Float64) -> Float64:
    """Return the chance (n,) of the first of two weights (n, 3), by their sums over the channels.

    Never quite 0 or 1 where both are possible: a rare choice would weigh too much.
    """
    one, two = chosen.sum(axis=1), other.sum(axis=1)
    total = one + two
    share = np.where(total > 0.0, one / np.where(total > 0.0, total, 1.0), 0.5)
    return np.where((one > 0.0) & (two > 0.0), np.clip(share, 0.05, 0.95), share)
