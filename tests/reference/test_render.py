"""A picture is the same however it is divided, and says what is wrong with what it is asked for."""

from __future__ import annotations

import os
import pickle
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.material.clearcoat import Clearcoat
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.unlit import Unlit
from gltf_iri.reference.paint import Job
from gltf_iri.reference.render import render_reference
from gltf_iri.reference.stage import build_stage
from gltf_iri.reference.tiles import count_tiles, paint_tiles, tile_rows
from gltf_iri.scene.environment import studio
from gltf_iri.scene.model import Light

SUN = Light("", "directional", (1.0, 1.0, 1.0), 3.0, np.zeros(3), np.array([0.6, -0.48, -0.64]))


def glowing(colour, alpha=1.0, mode="OPAQUE", **changes):
    base = MetallicRoughness(base_color_factor=(*colour, alpha))
    return Material(pbr=base, unlit=Unlit(), alpha_mode=mode, **changes)


def at(props, z, material, **changes):
    world = np.eye(4)
    world[2, 3] = z
    return replace(props.quad(world=world, **changes), material=material)


def test_one_process_and_two_paint_the_same_bits(props):
    scene = props.scene_of(props.sphere(), lights=(SUN,))
    options = {"size": (80, 120), "image_samples": 16, "seed": 5}
    assert count_tiles((80, 120)) > 2
    one, two = (
        render_reference(*scene, props.camera(), studio(), processes=processes, **options)
        for processes in (1, 2)
    )
    for name in ("rgba", "material", "depth_m", "standard_error"):
        assert np.array_equal(getattr(one, name), getattr(two, name)), name
    assert one.standard_error.max() > 0


def test_another_seed_moves_the_estimate_within_its_error(props):
    scene = props.scene_of(props.sphere())
    first, second = (
        render_reference(
            *scene, props.camera(), studio(), size=(24, 18), image_samples=64, seed=seed, processes=1
        )
        for seed in (0, 1)
    )
    error = np.hypot(first.standard_error, second.standard_error)
    moved = np.abs(first.rgba - second.rgba)[..., :3]
    drawn = first.material >= 0
    assert np.all(moved[drawn] > 0)
    # Eight copies give the error with a spread of its own; still it is of the right size on the whole.
    assert 0.3 < np.sqrt(np.mean(moved[drawn] ** 2) / np.mean(error[drawn] ** 2)) < 3.0


class EndsTheProcess:
    """What receives this, dies."""

    def __reduce__(self):
        return os._exit, (1,)


def some_tiles(props):
    stage = build_stage(*props.scene_of(props.quad()))
    return Job(stage, props.camera(), None, (80, 120), None, None, {}, "D65", "all", True, 16, 8, 8, 0)


def run_script(text, job, folder):
    """Run `text` with the path of the pickled `job` until no process holds its output open."""
    (folder / "job").write_bytes(pickle.dumps(job))
    (folder / "script.py").write_text(text, encoding="utf-8")
    return subprocess.run(
        [sys.executable, folder / "script.py", folder / "job"],
        env={**os.environ, "PYTHONPATH": str(Path(__file__).parents[2])},
        capture_output=True,
        text=True,
        timeout=60,
    )


def test_a_process_that_dies_is_told(props):
    with pytest.raises(MissingCapabilityError, match="One of 2 processes died"):
        list(paint_tiles(replace(some_tiles(props), stage=EndsTheProcess()), 2))


UNGUARDED = """
import pickle, sys
from gltf_iri.reference.tiles import paint_tiles
list(paint_tiles(pickle.load(open(sys.argv[1], "rb")), 2))
"""


