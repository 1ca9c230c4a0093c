"""Rows of the workloads that end in a colour: what each contestant takes, and how far it is from truth."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import has_numba
from gltf_iri.bench.timing import interleaved_ns
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import METHODS, parameters_text
from gltf_iri.planning.settings import Settings, settings_of, with_defaults

__all__ = ["WHITE", "ColourRow", "Contestant", "colour_row", "colour_rows", "registered"]
__all__ += ["with_ratios"]

Float64 = NDArray[np.float64]
WHITE: Final = "D65"


@dataclass(frozen=True, slots=True)
class Contestant:
    """One way to a colour: a method, its backend and its parameters, defaults included."""

    method: str
    backend: str
    run: Callable[[], Float64 | None]  # → linear Rec.709, (n, 3), or nothing for a part of a method
    parameters: Settings = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class ColourRow:
    """One row of the benchmark; errors are against the truth under D65, ΔE is CIEDE2000.

    Errors are None for a part of a method, which ends in no colour.
    ns_per_eval is a median, taken in the same rounds as that of every row of its workload.
    ratio is that time over the one of the method `ratio_to`, on the same backend and with its defaults.
    """

    workload: str
    method: str
    backend: str
    parameters: Settings
    ns_per_eval: float
    max_abs: float | None = None
    delta_e_mean: float | None = None
    delta_e_p95: float | None = None
    delta_e_max: float | None = None
    ratio: float | None = None
    ratio_to: str = ""

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return asdict(self)

    @property
    def label(self) -> str:
        """The method with its parameters."""
        chosen = parameters_text(self.parameters)
        return f"{self.method} ({chosen})" if chosen else self.method


def registered(method: str, subject: Film | Mirror) -> Iterator[Contestant]:
    """Yield the method called `method` with each of its settings, on each installed backend that it has."""
    for backend in METHODS[method].backends:
        if backend == "numba" and not has_numba():
            continue
        for chosen in settings_of(method):

            def run(backend: str = backend, chosen: Settings = chosen) -> Float64:
                return evaluate(method, subject, white=WHITE, backend=backend, parameters=chosen).rgb

            yield Contestant(method, backend, run, with_defaults(method, chosen))


def colour_rows(
    workload: str,
    contestants: Sequence[Contestant],
    truth: Float64,
    rounds: int,
    after_round: Callable[[], None] = lambda: None,
) -> list[ColourRow]:
    """Return a row for each contestant; `truth` is (n, 3) linear Rec.709."""
    colours = [each.run() for each in contestants]
    times_ns = interleaved_ns([each.run for each in contestants], rounds, after_round)
    return [
        colour_row((workload, each.method, each.backend), each.parameters, time_ns / len(truth), rgb, truth)
        for each, rgb, time_ns in zip(contestants, colours, times_ns, strict=True)
    ]


def with_ratios(rows: Sequence[ColourRow], ratio_to: str) -> list[ColourRow]:
    """Return the rows of one workload with their times over those of the method called `ratio_to`."""
    reference: dict[str, float] = {}
    for row in rows:
        if row.method == ratio_to:
            reference.setdefault(row.backend, row.ns_per_eval)
    return [
        replace(row, ratio=row.ns_per_eval / reference[row.backend], ratio_to=ratio_to)
        if row.backend in reference
        else row
        for row in rows
    ]


def colour_row(
    names: tuple[str, str, str],
    parameters: Settings,
    ns_per_eval: float,
    rgb: Float64 | None,
    truth: Float64,
) -> ColourRow:
    """Return the row of a workload, method and backend whose colours are `rgb`, (n, 3) as `truth` is."""
    if rgb is None:
        return ColourRow(*names, parameters, ns_per_eval)
    delta_e = delta_e_2000(rgb, truth)
    return ColourRow(
        *names,
        parameters,
        ns_per_eval=ns_per_eval,
        max_abs=float(np.abs(rgb - truth).max()),
        delta_e_mean=float(delta_e.mean()),
        delta_e_p95=float(np.percentile(delta_e, 95)),
        delta_e_max=float(delta_e.max()),
    )
