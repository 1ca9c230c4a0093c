"""The report: valid JSON, and a page that stands alone and trusts no name."""

from __future__ import annotations

import errno
import json
import os
import re
from dataclasses import replace

import jsonschema
import numpy as np
import pytest

from gltf_iri.comparison.metric import agreement
from gltf_iri.comparison.reference_judge import noisy_error
from gltf_iri.comparison.reference_result import ReferenceMaterial, ReferenceResult, SameProblem
from gltf_iri.comparison.report import report_html, write_report
from gltf_iri.errors import UsageError
from gltf_iri.resources import spec_root

HOSTILE = """<script>alert(1)</script>" onload='x' {{ 7*7 }} <img src=http://x.example/>"""


@pytest.fixture
def written(judged, tmp_path):
    comparison = judged(name=HOSTILE)
    return comparison, write_report(comparison, tmp_path / "new" / "folder")


def test_report_is_valid_against_its_schema(written) -> None:
    _, paths = written
    schema = json.loads((spec_root() / "report.schema.json").read_text())
    jsonschema.Draft202012Validator.check_schema(schema)
    jsonschema.Draft202012Validator(schema).validate(json.loads(paths["report"].read_text()))


def test_every_file_is_there_and_nothing_is_left_over(written) -> None:
    _, paths = written
    folder = paths["report"].parent
    assert {path.name for path in folder.iterdir()} == {path.name for path in paths.values()}
    for name in ("glsl", "python", "truth", "difference_glsl_python", "difference_method_truth"):
        assert paths[name].read_bytes().startswith(b"\x89PNG")


def test_a_full_disk_leaves_the_report_before_as_it_was(written, judged, monkeypatch) -> None:
    folder = written[1]["report"].parent
    before = {path: path.read_bytes() for path in folder.iterdir()}
    opened = []

    def fdopen(handle, mode):
        opened.append(handle)
        if len(opened) == len(before):
            os.close(handle)
            raise OSError(errno.ENOSPC, "No space left on device")
        return os_fdopen(handle, mode)

    os_fdopen = os.fdopen
    monkeypatch.setattr(os, "fdopen", fdopen)
    with pytest.raises(UsageError, match="cannot be written to: No space left on device"):
        write_report(judged(name="another"), folder)
    assert {path: path.read_bytes() for path in folder.iterdir()} == before


def test_a_file_whose_name_is_not_utf_8_is_reported(judged, tmp_path) -> None:
    name = os.fsdecode(b"caf\xe9.glb")
    paths = write_report(replace(judged(), file=name), tmp_path)
    assert json.loads(paths["report"].read_text(encoding="utf-8"))["file"] == name
    assert "caf?.glb" in paths["page"].read_text(encoding="utf-8")


def test_a_hostile_material_name_stays_text(written) -> None:
    page = written[1]["page"].read_text()
    assert "<script" not in page
    assert "&lt;script&gt;alert(1)&lt;/script&gt;" in page
    assert "{{ 7*7 }}" in page


@pytest.fixture
def held(judged):
    """A comparison with the reference beside it, which sees what OpenGL drew, but for noise."""
    comparison = judged(name=HOSTILE)
    shown = comparison.pictures
    nothing = agreement(np.zeros((0, 3)), np.zeros((0, 3)))
    same = SameProblem(agreement(shown.glsl[shown.drawn], shown.python[shown.drawn]), nothing, 1, 0)
    noisy = noisy_error(shown.glsl, shown.glsl, 0.01 * shown.glsl, shown.drawn, 1.0)
    none = noisy_error(shown.glsl, shown.glsl, shown.glsl, ~shown.drawn, 1.0)
    result = ReferenceResult(
        lights=HOSTILE,
        samples={"image_samples": 16, "paths": 4},
        seconds=1.5,
        same_problem=same,
        opaque=noisy,
        see_through=none,
        whole=noisy,
        materials=(ReferenceMaterial(0, HOSTILE, False, same, noisy),),
        glsl=shown.glsl,
        picture=shown.glsl,
        drawn=shown.drawn,
        delta_e=shown.delta_e,
    )
    return replace(comparison, reference=result)


def test_the_reference_is_in_the_report_where_it_was_asked_for(held, tmp_path) -> None:
    paths = write_report(held, tmp_path)
    schema = json.loads((spec_root() / "report.schema.json").read_text())
    report = json.loads(paths["report"].read_text())
    jsonschema.Draft202012Validator(schema).validate(report)
    assert report["reference"]["whole"]["noise_delta_e_mean"] > report["reference"]["whole"]["delta_e_mean"]
    assert report["reference"]["see_through"]["delta_e_mean"] is None
    page = paths["page"].read_text()
    assert "Where both solve the same problem, OpenGL and the reference are at most" in page
    assert "<script" not in page
    for name in ("drawn", "reference", "difference_reference"):
        assert paths[name].read_bytes().startswith(b"\x89PNG")


def test_page_loads_nothing_from_anywhere(written) -> None:
    page = written[1]["page"].read_text()
    sources = re.findall(r"(?:src|href)=[\"']?([^\"'\s>]{5})", page.replace("&lt;img src=http", ""))
    assert sources and set(sources) == {"data:"}
    assert "default-src 'none'" in page


def test_a_disagreement_is_said_in_the_first_line(judged) -> None:
    images = dict.fromkeys(
        ("glsl", "python", "truth", "difference_glsl_python", "difference_method_truth"), b""
    )
    assert "GLSL and Python disagree" in report_html(judged(0.1), images)
    assert "GLSL and Python agree" in report_html(judged(), images)
