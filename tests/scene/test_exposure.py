"""The automatic exposure reads the light and nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.scene.environment import studio, white
from gltf_iri.scene.exposure import EXPOSURE_MAX_EV, automatic_exposure, light_level
from gltf_iri.scene.model import Environment, Light, Primitive, Scene

SUN = Light("", "directional", (1.0, 1.0, 1.0), np.pi, np.zeros(3), np.array([0.0, -1.0, 0.0]))
LAMP = replace(SUN, kind="point", position=np.array([0.0, 3.0, 0.0]))


def _scene(*lights, points=((-1, 0, 0), (1, 0, 0), (0, 0, 1))):
    points = np.asarray(points, dtype=np.float32)
    triangles = np.arange(len(points) // 3 * 3, dtype=np.uint32).reshape(-1, 3)
    return Scene("", (Primitive("", "", -1, points, points, triangles, np.eye(4)),), (), lights)


@pytest.mark.parametrize("environment", [studio(), white()], ids=lambda e: e.name)
def test_the_made_environments_need_no_correction(environment):
    assert light_level(_scene(), environment) == pytest.approx(1.0, abs=1e-5)
    assert str(automatic_exposure(_scene(), environment)) == "0.0"


def test_a_white_card_that_faces_the_sun_comes_out_white():
    assert light_level(_scene(SUN), None) == pytest.approx(1.0)
    assert automatic_exposure(_scene(SUN, SUN), white()) == pytest.approx(-np.log2(3), abs=0.005)


@pytest.mark.parametrize("factor", [1e-3, 0.1, 8.0, 5e4])
def test_twice_the_light_is_one_stop_less(factor):
    dim = replace(SUN, intensity=factor)
    bright = replace(SUN, intensity=2 * factor)
    map_ = Environment("", np.full((4, 8, 3), factor, np.float32))
    assert light_level(_scene(bright), None) == pytest.approx(2 * light_level(_scene(dim), None))
    assert light_level(_scene(), map_) == pytest.approx(factor)
    assert automatic_exposure(_scene(), map_) == pytest.approx(-np.log2(factor), abs=0.005)


def test_rows_near_the_poles_count_for_the_little_sky_that_they_cover():
    radiance = np.zeros((64, 128, 3), np.float32)
    radiance[:32] = 2.0
    assert light_level(_scene(), Environment("", radiance)) == pytest.approx(1.0)
    radiance = np.zeros((64, 128, 3), np.float32)
    radiance[0] = 1.0
    cap = (1 - np.cos(np.pi / 64)) / 2
    assert light_level(_scene(), Environment("", radiance)) == pytest.approx(cap, rel=1e-3)


def test_a_lamp_counts_by_its_distance_and_one_close_vertex_decides_nothing():
    far = ((0, 0, 0), (0, 0, 0), (0, 0, 0), (0, 2.999, 0), (0, 0, 0), (0, 0, 0))
    assert light_level(_scene(LAMP, points=far), None) == pytest.approx(1 / 9)


def test_a_vertex_of_millions_changes_nothing():
    few, many = _scene(LAMP), _scene(LAMP, points=np.tile(np.zeros((3, 3)), (20_000, 1)))
    assert np.isfinite(light_level(many, None))
    assert light_level(few, None) < light_level(many, None) == pytest.approx(1 / 9)


@pytest.mark.parametrize(
    ("intensity", "ev"), [(0.0, 0.0), (1e-38, EXPOSURE_MAX_EV), (3e38, -EXPOSURE_MAX_EV)], ids=str
)
def test_light_beyond_reason_stays_within_the_bounds(intensity, ev):
    assert automatic_exposure(_scene(replace(SUN, intensity=intensity)), None) == ev
