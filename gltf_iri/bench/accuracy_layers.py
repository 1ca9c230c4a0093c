"""Layers of mirrors on the map of cost and error: every method over a few stacks, each seen from some poses.

A colour is what one layer sends, or what of a white base gets through: two layers and the base make three a
pose. What a method makes once for a stack, its tables, counts as filling. Surfaces are drawn out of tables of
bands or colours (`gltf_iri.baking`), which are asked the same.
"""

from __future__ import annotations

import functools
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.baking.layer_fill import bake_layers
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.bench.accuracy_entries import Entry, measured
from gltf_iri.bench.accuracy_row import AccuracyRow, Errors, errors_of
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.bench.layer_set import layer_set
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerColours, LayerStack
from gltf_iri.optics.layer_stack import Sight, sight_of
from gltf_iri.optics.microfacet import ALPHA_MIN
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables, PlannedLayer
from gltf_iri.planning.method import method_names, truth_of
from gltf_iri.planning.reach import Span
from gltf_iri.planning.settings import ACCURACY_SETTINGS, settings_of, with_defaults
from gltf_iri.planning.way import Way

__all__ = ["COLOURS_A_POSE", "LAYERS", "LayerSubject", "LayerTruth", "StackTables", "layer_entries"]
__all__ += ["layer_rows", "layer_subject", "layer_truth", "stack_tables", "table_entries"]

Float64 = NDArray[np.float64]

# The set's name, under which planning/costs.json keeps what its ways cost.
LAYERS: Final = "layers"

# Of both layers, and of what reaches a base and comes back.
COLOURS_A_POSE: Final = 3

_STACKS: Final = 4
_POSES: Final = 8
_MOST_CELLS: Final = 5  # the truth of more takes minutes
_SEED: Final = 5

# Numbers a factor of the tables: a colour, and bands.
_COLOUR: Final = 3
_TABLE_BANDS: Final = (_COLOUR, 8, 16, 32)
_COS_NODES: Final = 256


@dataclass(frozen=True, slots=True)
class LayerSubject:
    """Single stacks of two layers, each with how its layers are seen, (p,) poses."""

    stacks: tuple[LayerStack, ...]
    sights: tuple[Sight, ...]


@dataclass(frozen=True, slots=True)
class LayerTruth:
    """The true colours (n, 3) of a set, and what one of them took."""

    rgb: Float64
    ns: float


@dataclass(frozen=True, slots=True)
class StackTables:
    """Filled tables of one size, one a stack; filling_ns is that of one."""

    way: str
    label: str
    baked: tuple[BakedLayers, ...]
    filling_ns: float


def layer_subject(stacks: int = _STACKS, poses: int = _POSES) -> LayerSubject:
    """Return so many stacks out of `layer_set`, and as many poses of each, uniform as there."""
    drawn, _ = layer_set(stacks, 2, _MOST_CELLS)
    g = np.random.default_rng(_SEED)
    found, sights = [], []
    for number in range(stacks):
        layers = tuple(
            BraggLayer.of(*(a[number] for a in (e.n1, e.n2, e.d1_nm, e.d2_nm, e.cells, e.alpha)))
            for e in drawn.layers
        )
        host = drawn.host_ior[number]
        found.append(LayerStack.of(layers, host))
        cos_i, cos_o, turn = g.random((3, poses))
        sights.append(sight_of(host, cos_i, cos_o, np.cos(2.0 * np.pi * turn)))
    return LayerSubject(tuple(found), tuple(sights))


def layer_rows(
    workload: str,
    subject: LayerSubject,
    truth: LayerTruth,
    tables: Sequence[StackTables],
    limit_s: float,
    rounds: int | None,
) -> list[AccuracyRow]:
    """Return a row for every method with all its settings and for `tables`, timed in turn."""
    name = truth_of("layers")
    exact = AccuracyRow(workload, "numpy", name, name, name, truth.ns, Errors(0.0, 0.0, 0.0, 0.0, 0))
    entries = [*layer_entries(subject, truth.rgb), *table_entries(tables, subject, truth.rgb)]
    return [exact, *measured(workload, entries, limit_s, rounds)]


