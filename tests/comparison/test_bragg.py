"""Bragg layers: GLSL against the spectral reference, Python's twin, the report, and the command."""

from __future__ import annotations

import json
import runpy
from dataclasses import replace
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from gltf_iri.baking.layer_fill import bake_layer_plans
from gltf_iri.budgets.plans import plans_within
from gltf_iri.cli.main import run
from gltf_iri.comparison.metric import colour_error
from gltf_iri.comparison.reference_judge import same_surface
from gltf_iri.comparison.reference_run import against_reference
from gltf_iri.comparison.report import report_html
from gltf_iri.comparison.rig import rig
from gltf_iri.comparison.run import compare
from gltf_iri.errors import UsageError
from gltf_iri.planning.decide import plan_materials
from gltf_iri.reference.render import render_reference
from gltf_iri.resources import spec_root
from gltf_iri.scene.environment import white
from gltf_iri.scene.framing import frame_scene
from gltf_iri.scene.load import load
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

# The balls that the renderer's own tests draw.
_BALLS = runpy.run_path(str(Path(__file__).resolve().parents[1] / "rendering" / "bragg_files.py"))
MATERIALS, bragg_ball = _BALLS["MATERIALS"], _BALLS["bragg_ball"]

SIZE = (32, 32)
BUDGET = 1.0


@pytest.fixture
def staged(tmp_path):
    """Load one of the balls under the rig: what both renderers take, without plans."""

    def build(name, **changes):
        model = load(bragg_ball(tmp_path, name, **changes))
        scene = model.scene()
        camera = frame_scene(scene, aspect=1.0)
        return model, replace(scene, lights=rig(scene, camera)), camera

    return build


@pytest.mark.parametrize("name", MATERIALS)
def test_glsl_within_a_budget_is_the_spectral_reference(gl_context, renderer, staged, name, record_property):
    """ΔE p95 ≤ 1 under the rig, where both solve the same problem and only the method errs."""
    model, scene, camera = staged(name)
    plans = plans_within(model, scene, BUDGET, size_pixels=SIZE[0] * SIZE[1], has_image_light=False)
    tables = bake_layer_plans(plans)
    frame = renderer.render(
        model,
        scene,
        plans,
        camera,
        None,
        size=SIZE,
        float_textures=True,
        sharp_textures=True,
        with_inputs=True,
        layer_tables=tables,
    )
    truth = render_reference(model, scene, plans, camera, None, size=SIZE, lighting="punctual", processes=1)
    same = same_surface(frame.inputs, truth, camera)
    error = colour_error(frame.inputs.colour[same].astype(np.float64), truth.rgba[same][:, :3])
    chosen = plans[0].layers
    record_property("measured", f"{name}: ΔE p95 {error.delta_e_p95:.2g}, {chosen.method}, {chosen.tables}")
    assert error.pixels > 400
    assert error.delta_e_p95 <= BUDGET


@pytest.mark.parametrize("name", ["two over metal", "coated"])
def test_in_a_white_room_image_light_is_the_spectral_reference(
    gl_context, renderer, staged, name, record_property
):
    """There the split sum is exact: what each lobe sends is its own integral."""
    model, scene, camera = staged(name)
    plans = plan_materials(model.materials, document=model.document, scene=scene)
    tables, room = bake_layer_plans(plans), white()
    options = {"float_textures": True, "sharp_textures": True, "with_inputs": True, "layer_tables": tables}
    dark = replace(scene, lights=())
    frame = renderer.render(model, dark, plans, camera, room, size=(12, 12), **options)
    truth = render_reference(
        model, dark, plans, camera, room, size=(12, 12), lighting="image", image_samples=4096, processes=1
    )
    same = same_surface(frame.inputs, truth, camera)
    error = colour_error(frame.inputs.colour[same].astype(np.float64), truth.rgba[same][:, :3])
    record_property("measured", f"{name} in a white room: ΔE p95 {error.delta_e_p95:.2g}")
    assert error.pixels > 60
    assert error.delta_e_p95 <= 0.3


@pytest.fixture
def compared(gl_context, renderer, studio_light, staged):
    """Draw a ball under the rig and the studio, by the plan's default, and compare."""

    def build(name, **changes):
        model, scene, camera = staged(name, **changes)
        plans = plan_materials(model.materials, document=model.document, scene=scene)
        tables = bake_layer_plans(plans)
        return compare(renderer, model, scene, plans, camera, studio_light, size=SIZE, layer_tables=tables)

    return build


def test_python_shades_the_pixels_as_glsl_does_and_the_report_tells_of_the_layers(compared):
    comparison = compared("painted")
    (material,) = comparison.materials
    assert material.glsl_vs_python.rough.pixels > 400
    assert material.glsl_vs_python.rough.within(GLSL_PIXEL_RELATIVE)
    assert 0.0 < material.method_vs_truth.delta_e_p95 < 1.0
    assert (material.method_white, material.truth_white) == ("D65", "D65")
    schema = json.loads((spec_root() / "report.schema.json").read_text())
    jsonschema.Draft202012Validator(schema).validate(comparison.to_json())
    names = ("glsl", "python", "truth", "difference_glsl_python", "difference_method_truth")
    page = report_html(comparison, dict.fromkeys(names, b""))
    assert "layers-bands: D65" in page and "None: D65" not in page
    assert "Layers against truth" in page and "film" not in page.lower()


def test_under_a_coating_pixels_are_reported_and_not_judged(compared):
    """Its highlight is as narrow as can be, which float32 does not follow."""
    split = compared("coated").materials[0].glsl_vs_python
    assert split.rough.pixels == 0
    assert split.smooth.max_relative < GLSL_PIXEL_RELATIVE


def test_rays_with_the_same_tables_agree(gl_context, renderer, staged):
    model, scene, camera = staged("beetle")
    plans = plan_materials(model.materials, document=model.document, scene=scene)
    held = against_reference(
        renderer, model, scene, plans, camera, None, size=SIZE, layer_tables=bake_layer_plans(plans)
    )
    assert held.same_problem.rough.pixels > 400
    assert held.agrees


def test_tables_that_a_plan_wants_must_be_there(staged):
    model, scene, camera = staged("beetle")
    plans = plan_materials(model.materials, document=model.document, scene=scene)
    with pytest.raises(UsageError, match="bake_layer_plans"):
        render_reference(model, scene, plans, camera, None, size=SIZE, layer_method=None)


def test_command_compares_layers_within_a_budget(gl_context, tmp_path, capsys):
    path = bragg_ball(tmp_path, "beetle")
    arguments = [
        "compare",
        str(path),
        "-o",
        str(tmp_path / "out"),
        "--size",
        "32x24",
        "--budget",
        "1",
        "--json",
    ]
    assert run(arguments) == 0
    printed = json.loads(capsys.readouterr().out)
    schema = json.loads((spec_root() / "report.schema.json").read_text())
    jsonschema.Draft202012Validator(schema).validate(printed)
    assert printed["materials"][0]["layers"]["method"].startswith("layers-")
