"""The validator has a report for every file, whatever is in it."""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from built import documents
from hypothesis import HealthCheck, given, settings
from mutate import break_gltf
from soundness import faults
from test_hostile import HERE, MOST_ADDRESSES, MOST_MEMORY, MOST_SECONDS
from victims import assets
from write import FOLDER
from wrong.crowds import CROWDS
from wrong.large import LARGE

from gltf_iri.validation.options import Options
from gltf_iri.validation.validate import validate

SAMPLES = assets([Path(__file__).resolve().parents[2] / "samples"])
ALL = Options(max_issues=0)


@settings(max_examples=60, deadline=None, suppress_health_check=list(HealthCheck))
@given(documents())
def test_every_report_on_built_documents_holds_together(data: bytes) -> None:
    assert list(faults(validate(data, options=ALL), data)) == []


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_every_report_on_broken_assets_holds_together(path: Path) -> None:
    chance = random.Random(path.name)
    for _ in range(25):
        data = break_gltf(path.read_bytes(), chance, is_glb=path.suffix == ".glb")
        assert list(faults(validate(data, folder=path.parent, options=ALL), data)) == []


def test_every_hostile_file_gets_its_report() -> None:
    for path in FOLDER.iterdir():
        assert list(faults(validate(path, options=ALL), path.read_bytes())) == [], path.name


@pytest.mark.skipif(sys.platform != "linux", reason="memory is read from /proc")
def test_every_hostile_file_that_is_large_gets_its_report_within_bounds(
    tmp_path: Path, record_property: Callable[[str, object], None]
) -> None:
    paths = []
    for name, write in {**LARGE, **CROWDS}.items():
        paths.append(tmp_path / Path(name).stem / name)
        paths[-1].parent.mkdir()
        write(paths[-1])
    script = [sys.executable, str(HERE / "verdicts.py"), str(MOST_ADDRESSES), str(MOST_SECONDS)]
    environment = {"OPENBLAS_NUM_THREADS": "1", "PYTHONPATH": str(HERE.parents[1])}
    call = [*script, *map(str, paths)]
    done = subprocess.run(call, capture_output=True, text=True, check=True, env=environment)
    costs = [json.loads(line) for line in done.stdout.splitlines()]

    slowest = max(costs, key=lambda cost: cost["seconds"])
    largest = max(costs, key=lambda cost: cost["bytes"])
    record_property(
        "measured",
        f"{len(costs)} reports on hostile files: slowest {slowest['file']} with {slowest['seconds']:.2f} s, "
        f"largest {largest['file']} with {largest['bytes'] / 2**20:.0f} MiB",
    )
    assert [cost["file"] for cost in costs] == [path.name for path in paths]
    assert {cost["file"] for cost in costs if cost["end"] != "accepted"} == set()
    # A file's own bytes stand beside it: those of most are few.
    for cost, path in zip(costs, paths, strict=True):
        assert cost["bytes"] < MOST_MEMORY + path.stat().st_size, path.name


def test_the_same_file_gets_the_same_report() -> None:
    for path in SAMPLES[:3]:
        assert validate(path).to_json() == validate(path).to_json()
