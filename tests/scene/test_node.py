from __future__ import annotations

import math

import numpy as np
import pytest

from gltf_iri.errors import AssetError, UsageError
from gltf_iri.scene.node import rotation_matrix, world_matrices


def _moved(world, point):
    return (world @ [*point, 1.0])[:3]


def test_a_node_scales_then_rotates_then_translates():
    quarter_turn_about_y = [0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5)]
    node = {"translation": [1, 2, 3], "rotation": quarter_turn_about_y, "scale": [2, 3, 4]}
    (world,) = world_matrices({"nodes": [node]}, [])
    np.testing.assert_allclose(_moved(world, (1, 0, 0)), (1, 2, 1), atol=1e-15)  # 2 x̂ → −2 ẑ
    np.testing.assert_allclose(_moved(world, (0, 1, 0)), (1, 5, 3), atol=1e-15)
    np.testing.assert_allclose(_moved(world, (0, 0, 1)), (5, 2, 3), atol=1e-15)  # 4 ẑ → 4 x̂


def test_a_rotation_turns_vectors_as_rodrigues_formula_does():
    g = np.random.default_rng(5)
    for _ in range(50):
        axis = g.normal(size=3)
        axis /= np.linalg.norm(axis)
        angle, vector = g.uniform(-math.pi, math.pi), g.normal(size=3)
        quaternion = [*(math.sin(angle / 2) * axis), math.cos(angle / 2)]
        expected = (
            vector * math.cos(angle)
            + np.cross(axis, vector) * math.sin(angle)
            + axis * (axis @ vector) * (1 - math.cos(angle))
        )
        np.testing.assert_allclose(rotation_matrix(quaternion) @ vector, expected, atol=1e-14)


def test_a_matrix_is_stored_column_by_column():
    node = {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1]}
    (world,) = world_matrices({"nodes": [node]}, [])
    np.testing.assert_array_equal(_moved(world, (0, 0, 0)), (7, 8, 9))


def test_children_move_with_their_parents_whatever_the_order_in_the_file():
    nodes = [{"translation": [1, 0, 0]}, {"scale": [2, 2, 2], "children": [0]}, {"children": [1]}]
    nodes[2]["translation"] = [0, 10, 0]
    worlds = world_matrices({"nodes": nodes}, [])
    np.testing.assert_array_equal(_moved(worlds[0], (1, 1, 1)), (4, 12, 2))
    np.testing.assert_array_equal(_moved(worlds[1], (1, 1, 1)), (2, 12, 2))


def test_a_very_long_chain_of_nodes_is_walked():
    length = 5000  # far beyond Python's own recursion limit
    nodes = [{"translation": [1, 0, 0], "children": [i + 1]} for i in range(length - 1)]
    worlds = world_matrices({"nodes": [*nodes, {}]}, [])
    np.testing.assert_array_equal(_moved(worlds[-1], (0, 0, 0)), (length - 1, 0, 0))


def test_a_rotation_that_is_not_of_unit_length_is_normalised_and_noted():
    notes: list[str] = []
    (world,) = world_matrices({"nodes": [{"rotation": [0, 0, 0.5, 0.5]}]}, notes)
    np.testing.assert_allclose(_moved(world, (1, 0, 0)), (0, 1, 0), atol=1e-15)
    assert any("/nodes/0/rotation" in note for note in notes)


@pytest.mark.parametrize(
    ("node", "pointer"),
    [
        ({"rotation": [0, 0, 0, 0]}, "/nodes/0/rotation"),
        ({"matrix": [1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}, "/nodes/0/matrix"),
    ],
)
def test_numbers_that_are_no_affine_transform_are_refused(node, pointer):
    with pytest.raises(AssetError) as caught:
        world_matrices({"nodes": [node]}, [])
    assert caught.value.pointer == pointer


def test_a_mirrored_node_is_known_by_its_determinant(triangle):
    triangle.json["nodes"] = [{"mesh": 0, "scale": [-1, 1, 1]}, {"mesh": 0, "scale": [-1, -1, 1]}]
    triangle.json["scenes"] = [{"nodes": [0, 1]}]
    once, twice = triangle.load().scene().primitives
    assert once.is_mirrored
    assert not twice.is_mirrored


def test_the_default_scene_is_drawn_and_another_on_request(triangle):
    triangle.json["nodes"] = [{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b"}]
    triangle.json["scenes"] = [{"nodes": [0]}, {"nodes": [1], "name": "second"}]
    triangle.json["scene"] = 1
    model = triangle.load()
    assert [p.node_name for p in model.scene().primitives] == ["b"]
    assert model.scene().name == "second"
    assert [p.node_name for p in model.scene(0).primitives] == ["a"]


def test_without_a_default_the_first_scene_is_drawn_and_noted(triangle):
    triangle.json["nodes"] = [{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b"}]
    triangle.json["scenes"] = [{"nodes": [0]}, {"nodes": [1]}]
    del triangle.json["scene"]
    scene = triangle.load().scene()
    assert [p.node_name for p in scene.primitives] == ["a"]
    assert any("default scene" in note for note in scene.notes)


def test_without_scenes_every_root_node_is_drawn_and_noted(triangle):
    triangle.json["nodes"] = [{"mesh": 0, "name": "child"}, {"mesh": 0, "name": "root", "children": [0]}]
    del triangle.json["scenes"], triangle.json["scene"]
    scene = triangle.load().scene()
    assert sorted(p.node_name for p in scene.primitives) == ["child", "root"]
    assert any("no scene" in note for note in scene.notes)


def test_asking_for_a_scene_that_is_not_there_is_a_wrong_call(triangle):
    with pytest.raises(UsageError, match="no scene 3"):
        triangle.load().scene(3)
