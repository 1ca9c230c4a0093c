"""Who does the work on many files: local processes or the workers of a Dask cluster, behind one face."""

from __future__ import annotations

import multiprocessing
import signal
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from gltf_iri.errors import MissingCapabilityError, UsageError

__all__ = ["Crew", "crew_of"]

# A scheduler that is there answers in milliseconds.
_CONNECT_TIMEOUT_S = 10


class Crew(ABC):
    """An executor that comes back after one of its workers died."""

    size: int

    @abstractmethod
    def submit(self, work: Callable[..., Any], *arguments: Any) -> Future[Any]:
        """Let a worker do `work`."""

    @abstractmethod
    def dismiss(self) -> None:
        """Let the workers go, whatever they are at."""

    @abstractmethod
    def is_death(self, error: BaseException) -> bool:
        """Tell whether `error` means that a worker died, not that the work failed."""

    def as_seen(self, paths: Sequence[str]) -> list[tuple[str, str]]:
        """Return for each path the one that a worker opens, and the name that the report shows."""
        return [(str(Path(path).absolute()), path) for path in paths]


@contextmanager
def crew_of(jobs: int, scheduler: str | None) -> Iterator[Crew]:
    """Yield the workers: `jobs` local processes, or those of the Dask scheduler at this address.

    Raises MissingCapabilityError where Dask is not installed, UsageError where no scheduler answers.
    """
    crew = _Processes(jobs) if scheduler is None else _Cluster(scheduler)
    try:
        yield crew
    finally:
        crew.dismiss()


class _Processes(Crew):
    """Local processes; when one dies, the pool breaks as a whole and a new one takes its place."""

    def __init__(self, jobs: int) -> None:
        self.size = jobs
        self._pool = self._new_pool()

    def submit(self, work: Callable[..., Any], *arguments: Any) -> Future[Any]:
        try:
            return self._pool.submit(work, *arguments)
        except BrokenExecutor:
            self._pool.shutdown(wait=False)
            self._pool = self._new_pool()
            return self._pool.submit(work, *arguments)

    def is_death(self, error: BaseException) -> bool:
        return isinstance(error, BrokenExecutor)

    def dismiss(self) -> None:
        self._pool.shutdown(wait=False, cancel_futures=True)

    def _new_pool(self) -> Executor:
        # Not "fork": this process may have threads, and a child would inherit their locks half-taken.
        known = multiprocessing.get_all_start_methods()
        context = multiprocessing.get_context("forkserver" if "forkserver" in known else "spawn")
        return ProcessPoolExecutor(self.size, context, _ignore_interrupts)


def _ignore_interrupts() -> None:
    """Leave Ctrl-C to the process that started the workers: it ends them, in silence."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


class _Cluster(Crew):
    """The workers of a Dask cluster; the scheduler gives the work of one that died to another."""

    def __init__(self, address: str) -> None:
        try:
            import distributed
        except ImportError as error:
            raise MissingCapabilityError(
                "A Dask cluster needs the package distributed: pip install 'gltf-iri[cluster]'."
            ) from error
        connect: Any = distributed.Client
        try:
            _greet(address)
            self._client = connect(address, timeout=_CONNECT_TIMEOUT_S, set_as_default=False)
        except (OSError, ValueError, TypeError) as error:
            raise UsageError(
                f"No Dask scheduler answers at {address!r}; name one such as tcp://host:8786."
            ) from error
        workers = self._client.scheduler_info()["workers"].values()
        self.size = max(1, sum(worker["nthreads"] for worker in workers))
        self._executor = self._client.get_executor(pure=False)
        self._deaths = (distributed.KilledWorker, CancelledError)

    def submit(self, work: Callable[..., Any], *arguments: Any) -> Future[Any]:
        future: Future[Any] = self._executor.submit(work, *arguments)
        return future

    def is_death(self, error: BaseException) -> bool:
        return isinstance(error, self._deaths)

    def dismiss(self) -> None:
        self._executor.shutdown(wait=False)
        self._client.close()


def _greet(address: str) -> None:
    """Let a scheduler say who it is; OSError where none does.

    A client waits for ever for whatever listens there and is no Dask, such as the port of a dashboard, and
    one that found nobody complains once more, on stderr, when it is thrown away.
    """
    import asyncio

    from distributed.comm import connect
    from distributed.security import Security

    with_whom: Any = Security().get_connection_args("client")
    greeting: Any = connect

    async def greet() -> None:
        # Its own limit does not hold for the answer.
        comm = await asyncio.wait_for(
            greeting(address, timeout=_CONNECT_TIMEOUT_S, **with_whom), _CONNECT_TIMEOUT_S
        )
        await comm.close()

    asyncio.run(greet())