def layer_truth(subject: LayerSubject) -> LayerTruth:
    """Return the true colours of `subject`, evaluated once."""
    start = time.perf_counter()
    rgb = _colours(_methods(truth_of("layers"), subject, {}), subject)
    return LayerTruth(rgb, 1e9 * (time.perf_counter() - start) / len(rgb))


def stack_tables(subject: LayerSubject) -> list[StackTables]:
    """Return tables of colours and of bands, filled, along the cosine only."""
    found = []
    for bands in _TABLE_BANDS:
        tables = LayerTables(bands, bands == _COLOUR, _COS_NODES, 1, "f4", 0.0)
        start = time.perf_counter()
        baked = tuple(bake_layers(_plan(stack, tables), WHITE) for stack in subject.stacks)
        filling_ns = 1e9 * (time.perf_counter() - start) / len(baked)
        way = f"table of {'colours' if tables.is_colour else f'{bands} bands'}"
        found.append(StackTables(way, f"{way}: cos_theta {_COS_NODES}, RGBA32F", baked, filling_ns))
    return found


def layer_entries(subject: LayerSubject, truth: Float64) -> Iterator[Entry]:
    """Yield every method but the truth with all its settings; `truth` (n, 3) are the true colours."""
    for name in method_names("layers"):
        for chosen in settings_of(name, ACCURACY_SETTINGS) if name != truth_of("layers") else ():
            values = with_defaults(name, chosen)
            methods = _methods(name, subject, values)
            label = Way(name, values).label
            first, second = _entry(label, subject, methods, truth), _entry(label, subject, methods, truth)
            filling_ns = 1e9 * (first.first_s - second.first_s) / len(subject.stacks)
            # The first call fills what tables there are.
            fills = filling_ns if name == "layers-single-table" else None
            yield replace(second, method=name, parameters=values, filling_ns=fills)


def table_entries(tables: Sequence[StackTables], subject: LayerSubject, truth: Float64) -> Iterator[Entry]:
    """Yield the look-ups in `tables`."""
    for each in tables:
        entry = _entry(each.way, subject, [LayerLookup(baked) for baked in each.baked], truth)
        yield replace(entry, label=each.label, filling_ns=each.filling_ns)


def _plan(stack: LayerStack, tables: LayerTables) -> LayersPlan:
    """Return the plan of a stack of numbers over a base."""
    layers = []
    for source, layer in enumerate(stack.layers):
        d1_nm, d2_nm, alpha = float(layer.d1_nm), float(layer.d2_nm), max(float(layer.alpha), ALPHA_MIN)
        period = d1_nm + d2_nm
        index = float(layer.n1), float(layer.n2)
        layers.append(PlannedLayer(source, *index, (period, period), d1_nm / period, int(layer.cells), alpha))
    method = "layers-rgb" if tables.is_colour else "layers-bands"
    return LayersPlan(tuple(layers), float(stack.host_ior), "base", Span.at(1.0), method, tables=tables)


def _entry(way: str, subject: LayerSubject, methods: Sequence[LayerColours], truth: Float64) -> Entry:
    """Return `methods`, one a stack, judged and called once."""
    run = functools.partial(_colours, methods, subject)
    start = time.perf_counter()
    rgb = run()
    elapsed = time.perf_counter() - start
    return Entry("numpy", way, way, None, errors_of(rgb, truth), run, len(rgb), elapsed)


def _methods(name: str, subject: LayerSubject, values: dict[str, float | str]) -> list[LayerColours]:
    return [layer_colours(name, stack, white=WHITE, parameters=values) for stack in subject.stacks]


def _colours(methods: Sequence[LayerColours], subject: LayerSubject) -> Float64:
    """Return (stacks · 3 · poses, 3): of the first layer, of the second, and of what passes both."""
    found = []
    for method, sight in zip(methods, subject.sights, strict=True):
        cosines = sight.cos_h, sight.cos_i, sight.cos_o
        found += [method.reflected(0, *cosines), method.reflected(1, *cosines), method.passed(*cosines[1:])]
    return np.concatenate(found)
