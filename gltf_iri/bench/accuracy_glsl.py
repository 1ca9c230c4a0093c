"""The map of cost and error in OpenGL: the methods' twins, and tables as surfaces look them up."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked import BakedTable
from gltf_iri.bench.accuracy_row import AccuracyRow, errors_of
from gltf_iri.bench.accuracy_tables import Tables
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.bench.film_parts import film_of
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.planning.method import METHODS, Domain, method_names
from gltf_iri.planning.settings import ACCURACY_SETTINGS, settings_of, with_defaults
from gltf_iri.planning.way import AVERAGED, ONE_CHANNEL, Way
from gltf_iri.rendering.probe import Probe
from gltf_iri.rendering.table_call import table_call, texture_call
from gltf_iri.rendering.timed_calls import TimedCall, call_colours, time_calls
from gltf_iri.rendering.timing import averaging_call, one_channel_call, twin_call

if TYPE_CHECKING:
    import moderngl

__all__ = ["TEXTURE", "glsl_rows", "release_textures"]

# The row of one filtered sample of a material's texture: what leaving one out saves.
TEXTURE: Final = "texture"

_ROUNDS: Final = 9
_SIDE: Final = 256

# A thickness that varies by a twentieth within a pixel.
_SPREAD_SHARE: Final = 0.05

# What differs from the baseline by less than the clock tells; a price of nothing has no place on a plot.
_LEAST_NS: Final = 0.01


def glsl_rows(
    context: moderngl.Context,
    workload: str,
    subject: Film | Mirror,
    truth: NDArray[np.float64],
    tables: Sequence[Tables],
    limit_s: float,
    rounds: int | None = None,
) -> list[AccuracyRow]:
    """Return a row for each twin with all its settings, and for each of `tables`, timed in turn.

    truth : the true colours (n, 3) of `subject`.
    limit_s : about how long the timing lasts where `rounds` is None.
    """
    calls: list[TimedCall] = []
    rows: list[AccuracyRow] = []
    try:
        for call, row in _twins(context, workload, subject, truth):
            calls.append(call)
            rows.append(row)
        for each in filter(lambda each: each.baked, tables):
            at = np.concatenate(each.points) if isinstance(subject, Mirror) else film_of(each.points)
            calls.append(table_call(context, each.baked[0], at))
            rows.append(_table_row(context, workload, each))
        calls.append(texture_call(context, calls[0]))
        rows.append(AccuracyRow(workload, "glsl", TEXTURE, TEXTURE, None, 0.0, None))
        limit_s = limit_s if rounds is None else math.inf
        times = time_calls(context, calls, rounds=rounds or _ROUNDS, side=_SIDE, limit_s=limit_s)
    finally:
        for call in calls:
            release_textures(call)
    return [
        replace(row, ns_per_eval=max(ns, _LEAST_NS), ns_per_pixel=ns + times.baseline_ns)
        for row, ns in zip(rows, times.ns, strict=True)
    ]


def _twins(
    context: moderngl.Context, workload: str, subject: Film | Mirror, truth: NDArray[np.float64]
) -> Iterator[tuple[TimedCall, AccuracyRow]]:
    probe = Probe(context)
    domain: Domain = "mirror" if isinstance(subject, Mirror) else "film"
    for name in method_names(domain):
        for chosen in settings_of(name, ACCURACY_SETTINGS) if METHODS[name].glsl_function else ():
            values = with_defaults(name, chosen)
            way = Way(name, values).label
            rgb = probe.evaluate(name, subject, white=WHITE, parameters=values).rgb
            row = AccuracyRow(workload, "glsl", way, way, name, 0.0, errors_of(rgb, truth), values)
            yield twin_call(name, subject, WHITE, values), row
            if METHODS[name].glsl_spread_function is not None and isinstance(subject, Film):
                averaged = way + AVERAGED
                call = averaging_call(name, subject, _SPREAD_SHARE, WHITE, values)
                yield call, AccuracyRow(workload, "glsl", averaged, averaged, name, 0.0, None, values)
            if not chosen and isinstance(subject, Film):
                grey = way + ONE_CHANNEL
                call = one_channel_call(name, subject, WHITE, values)
                yield call, AccuracyRow(workload, "glsl", grey, grey, name, 0.0, None, values)


def _table_row(context: moderngl.Context, workload: str, tables: Tables) -> AccuracyRow:
    colours = [_looked_up(context, baked, at) for baked, at in zip(tables.baked, tables.points, strict=True)]
    errors = tables.errors(np.concatenate(colours))
    return AccuracyRow(
        workload, "glsl", tables.label, tables.way, None, 0.0, errors, filling_ns=tables.filling_ns
    )


def _looked_up(
    context: moderngl.Context, baked: BakedTable, at: Film | NDArray[np.float64]
) -> NDArray[np.float32]:
    call = table_call(context, baked, at)
    try:
        return call_colours(context, call, len(at.cos_theta_1 if isinstance(at, Film) else at))
    finally:
        release_textures(call)


def release_textures(call: TimedCall) -> None:
    """Give back the textures that `call` was made with."""
    for texture in call.textures.values():
        texture.release()
