"""`bench optics`: reflectances of films and mirrors, this package beside the libraries that compute them too.

For each workload every contestant runs once a round, on one thread. Errors are against 50 digits on a thinned
grid, at the angles' float64 cosines; a contestant beyond `WRONG` is shown but never "the fastest correct".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.backends import Backend, has_numba
from gltf_iri.bench.machine import package_version
from gltf_iri.bench.ours import OURS
from gltf_iri.bench.peers import PEERS, silent_peers
from gltf_iri.bench.timing import interleaved_ns
from gltf_iri.bench.workloads import WORKLOADS, Workload, error_max_abs
from gltf_iri.errors import MissingCapabilityError

__all__ = ["OPTICS_ROUNDS", "WRONG", "OpticsRow", "load_peers", "measure_optics"]

Run = Callable[[], NDArray[np.float64]]
Prepare = Callable[[Workload], Run]

OPTICS_ROUNDS: Final = 7
WRONG: Final = 1e-6
_CLOSED_FORMS: Final = ("film", "bragg")  # what the targets speak of; general functions stand beside them
_ERROR_GRID: Final = (12, 11, 10)  # structures, angles, wavelengths
_ERROR_GRID_MANY: Final = (12, 1, 6)


@dataclass(frozen=True, slots=True)
class OpticsRow:
    """One contestant on one workload; an evaluation is one wavelength at one angle, s and p averaged.

    backend : "numpy" or "numba" for this package, "peer" for a library; version : of the library.
    max_abs : against 50 digits, NaN where an answer is.
    evaluations : in one run; peers that are slow get a thinned grid.
    speedup : how many times faster than the fastest correct peer of the same run; None without one.
    target : what `speedup` is meant to be.
    remark : why there are no figures, where there are none.
    """

    workload: str
    method: str
    backend: str
    version: str
    ns_per_eval: float | None
    max_abs: float | None
    evaluations: int
    speedup: float | None = None
    target: float | None = None
    is_fastest_correct_peer: bool = False
    remark: str = ""
    delta_e_mean: float | None = None  # a reflectance has no colour
    delta_e_p95: float | None = None

    @property
    def is_correct(self) -> bool:
        """True where the answers are right to `WRONG`; NaN is not."""
        return self.max_abs is not None and self.max_abs <= WRONG

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return {**asdict(self), "is_correct": self.is_correct}


@dataclass(frozen=True, slots=True)
class _Contestant:
    method: str
    backend: str
    version: str
    prepare: Prepare
    grid: tuple[int, int, int]


def load_peers() -> tuple[dict[str, Any], dict[str, str]]:
    """Import the peers; returns the libraries, and for those that cannot be imported the reason, by name.

    Raises MissingCapabilityError where none can.
    """
    loaded, missing = {}, {}
    with silent_peers():
        for peer in PEERS:
            try:
                loaded[peer.name] = peer.load()
            except Exception as error:  # whatever a library raises while it is imported, it is not there
                missing[peer.name] = f"{type(error).__name__}: {error}".splitlines()[0]
    # colour is a dependency of this package and proves nothing about the extra.
    if not set(loaded) - {"colour"}:
        raise MissingCapabilityError(
            "There is nothing to compare with: pip install 'gltf-iri[peers]' (3 GB, because of torch)."
        )
    return loaded, missing


def measure_optics(
    names: Sequence[str],
    libraries: dict[str, Any],
    rounds: int = OPTICS_ROUNDS,
    grid: tuple[int, int, int] | None = None,
    after_round: Callable[[], None] = lambda: None,
) -> Iterator[list[OpticsRow]]:
    """Yield for each workload its rows, own rows first.

    libraries : the peers by name, as `load_peers` returns them; none for own rows alone.
    grid : at most so many structures, angles and wavelengths for everyone; None for what each can finish.
    """
    for name in names:
        with silent_peers():
            rows = _measure(WORKLOADS[name], libraries, rounds, grid, after_round)
        yield rows


def _measure(
    workload: Workload,
    libraries: dict[str, Any],
    rounds: int,
    grid: tuple[int, int, int] | None,
    after_round: Callable[[], None],
) -> list[OpticsRow]:
    judged_on = workload.thinned(*(_ERROR_GRID_MANY if workload.alike == "W5" else _ERROR_GRID))
    truth = judged_on.truth()
    rows, runs = [], []
    for contestant in _contestants(workload, libraries):
        given = workload.thinned(*contestant.grid)
        given = given if grid is None else given.thinned(*grid)
        identity = (workload.name, contestant.method, contestant.backend, contestant.version)
        try:
            error = error_max_abs(contestant.prepare(judged_on)(), truth)
            run = contestant.prepare(given)
            run()
        except Exception as failure:  # a peer that fails is named with its reason, and the others go on
            if contestant.backend != "peer":
                raise
            reason = f"{type(failure).__name__}: {failure}".splitlines()[0]
            rows.append(OpticsRow(*identity, None, None, given.evaluations, remark=reason))
            continue
        rows.append(OpticsRow(*identity, np.nan, error, given.evaluations))
        runs.append(run)
    times_ns = iter(interleaved_ns(runs, rounds, after_round))
    timed = [
        row if row.max_abs is None else replace(row, ns_per_eval=next(times_ns) / row.evaluations)
        for row in rows
    ]
    return _compared(timed, dict(workload.targets))


def _contestants(workload: Workload, libraries: dict[str, Any]) -> Iterator[_Contestant]:
    whole = workload.shape
    for own in OURS:
        for backend in own.backends:
            if not own.fits(workload) or (backend == "numba" and not has_numba()):
                continue

            def prepare(given: Workload, own: Any = own, backend: Backend = backend) -> Run:
                run: Run = own.prepare(given, backend)
                return run

            version = package_version(backend) or ""
            yield _Contestant(own.name, backend, version, prepare, own.grids.get(workload.alike, whole))
    for peer in PEERS:
        if peer.name not in libraries:
            continue

        def prepare_peer(given: Workload, peer: Any = peer) -> Run:
            run: Run = peer.prepare(libraries[peer.name], given)
            return run

        version = package_version(peer.package) or ""
        yield _Contestant(peer.name, "peer", version, prepare_peer, peer.grids[workload.alike])


def _compared(rows: list[OpticsRow], targets: dict[str, float]) -> list[OpticsRow]:
    """Return the rows with their times over that of the fastest correct peer."""
    peers_ns = [row.ns_per_eval for row in rows if row.backend == "peer" and row.is_correct]
    fastest_ns = min((ns for ns in peers_ns if ns is not None), default=None)
    compared = []
    for row in rows:
        speedup = fastest_ns / row.ns_per_eval if fastest_ns and row.ns_per_eval else None
        target = targets.get(row.backend) if row.method in _CLOSED_FORMS else None
        is_fastest = row.backend == "peer" and row.is_correct and row.ns_per_eval == fastest_ns
        compared.append(replace(row, speedup=speedup, target=target, is_fastest_correct_peer=is_fastest))
    return compared
