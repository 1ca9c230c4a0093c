"""The stack of a plan's Bragg layers, at values of the texture that their periods run along."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack
from gltf_iri.planning.layer_plan import LayersPlan, PlannedLayer

__all__ = ["period_nm", "planned_stack"]

Float64 = NDArray[np.float64]


def period_nm(plan: LayersPlan, layer: PlannedLayer, texel: ArrayLike) -> Float64:
    """Return the period of `layer` where the texture is `texel`; beyond the plan's ends it is that there."""
    low, high = layer.period_nm
    span = plan.texel.high - plan.texel.low
    value = np.asarray(texel, np.float64)
    share = np.clip((value - plan.texel.low) / span, 0.0, 1.0) if span > 0.0 else np.zeros_like(value)
    return np.asarray(low * (1.0 - share) + high * share)


def planned_stack(plan: LayersPlan, texel: ArrayLike = 1.0, base: LayerBase | None = None) -> LayerStack:
    """Return the layers of `plan` where the texture of periods is `texel` (...); `base` is black where None.

    Raises UsageError as `LayerStack.of`.
    """
    layers = []
    for layer in plan.layers:
        nm = period_nm(plan, layer, texel)
        d1, d2 = layer.fill * nm, (1.0 - layer.fill) * nm
        layers.append(BraggLayer.of(layer.n1, layer.n2, d1, d2, layer.cells, layer.alpha))
    return LayerStack.of(tuple(layers), plan.host_ior, base)
