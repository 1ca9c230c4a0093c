"""Workload `mirrors`: how far each mirror method is from the truth, and what it costs, by number of cells."""

from __future__ import annotations

import functools
import time
from collections.abc import Callable, Iterator
from typing import Final

from gltf_iri.backends import has_numba
from gltf_iri.bench.colour_rows import WHITE, ColourRow, Contestant, colour_rows, registered, with_ratios
from gltf_iri.bench.landmark_cost import landmark_cost
from gltf_iri.bench.mirror_set import LOW_CONTRAST_CELLS, MIRROR_CELLS, low_contrast_set, mirror_set
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.landmarks import ROOT_FINDERS
from gltf_iri.planning.method import METHODS, method_names, truth_of
from gltf_iri.planning.settings import Settings

__all__ = ["MIRROR_ROUNDS", "MIRROR_WORKLOADS", "RATIO_TO", "landmark_parts", "measure_mirrors"]

MIRROR_ROUNDS: Final = 5
RATIO_TO: Final = "landmarks-sub"

MIRROR_WORKLOADS: Final[dict[str, Callable[[], Mirror]]] = {
    **{f"mirrors-{cells}": functools.partial(mirror_set, cells) for cells in MIRROR_CELLS},
    **{f"low-contrast-{cells}": functools.partial(low_contrast_set, cells) for cells in LOW_CONTRAST_CELLS},
}


def measure_mirrors(
    workload: str, rounds: int = MIRROR_ROUNDS, after_round: Callable[[], None] = lambda: None
) -> list[ColourRow]:
    """Return one row for each mirror method, its parameters and backends.

    The truth is slow: its time is that of the one run that the others are judged by.
    """
    mirror = MIRROR_WORKLOADS[workload]()
    truth_by = truth_of("mirror")
    start = time.perf_counter_ns()
    truth = evaluate(truth_by, mirror, white=WHITE, backend="numpy").rgb
    truth_ns = (time.perf_counter_ns() - start) / len(truth)
    rows = colour_rows(workload, list(_contestants(mirror)), truth, rounds, after_round)
    return [
        ColourRow(workload, truth_by, "numpy", {}, truth_ns, 0.0, 0.0, 0.0, 0.0),
        *with_ratios(rows, RATIO_TO),
    ]


def _contestants(mirror: Mirror) -> Iterator[Contestant]:
    for name in method_names("mirror"):
        if not METHODS[name].is_truth:
            yield from registered(name, mirror)


def landmark_parts() -> list[ColourRow]:
    """Return rows without a colour for what `landmarks-sub` spends on what, compiled; none without numba."""
    if not has_numba():
        return []
    rows = []
    for finder in ROOT_FINDERS:
        cost = landmark_cost(finder)
        chosen: Settings = {"subdivisions": cost.subdivisions, "root_finder": finder}
        parts = {
            "constants": cost.constants_ns,
            "search": cost.search_ns,
            f"evaluation, {cost.reflectances:.0f} boxes": cost.evaluation_ns,
        }
        for part, ns in parts.items():
            rows.append(ColourRow("mirrors-20", f"landmarks-sub: {part}", "numba", chosen, ns))
    return rows
