"""What becomes of a path that meets Bragg layers over a base that lets light through.

The stack stands in place of the base's interface. A path from outside is mirrored (`layer_mirrors.py`), or it
goes on through the layers into the base; chance decides by their brightness, and the weights make the mean
right. The rules, beside those of gltf_iri/reference/glass_surface.py:

- Going through weighs T_c · `entering` at the path's own angle outside, and (1 − metallic) · transmission ·
  base_color. The base's facets then bend the path as those of glass do, and mirror nothing; where others
  stand in the way out, another one is met in its place.
- A path that leaves a body meets the base's facets first, which mirror it totally beyond their critical
  angle. What they would let out at an angle o meets the layers as if it came from outside at o: it leaves
  with T_c · `entering`, or layers and host mirror it back inside as they would on the outside. No more comes
  of light than there was; of one smooth layer in air that is all of it, as physics has it. What would be
  reflected more than once among several counts as absorbed, from either side.
- Anisotropy belongs to the surface that the layers replace.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.reference.facets import TO_OTHER_SIDE, draw_facet, mirrored, refracted, shadowing_ratio
from gltf_iri.reference.host_directions import in_host
from gltf_iri.reference.layer_mirrors import LayerMirrors
from gltf_iri.reference.layers_on import LayersMethod, let_through
from gltf_iri.reference.surface import Surface

__all__ = ["LocalCrossing", "cross_layers"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Facets of the base that a path is drawn anew; of the roughest 1e-4 of the light would need more.
_FACETS: Final = 24

# A way that is rarely chosen would weigh too much.
_CHANCE_MIN: Final = 0.05

_TURNED: Final = np.array([-1.0, -1.0, 1.0])


@dataclass(frozen=True, slots=True)
class LocalCrossing:
    """Where n paths go on, along axes of which +Z points away from the surface, on the side they go to."""

    direction: Float64  # (n, 3), unit
    weight: Float64  # (n, 3); 0 ends a path
    passes: Mask  # (n,), to the other side


def cross_layers(
    surface: Surface,
    plan: LayersPlan,
    method: LayersMethod,
    ior: Float64 | None,
    leaves: Mask,
    back: Float64,
    rng: np.random.Generator,
) -> LocalCrossing:
    """Return where paths that meet the layers on `surface` go on.

    Parameters
    ----------
    ior : (n,), of the body; None for walls without volume.
    leaves : (n,), the paths' side of the surface is inside of the body.
    back : (n, 3), unit, where paths come from, along axes of which +Z points to their side of the surface.
    """
    bent = _through_base(surface.alpha_roughness, ior, leaves, back, rng)
    # What would leave along `bent` meets the layers as what comes from its mirror image outside does; neither
    # metal nor the base's colour lies on that way.
    outside = replace(surface, metallic=np.where(leaves, 0.0, surface.metallic))
    view = np.where(leaves[:, None], bent.direction * _TURNED, back)
    mirrors, colours = LayerMirrors(outside, plan, method, view), method(surface.bragg_period_texel)
    share = np.where(leaves[:, None], 1.0, surface.passing_share)
    passage = share * let_through(colours, plan.host_ior, view[:, 2])

    brightness = np.vstack([mirrors.brightness(colours), np.abs(passage).sum(axis=1)])
    there = np.vstack([mirrors.is_there(), np.any(passage != 0.0, axis=1)])
    chosen, chance = _choose(brightness, there, rng)
    place = rng.random((len(back), 2))
    direction, weight = bent.direction.copy(), passage.copy()
    for number in range(mirrors.count):
        rows = np.flatnonzero(chosen == number)
        if len(rows):
            direction[rows], weight[rows] = mirrors.sent(number, rows, place[rows])
    weight /= chance[:, None]
    passes = (chosen == mirrors.count) & ~bent.is_total
    if ior is not None:
        back_in = np.flatnonzero(leaves & ~passes)
        # Snell's law: the angles inside of what is mirrored at those outside.
        direction[back_in] = in_host(direction[back_in], ior[back_in, None])
    direction[bent.is_total], weight[bent.is_total] = bent.direction[bent.is_total], 1.0
    weight[(passes | leaves) & bent.is_lost] = 0.0
    return LocalCrossing(direction, weight, passes)


def _choose(
    brightness: Float64, is_there: Mask, rng: np.random.Generator
) -> tuple[NDArray[np.int64], Float64]:
    """Return which (n,) of the ways (k, n) are chosen, and with what chance (n,)."""
    total = brightness.sum(axis=0)
    share = np.divide(brightness, total, out=np.zeros_like(brightness), where=total > 0.0)
    chance = np.where(is_there, np.maximum(share, _CHANCE_MIN), 0.0)
    chance /= chance.sum(axis=0)
    chosen = np.sum(rng.random(len(total)) >= np.cumsum(chance, axis=0)[:-1], axis=0)
    found = np.take_along_axis(chance, chosen[None], axis=0)[0]
    # Rounding may choose what is not there: it weighs nothing, by any divisor.
    return chosen, np.where(found > 0.0, found, 1.0)


@dataclass(frozen=True, slots=True)
class _Bent:
    """Past the base's facets, as `LocalCrossing` has it; where they mirror all, on the path's own side."""

    direction: Float64
    is_total: Mask
    is_lost: Mask  # other facets stood in the way of all that were drawn


def _through_base(
    alpha: Float64, ior: Float64 | None, leaves: Mask, back: Float64, rng: np.random.Generator
) -> _Bent:
    """Return where the base's facets of width `alpha` (n,), which mirror nothing but totally, send paths."""
    direction, is_total = back.copy(), np.zeros(len(back), np.bool_)
    rows = np.arange(len(back))
    for _ in range(_FACETS):
        here, width = back[rows], alpha[rows]
        facet = draw_facet(here, width, width, rng.random((len(rows), 2)))
        # A thin wall's lobe is its mirror's, on the other side.
        onward, total = mirrored(here, facet), np.zeros(len(rows), np.bool_)
        escape = shadowing_ratio(here, onward, width, width, is_mirrored=True)
        if ior is not None:
            bent, squared = refracted(here, facet, np.where(leaves[rows], ior[rows], 1.0 / ior[rows]))
            total = leaves[rows] & (squared <= 0.0)
            onward = np.where(total[:, None], onward, bent * TO_OTHER_SIDE)
            alone = shadowing_ratio(here, onward, width, width, is_mirrored=False)
            escape = np.where(total, escape, alone)
        is_free = (onward[:, 2] > 0.0) & (rng.random(len(rows)) < escape)
        direction[rows[is_free]], is_total[rows[is_free]] = onward[is_free], total[is_free]
        rows = rows[~is_free]
        if not len(rows):
            break
    is_lost = np.zeros(len(back), np.bool_)
    is_lost[rows] = True
    return _Bent(direction, is_total, is_lost)
