"""A .npy file of films to a .npy file of colours: checked, planned for its own reach, and streamed."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.arrays.film_rows import column_spans, open_rows, span_steps
from gltf_iri.arrays.films import ArrayFilms, FilmColours, reach_of_films
from gltf_iri.arrays.memory import PeakMemory
from gltf_iri.arrays.stream import THREADS, check_out, stream_colours, stream_steps
from gltf_iri.backends import choose_backend
from gltf_iri.baking.cache import TableCache
from gltf_iri.baking.fill import bake
from gltf_iri.budgets.choose import way_for_films
from gltf_iri.budgets.subjects import way_for_film
from gltf_iri.colour.spaces import WhiteName
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.registry import checked_parameters
from gltf_iri.planning.method import DEFAULT_METHOD, ParameterValue, find_method
from gltf_iri.planning.reach import Span
from gltf_iri.planning.way import Way

__all__ = ["ArrayReport", "evaluate_array", "steps_of_array"]

Rows = NDArray[np.floating[Any]]

# Rows that stand for all where no reach says what they are.
_LOOKED_AT: Final = 1 << 14
_GOLDEN: Final = 0.5 * (math.sqrt(5.0) - 1.0)


@dataclass(frozen=True, slots=True)
class ArrayReport:
    """What was done.

    way : label of the way; delta_e : what its budget promises, None where no budget was given.
    seconds : of the pass that computes and writes; planning_s : of reading spans, choosing and baking before.
    anonymous_bytes : the most memory that the process held of its own; None where the system does not tell.
    undefined : rows that met each case that the method leaves undefined.
    """

    out: Path
    rows: int
    columns: tuple[str, ...]
    way: str
    method: str
    parameters: Mapping[str, ParameterValue]
    white: WhiteName
    backend: str
    threads: int
    delta_e: float | None
    planning_s: float
    seconds: float
    anonymous_bytes: int | None
    undefined: Mapping[str, int]

    @property
    def ns_per_colour(self) -> float:
        """Wall time over rows, all threads together."""
        return 1e9 * self.seconds / self.rows

    def to_json(self) -> dict[str, Any]:
        """Return what `evaluate --json` prints."""
        names = [name for name in self.__dataclass_fields__ if name != "undefined"]
        row = {name: getattr(self, name) for name in names}
        return {
            **row,
            "parameters": dict(self.parameters),
            "ns_per_colour": self.ns_per_colour,
            "undefined": dict(self.undefined),
        }


def steps_of_array(source: Path, columns: tuple[str, ...]) -> int:
    """Return how often `evaluate_array` advances; raises UsageError as `open_rows`."""
    rows = open_rows(source, columns)
    return span_steps(rows) + stream_steps(rows)


def evaluate_array(
    source: Path,
    out: Path,
    films: ArrayFilms,
    *,
    method: str | None = None,
    budget: float | None = None,
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
    white: WhiteName = "D65",
    backend: str = "auto",
    threads: int = THREADS,
    cache: TableCache | None = None,
    advance: Callable[[], None] = lambda: None,
) -> ArrayReport:
    """Write the colours of the films of `source` to `out`, linear Rec.709, not cut to the gamut.

    films : what the columns mean, and what all rows share.
    method : computes each colour; None for the default, or where there is a `budget` for the cheapest way
        that keeps it: at all values between the least and the greatest of each column, or on rows spread over
        the array where films differ in index, lie under something else than air or over an absorbing base.
    cache : of tables; None fills them anew.

    Raises UsageError where the array, the place or the call is wrong; nothing is then written.
    """
    if budget is not None and (method is not None or parameters):
        raise UsageError("A budget chooses the method and its parameters; give one or the other.")
    memory = PeakMemory()

    def looking() -> None:
        memory.sample()
        advance()

    started = time.perf_counter()
    rows = open_rows(source, films.columns)
    check_out(out, source)
    spans = column_spans(rows, films.columns, advance=looking)
    way = None if budget is None else _way(films, rows, spans, budget, white)
    chosen = find_method(DEFAULT_METHOD if method is None else method, "film")
    colours = FilmColours(
        films,
        len(rows),
        chosen.name if way is None or way.method is None else way.method,
        tables={} if way is None else {table.lobe: bake(table, white, cache=cache) for table in way.tables},
        parameters=checked_parameters(chosen, parameters) if way is None else way.parameters,
        white=white,
        backend=backend,
    )
    # Loads what the colours take, which belongs to no rate, and refuses what cannot be evaluated.
    colours(np.asarray(rows[:1], dtype=np.float64))
    colours.undefined.clear()
    planned = time.perf_counter()
    stream_colours(rows, out, colours, threads=threads, advance=looking)
    memory.sample()
    return ArrayReport(
        out=out,
        rows=len(rows),
        columns=films.columns,
        way=colours.label if way is None else way.label,
        method=colours.method,
        parameters=colours.parameters,
        white=white,
        backend=colours.backend,
        threads=threads,
        delta_e=None if way is None else way.delta_e,
        planning_s=planned - started,
        seconds=time.perf_counter() - planned,
        anonymous_bytes=memory.bytes,
        undefined=dict(colours.undefined),
    )


def _way(films: ArrayFilms, rows: Rows, spans: Mapping[str, Span], budget: float, white: WhiteName) -> Way:
    """Return the cheapest way within `budget` over the reach of all rows, or measured on some of them."""
    reach = reach_of_films(films, spans)
    if reach is not None:
        return way_for_films(reach, budget, count=len(rows), white=white)
    # Not every so many rows: those of a flattened grid would all have one angle or one thickness.
    share = (0.5 + _GOLDEN * np.arange(min(len(rows), _LOOKED_AT))) % 1.0
    block = np.asarray(rows[np.unique((len(rows) * share).astype(np.intp))], dtype=np.float64)
    (lobe,) = films.bases  # a material's films have a reach
    device = choose_backend("auto", len(rows), ("numpy", "numba"), "table")
    return way_for_film(films.film(block, lobe), budget, device=device, white=white).way
