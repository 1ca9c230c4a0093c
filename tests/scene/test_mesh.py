from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.errors import AssetError
from gltf_iri.scene.mesh import to_trimesh

ZIGZAG = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 2, 0], [1, 2, 0]]
SQUARE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
UP = [[0, 0, 1]] * 4
TETRAHEDRON = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
TETRAHEDRON_FACES = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]


def _only(asset):
    (primitive,) = asset.load().scene().primitives
    return primitive


def _oriented(triangles):
    """Triangles as cycles that start at their lowest index, so that only the winding is compared."""
    return sorted(tuple(np.roll(t, -int(np.argmin(t)))) for t in np.asarray(triangles).tolist())


@pytest.mark.parametrize("is_indexed", [False, True])
@pytest.mark.parametrize(
    ("mode", "expected"),
    [
        (4, [(0, 1, 2), (3, 4, 5)]),
        (5, [(0, 1, 2), (1, 3, 2), (2, 3, 4), (3, 5, 4)]),
        (6, [(1, 2, 0), (2, 3, 0), (3, 4, 0), (4, 5, 0)]),
    ],
)
def test_lists_strips_and_fans_become_the_triangles_of_the_specification(asset, mode, expected, is_indexed):
    normals = asset.accessor([[0, 0, 1]] * 6)
    indices = range(6) if is_indexed else None
    asset.primitive(ZIGZAG, indices, mode=mode, attributes={"NORMAL": normals})
    assert _oriented(_only(asset).triangles) == _oriented(expected)


def test_every_triangle_of_a_flat_strip_faces_the_same_way(asset):
    asset.primitive(ZIGZAG, mode=5)
    np.testing.assert_array_equal(_only(asset).normals, [[0, 0, 1]] * 12)


def test_points_and_lines_are_passed_over_and_noted(asset):
    asset.primitive(ZIGZAG, mode=4)
    for mode in range(4):
        asset.primitive(ZIGZAG, mode=mode)
    scene = asset.load().scene()
    assert len(scene.primitives) == 1
    assert sum("not drawn" in note for note in scene.notes) == 4


def test_a_scene_of_points_alone_is_refused_in_one_sentence(asset):
    asset.primitive(ZIGZAG, mode=0)
    with pytest.raises(AssetError, match=r"no triangles to draw: .* holds points") as caught:
        asset.load().scene()
    assert caught.value.file == asset.path


def test_vertices_without_normals_are_unshared_and_get_their_faces_normal(asset):
    uvs = asset.accessor([[0, 0], [1, 0], [0, 1], [1, 1]])
    tangents = asset.accessor([[1, 0, 0, 1]] * 4)
    asset.primitive(TETRAHEDRON, TETRAHEDRON_FACES, attributes={"TEXCOORD_0": uvs, "TANGENT": tangents})
    primitive = _only(asset)
    assert primitive.tangents is None
    assert primitive.positions.shape == (12, 3)
    np.testing.assert_array_equal(primitive.positions, np.array(TETRAHEDRON)[TETRAHEDRON_FACES])
    np.testing.assert_array_equal(primitive.uvs[0][3:6], [[0, 0], [1, 0], [1, 1]])
    faces = primitive.positions[primitive.triangles].astype(np.float64)
    for corners, normals in zip(faces, primitive.normals[primitive.triangles], strict=True):
        outwards = np.mean(corners, axis=0) - 0.25  # from the tetrahedron's centroid
        assert np.all(normals @ (corners[1] - corners[0]) == pytest.approx(0, abs=1e-7))
        assert np.all(normals @ outwards > 0)
    np.testing.assert_allclose(np.linalg.norm(primitive.normals, axis=1), 1, atol=1e-7)


def test_a_degenerate_triangle_gets_a_normal_of_length_one(asset):
    asset.primitive([[0, 0, 0], [1, 0, 0], [2, 0, 0]])
    np.testing.assert_allclose(np.linalg.norm(_only(asset).normals, axis=1), 1)


def test_a_normal_of_length_zero_is_replaced_by_its_triangles_and_noted(asset):
    normals = asset.accessor([[0, 0, 2], [0, 0, 0], [0, 0, 1], [0, 0, 1]])
    asset.primitive(SQUARE, [0, 1, 2, 0, 2, 3], attributes={"NORMAL": normals})
    scene = asset.load().scene()
    np.testing.assert_array_equal(scene.primitives[0].normals, UP)
    assert any("1 normals of length 0" in note for note in scene.notes)


def test_tangents_stay_with_their_handedness(asset):
    tangents = asset.accessor([[2, 0, 0, 1], [1, 0, 0, -1], [1, 0, 0, 1], [1, 0, 0, 1]])
    normals = asset.accessor(UP)
    asset.primitive(SQUARE, [0, 1, 2], attributes={"NORMAL": normals, "TANGENT": tangents})
    np.testing.assert_array_equal(_only(asset).tangents[:2], [[1, 0, 0, 1], [1, 0, 0, -1]])


