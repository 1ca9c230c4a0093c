"""A pixel's ray is what projects to the pixel's centre, from the near plane to the far one."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.reference.rays import camera_rays
from gltf_iri.scene.camera import projection_matrix
from gltf_iri.scene.model import Camera

SIZE = (7, 5)


def placed_view():
    """A rigid view that looks along no axis, from no origin."""
    turn, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    view = np.eye(4)
    view[:3, :3] = turn * np.linalg.det(turn)
    view[:3, 3] = (0.3, -2.0, 5.0)
    return view


CAMERAS = {
    "perspective": Camera("", "perspective", placed_view(), 0.2, 9.0, yfov_rad=0.7),
    "its own aspect": Camera("", "perspective", placed_view(), 0.2, 9.0, yfov_rad=0.7, aspect=2.5),
    "orthographic": Camera("", "orthographic", placed_view(), 0.2, 9.0, xmag_m=2.0, ymag_m=3.0, aspect=2 / 3),
}


def projected(camera, points):
    matrix = projection_matrix(camera, SIZE[0] / SIZE[1]) @ camera.view
    clip = np.column_stack([points, np.ones(len(points))]) @ matrix.T
    return clip[:, :3] / clip[:, 3:]


@pytest.mark.parametrize("camera", CAMERAS.values(), ids=CAMERAS)
def test_rays_project_to_their_pixels_centres_between_the_planes(camera):
    origins, directions, lengths = camera_rays(camera, SIZE)
    column, row = np.meshgrid(np.arange(SIZE[0]), np.arange(SIZE[1]))
    # Row 0 is on top, where OpenGL's y is 1.
    x, y = (2 * column.ravel() + 1) / SIZE[0] - 1, 1 - (2 * row.ravel() + 1) / SIZE[1]
    for share, z in ((0.0, -1.0), (1.0, 1.0)):
        there = projected(camera, origins + (share * lengths)[:, None] * directions)
        assert np.abs(there - np.column_stack([x, y, np.full(len(x), z)])).max() < 1e-12
    assert np.abs(np.linalg.norm(directions, axis=1) - 1).max() < 1e-15


def test_without_a_far_plane_rays_do_not_end():
    camera = replace(CAMERAS["perspective"], zfar_m=None)
    assert np.all(np.isinf(camera_rays(camera, SIZE)[2]))


def test_rows_are_cut_out_of_the_whole_picture():
    whole = camera_rays(CAMERAS["perspective"], SIZE)
    for part, all_of_them in zip(camera_rays(CAMERAS["perspective"], SIZE, (2, 4)), whole, strict=True):
        assert np.array_equal(part, all_of_them[2 * SIZE[0] : 4 * SIZE[0]])
