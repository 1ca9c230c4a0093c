"""Layers on the map of cost and error in OpenGL: twins of methods, and tables as surfaces read them.

A call asks for the three colours of a pose, as a light on a surface does; a colour costs a third of it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.bench.accuracy_glsl import release_textures
from gltf_iri.bench.accuracy_layers import COLOURS_A_POSE, LayerSubject, StackTables
from gltf_iri.bench.accuracy_row import AccuracyRow, errors_of
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.evaluation.layers import BraggLayer, LayerStack
from gltf_iri.optics.layer_stack import Sight
from gltf_iri.planning.method import METHODS, method_names
from gltf_iri.planning.settings import with_defaults
from gltf_iri.planning.way import Way
from gltf_iri.rendering.layer_call import layer_table_call, layer_twin_call
from gltf_iri.rendering.timed_calls import TimedCall, call_colours, time_calls

if TYPE_CHECKING:
    import moderngl

__all__ = ["layer_glsl_rows"]

Float64 = NDArray[np.float64]
Make = Callable[[Sequence[int]], TimedCall]

_ROUNDS: Final = 9
# A side of the target: twins sum over angles and wavelengths, some 0.2 ms a colour in software.
_TWIN_SIDE: Final = 16
_TABLE_SIDE: Final = 256

_EVERY: Final = tuple(range(COLOURS_A_POSE))


def layer_glsl_rows(
    context: moderngl.Context,
    workload: str,
    subject: LayerSubject,
    truth: Float64,
    tables: Sequence[StackTables],
    limit_s: float,
    rounds: int | None = None,
) -> list[AccuracyRow]:
    """Return a row for each twin with its defaults, and for each of `tables`, timed in turn.

    Other settings than the defaults loop further than software renderers bear (rendering/layer_loops.py).
    truth : the true colours of `subject`. limit_s : about how long the timing lasts where `rounds` is None.
    """
    rows = _timed(context, list(_twins(context, workload, subject, truth)), _TWIN_SIDE, limit_s, rounds)
    found = list(_tables(context, workload, subject, truth, tables))
    return rows + _timed(context, found, _TABLE_SIDE, limit_s, rounds)


def _twins(
    context: moderngl.Context, workload: str, subject: LayerSubject, truth: Float64
) -> Iterator[tuple[TimedCall, AccuracyRow]]:
    rows, sight = _rows_of(subject)
    for name in method_names("layers"):
        if METHODS[name].glsl_function is None:
            continue
        values = with_defaults(name, {})

        def make(wanted: Sequence[int], name: str = name) -> TimedCall:
            return layer_twin_call(name, rows, sight, wanted, white=WHITE)

        colours = _colours(context, make, len(sight.cos_h))
        # Stack by stack, as the truth is: (3, stacks, poses) → (stacks, 3, poses)
        by_stack = colours.reshape(COLOURS_A_POSE, len(subject.stacks), -1, 3).swapaxes(0, 1)
        errors, way = errors_of(by_stack.reshape(-1, 3), truth), Way(name, values).label
        yield make(_EVERY), AccuracyRow(workload, "glsl", way, way, name, 0.0, errors, values)


def _tables(
    context: moderngl.Context,
    workload: str,
    subject: LayerSubject,
    truth: Float64,
    tables: Sequence[StackTables],
) -> Iterator[tuple[TimedCall, AccuracyRow]]:
    for each in tables:
        colours = []
        for baked, sight in zip(each.baked, subject.sights, strict=True):

            def make(wanted: Sequence[int], baked: BakedLayers = baked, sight: Sight = sight) -> TimedCall:
                return layer_table_call(context, baked, sight, wanted)

            colours.append(_colours(context, make, len(sight.cos_h)))
        errors = errors_of(np.concatenate(colours), truth)
        _, everywhere = _rows_of(subject)
        yield (
            layer_table_call(context, each.baked[0], everywhere, _EVERY),
            AccuracyRow(
                workload, "glsl", each.label, each.way, None, 0.0, errors, filling_ns=each.filling_ns
            ),
        )


def _colours(context: moderngl.Context, make: Make, poses: int) -> NDArray[np.float32]:
    """Return (3 · poses, 3), each colour by a call of its own."""
    found = []
    for number in _EVERY:
        call = make((number,))
        try:
            found.append(call_colours(context, call, poses))
        finally:
            release_textures(call)
    return np.concatenate(found)


def _timed(
    context: moderngl.Context,
    calls: Sequence[tuple[TimedCall, AccuracyRow]],
    side: int,
    limit_s: float,
    rounds: int | None,
) -> list[AccuracyRow]:
    try:
        times = time_calls(
            context,
            [call for call, _ in calls],
            rounds=rounds or _ROUNDS,
            side=side,
            limit_s=limit_s if rounds is None else math.inf,
        )
    finally:
        for call, _ in calls:
            release_textures(call)
    return [
        replace(row, ns_per_eval=max(ns, 0.01) / COLOURS_A_POSE, ns_per_pixel=ns + times.baseline_ns)
        for (_, row), ns in zip(calls, times.ns, strict=True)
    ]


def _rows_of(subject: LayerSubject) -> tuple[LayerStack, Sight]:
    """Return all stacks as one of rows (stacks · poses,), and how each is seen."""
    poses = len(subject.sights[0].cos_h)

    def column(*values: NDArray[Any]) -> NDArray[Any]:
        return np.repeat(np.array(values), poses)

    layers = tuple(
        BraggLayer.of(
            *(column(*(getattr(layer, each.name) for layer in of_stacks)) for each in fields(BraggLayer))
        )
        for of_stacks in zip(*(stack.layers for stack in subject.stacks), strict=True)
    )
    host = column(*(stack.host_ior for stack in subject.stacks))
    seen = (np.concatenate([getattr(s, each.name) for s in subject.sights]) for each in fields(Sight))
    return LayerStack.of(layers, host), Sight(*seen)
