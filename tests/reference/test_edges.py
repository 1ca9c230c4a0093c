"""Distances on the picture, measured between projected points."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.reference.edges import edge_distance_px
from gltf_iri.reference.render import render_reference
from gltf_iri.scene.camera import projection_matrix

SIZE = (40, 30)


def on_the_picture(camera, point):
    """Place of a world point in pixels from the upper left corner."""
    clip = projection_matrix(camera, SIZE[0] / SIZE[1]) @ camera.view @ np.append(point, 1.0)
    x, y = clip[:2] / clip[3]
    return np.array([(x + 1) / 2 * SIZE[0], (1 - y) / 2 * SIZE[1]])


def to_line(point, a, b):
    along = (b - a) / np.linalg.norm(b - a)
    return abs(along[0] * (point - a)[1] - along[1] * (point - a)[0])


@pytest.mark.parametrize("view", [{}, {"half_height": 1.5}], ids=["perspective", "orthographic"])
def test_the_distance_is_that_of_the_nearest_projected_edge(props, view):
    rng = np.random.default_rng(6)
    camera = props.camera(**view)
    corners, centres = rng.uniform(-1, 1, (50, 3, 3)), rng.uniform(0, 30, (50, 2))
    found = edge_distance_px(camera, SIZE, corners, centres)
    for i in range(50):
        a, b, c = (on_the_picture(camera, corner) for corner in corners[i])
        nearest = min(to_line(centres[i], *line) for line in ((a, b), (b, c), (c, a)))
        assert found[i] == pytest.approx(nearest, rel=1e-9, abs=1e-12)


def test_a_corner_behind_the_eye_still_has_its_edges(props):
    floor = np.array([[[-3.0, -1, 9], [3.0, -1, 9], [0.0, -1, -9]]])
    found = edge_distance_px(props.camera(), SIZE, floor, np.array([[20.0, 25.0]]))
    # Both long edges meet at (0, −1, −9) and run towards the viewer on either side of the middle.
    assert np.isfinite(found).all()
    assert found[0] > 1.0


def test_the_picture_tells_how_far_its_pixels_lie_from_edges(props):
    scene = props.scene_of(props.quad())
    frame = render_reference(*scene, props.camera(half_height=1.25), None, size=(50, 50), processes=1)
    # The square covers pixels 5 to 45, and its diagonal runs from the lower left to the upper right.
    assert frame.edge_px[30, 25] == pytest.approx(5 / np.sqrt(2) + np.sqrt(0.5))
    assert frame.edge_px[25, 6] == pytest.approx(1.5)
    assert np.isinf(frame.edge_px[0, 0])
