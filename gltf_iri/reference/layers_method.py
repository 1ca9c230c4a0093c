"""By which method the colours of a material's Bragg layers are had, at many points."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, cast

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers, given_tables
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.method import find_method
from gltf_iri.reference.layer_truth import TabulatedLayers
from gltf_iri.reference.layers_direct import DirectLayers
from gltf_iri.reference.layers_on import LayersMethod

__all__ = ["LAYERS_TRUTH", "check_layers", "layers_method"]

Float64 = NDArray[np.float64]

LAYERS_TRUTH: Final = "layers-single"


def check_layers(
    plan: MaterialPlan, method: str | None, layer_tables: Mapping[int, BakedLayers], white: str
) -> BakedLayers | None:
    """Return the tables that `layers_method` reads; None where it needs none.

    Raises UsageError for an unknown method, and where the plan's own method has tables that are not there.
    """
    if method is not None:
        find_method(method, "layers")
        return None
    if plan.layers is None or plan.layers.tables is None:
        return None
    return given_tables(plan, layer_tables, white)


def layers_method(
    plan: MaterialPlan, method: str | None, layer_tables: Mapping[int, BakedLayers], white: str
) -> LayersMethod | None:
    """Return what gives the colours of the layers of `plan`; None where it has none.

    method : its name; None for the plan's own, from its tables where it has some.
    Raises what `check_layers` does.
    """
    layers = plan.layers
    if layers is None:
        return None
    baked = check_layers(plan, method, layer_tables, white)
    if baked is not None:
        tables = baked
        return lambda texel: LayerLookup(tables, texel)
    name = method or layers.method
    if name == LAYERS_TRUTH:
        # The truth takes milliseconds; a picture asks for millions of directions.
        truth = TabulatedLayers(layers, cast(White, white))
        return truth if method is not None else lambda texel: DirectLayers(layers, truth(texel))
    parameters = layers.parameters if name == layers.method else {}

    def direct(texel: Float64) -> DirectLayers:
        stack = planned_stack(layers, texel if layers.varies else layers.texel.low)
        return DirectLayers(layers, layer_colours(name, stack, white=white, parameters=parameters))

    return direct
