"""The Python face: small, lazy, and what its docstrings promise."""

from __future__ import annotations

import doctest
import inspect
import json
import subprocess
import sys
from pathlib import Path
from types import ModuleType

import numpy as np
import pytest

import gltf_iri
from gltf_iri.colour.spaces import WHITES
from gltf_iri.errors import AssetError, UsageError
from gltf_iri.evaluation.film import Film, base_from_dispersion, base_from_f0, base_from_ior
from gltf_iri.evaluation.registry import evaluate as evaluate_film
from gltf_iri.material.ior import Ior
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material
from gltf_iri.planning.method import DEFAULT_METHOD, METHODS
from gltf_iri.scene.environment import white

ROOT = Path(__file__).parents[1]
FILMS = [method.name for method in METHODS.values() if method.domain == "film"]
TRIANGLE = {
    "asset": {"version": "2.0"},
    "scene": 0,
    "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "materials": [{"extensions": {"KHR_materials_iridescence": {"iridescenceFactor": 1.0}}}],
    "accessors": [
        {
            "bufferView": 0,
            "componentType": 5126,
            "count": 3,
            "type": "VEC3",
            "min": [0, 0, 0],
            "max": [1, 1, 0],
        }
    ],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri": "triangle.bin"}],
}


def copper(wavelength_nm):
    return 0.3 + 1j * wavelength_nm / 200.0


@pytest.fixture
def model(tmp_path):
    np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype="<f4").tofile(tmp_path / "triangle.bin")
    (tmp_path / "triangle.gltf").write_text(json.dumps(TRIANGLE), encoding="utf-8")
    return gltf_iri.load(tmp_path / "triangle.gltf")


def test_all_names_exactly_what_is_exported():
    public = {
        name
        for name, value in vars(gltf_iri).items()
        if not isinstance(value, ModuleType) and name != "annotations" and not name.startswith("_")
    }
    assert public | {"__version__"} == set(gltf_iri.__all__)


def test_importing_the_package_imports_nothing_heavy():
    code = "import sys, gltf_iri; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert not {"numpy", "click", "moderngl", "rich", "PIL"} & set(done.stdout.split())


def test_the_examples_in_the_docstring_hold():
    results = doctest.testmod(gltf_iri)
    assert results.attempted > 0
    assert results.failed == 0


@pytest.mark.parametrize("method", FILMS)
def test_evaluate_broadcasts_like_numpy(method):
    rgb = gltf_iri.evaluate(
        method,
        cos_theta_1=np.linspace(0.1, 1.0, 4)[:, None],
        thickness_nm=[0.0, 300.0],
        base_f0=[0.9, 0.6, 0.3],
    ).rgb
    assert rgb.shape == (4, 2, 3)
    one = gltf_iri.evaluate(method, cos_theta_1=1.0, thickness_nm=300.0, base_f0=[0.9, 0.6, 0.3]).rgb
    assert one.shape == (3,)
    np.testing.assert_allclose(rgb[3, 1], one, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    ("given", "base"),
    [
        ({}, base_from_ior(1.5)),
        ({"base_ior": 1.8}, base_from_ior(1.8)),
        ({"base_f0": 0.5}, base_from_f0([0.5, 0.5, 0.5])),
        ({"base_nk": [0.2, 3.0]}, base_from_ior(0.2 + 3.0j)),
        ({"base_ior": copper}, base_from_dispersion(copper)),
    ],
)
def test_each_way_to_give_the_base_is_that_base(given, base):
    expected = evaluate_film("spectral", Film.of(0.5, 400.0, 1.3, base), white="E").rgb
    seen = gltf_iri.evaluate("spectral", cos_theta_1=0.5, thickness_nm=400.0, white="E", **given).rgb
    np.testing.assert_array_equal(seen, expected)


@pytest.mark.parametrize(
    "wrong",
    [
        {"base_f0": 0.5, "base_ior": 1.5},
        {"base_nk": 1.5},
        {"base_f0": 1.5},
        {"cos_theta_1": 1.5},
        {"thickness_nm": -1.0},
        {"white": "A"},
        {"method": "airy"},
    ],
)
def test_a_wrong_call_raises_usage_error(wrong):
    with pytest.raises(UsageError):
        gltf_iri.evaluate(**({"method": "khr", "cos_theta_1": 1.0, "thickness_nm": 400.0} | wrong))


@pytest.mark.parametrize(
    "wrong",
    [
        {"thickness_nm": 400.0},
        {"film_ior": 1.3},
        {"outside_ior": 1.0},
        {"base_ior": 1.5},
        {"bragg": (1.5, 1.6, 90.0, 80.0)},
        {"bragg": (1.5, 1.6, 90.0, 80.0, 5, 1.0)},
        {"bragg": 1.5},
        {"bragg": (1.5, 1.6, 90.0, 80.0, 2.5)},
        {"method": "khr"},
        {"method": "bloch", "parameters": {"samples": None}},
        {"method": "bloch", "bragg": (1.5, 1.6 + 0.1j, 90.0, 80.0, 5)},
        {"backend": "gpu"},
    ],
    ids=str,
)
def test_nothing_said_of_a_mirror_is_ignored(wrong):
    with pytest.raises(UsageError):
        gltf_iri.evaluate(**({"cos_theta_1": 1.0, "bragg": (1.5, 1.6, 90.0, 80.0, 5)} | wrong))


