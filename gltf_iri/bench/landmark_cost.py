"""What of `landmarks-sub` is search, which the root finder decides, and what evaluation, which s does."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np

from gltf_iri.bench.mirror_set import mirror_set
from gltf_iri.bench.timing import interleaved_ns
from gltf_iri.colour.cumulative import cumulative_steps
from gltf_iri.evaluation.landmark_boxes import lanes_of, lossless_cells, spectral_boxes
from gltf_iri.optics.landmarks import RootFinder, newton_steps

__all__ = ["LandmarkCost", "landmark_cost"]

_CELLS: Final = 20  # does not enter


@dataclass(frozen=True, slots=True)
class LandmarkCost:
    """The cost of one colour by compiled loops on one thread.

    constants_ns : the cell's constants, in numpy. search_ns : all landmarks of both polarisations.
    evaluation_ns : cutting boxes, their envelopes, the look-ups. reflectances : how many envelopes.
    """

    root_finder: RootFinder
    subdivisions: int
    constants_ns: float
    search_ns: float
    evaluation_ns: float
    reflectances: float


def landmark_cost(
    root_finder: RootFinder = "newton-2", subdivisions: int = 3, *, count: int = 4000, rounds: int = 25
) -> LandmarkCost:
    """Return the medians of `rounds` interleaved runs over `count` mirrors of the bench; wants numba."""
    from gltf_iri.compiled.landmarks import landmark_colours, landmark_search

    mirror = mirror_set(_CELLS, count)
    steps, table = newton_steps(root_finder), cumulative_steps("D65")
    blocks = [(part, cells.copy()) for part, cells in lossless_cells(mirror)]
    rgb = np.zeros((count, 3))

    def constants() -> None:
        list(lossless_cells(mirror))

    def search() -> None:
        for part, cells in blocks:
            landmark_search(part.stop - part.start, cells, steps)

    def whole() -> None:
        for part, cells in blocks:
            landmark_colours(cells, subdivisions, steps, table, rgb[part])

    for run in (search, whole):
        run()  # compiles
    constants_ns, search_ns, whole_ns = (
        each / count for each in interleaved_ns((constants, search, whole), rounds)
    )
    boxes = spectral_boxes(lanes_of(mirror), subdivisions, root_finder)
    reflectances = len(boxes.lane) / count
    return LandmarkCost(
        root_finder, subdivisions, constants_ns, search_ns, whole_ns - search_ns, reflectances
    )
