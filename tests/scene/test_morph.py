from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.errors import AssetError

BASE = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype=float)
FIRST = np.array([[0, 0, 1], [0, 0, 2], [0, 0, 3]], dtype=float)
SECOND = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 0]], dtype=float)


@pytest.fixture
def morphed(asset):
    targets = [{"POSITION": asset.accessor(FIRST)}, {"POSITION": asset.accessor(SECOND)}]
    asset.primitive(BASE, targets=targets)
    return asset


def _positions(asset):
    return asset.load().scene().primitives[0].positions


def test_targets_are_added_by_the_weights_of_the_mesh(morphed):
    morphed.json["meshes"][0]["weights"] = [0.5, -2.0]
    np.testing.assert_array_equal(_positions(morphed), BASE + 0.5 * FIRST - 2.0 * SECOND)


def test_a_node_states_its_own_weights_and_other_nodes_keep_the_mesh_s(morphed):
    morphed.json["meshes"][0]["weights"] = [1.0, 0.0]
    morphed.json["nodes"] = [{"mesh": 0, "weights": [0.0, 1.0]}, {"mesh": 0}]
    morphed.json["scenes"] = [{"nodes": [0, 1]}]
    own, shared = morphed.load().scene().primitives
    np.testing.assert_array_equal(own.positions, BASE + SECOND)
    np.testing.assert_array_equal(shared.positions, BASE + FIRST)


def test_without_weights_the_mesh_stays_as_it_is(morphed):
    np.testing.assert_array_equal(_positions(morphed), BASE)


def test_flat_normals_are_those_of_the_displaced_triangle(morphed):
    morphed.json["meshes"][0]["weights"] = [1.0, 0.0]
    corner = BASE + FIRST
    across = np.cross(corner[1] - corner[0], corner[2] - corner[0])
    expected = across / np.linalg.norm(across)
    np.testing.assert_allclose(morphed.load().scene().primitives[0].normals, [expected] * 3, atol=1e-7)


def test_normals_and_tangents_move_and_the_handedness_does_not(asset):
    deltas = {"NORMAL": asset.accessor([[1, 0, -1]] * 3), "TANGENT": asset.accessor([[-1, 0, -1]] * 3)}
    attributes = {"NORMAL": asset.accessor([[0, 0, 1]] * 3), "TANGENT": asset.accessor([[1, 0, 0, -1]] * 3)}
    asset.primitive(BASE, attributes=attributes, targets=[deltas])
    asset.json["meshes"][0]["weights"] = [1.0]
    primitive = asset.load().scene().primitives[0]
    np.testing.assert_array_equal(primitive.normals, [[1, 0, 0]] * 3)
    np.testing.assert_array_equal(primitive.tangents, [[0, 0, -1, -1]] * 3)


def test_displaced_colours_stay_within_zero_and_one(asset):
    colours = asset.accessor([[0.75, 0.5, 0.25]] * 3)
    target = {"COLOR_0": asset.accessor([[1, -1, 0.25]] * 3)}
    asset.primitive(BASE, attributes={"COLOR_0": colours}, targets=[target])
    asset.json["meshes"][0]["weights"] = [1.0]
    np.testing.assert_array_equal(asset.load().scene().primitives[0].colours, [[1, 0, 0.5, 1]] * 3)


def test_as_many_weights_as_targets_are_wanted(morphed):
    morphed.json["meshes"][0]["weights"] = [1.0]
    with pytest.raises(AssetError, match="2 morph targets and 1 weights"):
        _positions(morphed)


def test_a_target_with_other_vertices_is_refused(morphed):
    morphed.json["meshes"][0]["primitives"][0]["targets"][1]["POSITION"] = morphed.accessor([[0, 0, 0]] * 2)
    morphed.json["meshes"][0]["weights"] = [1.0, 1.0]
    with pytest.raises(AssetError) as caught:
        _positions(morphed)
    assert caught.value.pointer == "/meshes/0/primitives/0/targets/1/POSITION"


def test_a_displacement_beyond_float32_is_refused_without_a_warning(morphed):
    morphed.json["meshes"][0]["weights"] = [3e38, 0.0]
    with pytest.raises(AssetError, match="float32"):
        _positions(morphed)
