"""The methods for layered mirrors by name, as what computes the colours of one stack.

`gltf_iri.evaluation.registry` evaluates the same methods at poses; a test holds both sets equal.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from gltf_iri.colour.spaces import WHITES, Light
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layers import LayerColours, LayerStack
from gltf_iri.evaluation.layers_bands import LayersBands
from gltf_iri.evaluation.layers_rgb import LayersRgb
from gltf_iri.evaluation.layers_single import LayersSingle
from gltf_iri.evaluation.layers_single_table import LayersSingleTable
from gltf_iri.evaluation.parameters import checked_parameters
from gltf_iri.planning.method import ParameterValue, find_method

__all__ = ["LAYER_COLOURS", "layer_colours"]

# made(stack, white, **parameters)
LAYER_COLOURS: Mapping[str, Callable[..., LayerColours]] = MappingProxyType(
    {
        "layers-single": LayersSingle,
        "layers-single-table": LayersSingleTable,
        "layers-rgb": LayersRgb,
        "layers-bands": LayersBands,
    }
)


def layer_colours(
    method: str,
    stack: LayerStack,
    *,
    white: str | Light = "D65",
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
) -> LayerColours:
    """Return what computes the colours of `stack`'s layers by the method called `method`.

    Raises UsageError where the method, the white or a parameter is unknown, and for stacks of arrays where
    the method tabulates one stack.
    """
    descriptor = find_method(method, "layers")
    if not isinstance(white, Light) and white not in WHITES:
        raise UsageError(f"There is no white '{white}'; choose one of: {', '.join(WHITES)}.")
    return LAYER_COLOURS[method](stack, white, **checked_parameters(descriptor, parameters))
