"""The cheapest method for the colours of a stack of Bragg layers that keeps a budget, in Python.

Its errors are measured at random poses, cosines uniform, against `layers-single`: of each layer's reflection
through those above, and over a base of what passes all; what is stated is the greatest of these.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.budgets.candidates import Candidate, direct_candidates
from gltf_iri.budgets.errors import Measured
from gltf_iri.budgets.search import Chosen, cheapest_way, check_budget, the_truth
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.quantile import bounds
from gltf_iri.colour.spaces import Light
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import LayerColours, LayerStack
from gltf_iri.evaluation.stack_evaluation import StackEvaluation, evaluate_stack
from gltf_iri.optics.layer_stack import Sight, sight_of
from gltf_iri.planning.costs import Device, shipped_costs
from gltf_iri.planning.method import METHODS, truth_of

__all__ = ["evaluate_stack_within", "way_for_stack"]

Float64 = NDArray[np.float64]

_WORKLOAD: Final = "layers"  # of the map of costs, and the methods' domain
# How many poses are looked at; all only while it is open whether the budget is kept.
_LOOKS: Final = (24, 256)
_SEED: Final = 7


def way_for_stack(
    stack: LayerStack, budget: float, *, device: Device = "numpy", white: str | Light = "D65"
) -> Chosen:
    """Return the cheapest method for the colours of `stack` whose p95 of ΔE keeps `budget`, and why.

    Stacks of arrays are looked at at as many poses together. Raises UsageError for a budget below 0 or NaN,
    where none keeps it, and where the map of costs knows no method for layers.
    """
    candidates = direct_candidates("layers", device, [_WORKLOAD])
    if not candidates:
        known = ", ".join(shipped_costs().ns.get(device, {}))
        raise UsageError(f"The map of costs knows no methods for layers, only {known}: name a method.")
    if check_budget(budget) == 0.0:
        return the_truth(candidates)
    seen: dict[int, tuple[Sight, list[Float64]]] = {}
    shape = np.broadcast_shapes(stack.host_ior.shape, *(layer.shape for layer in stack.layers))
    g = np.random.default_rng(_SEED)

    def look(poses: int) -> tuple[Sight, list[Float64]]:
        if poses not in seen:
            cos_i, cos_o, turn = g.uniform(size=(3, math.ceil(poses / max(math.prod(shape), 1)), *shape))
            sight = sight_of(stack.host_ior, cos_i, cos_o, np.cos(np.pi * turn))
            seen[poses] = sight, _terms(layer_colours(truth_of(_WORKLOAD), stack, white=white), stack, sight)
        return seen[poses]

    def measure(candidate: Candidate, allowed: float) -> Measured:
        method = str(candidate.method)
        if METHODS[method].is_truth:
            return Measured(0.0, True)
        below = math.inf
        for poses in _LOOKS:
            sight, truth = look(poses)
            try:
                colours = layer_colours(method, stack, white=white, parameters=candidate.parameters)
                found = _terms(colours, stack, sight)
            except UsageError:  # one that tabulates a single stack, or knows no total reflection
                return Measured(math.inf, False)
            errors = [delta_e_2000(a, b).reshape(-1) for a, b in zip(found, truth, strict=True)]
            above, below = (max((bounds(each)[end] for each in errors), default=0.0) for end in (0, 1))
            # What surely errs by more already needs no closer look.
            if above > allowed:
                break
        return Measured(below, below <= allowed and poses == _LOOKS[-1])

    return cheapest_way(candidates, measure, budget, 1.0, subject="these layers")


def evaluate_stack_within(
    stack: LayerStack,
    cos_theta: ArrayLike,
    budget: float,
    light: Sequence[ArrayLike] | None = None,
    *,
    white: str | Light = "D65",
    backend: str = "auto",
) -> StackEvaluation:
    """Evaluate `stack` as `evaluate_stack` does, by the cheapest method that keeps `budget`.

    `.delta_e` is its bound and `.ns_per_colour` its price. Raises UsageError as both.
    """
    way = way_for_stack(stack, budget, white=white).way
    done = evaluate_stack(
        str(way.method), stack, cos_theta, light, white=white, backend=backend, parameters=way.parameters
    )
    return replace(done, delta_e=way.delta_e, ns_per_colour=way.ns_per_colour)


def _terms(colours: LayerColours, stack: LayerStack, sight: Sight) -> list[Float64]:
    """Return each layer's colours, and over a base that of what passes all."""
    cosines = sight.cos_h, sight.cos_i, sight.cos_o
    terms = [colours.reflected(number, *cosines) for number in range(len(stack.layers))]
    if not stack.base.is_black:
        terms.append(colours.passed(sight.cos_i, sight.cos_o))
    return [np.asarray(each) for each in terms]
