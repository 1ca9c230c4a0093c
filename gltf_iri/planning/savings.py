"""What it saves to leave an effect out, in nanoseconds a pixel, by the map of costs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from gltf_iri.planning.costs import Costs
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.method import DEFAULT_METHOD, find_method, method_names
from gltf_iri.planning.reach import Lobe
from gltf_iri.planning.way import ONE_CHANNEL, Way

__all__ = ["pruned_defines", "saved_ns_per_pixel"]

# What the map calls one sample of a texture.
_TEXTURE: Final = "texture"

# The effect that brings each lobe, and the set of films whose cost stands for the film over it.
_LOBES: Final[Mapping[Lobe, tuple[Effect, str]]] = {
    "dielectric": (Effect.DIELECTRIC, "films"),
    "metal": (Effect.METAL, "metals"),
}


def saved_ns_per_pixel(
    plan: MaterialPlan, lights: int, costs: Costs, *, method: str | None = None
) -> dict[str, float]:
    """Return the nanoseconds a pixel that each effect would cost which the file mentions and the plan skips.

    Only what the map knows is named: a texture for each that is not sampled, the film for each lobe and light
    that does without, and what one channel in place of three saves, as "grey-dielectric" and "grey-metal".

    lights : that the film would be evaluated for, image light among them.
    method : of a film that is left out; None for the plan's default.
    """
    return dict(_savings(plan, lights, costs, _drawn_as(plan, method)))


def pruned_defines(plans: Sequence[MaterialPlan], seen: Sequence[str]) -> tuple[str, ...]:
    """Return the defines of what the file mentions and a shader with the defines `seen` does without.

    plans : of the materials that are drawn with it.
    """
    pruned = {
        effect for plan in plans for effect in (*plan.skipped, *plan.effects) if effect not in plan.absent
    }
    return tuple(effect.define for effect in Effect if effect in pruned and effect.define not in seen)


def _drawn_as(plan: MaterialPlan, method: str | None) -> Way:
    """Return the way by which the film is drawn, or would be."""
    if plan.way is not None and plan.way.method is not None:
        return plan.way
    asked = method if method in method_names("film") else None  # one for layers says nothing of films
    found = find_method(plan.method or asked or DEFAULT_METHOD, "film")
    return Way(found.name, {parameter.name: parameter.default for parameter in found.parameters})


def _savings(plan: MaterialPlan, lights: int, costs: Costs, way: Way) -> Iterator[tuple[str, float]]:
    def film_ns(workload: str) -> float | None:
        ns = costs.ns_per_colour("glsl", workload, way.label)
        return None if ns is None else lights * ns

    texture_ns = costs.ns_per_colour("glsl", "films", _TEXTURE)
    workload_of = dict(_LOBES.values())
    for effect in plan.skipped:
        ns: float | None = None
        if effect in plan.absent:
            continue
        if effect.value.endswith("-texture"):
            ns = texture_ns
        elif effect is Effect.IRIDESCENCE:
            each = [film_ns(workload) for lobe, workload in _LOBES.values() if plan.calls_for(lobe)]
            ns = None if None in each else sum(cost for cost in each if cost is not None)
        elif effect in workload_of and plan.calls_for(Effect.IRIDESCENCE):
            ns = film_ns(workload_of[effect])
        if ns:
            yield effect.value, ns
    for lobe in sorted(plan.grey):
        three, one = (
            costs.ns_per_colour("glsl", "films", way.label + channels) for channels in ("", ONE_CHANNEL)
        )
        if three is not None and one is not None and plan.table(lobe) is None:
            yield f"grey-{lobe}", lights * max(three - one, 0.0)
