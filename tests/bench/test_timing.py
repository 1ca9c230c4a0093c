"""Times are taken in turns, and a run's threads are put back as they were."""

from __future__ import annotations

import os
import sys

import pytest

from gltf_iri.bench.machine import machine, package_version
from gltf_iri.bench.timing import interleaved_ns, one_thread


def test_contestants_run_in_turns() -> None:
    calls: list[str] = []

    def slow(name: str) -> None:
        # Longer than what is repeated within a round.
        end = os.times().elapsed + 0.05
        while os.times().elapsed < end:
            pass
        calls.append(name)

    rounds: list[int] = []
    times = interleaved_ns([lambda: slow("a"), lambda: slow("b")], 2, lambda: rounds.append(1))
    assert calls == ["a", "b", "a", "b"]
    assert len(rounds) == 2
    assert all(time > 5e6 for time in times)


def test_a_short_run_is_repeated_and_its_time_is_that_of_one() -> None:
    calls: list[int] = []
    (time,) = interleaved_ns([lambda: calls.append(1)], 1)
    assert len(calls) > 100
    assert time < 1e5


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux says on which cores a process may run")
def test_one_thread_is_one_core_until_the_end() -> None:
    before, environment = os.sched_getaffinity(0), dict(os.environ)
    with one_thread() as is_pinned:
        assert is_pinned
        assert len(os.sched_getaffinity(0)) == 1
        assert os.environ["OMP_NUM_THREADS"] == os.environ["NUMBA_NUM_THREADS"] == "1"
    assert os.sched_getaffinity(0) == before
    assert dict(os.environ) == environment


def test_the_machine_names_what_figures_depend_on() -> None:
    facts = machine(("tmm", "no-such-package"))
    assert facts["processor"]
    assert facts["avx512"] in (True, False, None)
    assert facts["numpy"] == package_version("numpy") is not None
    assert facts["no-such-package"] is None
