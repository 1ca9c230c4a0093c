"""Many files: whoever does the work, every file gets its report, and one that kills its worker is named."""

from __future__ import annotations

import json
import multiprocessing
import os
import signal
import socket
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Future
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from gltf_iri.errors import UsageError
from gltf_iri.validation.many import crews
from gltf_iri.validation.many.many import FileResult, validate_many
from gltf_iri.validation.many.results_file import ResultsFile
from gltf_iri.validation.options import Options

SOUND = {"asset": {"version": "2.0"}}
FILES = 150


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[str]:
    folder = tmp_path_factory.mktemp("many")
    paths = []
    for number in range(FILES):
        path = folder / f"{number:03}.gltf"
        tree = SOUND if number % 3 else {**SOUND, "nodes": [{"mesh": number}]}
        path.write_text(json.dumps(tree), encoding="utf-8")
        paths.append(str(path))
    return paths


def sorted_lines(results: Iterator[FileResult]) -> list[str]:
    return sorted(result.line for result in results)


@pytest.fixture(scope="module")
def alone(files: list[str]) -> list[str]:
    return sorted_lines(validate_many(files, Options()))


def test_one_process_keeps_the_order(files: list[str]) -> None:
    results = list(validate_many(files, Options()))
    assert [result.path for result in results] == files
    assert {result.report["issues"]["numErrors"] > 0 for result in results[::3]} == {True}
    assert {result.report["issues"]["numErrors"] for result in results[1::3]} == {0}


def test_two_processes_say_what_one_says(files: list[str], alone: list[str]) -> None:
    assert sorted_lines(validate_many(files, Options(), jobs=2)) == alone


def test_options_reach_the_workers(files: list[str]) -> None:
    results = validate_many(files[:3], Options(ignore=frozenset({"UNRESOLVED_REFERENCE"})), jobs=2)
    assert all("UNRESOLVED_REFERENCE" not in result.line for result in results)


def test_a_file_that_cannot_be_read_has_a_report_too(files: list[str], tmp_path: Path) -> None:
    missing = str(tmp_path / "missing.gltf")
    results = {r.path: r for r in validate_many([missing, files[1]], Options(), jobs=2)}
    told = results[missing].report["issues"]
    assert told["numErrors"] == 1
    assert told["messages"][0]["code"] == "IO_ERROR"
    assert results[missing].failure is not None
    assert results[files[1]].failure is None


def test_a_killed_process_loses_no_file(files: list[str], alone: list[str]) -> None:
    lines = []
    for result in validate_many(files, Options(), jobs=2):
        lines.append(result.line)
        if len(lines) == 1:
            os.kill(multiprocessing.active_children()[0].pid or 0, signal.SIGKILL)
    assert sorted(lines) == alone


class _Mortal(crews.Crew):
    """Works on the spot, but breaks whenever it meets a file that `kills` names, as often as it says."""

    def __init__(self, kills: dict[str, int]) -> None:
        self.size = 2
        self.kills = kills

    def submit(self, work: Callable[..., Any], *arguments: Any) -> Future[Any]:
        future: Future[Any] = Future()
        for _, name in arguments[0]:
            if self.kills.get(name, 0):
                self.kills[name] -= 1
                future.set_exception(BrokenProcessPool("it died"))
                return future
        future.set_result(work(*arguments))
        return future

    def is_death(self, error: BaseException) -> bool:
        return isinstance(error, BrokenExecutor)

    def dismiss(self) -> None: ...


def with_crew(monkeypatch: pytest.MonkeyPatch, crew: crews.Crew) -> None:
    @contextmanager
    def crew_of(jobs: int, scheduler: str | None) -> Iterator[crews.Crew]:
        yield crew

    monkeypatch.setattr(crews, "crew_of", crew_of)


def died(results: Sequence[FileResult]) -> list[str]:
    return [result.path for result in results if "IRI_WORKER_DIED" in result.line]


def test_a_file_that_always_kills_its_worker_is_named_and_the_rest_is_judged(
    files: list[str], alone: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with_crew(monkeypatch, _Mortal({files[40]: 99, files[149]: 99}))
    results = list(validate_many(files, Options(), jobs=2))
    assert sorted(died(results)) == [files[40], files[149]]
    assert len(results) == FILES
    assert {r.line for r in results if r.failure is None} < set(alone)


@pytest.mark.parametrize("deaths", [1, 2])
def test_a_file_whose_worker_died_by_chance_gets_its_report(
    deaths: int, files: list[str], alone: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with_crew(monkeypatch, _Mortal({files[77]: deaths}))
    assert sorted_lines(validate_many(files, Options(), jobs=2)) == alone


def test_a_cluster_says_what_one_process_says_also_when_a_worker_is_killed(
    files: list[str], alone: list[str]
) -> None:
    distributed = pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, silence_logs=50
    ) as cluster:
        address = cluster.scheduler_address
        assert sorted_lines(validate_many(files, Options(), scheduler=address)) == alone
        lines = []
        for result in validate_many(files, Options(), scheduler=address):
            lines.append(result.line)
            if len(lines) == 1:
                os.kill(next(iter(cluster.workers.values())).pid, signal.SIGKILL)
        assert sorted(lines) == alone


def test_results_that_were_broken_off_go_on(files: list[str], alone: list[str], tmp_path: Path) -> None:
    place = tmp_path / "results.jsonl"
    with ResultsFile(place, is_resumed=False) as out:
        for result in validate_many(files[:50], Options()):
            out.append(result.line)
    place.write_bytes(place.read_bytes()[:-20])  # as a crash leaves it
    with ResultsFile(place, is_resumed=True) as out:
        assert out.done == set(files[:49])
        assert out.errors == 17
        rest = [path for path in files if path not in out.done]
        for result in validate_many(rest, Options(), jobs=2):
            out.append(result.line)
    assert sorted(place.read_text(encoding="ascii").splitlines()) == alone


def test_a_file_that_holds_no_results_is_left_as_it_is(tmp_path: Path) -> None:
    place = tmp_path / "model.gltf"
    place.write_text('{"asset": {}}\n', encoding="utf-8")
    with pytest.raises(UsageError, match=r"Line 1 of .* is no result"):
        ResultsFile(place, is_resumed=True)
    assert place.read_text(encoding="utf-8") == '{"asset": {}}\n'


def test_no_scheduler_is_a_sentence(files: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    monkeypatch.setattr(crews, "_CONNECT_TIMEOUT_S", 0.2)
    with pytest.raises(UsageError, match="No Dask scheduler answers"):
        list(validate_many(files, Options(), scheduler="tcp://127.0.0.1:1"))


def test_what_listens_and_is_no_scheduler_is_a_sentence(
    files: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed", reason="the extra 'cluster' is not installed")
    monkeypatch.setattr(crews, "_CONNECT_TIMEOUT_S", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as mute:
        port = mute.getsockname()[1]
        with pytest.raises(UsageError, match="No Dask scheduler answers"):
            list(validate_many(files, Options(), scheduler=f"tcp://127.0.0.1:{port}"))
