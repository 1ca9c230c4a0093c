"""Workloads of scenes, image light and arrays: rows are well-formed, and say what does not depend on time."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.bench import image_light_error, scene_growth, scenes
from gltf_iri.bench.arrays import measure_arrays
from gltf_iri.bench.image_light_error import FILMS, facets_seen, measure_image_light
from gltf_iri.bench.scene_growth import measure_growth
from gltf_iri.bench.scenes import STRIPPED, measure_scene
from gltf_iri.bench.twenty import FILMED, TWENTY, scene_files
from gltf_iri.cli.main import run
from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.microfacet import alpha_ggx
from gltf_iri.planning.decide import plan_materials
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.permutation import permutation
from gltf_iri.rendering.context import create_context
from gltf_iri.samples.collection import build_samples
from gltf_iri.scene.load import load
from gltf_iri.whole_files import write_whole

CONTRACT = {"workload", "method", "backend", "ns_per_eval", "max_abs", "delta_e_mean", "delta_e_p95"}


@pytest.fixture
def pearl(tmp_path: Path) -> Iterator[Path]:
    (sample,) = (each for each in build_samples() if each.name == "pearl")
    write_whole({tmp_path / name: data for name, data in sample.files.items()})
    yield tmp_path / next(iter(sample.files))


@pytest.mark.parametrize("roughness", [0.1, 0.4, 1.0])
@pytest.mark.parametrize("n_dot_v", [0.03, 0.4, 0.98])
def test_facets_add_up_to_what_a_white_mirror_sends(n_dot_v: float, roughness: float) -> None:
    cosine, weight = facets_seen(n_dot_v, float(alpha_ggx(roughness)), 128)
    a, b = dfg_terms(n_dot_v, roughness)
    # Where lines begin at the disc's rim instead of the horizon, weights have a kink from line to line.
    assert weight.sum() == pytest.approx(float(a + b), abs=2e-4)
    assert (weight * (1.0 - cosine) ** 5).sum() == pytest.approx(float(b), abs=2e-4)


def test_a_table_of_means_beats_what_renderers_do() -> None:
    rows = measure_image_light(FILMS[:1], (0.3, 0.7), angles=6, side=48)
    assert [row.roughness for row in rows] == [0.3] * 4 + [0.7] * 4
    assert all(set(row.to_json()) >= CONTRACT for row in rows)
    for k in (0, 4):
        as_f0, at_n_dot_v, at_mean, table = rows[k : k + 4]
        assert table.delta_e_p95 < image_light_error.BUDGET < at_mean.delta_e_p95
        assert at_mean.delta_e_mean < at_n_dot_v.delta_e_mean < as_f0.delta_e_mean
    assert max(row.convergence for row in rows) < 3e-3


def test_every_variant_of_a_scene_has_a_row(pearl: Path) -> None:
    context = create_context()
    try:
        rows = measure_scene(context, pearl, rounds=1, size=(48, 32), error_size=(48, 32))
    finally:
        context.release()
    names = [row.method for row in rows]
    assert names == [STRIPPED, "khr-guarded", "fourier", f"budget {scenes.BUDGET:g}"]
    assert all(set(row.to_json()) >= CONTRACT for row in rows)
    assert rows[0].ways == {}
    assert rows[0].ratio == 1.0
    assert rows[0].delta_e_p95 is None
    by_name = dict(zip(names, rows, strict=True))
    assert by_name["fourier"].delta_e_p95 is not None
    assert by_name["khr-guarded"].delta_e_p95 is not None
    assert by_name["fourier"].delta_e_p95 < by_name["khr-guarded"].delta_e_p95
    assert rows[-1].delta_e_p95 is not None
    assert rows[-1].delta_e_p95 <= scenes.BUDGET


def test_the_scene_of_twenty_is_sound_and_its_last_three_are_iridescent(tmp_path: Path) -> None:
    for materials, balls in ((TWENTY, TWENTY), (TWENTY - FILMED, TWENTY), (TWENTY - FILMED, TWENTY - FILMED)):
        place = tmp_path / f"{materials}-{balls}"
        write_whole({place / name: data for name, data in scene_files(materials, balls).items()})
        model = load(place / "balls.gltf")
        assert len(model.materials) == materials
        assert len(model.scene().primitives) == balls
        assert not model.notes
        has_film = [each.iridescence is not None for each in model.materials]
        assert has_film == [k >= TWENTY - FILMED for k in range(materials)]


def test_films_that_are_alike_share_a_program(tmp_path: Path) -> None:
    write_whole({tmp_path / name: data for name, data in scene_files(are_films_alike=True).items()})
    model = load(tmp_path / "balls.gltf")
    plans = plan_materials(model.materials, document=model.document, scene=model.scene())
    films = plans[TWENTY - FILMED :]
    assert len({permutation(plan, (), (Effect.IMAGE_LIGHT,)) for plan in films}) == 1
    assert len({plan.material for plan in films}) == FILMED


def test_what_three_films_add_is_named_program_by_program(monkeypatch: pytest.MonkeyPatch) -> None:
    # One ball compiles in a moment, and the last one has a film; filtered skies take longer.
    monkeypatch.setattr(scene_growth, "choose_environment", lambda _: None)
    monkeypatch.setattr(
        scene_growth, "scene_files", lambda m, b, **alike: _last_ball(scene_files(m, b, **alike))
    )
    rows, programs = measure_growth(rounds=1, size=(16, 16))
    left_out, worn, stripped, guarded, within, _, alike = rows
    assert left_out.ratio_left_out == left_out.compile_ratio == 1.0
    assert worn.ratio == 1.0
    assert "METHOD_KHR_GUARDED" in guarded.switches
    assert "HAS_IRIDESCENCE" in within.switches
    assert "HAS_IRIDESCENCE" in alike.switches
    for row in (left_out, worn, stripped):
        assert "HAS_IRIDESCENCE" in row.pruned
    for row in rows:
        assert set(row.to_json()) >= CONTRACT
        assert not set(row.switches) & set(row.pruned)
    assert len(programs) == within.programs


def _last_ball(files: dict[str, bytes]) -> dict[str, bytes]:
    """Return the scene with the last of its balls alone."""
    asset = json.loads(files["balls.gltf"])
    *_, ball, camera = asset["scenes"][0]["nodes"]
    asset["scenes"][0]["nodes"] = [ball, camera]
    return {**files, "balls.gltf": json.dumps(asset).encode()}


def test_arrays_are_measured_against_brute_force_and_truth() -> None:
    rows = measure_arrays(600, few=100, ways=(("--method", "fourier"),))
    assert [row.asked for row in rows] == [
        "--method spectral",
        "--method spectral-grid --set samples=471",
        "--method fourier",
    ]
    assert [row.rows for row in rows] == [100, 100, 600]
    assert all(set(row.to_json()) >= CONTRACT for row in rows)
    assert rows[1].ratio == 1.0
    assert rows[0].max_abs < 1e-6  # float32 holds the truth
    assert all(row.delta_e_p95 < 0.05 for row in rows)
    assert all(np.isfinite(row.ratio) for row in rows)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [(["films", "--count", "5"], "arrays"), (["twenty", "--file", __file__], "scenes")],
)
def test_options_of_other_workloads_are_refused(
    arguments: list[str], says: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["bench", *arguments]) == 2
    assert says in capsys.readouterr().err