@pytest.mark.parametrize(
    ("values", "dtype", "normalized", "expected"),
    [
        ([[255, 0, 51]] * 4, "u1", True, (1, 0, 0.2, 1)),
        ([[65535, 0, 13107, 0]] * 4, "u2", True, (1, 0, 0.2, 0)),
        ([[0.5, 2.0, 0.25, 0.75]] * 4, "f4", False, (0.5, 2.0, 0.25, 0.75)),
    ],
)
def test_vertex_colours_are_linear_and_have_alpha(asset, values, dtype, normalized, expected):
    colours = asset.accessor(values, dtype, normalized=normalized)
    asset.primitive(SQUARE, [0, 1, 2], attributes={"COLOR_0": colours, "NORMAL": asset.accessor(UP)})
    np.testing.assert_allclose(_only(asset).colours, [expected] * 4, rtol=1e-6)


def test_quantised_positions_are_read_as_numbers(asset):
    asset.json["extensionsUsed"] = asset.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    primitive = asset.primitive(SQUARE, [0, 1, 2])
    primitive["attributes"]["POSITION"] = asset.accessor(100 * np.array(SQUARE), "i2")
    np.testing.assert_array_equal(_only(asset).positions, 100 * np.array(SQUARE)[:3])


def test_quantized_normals_tangents_and_coordinates_are_what_they_stand_for(asset):
    asset.json["extensionsUsed"] = asset.json["extensionsRequired"] = ["KHR_mesh_quantization"]
    primitive = asset.primitive(SQUARE[:3], [0, 1, 2])
    primitive["attributes"] |= {
        "NORMAL": asset.accessor([[0, 0, 127]] * 3, "i1", normalized=True),
        "TANGENT": asset.accessor([[127, 0, 0, -127]] * 3, "i1", normalized=True),
        "TEXCOORD_0": asset.accessor([[0, 0], [255, 0], [0, 51]], "u1", normalized=True),
    }
    read = _only(asset)
    np.testing.assert_array_equal(read.normals, [[0, 0, 1]] * 3)
    np.testing.assert_array_equal(read.tangents, [[1, 0, 0, -1]] * 3)
    np.testing.assert_allclose(read.uvs[0], [[0, 0], [1, 0], [0, 0.2]], rtol=1e-7)


def test_two_uv_sets_are_kept_and_a_missing_one_is_noted(asset):
    first, second = asset.accessor([[0, 0]] * 3), asset.accessor([[1, 1]] * 3)
    asset.json["images"] = [{"uri": "absent.png"}]
    asset.json["textures"] = [{"source": 0}]
    asset.json["materials"] = [{"normalTexture": {"index": 0, "texCoord": 1}}]
    asset.primitive(SQUARE[:3], attributes={"TEXCOORD_0": first, "TEXCOORD_1": second}, material=0)
    asset.primitive(SQUARE[:3], attributes={"TEXCOORD_0": first}, material=0)
    scene = asset.load().scene()
    np.testing.assert_array_equal(scene.primitives[0].uvs[1], [[1, 1]] * 3)
    assert [note for note in scene.notes if "TEXCOORD_1" in note] == [
        "/meshes/0/primitives/1 is textured by TEXCOORD_1, which it does not have."
    ]


@pytest.mark.parametrize(
    ("break_it", "pointer"),
    [
        (lambda a, p: p.update(indices=a.accessor([[0], [1], [4]], "u2")), "/meshes/0/primitives/0/indices"),
        (lambda a, p: p.update(indices=a.accessor([[0], [1], [2]])), "/meshes/0/primitives/0/indices"),
        (
            lambda a, p: p["attributes"].update(NORMAL=a.accessor([[0, 0, 1]] * 3)),
            "/meshes/0/primitives/0/attributes/NORMAL",
        ),
        (
            lambda a, p: p["attributes"].update(NORMAL=a.accessor([[0, 0]] * 4)),
            "/meshes/0/primitives/0/attributes/NORMAL",
        ),
    ],
    ids=["index past the end", "fractional index", "fewer normals than vertices", "flat normals"],
)
def test_contradictions_are_refused_with_their_pointer(asset, break_it, pointer):
    break_it(asset, asset.primitive(SQUARE))
    with pytest.raises(AssetError) as caught:
        asset.load().scene()
    assert caught.value.pointer == pointer


def test_an_incomplete_last_triangle_is_left_out_and_noted(asset):
    asset.primitive(ZIGZAG[:5])
    scene = asset.load().scene()
    assert len(scene.primitives[0].triangles) == 1
    assert any("incomplete" in note for note in scene.notes)


def test_instances_share_their_arrays(asset):
    asset.primitive(SQUARE, [0, 1, 2])
    asset.json["nodes"] = [{"mesh": 0}, {"mesh": 0, "translation": [5, 0, 0]}]
    asset.json["scenes"] = [{"nodes": [0, 1]}]
    first, second = asset.load().scene().primitives
    assert first.positions is second.positions
    assert second.world[0, 3] == 5


@pytest.mark.parametrize("scale", [[1, 1, 1], [-1, 1, 1], [-2, -3, -4]])
def test_a_solid_handed_to_trimesh_has_the_same_outside_mirrored_or_not(asset, scale):
    asset.primitive(TETRAHEDRON, TETRAHEDRON_FACES)
    asset.json["nodes"] = [{"mesh": 0, "scale": scale, "translation": [10, 0, 0]}]
    solid = to_trimesh(_only(asset))
    assert len(solid.vertices) == 12
    assert solid.volume == pytest.approx(abs(np.prod(scale)) / 6)
    np.testing.assert_allclose(np.sort(solid.bounds[:, 0]), sorted([10, 10 + scale[0]]))
