"""GLSL twins in the benchmark: timed on the renderer that is named, and as good as the methods themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from gltf_iri.bench import glsl
from gltf_iri.planning.method import METHODS
from gltf_iri.rendering.context import renderer_name

if TYPE_CHECKING:
    import moderngl


def test_twins_are_timed_and_as_far_from_the_truth_as_their_methods(
    gl_context: moderngl.Context, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(glsl, "_SIDE", 32)
    rows = glsl.measure_glsl(gl_context, rounds=1)
    films = {row.method: row for row in rows if row.workload == "glsl-films"}
    twins = {m.name for m in METHODS.values() if m.glsl_function and m.domain != "layers"}
    assert twins == {row.method for row in rows}
    assert all(row.backend == renderer_name(gl_context) for row in rows)
    assert films["khr"].delta_e_mean == pytest.approx(METHODS["khr"].delta_e_mean, abs=0.01)
