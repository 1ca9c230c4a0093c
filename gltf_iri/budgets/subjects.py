"""The cheapest way to the colours of given films or mirrors, whose errors are measured on themselves.

Of many, evenly spread ones stand for all (`gltf_iri.colour.quantile`); of few each is looked at.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any, Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import choose_backend
from gltf_iri.budgets.candidates import Candidate, direct_candidates, film_workload, mirror_workload
from gltf_iri.budgets.errors import Measured
from gltf_iri.budgets.search import Chosen, cheapest_way, check_budget, the_truth
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.quantile import LOOKS, SHARE, bounds
from gltf_iri.colour.spaces import Light
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Base, Evaluation, Film, base_from_ior
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.costs import Device
from gltf_iri.planning.method import METHODS, truth_of
from gltf_iri.planning.mirror import film_in_mirror

__all__ = ["evaluate_within", "way_for_film", "way_for_mirror"]

Float64 = NDArray[np.float64]
Rows = tuple[NDArray[np.intp], ...]
Subject = TypeVar("Subject", Film, Mirror)

_GOLDEN: Final = 0.5 * (math.sqrt(5.0) - 1.0)

# The truth of a mirror takes milliseconds.
_MIRROR_LOOKS: Final = LOOKS[:2]


def way_for_film(
    film: Film, budget: float, *, device: Device = "numpy", white: str | Light = "D65"
) -> Chosen:
    """Return the cheapest method for the colours of `film` whose p95 of ΔE keeps `budget`, and why.

    Raises UsageError for a budget below 0 or NaN, and where none keeps it.
    """
    is_grey = bool(np.all(film.base.index == film.base.index[..., :1]))
    workload = film_workload(float(film.thickness_nm.max(initial=0.0)), is_grey=is_grey)
    candidates = direct_candidates("film", device, [workload])
    return _choose(film, _film_rows, candidates, budget, white, LOOKS, "these films")


def way_for_mirror(
    mirror: Mirror, budget: float, *, device: Device = "numpy", white: str | Light = "D65"
) -> Chosen:
    """Return the cheapest method for the colours of `mirror`, as `way_for_film` does."""
    candidates = direct_candidates("mirror", device, [mirror_workload(mirror.cells.max(initial=1))])
    return _choose(mirror, _mirror_rows, candidates, budget, white, _MIRROR_LOOKS, "these mirrors")


def evaluate_within(
    subject: Film | Mirror, budget: float, *, white: str | Light = "D65", backend: str = "auto"
) -> Evaluation:
    """Return the colours of `subject` by the cheapest method that keeps `budget`; `.delta_e` is its bound.

    Its price by the map of costs is `.ns_per_colour`.

    Mirrors that are films (`gltf_iri.planning.mirror`) are computed as films; the method tells so.

    Raises UsageError as `way_for_film` and `evaluate`.
    """
    device = choose_backend(backend, math.prod(subject.shape), ("numpy", "numba"), "budget")
    if isinstance(subject, Mirror):
        subject = _film_of(subject) or subject
    if isinstance(subject, Film):
        way = way_for_film(subject, budget, device=device, white=white).way
    else:
        way = way_for_mirror(subject, budget, device=device, white=white).way
    method = str(way.method)
    taken = device if device in METHODS[method].backends else "numpy"
    done = evaluate(method, subject, white=white, backend=taken, parameters=way.parameters)
    return replace(done, delta_e=way.delta_e, ns_per_colour=way.ns_per_colour)


def _film_of(mirror: Mirror) -> Film | None:
    found = film_in_mirror(mirror.n1, mirror.n2, mirror.d2_nm, mirror.cells, mirror.host_ior)
    if found is None:
        return None
    base = base_from_ior(found.base_ior)
    return Film.of(mirror.cos_theta_h, found.thickness_nm, found.film_ior, base, found.outside_ior)


def _choose(
    subject: Subject,
    rows_of: Callable[[Subject, Rows], Subject],
    candidates: tuple[Candidate, ...],
    budget: float,
    white: str | Light,
    looks: tuple[int, ...],
    words: str,
) -> Chosen:
    if check_budget(budget) == 0.0:
        return the_truth(candidates)
    count = math.prod(subject.shape)
    truth = truth_of("mirror" if isinstance(subject, Mirror) else "film")
    seen: dict[int, tuple[Subject, Float64]] = {}

    def look(points: int) -> tuple[Subject, Float64]:
        if points not in seen:
            some = rows_of(subject, _spread_rows(subject.shape, min(points, count)))
            seen[points] = some, evaluate(truth, some, white=white).rgb
        return seen[points]

    def measure(candidate: Candidate, allowed: float) -> Measured:
        method = str(candidate.method)
        if METHODS[method].is_truth or count == 0:
            return Measured(0.0, True)
        below = math.inf
        for points in looks:
            some, true = look(points)
            try:
                found = evaluate(method, some, white=white, parameters=candidate.parameters).rgb
            except UsageError:  # a mirror's method that does not know cells that absorb
                break
            errors = delta_e_2000(found, true)
            above, below = (_p95(errors),) * 2 if count <= points else bounds(errors)
            if below <= allowed or above > allowed:
                break
        return Measured(below, below <= allowed)

    return cheapest_way(candidates, measure, budget, max(count, 1), subject=words)


def _p95(errors: Float64) -> float:
    """Return an error that SHARE of all do not exceed; NaN counts as infinite."""
    ordered = np.sort(np.where(np.isnan(errors), np.inf, errors))
    return float(ordered[math.ceil(SHARE * (len(ordered) - 1))])


def _spread_rows(shape: tuple[int, ...], points: int) -> Rows:
    """Return the indices of `points` rows of `shape`, spread by the golden ratio; all where they suffice."""
    count = math.prod(shape)
    flat = np.arange(points)
    if points < count:
        flat = np.minimum((count * ((0.5 + _GOLDEN * flat) % 1.0)).astype(np.intp), count - 1)
    return np.unravel_index(flat, shape) if shape else (flat,)


def _film_rows(film: Film, rows: Rows) -> Film:
    base = Base(
        _taken(film.base.f0, film.shape, rows, 3),
        _taken(film.base.index, film.shape, rows, 3),
        film.base.index_at,
    )
    columns = (film.cos_theta_1, film.thickness_nm, film.film_ior)
    cosine, thickness_nm, film_ior = (_taken(each, film.shape, rows) for each in columns)
    return Film(
        cosine, thickness_nm, film_ior, base, _taken(film.outside_ior, film.shape, rows), film.film_ior_at
    )


def _mirror_rows(mirror: Mirror, rows: Rows) -> Mirror:
    names = ("cos_theta_h", "n1", "n2", "d1_nm", "d2_nm", "cells", "host_ior")
    return Mirror(*(_taken(getattr(mirror, name), mirror.shape, rows) for name in names))


def _taken(values: NDArray[Any], shape: tuple[int, ...], rows: Rows, *last: int) -> NDArray[Any]:
    """Return some rows of `values`, which broadcast to `shape`, without writing it out."""
    if not shape:
        return np.broadcast_to(values, (1, *last))[rows[0]]
    return np.broadcast_to(values, (*shape, *last))[rows]