KILLED = """
import os, pickle, signal, sys
from gltf_iri.reference.tiles import paint_tiles
if __name__ == "__main__":
    tiles = paint_tiles(pickle.load(open(sys.argv[1], "rb")), 2)
    next(tiles)
    os.kill(os.getpid(), signal.SIGKILL)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="SIGKILL is a signal on POSIX only")
def test_processes_end_with_the_one_that_started_them(props, tmp_path):
    done = run_script(KILLED, some_tiles(props), tmp_path)
    assert done.returncode == -signal.SIGKILL


def test_a_script_that_workers_would_run_again_is_told_so(props, tmp_path):
    done = run_script(UNGUARDED, some_tiles(props), tmp_path)
    assert done.returncode == 1
    assert done.stderr.splitlines()[-1].startswith("gltf_iri.errors.UsageError: A script that paints with")


@pytest.mark.parametrize("size", [(1, 1), (7, 3000), (5000, 2), (640, 480)])
def test_tiles_cover_every_row_once(size):
    rows = [row for first, past in tile_rows(size) for row in range(first, past)]
    assert rows == list(range(size[1]))


def test_each_tile_advances_once(props):
    ticks = []
    scene = props.scene_of(props.quad())
    size = (100, 90)
    render_reference(*scene, props.camera(), None, size=size, processes=1, advance=lambda: ticks.append(1))
    assert len(ticks) == count_tiles(size) > 1


def test_nothing_is_nothing_and_a_surface_has_its_plan_and_depth(props):
    scene = props.scene_of([at(props, -1.0, 1)], [Material(), glowing((0.2, 0.3, 0.4))])
    frame = render_reference(*scene, props.camera(4.0), None, size=(9, 9), processes=1)
    assert frame.material[0, 0] == -1
    assert np.array_equal(frame.rgba[0, 0], np.zeros(4))
    assert np.isinf(frame.depth_m[0, 0])
    assert frame.material[4, 4] == 1
    assert frame.depth_m[4, 4] == pytest.approx(5.0, abs=1e-12)
    assert np.abs(frame.rgba[4, 4] - [0.2, 0.3, 0.4, 1.0]).max() < 1e-15


def test_blended_surfaces_are_laid_over_what_is_behind_them(props):
    pane = glowing((1.0, 0.5, 0.0), 0.25, "BLEND")
    wall = glowing((0.1, 0.2, 0.3))
    size = {"size": (9, 9), "processes": 1}
    in_front = props.scene_of([at(props, 0.0, 1), at(props, 0.5, 0)], [pane, wall])
    alone = props.scene_of([at(props, 0.5, 0)], [pane, wall])
    over = render_reference(*in_front, props.camera(), None, **size).rgba[4, 4]
    assert np.abs(over - [0.25 + 0.075, 0.125 + 0.15, 0.225, 1.0]).max() < 1e-12
    by_itself = render_reference(*alone, props.camera(), None, **size).rgba[4, 4]
    assert np.abs(by_itself - [0.25, 0.125, 0.0, 0.25]).max() < 1e-12
    opaque = render_reference(*alone, props.camera(), None, is_blending=False, **size)
    assert np.abs(opaque.rgba[4, 4] - [1.0, 0.5, 0.0, 1.0]).max() < 1e-12
    assert opaque.notes == ("Blended materials are drawn as if opaque.",)


def test_emission_shines_through_its_coat(props):
    glow = Material(emissive_factor=(1.0, 0.5, 0.25), pbr=MetallicRoughness(metallic_factor=0.0))
    coated = replace(glow, clearcoat=Clearcoat(1.0))
    bare, under = (
        render_reference(
            *props.scene_of(props.quad(), m), props.camera(half_height=1.0), None, size=(3, 3), processes=1
        ).rgba[1, 1, :3]
        for m in (glow, coated)
    )
    # Head on, a smooth coat of index 1.5 reflects its F0 = 0.04.
    assert np.abs(under / bare - 0.96).max() < 1e-4


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"size": (0, 5)}, "0 × 5"),
        ({"size": (100_000, 100_000)}, "out of range"),
        ({"size": (100_000, 1)}, "pixels a side"),
        ({"lighting": "moon"}, "no lighting 'moon'"),
        ({"film_method": "soap"}, "no method 'soap'"),
        ({"image_samples": 0}, "0 image samples"),
        ({"image_samples": 10**15}, "1 to 1048576"),
        ({"path_depth": 0}, "0 surfaces a path"),
        ({"path_depth": 10**9}, "1 to 1024"),
        ({"paths": -1}, "-1 paths"),
        ({"paths": 10**15}, "1 to 1048576"),
        ({"seed": -1}, "seed -1"),
        ({"processes": 0}, "0 processes"),
    ],
)
def test_what_cannot_be_painted_is_refused_in_a_sentence(props, options, words):
    scene = props.scene_of(props.quad())
    with pytest.raises(UsageError, match=words):
        render_reference(*scene, props.camera(), None, **({"size": (4, 4)} | options))
