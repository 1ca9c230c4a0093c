"""Workloads `films` and `films-3um`: how far each film method is from the truth, and what it costs."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.colour_rows import WHITE, ColourRow, Contestant, colour_rows, registered, with_ratios
from gltf_iri.bench.film_set import film_set
from gltf_iri.bench.fourier_variants import exact_interfaces, khr_with_exact_sensitivity
from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import method_names

__all__ = ["FILM_ROUNDS", "FILM_WORKLOADS", "RATIO_TO", "measure_films", "thicker_film_set"]

FILM_ROUNDS: Final = 5
RATIO_TO: Final = "khr"
_ORDERS: Final = (1, 2, 3, 6)


def thicker_film_set() -> Film:
    """Return the film set with its thicknesses stretched from 100–800 nm to 100–3000 nm: the same draws."""
    thin = film_set()
    thickness_nm = 100.0 + (thin.thickness_nm - 100.0) * (2900.0 / 700.0)
    return Film.of(thin.cos_theta_1, thickness_nm, thin.film_ior, base_from_ior(thin.base.index[..., 0].real))


FILM_WORKLOADS: Final[dict[str, Callable[[], Film]]] = {"films": film_set, "films-3um": thicker_film_set}


def measure_films(
    workload: str = "films", rounds: int = FILM_ROUNDS, after_round: Callable[[], None] = lambda: None
) -> list[ColourRow]:
    """Return one row for each film method, its parameters and backends, and for the text's variants."""
    film = FILM_WORKLOADS[workload]()
    truth = evaluate("spectral", film, white=WHITE, backend="numpy").rgb
    rows = colour_rows(workload, list(_contestants(film)), truth, rounds, after_round)
    return with_ratios(rows, RATIO_TO)


def _contestants(film: Film) -> Iterator[Contestant]:
    for method in method_names("film"):
        yield from registered(method, film)
    yield Contestant(
        "khr, exact sensitivity", "numpy", functools.partial(khr_with_exact_sensitivity, film, WHITE)
    )
    for orders in _ORDERS:
        yield Contestant(f"exact interfaces, m ≤ {orders}", "numpy", functools.partial(_series, film, orders))


def _series(film: Film, orders: int) -> NDArray[np.float64]:
    return exact_interfaces(film, WHITE, orders)
