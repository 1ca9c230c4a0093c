from __future__ import annotations

import math

import numpy as np
import pytest

from gltf_iri.errors import AssetError
from gltf_iri.scene.camera import projection_matrix, read_camera
from gltf_iri.scene.model import Primitive, Scene

PERSPECTIVE = {"type": "perspective", "perspective": {"yfov": math.radians(60), "znear": 0.5, "zfar": 20.0}}
ORTHOGRAPHIC = {
    "type": "orthographic",
    "orthographic": {"xmag": 3.0, "ymag": 2.0, "znear": 1.0, "zfar": 9.0},
}
SLOPE = math.tan(math.radians(30))


def _camera(description=PERSPECTIVE, world=None, **lens):
    kind = description["type"]
    description = {"type": kind, kind: {**description[kind], **lens}}
    return read_camera(description, np.eye(4) if world is None else world, "camera", "/cameras/0")


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


def test_corners_of_a_perspective_frustum_reach_the_corners_of_clip_space():
    corners = [
        (2 * 0.5 * SLOPE, 0.5 * SLOPE, -0.5),
        (-2 * 20 * SLOPE, -20 * SLOPE, -20),
        (0, 0, -20),
    ]
    expected = [(1, 1, -1), (-1, -1, 1), (0, 0, 1)]
    np.testing.assert_allclose(_seen(_camera(), corners, aspect=2), expected, atol=1e-12)


def test_an_infinite_perspective_keeps_the_near_plane_and_reaches_one_only_in_the_limit():
    description = {"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.5}}
    depth = _seen(_camera(description), np.array([[0, 0, -0.5], [0, 0, -1], [0, 0, -1e12]]), 1)[:, 2]
    np.testing.assert_allclose(depth, [-1, 0, 1], atol=1e-11)


def test_corners_of_an_orthographic_box_reach_the_corners_of_clip_space():
    seen = _seen(_camera(ORTHOGRAPHIC), np.array([[3, 2, -1], [-3, -2, -9], [1.5, 0, -5]]), aspect=1.5)
    np.testing.assert_allclose(seen, [(1, 1, -1), (-1, -1, 1), (0.5, 0, 0)], atol=1e-12)


@pytest.mark.parametrize("description", [PERSPECTIVE, ORTHOGRAPHIC])
@pytest.mark.parametrize("aspect", [0.5, 1.5, 3.0])
def test_a_picture_of_another_shape_stretches_nothing_and_keeps_what_the_author_framed(description, aspect):
    camera = _camera(description, **({"aspectRatio": 1.5} if description is PERSPECTIVE else {}))
    matrix = projection_matrix(camera, aspect)
    assert matrix[1, 1] == pytest.approx(aspect * matrix[0, 0])  # equal lengths stay equal in pixels
    own = projection_matrix(camera, 1.5)
    assert matrix[0, 0] <= own[0, 0] * (1 + 1e-12)
    assert matrix[1, 1] <= own[1, 1] * (1 + 1e-12)


def test_a_camera_stands_where_its_node_does_whatever_the_scale():
    turn = np.array([[0, 0, 1, 5.0], [0, 1, 0, 6], [-1, 0, 0, 7], [0, 0, 0, 1]])  # −Z becomes −X
    camera = _camera(world=turn @ np.diag([2.0, 3.0, 4.0, 1.0]))
    np.testing.assert_allclose(camera.position, (5, 6, 7))
    seen = _seen(camera, np.array([[4.0, 6, 7], [3, 6.1, 7], [3, 6, 6.9]]), 1)
    np.testing.assert_allclose(seen[0, :2], (0, 0), atol=1e-12)
    assert seen[1, 1] > 0  # up stays up
    assert seen[2, 0] > 0  # looking along −X, −Z lies to the right


@pytest.mark.parametrize(
    ("description", "lens"),
    [
        (PERSPECTIVE, {"zfar": 0.25}),
        (PERSPECTIVE, {"yfov": 3.2}),
        (PERSPECTIVE, {"yfov": 1e-320}),  # its matrix overflows
        (ORTHOGRAPHIC, {"xmag": 0.0}),
        (ORTHOGRAPHIC, {"ymag": 1e-320}),
    ],
)
def test_a_lens_without_a_frustum_is_refused(description, lens):
    with pytest.raises(AssetError) as caught:
        _camera(description, **lens)
    assert caught.value.pointer == f"/cameras/0/{description['type']}"


def test_a_camera_on_a_node_without_extent_is_refused():
    with pytest.raises(AssetError, match="looks nowhere"):
        _camera(world=np.zeros((4, 4)))


def test_cameras_of_the_file_are_found_with_their_names(triangle):
    triangle.json["cameras"] = [{**PERSPECTIVE, "name": "lens"}, ORTHOGRAPHIC]
    triangle.json["nodes"] += [{"camera": 0}, {"camera": 1, "name": "tripod", "translation": [0, 0, 4]}]
    triangle.json["scenes"] = [{"nodes": [0, 1, 2]}]
    first, second = triangle.load().scene().cameras
    assert (first.name, first.kind) == ("lens", "perspective")
    assert (second.name, second.kind) == ("tripod", "orthographic")
    np.testing.assert_array_equal(second.position, (0, 0, 4))
