"""Cameras for scenes without one: everything is in the picture, seen from where it shows most."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gltf_iri.errors import AssetError, UsageError
from gltf_iri.scene.camera import projection_matrix
from gltf_iri.scene.framing import (
    AZIMUTH_RAD,
    ELEVATION_MAX_RAD,
    ELEVATION_RAD,
    MARGIN,
    ORBIT_COUNT_MAX,
    frame_scene,
    orbit_scene,
    view_angles,
)
from gltf_iri.scene.model import Primitive, Scene


def _seen(camera, points, aspect):
    """Normalised device coordinates of world points (n, 3)."""
    clip = (
        np.column_stack([points, np.ones(len(points))]) @ (projection_matrix(camera, aspect) @ camera.view).T
    )
    return clip[:, :3] / clip[:, 3:]


def _scene(points):
    points = np.asarray(points, dtype=np.float32)
    triangles = np.arange(len(points) // 3 * 3, dtype=np.uint32).reshape(-1, 3)
    return Scene("", (Primitive("", "", -1, points, points, triangles, np.eye(4)),), (), ())


@pytest.mark.parametrize("aspect", [0.4, 1.0, 2.5])
@pytest.mark.parametrize("azimuth_rad", [0.0, 0.4, 2.0, -3.0])
def test_automatic_framing_holds_every_vertex_and_fits_tightly(aspect, azimuth_rad):
    points = np.random.default_rng(3).normal(size=(300, 3)) * (4, 1, 0.3) + (100, -20, 3)
    camera = frame_scene(_scene(points), aspect=aspect, azimuth_rad=azimuth_rad, elevation_rad=ELEVATION_RAD)
    seen = _seen(camera, points, aspect)
    assert np.all(np.abs(seen) <= 1)
    fullest = max(np.ptp(seen[:, 0]), np.ptp(seen[:, 1]))
    assert fullest == pytest.approx(2 * (1 - MARGIN), rel=1e-3)
    for axis in range(2):
        if np.ptp(seen[:, axis]) > fullest - 1e-3:
            assert seen[:, axis].max() == pytest.approx(-seen[:, axis].min(), abs=1e-3)


def test_automatic_framing_looks_from_the_front_a_little_from_the_right_and_above():
    camera = frame_scene(_scene([[-1, -1, -1], [1, -1, -1], [0, 1, 1]]), aspect=1)
    x, y, z = camera.position
    assert z > x > 0
    assert z > y > 0
    seen = _seen(camera, np.array([[-1.0, -1, -1], [1, -1, -1], [0, 1, 1]]), 1)
    assert seen[1, 0] > seen[0, 0]
    assert seen[2, 1] > seen[1, 1]


@pytest.mark.parametrize("size", [0.0, 1e-6, 1e6])
def test_automatic_framing_is_finite_for_specks_and_giants(size):
    points = size * np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 1]])
    camera = frame_scene(_scene(points), aspect=1.5)
    assert np.all(np.isfinite(camera.view))
    assert 0 < camera.znear_m < camera.zfar_m < math.inf
    assert np.all(np.abs(_seen(camera, points, 1.5)) <= 1)


def test_framing_counts_drawn_vertices_only():
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1e9, 0, 0]], dtype=np.float32)
    low, high = _scene(points).bounds()
    np.testing.assert_array_equal(high, (1, 1, 0))
    np.testing.assert_array_equal(low, (0, 0, 0))


def test_an_empty_scene_cannot_be_framed():
    with pytest.raises(AssetError, match="no triangles"):
        frame_scene(Scene("", (), (), ()), aspect=1)


def _box(width, height, depth):
    return np.array([[0, 0, 0], [width, height, depth]], dtype=np.float64)


def test_a_cube_is_seen_as_the_constants_say():
    assert view_angles(_box(2, 2, 2)) == pytest.approx((AZIMUTH_RAD, ELEVATION_RAD))


@pytest.mark.parametrize(
    ("name", "size", "azimuth_deg", "elevation_deg"),
    [
        ("a board is seen from its front", (2, 1, 0), (0, 0), (0, 0)),
        ("a board that faces the side is seen from there", (0, 1, 2), (90, 90), (0, 0)),
        ("a long thing is seen from its broad side", (1, 1, 4), (45, 90), (15, 15)),
        ("a row is seen from its front", (6, 1, 1), (0, 10), (15, 15)),
        ("a column is seen from low", (1, 5, 1), (25, 25), (0, 5)),
        ("a plate is looked down upon", (2, 0, 2), (25, 25), (45, 45)),
        ("a point has no sides", (0, 0, 0), (0, 0), (0, 0)),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_the_view_follows_the_proportions(name, size, azimuth_deg, elevation_deg):
    azimuth, elevation = np.degrees(view_angles(_box(*size)))
    assert azimuth_deg[0] - 1e-9 <= azimuth <= azimuth_deg[1] + 1e-9, name
    assert elevation_deg[0] - 1e-9 <= elevation <= elevation_deg[1] + 1e-9, name
    assert elevation <= math.degrees(ELEVATION_MAX_RAD) + 1e-9


@pytest.mark.parametrize("extent", [(4, 1, 0.3), (1, 5, 1), (3, 0, 3)])
def test_an_orbit_keeps_its_distance_and_everything_in_the_picture(extent):
    points = np.random.default_rng(4).normal(size=(300, 3)) * extent + (100, -20, 3)
    cameras = orbit_scene(_scene(points), aspect=1.5, count=7)
    middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
    distances = [np.linalg.norm(camera.position - middle) for camera in cameras]
    np.testing.assert_allclose(distances, distances[0], rtol=1e-5)
    heights = [camera.position[1] for camera in cameras]
    np.testing.assert_allclose(heights, heights[0], rtol=1e-5)
    fullest = 0.0
    for camera in cameras:
        seen = np.abs(_seen(camera, points, 1.5))
        assert np.all(seen <= 1)
        fullest = max(fullest, seen[:, :2].max())
        np.testing.assert_allclose(_seen(camera, middle[None], 1.5)[0, :2], 0, atol=1e-4)
    assert fullest == pytest.approx(1 - MARGIN, rel=1e-3)


def test_an_orbit_goes_round_once_in_equal_steps():
    cameras = orbit_scene(_scene(np.eye(3)), aspect=1, count=8)
    backward = np.array([camera.view[2, [0, 2]] for camera in cameras])
    azimuth = np.unwrap(np.arctan2(backward[:, 0], backward[:, 1]))
    np.testing.assert_allclose(np.diff(azimuth), math.tau / 8, atol=1e-9)


def test_an_orbit_begins_where_the_still_picture_is_taken():
    points = np.random.default_rng(5).normal(size=(30, 3))
    still, first = frame_scene(_scene(points), aspect=1), orbit_scene(_scene(points), aspect=1, count=3)[0]
    assert still.view[2, 0] / still.view[2, 2] == pytest.approx(first.view[2, 0] / first.view[2, 2])


@pytest.mark.parametrize("count", [-1, 0, ORBIT_COUNT_MAX + 1])
def test_an_orbit_without_pictures_or_without_end_is_refused(count):
    with pytest.raises(UsageError, match=f"1 to {ORBIT_COUNT_MAX}"):
        orbit_scene(_scene(np.eye(3)), aspect=1, count=count)