def test_a_host_is_a_mirrors_alone():
    with pytest.raises(UsageError, match="outside_ior"):
        gltf_iri.evaluate(cos_theta_1=1.0, thickness_nm=300.0, host_ior=1.0)
    with pytest.raises(UsageError, match="thickness_nm"):
        gltf_iri.evaluate(cos_theta_1=1.0)


def test_a_mirror_is_the_same_from_tuple_and_array():
    cell = (1.5, 1.6, 90.0, 80.0, 5)
    seen = [gltf_iri.evaluate(cos_theta_1=0.5, bragg=given).rgb for given in (cell, np.array(cell))]
    np.testing.assert_array_equal(*seen)


def test_what_evaluate_takes_for_granted_is_gltfs():
    defaults = {name: p.default for name, p in inspect.signature(gltf_iri.evaluate).parameters.items()}
    film = {"cos_theta_1": 0.5, "thickness_nm": 300.0}
    said = gltf_iri.evaluate(**film, film_ior=Iridescence().film_ior, outside_ior=1.0, base_ior=Ior().ior)
    np.testing.assert_array_equal(gltf_iri.evaluate(**film).rgb, said.rgb)
    assert gltf_iri.evaluate(cos_theta_1=1.0, thickness_nm=300.0).method == DEFAULT_METHOD
    assert defaults["white"] == WHITES[0]


def test_plan_takes_a_material_and_a_method():
    film = Material(name="shell", iridescence=Iridescence(factor=1.0))
    assert gltf_iri.plan(film).method == "khr-guarded"
    plan = gltf_iri.plan(film, index=3, method="khr")
    assert (plan.name, plan.index, plan.method) == ("shell", 3, "khr")


def test_load_gives_materials_and_refuses_what_is_not_there(model, tmp_path):
    assert model.materials[0].iridescence == Iridescence(factor=1.0)
    with pytest.raises(UsageError):
        gltf_iri.load(tmp_path / "nothing.glb")


def test_validate_takes_a_path_or_bytes_and_reports(model, tmp_path):
    report = gltf_iri.validate(tmp_path / "triangle.gltf", only={"ACCESSOR_MAX_MISMATCH"})
    assert (report.uri, report.has_errors, report.issues) == (str(tmp_path / "triangle.gltf"), False, ())
    data = (tmp_path / "triangle.gltf").read_bytes()
    assert [issue.code for issue in gltf_iri.validate(data, only=["IO_ERROR"]).issues] == ["IO_ERROR"]
    found = gltf_iri.validate(data, folder=tmp_path, uri="a.gltf", only=["IO_ERROR"])
    assert (found.uri, found.issues) == ("a.gltf", ())
    assert gltf_iri.validate(b"[", override={"INVALID_JSON": 1}).counts == (0, 1, 0, 0)
    with pytest.raises(UsageError):
        gltf_iri.validate(tmp_path / "nothing.glb")


def test_validate_takes_severities_by_name():
    assert gltf_iri.validate(b"[", override={"INVALID_JSON": "hint"}).counts == (0, 0, 0, 1)


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"ignore": ["INVALID_JASON"]}, "the nearest is 'INVALID_JSON'"),
        ({"only": "INVALID_JSON"}, "only takes a list of codes"),
        ({"ignore": ["NODE_EMPTY"], "only": ["NODE_LOOP"]}, "exclude each other"),
        ({"override": {"NODE_EMPTY": "awful"}}, "override, NODE_EMPTY: 'awful' is no severity"),
        ({"override": {"NODE_EMPTY": 4}}, "4 is no severity"),
        ({"override": {"NODE_ENTY": 0}}, "override: there is no code"),
        ({"max_issues": -1}, "max_issues must be a whole number"),
    ],
)
def test_validate_refuses_what_would_change_nothing_or_too_much(wrong, told):
    with pytest.raises(UsageError, match=told):
        gltf_iri.validate(b"[", **wrong)


@pytest.mark.gl
def test_render_draws_the_scene_and_leaves_the_background(model, gl_context):
    frame = gltf_iri.render(model, size=(40, 30), environment=white(), method="khr")
    gl_context.__enter__()  # a context that is released leaves none current
    assert frame.rgba.shape == (30, 40, 4)
    assert frame.rgba.dtype == np.float32
    assert np.isfinite(frame.rgba).all()
    assert frame.rgba[:, :, :3].max() > 0.0
    assert frame.renderer


@pytest.mark.parametrize("wrong", [{"camera": 0}, {"method": "airy"}, {"environment": "no/such.hdr"}])
def test_render_refuses_what_does_not_exist_before_it_asks_for_opengl(model, monkeypatch, wrong):
    def no_opengl():
        raise AssertionError("OpenGL was asked for")

    monkeypatch.setattr("gltf_iri.rendering.context.create_context", no_opengl)
    with pytest.raises(UsageError):
        gltf_iri.render(model, **wrong)


def test_render_refuses_geometry_that_is_missing(model, tmp_path):
    (tmp_path / "triangle.bin").unlink()
    with pytest.raises(AssetError, match=r"triangle\.bin"):
        gltf_iri.render(model)
