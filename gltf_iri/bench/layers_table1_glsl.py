"""Table 1 of Fourneau et al. 2024 in OpenGL: the twins' colours times the facets' weight, a call a pixel."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.bench.layers_rows import LayerRow, colour_errors
from gltf_iri.bench.layers_table1 import REFERENCE, TABLE, WAYS, RoughLayer, table1_name
from gltf_iri.colour.wavelength_grid import grid_rule
from gltf_iri.planning.settings import Settings
from gltf_iri.rendering.table_call import table_call
from gltf_iri.rendering.timed_calls import TimedCall, call_colours, time_calls
from gltf_iri.rendering.timing import twin_call
from gltf_iri.rendering.twins import MIRROR_TYPES, ResultType

if TYPE_CHECKING:
    import moderngl

__all__ = ["glsl_rows"]

# What the facets' weight takes beside the mirror's seven arguments.
_FACET_TYPES: tuple[ResultType, ...] = ("float",) * 4


def glsl_rows(context: moderngl.Context, layer: RoughLayer, rounds: int, side: int) -> Iterator[LayerRow]:
    """Yield a row for each way that OpenGL has, the reference first; times are those of the whole BRDF."""
    calls = [(name, chosen, _call(context, layer, name, chosen)) for name, chosen in WAYS]
    try:
        times = time_calls(
            context, [_with_facets(call, layer) for _, _, call in calls], rounds=rounds, side=side
        )
        for (name, chosen, call), ns in zip(calls, times.ns, strict=True):
            errors = colour_errors(call_colours(context, call, len(layer.truth)), layer.truth)
            workload = table1_name(layer.period_nm, layer.alpha)
            yield LayerRow(workload, name, times.renderer, ns, *errors, chosen)
    finally:
        for _, _, call in calls:
            for texture in call.textures.values():
                texture.release()


def _call(context: moderngl.Context, layer: RoughLayer, name: str, chosen: Settings) -> TimedCall:
    if name == TABLE:
        return table_call(context, layer.table, layer.facets.cos_h)
    if name == REFERENCE:
        call = twin_call("yeh-spectral", layer.mirror, WHITE)
        return replace(call, name=name, tables={"spectral_rule": _grid(int(chosen["samples"]))})
    return twin_call(name, layer.mirror, WHITE, chosen)


def _grid(samples: int) -> NDArray[np.float32]:
    """Return the table that the truth's twin sums over, filled with evenly spaced wavelengths."""
    rule = grid_rule(samples, WHITE)
    table = np.zeros((3, samples, 4), dtype=np.float32)
    wavenumber = 1.0 / rule.wavelength_nm
    table[0, :, 0] = wavenumber
    table[0, :, 1] = wavenumber - table[0, :, 0]
    table[1, :, :3] = rule.weights
    return table


def _with_facets(call: TimedCall, layer: RoughLayer) -> TimedCall:
    """Return the call times the facets' weight."""
    at = layer.facets
    first = len(MIRROR_TYPES)
    weight = f"facet_weight({', '.join(f'a{first + k}' for k in range(len(_FACET_TYPES)))})"
    return replace(
        call,
        lines=('#include "optics/rough_bragg.glsl"', *call.lines),
        expression=f"{weight} * {call.expression}",
        types=(*call.types, *_FACET_TYPES),
        arguments=(*call.arguments, at.n_cross_h_squared, at.cos_i, at.cos_o, np.asarray(layer.alpha)),
    )
