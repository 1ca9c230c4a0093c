"""Whole scenes, drawn by OpenGL: GLSL against Python on every pixel, and the command that says so."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from gltf_iri.cli.main import run
from gltf_iri.comparison import judge as judge_module
from gltf_iri.comparison.run import compare
from gltf_iri.planning.decide import plan_materials
from gltf_iri.resources import spec_root
from gltf_iri.samples.collection import write_samples
from gltf_iri.scene.framing import frame_scene
from gltf_iri.scene.load import load
from gltf_iri.scene.model import Light
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

SIZE = (96, 96)
SAMPLES = ("oil-on-metal", "pearl", "thickness-swatches", "angle-fan")
SHARED = (
    "iridescence/IridescenceSuzanne/glTF-Binary/IridescenceSuzanne.glb",
    "iridescence/IridescenceLamp/glTF/IridescenceLamp.gltf",
    "iridescence/AnimationPointer/24_animation_pointer.gltf",
    "plain/MetalRoughSpheresNoTextures/MetalRoughSpheresNoTextures.glb",
)

# From the upper left, so that facets of every tilt are lit; near enough for its distance to matter.
LIGHTS = (
    Light("sun", "directional", (1.0, 0.9, 0.8), 2.0, np.zeros(3), np.array([0.48, -0.6, -0.64])),
    Light("bulb", "point", (0.5, 0.7, 1.0), 3.0, np.array([1.0, 1.5, 2.0]), np.array([0.0, 0.0, -1.0])),
)


@pytest.fixture(scope="session")
def samples(tmp_path_factory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("samples")
    models = [path for path in write_samples(folder) if path.suffix in (".gltf", ".glb")]
    return {path.parent.name: path for path in models}


@pytest.fixture
def compared(gl_context, renderer, studio_light):
    """Draw a file under its own lights, `LIGHTS` and the studio, and compare."""

    def build(path: Path, method: str | None = None):
        model = load(path)
        scene = model.scene()
        scene = replace(scene, lights=(*scene.lights, *LIGHTS))
        plans = plan_materials(model.materials, method=method)
        camera = frame_scene(scene, aspect=1.0)
        return compare(renderer, model, scene, plans, camera, studio_light, size=SIZE)

    return build


def check(comparison, record_property) -> None:
    split = comparison.whole.glsl_vs_python
    figures = f"rough {split.rough.max_relative} on {split.rough.pixels} pixels, "
    figures += f"smooth {split.smooth.max_relative} on {split.smooth.pixels}"
    record_property("measured", f"GLSL − Python, {comparison.file}: {figures}")
    assert split.all.pixels > 0.05 * SIZE[0] * SIZE[1], "too little of the scene is on the picture"
    for material in comparison.materials:
        assert material.glsl_vs_python.rough.within(GLSL_PIXEL_RELATIVE), material.plan.name
        assert material.left_out == 0


@pytest.mark.parametrize("method", ["khr", "khr-guarded"])
@pytest.mark.parametrize("name", SAMPLES)
def test_glsl_is_python_on_every_pixel_of_a_sample(compared, samples, name, method, record_property) -> None:
    check(compared(samples[name], method), record_property)


@pytest.mark.parametrize("name", SHARED)
def test_glsl_is_python_on_every_pixel_of_a_real_asset(compared, shared_dir, name, record_property) -> None:
    check(compared(shared_dir / "assets" / name), record_property)


def test_command_writes_a_valid_report_and_ends_with_0(gl_context, samples, tmp_path, capsys) -> None:
    arguments = ["compare", str(samples["oil-on-metal"]), "-o", str(tmp_path), "--size", "48x32", "--json"]
    assert run(arguments) == 0
    printed = json.loads(capsys.readouterr().out)
    schema = json.loads((spec_root() / "report.schema.json").read_text())
    jsonschema.Draft202012Validator(schema).validate(printed)
    assert Path(printed["files"]["page"]).read_text().startswith("<!doctype html>")
    assert printed["setup"]["size"] == [48, 32]


def test_command_ends_with_1_where_the_two_disagree(
    gl_context, samples, tmp_path, capsys, monkeypatch
) -> None:
    exact = judge_module.shade

    def a_little_brighter(*arguments):
        shading = exact(*arguments)
        return replace(shading, rgb=shading.rgb + 0.01)

    monkeypatch.setattr(judge_module, "shade", a_little_brighter)
    assert run(["compare", str(samples["pearl"]), "-o", str(tmp_path), "--size", "48x32"]) == 1
    assert "GLSL and Python disagree" in capsys.readouterr().err
    assert "disagree" in (tmp_path / "index.html").read_text()
