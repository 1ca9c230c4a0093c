from __future__ import annotations

import math

import numpy as np
import pytest

from gltf_iri.errors import AssetError

# A strip of cloth between two joints; the second stands 1 higher.
POSITIONS = np.array([[-0.5, 0, 0], [0.5, 0, 0], [-0.5, 1, 0], [0.5, 1, 0], [-0.5, 2, 0], [0.5, 2, 0]])
TRIANGLES = [0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5]
JOINTS = [[0, 1, 0, 0]] * 6
WEIGHTS = [[1, 0, 0, 0]] * 2 + [[0.5, 0.5, 0, 0]] * 2 + [[0, 1, 0, 0]] * 2


def _translation(x, y, z):
    matrix = np.eye(4)
    matrix[:3, 3] = (x, y, z)
    return matrix


@pytest.fixture
def cloth(asset):
    attributes = {
        "JOINTS_0": asset.accessor(JOINTS, "u1"),
        "WEIGHTS_0": asset.accessor(WEIGHTS),
        "NORMAL": asset.accessor([[0, 0, 1]] * 6),
        "TANGENT": asset.accessor([[1, 0, 0, 1]] * 6),
    }
    asset.primitive(POSITIONS, TRIANGLES, attributes=attributes)
    binds = [np.eye(4), _translation(0, -1, 0)]
    inverse_binds = asset.accessor([m.T.ravel() for m in binds])  # columns first
    asset.json["skins"] = [{"joints": [1, 2], "inverseBindMatrices": inverse_binds}]
    asset.json["nodes"] = [
        {"mesh": 0, "skin": 0},
        {"children": [2]},
        {"translation": [0, 1, 0]},
    ]
    asset.json["scenes"] = [{"nodes": [0, 1]}]
    return asset


def _primitive(asset):
    return asset.load().scene().primitives[0]


def test_joints_in_their_bind_pose_move_nothing(cloth):
    primitive = _primitive(cloth)
    np.testing.assert_allclose(primitive.positions, POSITIONS, atol=1e-7)
    np.testing.assert_allclose(primitive.normals, [[0, 0, 1]] * 6, atol=1e-7)


def test_vertices_follow_their_joints_by_the_weights(cloth):
    half_angle = math.radians(30) / 2
    cloth.json["nodes"][2]["rotation"] = [0, 0, math.sin(half_angle), math.cos(half_angle)]
    cloth.json["nodes"][1]["translation"] = [0, 0, 3]
    # By hand: the first joint lifts by 3 along z; the second turns its share about (0, 1) as well.
    cos, sin = math.cos(math.radians(30)), math.sin(math.radians(30))
    expected = []
    for (x, y, _), (first, second, *_) in zip(POSITIONS, WEIGHTS, strict=True):
        turned = (cos * x - sin * (y - 1), sin * x + cos * (y - 1) + 1)
        expected.append((first * x + second * turned[0], first * y + second * turned[1], 3))
    np.testing.assert_allclose(_primitive(cloth).positions, expected, atol=1e-6)


def test_the_place_of_the_skinned_node_itself_does_not_count(cloth):
    cloth.json["nodes"][0]["translation"] = [100, 0, 0]
    primitive = _primitive(cloth)
    np.testing.assert_allclose(primitive.positions, POSITIONS, atol=1e-7)
    np.testing.assert_array_equal(primitive.world, np.eye(4))


def test_normals_stay_perpendicular_under_a_sheared_joint(cloth):
    shear = np.array([[1, 0, 0.8, 0], [0, 1, 0, 0], [0.5, 0, 1, 0], [0, 0, 0, 1]])
    cloth.json["nodes"][1]["matrix"] = shear.T.ravel().tolist()
    primitive = _primitive(cloth)
    corner = primitive.positions[primitive.triangles].astype(float)
    faces = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    faces /= np.linalg.norm(faces, axis=1)[:, None]
    np.testing.assert_allclose(primitive.normals[primitive.triangles[:, 0]], faces, atol=1e-6)
    across = np.einsum("ni,ni->n", primitive.normals, primitive.tangents[:, :3])
    np.testing.assert_allclose(across, 0, atol=1e-6)


def test_mirroring_joints_keep_winding_and_normals_together(cloth):
    cloth.json["nodes"][1]["scale"] = [-1, 1, 1]
    primitive = _primitive(cloth)
    corner = primitive.positions[primitive.triangles].astype(float)
    faces = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    assert np.all(faces[:, 2] > 0)
    np.testing.assert_allclose(primitive.normals, [[0, 0, 1]] * 6, atol=1e-7)


def test_weights_that_do_not_sum_to_one_are_brought_there(cloth):
    attributes = cloth.json["meshes"][0]["primitives"][0]["attributes"]
    attributes["WEIGHTS_0"] = cloth.accessor([[0, 0, 0, 0]] + [[0.25, 0.25, 0, 0]] * 5)
    np.testing.assert_allclose(_primitive(cloth).positions, POSITIONS, atol=1e-7)


def test_a_second_set_of_joints_counts(cloth):
    attributes = cloth.json["meshes"][0]["primitives"][0]["attributes"]
    attributes["WEIGHTS_0"] = cloth.accessor([[0.5, 0, 0, 0]] * 6)
    attributes["JOINTS_1"] = cloth.accessor(JOINTS, "u2")
    attributes["WEIGHTS_1"] = cloth.accessor([[0, 0.5, 0, 0]] * 6)
    cloth.json["nodes"][2]["translation"] = [0, 1, 4]  # 4 more than when it was bound, at half the weight
    np.testing.assert_allclose(_primitive(cloth).positions[:, 2], [2] * 6, atol=1e-6)


def test_a_joint_that_does_not_exist_is_refused_unless_its_weight_is_zero(cloth):
    attributes = cloth.json["meshes"][0]["primitives"][0]["attributes"]
    attributes["JOINTS_0"] = cloth.accessor([[0, 1, 9, 9]] * 6, "u1")
    np.testing.assert_allclose(_primitive(cloth).positions, POSITIONS, atol=1e-7)
    attributes["JOINTS_0"] = cloth.accessor([[9, 1, 0, 0]] * 6, "u1")
    with pytest.raises(AssetError, match="joint 9; the skin has 2"):
        _primitive(cloth)


def test_fewer_inverse_bind_matrices_than_joints_are_refused(cloth):
    cloth.json["skins"][0]["inverseBindMatrices"] = cloth.accessor([np.eye(4).ravel()])
    with pytest.raises(AssetError) as caught:
        _primitive(cloth)
    assert caught.value.pointer == "/skins/0/inverseBindMatrices"


def test_a_skinned_mesh_without_weights_is_refused(cloth):
    del cloth.json["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"]
    with pytest.raises(AssetError, match="WEIGHTS_0"):
        _primitive(cloth)
