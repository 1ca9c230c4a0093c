"""The validator has a report for every file, whatever is in it."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from built import documents
from hypothesis import HealthCheck, given, settings
from mutate import break_gltf
from soundness import faults
from victims import assets

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


def test_the_same_file_gets_the_same_report() -> None:
    for path in SAMPLES[:3]:
        assert validate(path).to_json() == validate(path).to_json()
