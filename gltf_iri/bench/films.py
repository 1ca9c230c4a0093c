"""Workload `films`: how far each method is from the truth on the film set, and what it costs."""

from __future__ import annotations

import functools
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.film_set import film_set
from gltf_iri.bench.fourier_variants import exact_interfaces, khr_with_exact_sensitivity
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.registry import evaluate

__all__ = ["CONTENDERS", "WHITE", "BenchRow", "measure_films"]

Contender = Callable[[Film, White], NDArray[np.float64]]

WHITE: Final[White] = "D65"
_ROUNDS: Final = 5


@dataclass(frozen=True, slots=True)
class BenchRow:
    """One row of the benchmark; errors are against `spectral` under D65, ΔE is CIEDE2000."""

    workload: str
    method: str
    backend: str
    ns_per_eval: float
    max_abs: float
    delta_e_mean: float
    delta_e_p95: float
    delta_e_max: float

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return asdict(self)


def _registered(method: str, film: Film, white: White) -> NDArray[np.float64]:
    return evaluate(method, film, white=white, backend="numpy").rgb


def _orders(orders: int, film: Film, white: White) -> NDArray[np.float64]:
    return exact_interfaces(film, white, orders)


CONTENDERS: Final[dict[str, Contender]] = {
    "khr": functools.partial(_registered, "khr"),
    "khr, exact sensitivity": khr_with_exact_sensitivity,
    **{f"exact interfaces, m ≤ {m}": functools.partial(_orders, m) for m in (1, 2, 3, 6)},
    "khr-guarded": functools.partial(_registered, "khr-guarded"),
    "spectral": functools.partial(_registered, "spectral"),
}


def measure_films() -> Iterator[BenchRow]:
    """Yield one row for each contender; times are medians over some rounds on the whole set at once."""
    film = film_set()
    truth = evaluate("spectral", film, white=WHITE, backend="numpy").rgb
    for name, contender in CONTENDERS.items():
        rgb = contender(film, WHITE)
        times_ns = []
        for _ in range(_ROUNDS):
            start = time.perf_counter_ns()
            contender(film, WHITE)
            times_ns.append(time.perf_counter_ns() - start)
        delta_e = delta_e_2000(rgb, truth)
        yield BenchRow(
            workload="films",
            method=name,
            backend="numpy",
            ns_per_eval=statistics.median(times_ns) / len(truth),
            max_abs=float(np.abs(rgb - truth).max()),
            delta_e_mean=float(delta_e.mean()),
            delta_e_p95=float(np.percentile(delta_e, 95)),
            delta_e_max=float(delta_e.max()),
        )
