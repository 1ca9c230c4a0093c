"""Films with a way: Python shades with the same tables, and image light's truth is the mean over facets."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import jsonschema
import numpy as np
import pytest

from gltf_iri.baking.fill import bake_plans
from gltf_iri.comparison.report import write_report
from gltf_iri.comparison.rig import rig
from gltf_iri.comparison.run import compare
from gltf_iri.comparison.truth import averaged_truth
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.facet_mean import facet_cosines, facet_mean
from gltf_iri.optics.microfacet import alpha_ggx
from gltf_iri.planning.decide import plan_material
from gltf_iri.planning.film_table import FilmTable, TableAxis
from gltf_iri.planning.reach import Span
from gltf_iri.planning.way import Way
from gltf_iri.reference.film_on import Facets, Sight
from gltf_iri.reference.render import render_reference
from gltf_iri.resources import spec_root
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sphere import sphere
from gltf_iri.scene.framing import frame_scene
from gltf_iri.scene.load import load
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

SIZE = (32, 32)
ROUGHNESS = 0.6
BASE = (0.9, 0.6, 0.3)
FILM_IOR = 1.4
THICKNESS_NM = Span(250.0, 500.0)


def ball(folder: Path, *, is_textured=False) -> Path:
    """A ball whose film lies over both lobes; its thickness wavers where it is textured."""
    builder = GLTFBuilder("ball")
    u, v = texel_centres(16, 16)
    waves = np.stack([0.65 + 0.35 * np.sin(2.0 * np.pi * (n * u + v)) for n in (1, 2, 3)], axis=-1)
    builder.texture("waves", encode_png(to_bytes(waves)), repeat=True)
    film = {
        "iridescenceFactor": 0.9,
        "iridescenceIor": FILM_IOR,
        "iridescenceThicknessMinimum": THICKNESS_NM.low,
        "iridescenceThicknessMaximum": THICKNESS_NM.high,
    }
    if is_textured:
        film["iridescenceThicknessTexture"] = {"index": 0}
    material = builder.material(
        "ball",
        base_color=BASE,
        metallic=0.6,
        roughness=ROUGHNESS,
        extensions={"KHR_materials_iridescence": film},
    )
    builder.mesh("ball", sphere(1.0, rings=24, segments=48), material)
    (content,) = builder.to_glb().values()
    path = folder / "ball.glb"
    path.write_bytes(content)
    return path


def tables_of(quantities, nodes):
    spans = {
        "cos_theta": Span(0.0, 1.0),
        "thickness_nm": THICKNESS_NM,
        "base_f0": Span(0.0, 1.0),
        "roughness": Span(0.0, ROUGHNESS),
        "spread_nm": Span(0.0, 60.0),
    }
    thickness_nm = THICKNESS_NM.high
    return tuple(
        FilmTable(
            lobe,
            FILM_IOR,
            thickness_nm,
            base,
            tuple(TableAxis(q, spans[q], n) for q, n in zip(("cos_theta", *quantities), nodes, strict=True)),
            "f4",
            0.0,
        )
        for lobe, base in (("dielectric", (0.04,) * 3), ("metal", BASE))
    )


@pytest.fixture
def compared(gl_context, renderer, studio_light):
    """Draw a file under a rig and the studio, by `way`, and compare."""

    def build(path, way, *, lights=True):
        model = load(path)
        scene = model.scene()
        camera = frame_scene(scene, aspect=1.0)
        scene = replace(scene, lights=rig(scene, camera) if lights else ())
        plans = [plan_material(model.materials[0], 0, way=way, way_reason="for a test")]
        tables = bake_plans(plans)
        return compare(renderer, model, scene, plans, camera, studio_light, size=SIZE, tables=tables)

    return build


WAYS = {
    "directly, by a coarse series": (False, Way("fourier", {"tolerance": 0.01})),
    "a table of spreads": (
        True,
        Way("spectral", tables=tables_of(("thickness_nm", "spread_nm"), (17, 17, 4))),
    ),
    "a spread, directly": (True, Way("fourier")),
}
ONE_DIRECTION = Way("spectral", tables=tables_of((), (129,)))
ROUGH_FACETS = Way("spectral", tables=tables_of(("roughness",), (129, 9)))


def agreement_of(comparison):
    rough = comparison.whole.glsl_vs_python.rough
    assert rough.pixels > 0.5 * SIZE[0] * SIZE[1]
    assert rough.within(GLSL_PIXEL_RELATIVE)
    return f"{rough.max_relative} on {rough.pixels} pixels"


@pytest.mark.parametrize("name", WAYS)
def test_glsl_is_python_whatever_the_way(compared, tmp_path, name, record_property) -> None:
    is_textured, way = WAYS[name]
    comparison = compared(ball(tmp_path, is_textured=is_textured), way)
    record_property("measured", f"GLSL − Python, {name}: {agreement_of(comparison)}")
    schema = json.loads((spec_root() / "report.schema.json").read_text(encoding="utf-8"))
    jsonschema.validate(comparison.to_json(), schema)


def test_only_the_mean_over_facets_draws_image_light_on_a_rough_film(
    compared, tmp_path, record_property
) -> None:
    path = ball(tmp_path)
    errors = []
    for way in (ONE_DIRECTION, ROUGH_FACETS):
        comparison = compared(path, way, lights=False)
        record_property("measured", f"GLSL − Python, {way.label}: {agreement_of(comparison)}")
        errors.append(comparison.whole.picture_vs_truth.delta_e_p95)
    page = write_report(comparison, tmp_path / "report")["page"].read_text(encoding="utf-8")
    told = "table of 2 axes, filled by spectral; over the dielectric RGBA32F, 129 cos_theta × 9 roughness"
    assert told in page
    assert errors[1] < 0.05
    assert errors[0] > 4.0 * errors[1]


def test_a_comparison_without_the_tables_of_a_way_is_refused(gl_context, renderer, tmp_path) -> None:
    model = load(ball(tmp_path))
    scene = model.scene()
    plans = [plan_material(model.materials[0], 0, way=ONE_DIRECTION)]
    with pytest.raises(UsageError, match="film over its dielectric under D65, and none was given"):
        compare(renderer, model, scene, plans, frame_scene(scene, aspect=1.0), None, size=(8, 8))


@pytest.mark.parametrize("thickest_nm", [600.0, 4000.0])
def test_the_truth_of_image_light_is_the_mean_over_facets(thickest_nm) -> None:
    """By a quadrature four times as fine, of the spectral truth itself."""
    rng = np.random.default_rng(7)
    count = 6
    n_dot_v, roughness = rng.uniform(0.05, 1.0, count), rng.uniform(0.1, 1.0, count)
    thickness_nm, f0 = rng.uniform(50.0, thickest_nm, count), rng.uniform(0.0, 0.95, (count, 3))
    film = Film.of(n_dot_v, thickness_nm, FILM_IOR, base_from_f0(f0))
    sight = Sight("metal", np.zeros(count), Facets(roughness, n_dot_v))
    cosines, weights = facet_cosines(n_dot_v, alpha_ggx(roughness), slopes=40, turns=12)
    each = Film.of(cosines, thickness_nm[:, None], FILM_IOR, base_from_f0(f0[:, None]))
    exact = facet_mean(evaluate("spectral", each).rgb, weights)
    np.testing.assert_allclose(averaged_truth("D65")(film, sight).rgb, exact, atol=1e-5)


def test_the_truth_of_a_spread_is_the_mean_over_thicknesses() -> None:
    steps = np.linspace(-5.6, 5.6, 65)
    share = np.exp(-0.5 * steps**2) / np.exp(-0.5 * steps**2).sum()
    base = base_from_f0([0.9, 0.5, 0.1])
    film = Film.of([0.3, 0.7, 1.0], [400.0, 600.0, 900.0], FILM_IOR, base)
    std_nm = np.array([30.0, 60.0, 90.0])
    each = Film.of(
        film.cos_theta_1[:, None], film.thickness_nm[:, None] + std_nm[:, None] * steps, FILM_IOR, base
    )
    exact = np.einsum("k,rkc->rc", share, evaluate("spectral", each).rgb)
    found = averaged_truth("D65")(film, Sight("metal", std_nm)).rgb
    np.testing.assert_allclose(found, exact, atol=2e-5)


def test_rays_take_a_ways_method_and_need_no_tables(tmp_path) -> None:
    model = load(ball(tmp_path))
    scene = model.scene()
    camera = frame_scene(scene, aspect=1.0)
    scene = replace(scene, lights=rig(scene, camera))

    def traced(way, method=None):
        plans = [plan_material(model.materials[0], 0, method=method, way=way)]
        frame = render_reference(
            model, scene, plans, camera, None, size=(16, 16), lighting="punctual", processes=1
        )
        return frame.rgba[..., :3]

    exact = traced(None, "spectral")
    assert exact.max() > 0.1
    np.testing.assert_array_equal(traced(ONE_DIRECTION), exact)
    assert np.abs(traced(Way(None)) - exact).max() > 0.01
