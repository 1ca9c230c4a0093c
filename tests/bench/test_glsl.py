"""GLSL twins in the benchmark: timed on the renderer that is named, and as good as the methods themselves."""

from __future__ import annotations

import pytest

from gltf_iri.bench import glsl
from gltf_iri.planning.method import METHODS
from gltf_iri.rendering.context import create_context, renderer_name

pytestmark = pytest.mark.gl


def test_twins_are_timed_and_as_far_from_the_truth_as_their_methods(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(glsl, "_SIDE", 32)
    context = create_context()
    rows = glsl.measure_glsl(context, rounds=1)
    films = {row.method: row for row in rows if row.workload == "glsl-films"}
    assert {name for name, method in METHODS.items() if method.glsl_function} == {row.method for row in rows}
    assert all(row.backend == renderer_name(context) for row in rows)
    assert films["khr"].delta_e_mean == pytest.approx(METHODS["khr"].delta_e_mean, abs=0.01)
    context.release()
