"""What the workload of the validator times is what it says: sound files, judged whole."""

from __future__ import annotations

import pytest

from gltf_iri.bench import validator
from gltf_iri.errors import MissingCapabilityError
from gltf_iri.validation.validate import validate


def test_the_files_are_without_faults(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(validator, "_MANY_VERTICES", 1000)
    for data in (validator._triangle(), validator._million()):
        assert validate(data).issues == ()


def test_every_file_is_judged() -> None:
    row = validator.measure_many(2, files=70)
    assert (row.files, row.jobs) == (70, 2)
    assert row.files_per_s > 0.0


def test_theirs_is_left_out_where_it_is_not_installed(monkeypatch: pytest.MonkeyPatch) -> None:
    def absent() -> None:
        raise MissingCapabilityError("It is not there.")

    monkeypatch.setattr(validator, "find_khronos", absent)
    monkeypatch.setattr(validator, "_MANY_VERTICES", 1000)
    rows, reason = validator.measure_processes(1)
    assert reason == "It is not there."
    assert [row.file for row in rows] == ["triangle.gltf", "million-vertices.glb"]
    assert all(row.ms > 0.0 and row.ratio is None for row in rows)
