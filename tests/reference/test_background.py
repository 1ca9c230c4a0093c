"""Behind the scene, the reference shows what its rays see there."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.reference.background import over_background
from gltf_iri.scene.environment import studio
from gltf_iri.scene.model import Camera, Environment

FRONT = Camera("", "perspective", np.eye(4), 0.1, 100.0, yfov_rad=np.radians(40.0))


def test_what_was_drawn_hides_what_lies_behind_by_its_alpha():
    rgba = np.zeros((1, 3, 4))
    rgba[0, 1] = [0.2, 0.1, 0.0, 0.5]
    rgba[0, 2] = [0.4, 0.4, 0.4, 1.0]
    shown = over_background(rgba, FRONT, studio())
    card = np.array(studio().backdrop)
    np.testing.assert_allclose(shown[0, :, :3], [card, rgba[0, 1, :3] + 0.5 * card, rgba[0, 2, :3]])
    np.testing.assert_array_equal(shown[..., 3], rgba[..., 3])


@pytest.mark.parametrize("turn", [1.0, -1.0], ids=["towards −Z", "towards +Z"])
def test_a_map_lies_where_the_camera_looks(turn):
    radiance = np.zeros((16, 32, 3), np.float32)
    radiance[:, :16] = [1, 0, 0]  # −Z: u < ½
    radiance[:, 16:] = [0, 1, 0]
    view = np.diag([turn, 1.0, turn, 1.0])
    camera = Camera("", "perspective", view, 0.1, 100.0, yfov_rad=np.radians(10.0))
    shown = over_background(np.zeros((4, 6, 4)), camera, Environment("halves", radiance))
    np.testing.assert_allclose(shown[..., :3], np.broadcast_to(radiance[0, 0 if turn > 0 else -1], (4, 6, 3)))


def test_without_an_environment_it_stays_black():
    rgba = np.zeros((2, 2, 4))
    assert over_background(rgba, FRONT, None) is rgba
