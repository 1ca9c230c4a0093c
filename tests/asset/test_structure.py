from __future__ import annotations

import copy
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.asset.limits import MAX_NODE_DEPTH
from gltf_iri.asset.structure import check_structure
from gltf_iri.errors import AssetError

# One of everything, all of it sound.
WHOLE: dict[str, Any] = {
    "asset": {"version": "2.0", "generator": "test", "extras": 5},
    "extensionsUsed": ["EXT_a", "EXT_b"],
    "scene": 0,
    "scenes": [{"nodes": [0, 3]}],
    "nodes": [
        {"children": [1, 2], "name": "root"},
        {"mesh": 0, "skin": 0, "rotation": [0, 0, 0, 1.0000001], "weights": [0.5]},
        {"camera": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]},
        {"camera": 1, "extensions": {"EXT_a": {"anything": [1, "x", None]}}},
    ],
    "meshes": [
        {
            "primitives": [
                {
                    "attributes": {"POSITION": 0, "_CUSTOM": 1},
                    "indices": 1,
                    "material": 0,
                    "mode": 4,
                    "targets": [{"POSITION": 0}],
                }
            ],
            "weights": [0],
        }
    ],
    "materials": [{"free": "form"}],
    "accessors": [
        {
            "componentType": 5126,
            "count": 3,
            "type": "VEC3",
            "bufferView": 0,
            "byteOffset": 0,
            "min": [0, 0, 0],
        },
        {
            "componentType": 5123,
            "count": 3,
            "type": "SCALAR",
            "sparse": {
                "count": 1,
                "indices": {"bufferView": 0, "componentType": 5121},
                "values": {"bufferView": 0, "byteOffset": 4},
            },
        },
    ],
    "bufferViews": [{"buffer": 0, "byteLength": 36, "byteStride": 12, "target": 34962}],
    "buffers": [{"byteLength": 36, "uri": "a.bin"}],
    "cameras": [
        {"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 10}},
    ],
    "images": [{"uri": "a.png"}, {"bufferView": 0, "mimeType": "image/webp"}],
    "samplers": [{"magFilter": 9729, "wrapS": 10497}],
    "textures": [{"sampler": 0, "source": 1}],
    "skins": [{"joints": [0, 1], "skeleton": 0, "inverseBindMatrices": 0}],
    "animations": [
        {
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "rotation"}}],
            "samplers": [{"input": 0, "output": 1, "interpolation": "STEP"}],
        },
        {
            "channels": [{"sampler": 1, "target": {"path": "pointer"}}],
            "samplers": [{"input": 0, "output": 0}, {"input": 1, "output": 1}],
        },
    ],
}

REMOVE = object()


def changed(pointer: str, value: Any) -> dict[str, Any]:
    """Copy WHOLE with one value replaced, added or removed."""
    root = copy.deepcopy(WHOLE)
    *path, last = [int(t) if t.isdigit() else t for t in pointer.split("/")[1:]]
    holder: Any = root
    for token in path:
        holder = holder[token]
    if value is REMOVE:
        del holder[last]
    else:
        holder[last] = value
    return root


def test_a_sound_asset_passes_unchanged_and_without_notes() -> None:
    root = copy.deepcopy(WHOLE)
    assert check_structure(root) == []
    assert root == WHOLE


@pytest.mark.parametrize(
    ("pointer", "value"),
    [
        ("/scene", 1),
        ("/scene", -1),
        ("/scene", 0.5),
        ("/scene", True),
        ("/scene", "0"),
        ("/scene", 1e300),
        ("/scenes/0/nodes/0", 4),
        ("/nodes/1/mesh", 1),
        ("/nodes/1/skin", 1),
        ("/nodes/2/camera", 2),
        ("/nodes/1/rotation/3", 1.1),
        ("/nodes/1/rotation/3", None),
        ("/nodes/2/matrix/0", 1e39),
        ("/nodes/0/name", 7),
        ("/nodes/1", []),
        ("/nodes/3/extensions", []),
        ("/nodes/3/extensions/EXT_a", 1),
        ("/meshes/0/primitives/0/attributes/POSITION", 2),
        ("/meshes/0/primitives/0/attributes/_CUSTOM", "1"),
        ("/meshes/0/primitives/0/attributes", [0]),
        ("/meshes/0/primitives/0/indices", 2),
        ("/meshes/0/primitives/0/material", 1),
        ("/meshes/0/primitives/0/mode", 7),
        ("/meshes/0/primitives/0/targets/0/POSITION", 2),
        ("/meshes/0/primitives/0/targets/0", 1),
        ("/materials/0", "red"),
        ("/materials", {}),
        ("/accessors/0/componentType", 5124),
        ("/accessors/0/type", "VEC5"),
        ("/accessors/0/count", 0),
        ("/accessors/0/count", 1.5),
        ("/accessors/0/byteOffset", -4),
        ("/accessors/0/bufferView", 1),
        ("/accessors/0/min/0", "0"),
        ("/accessors/1/sparse/indices/componentType", 5126),
        ("/accessors/1/sparse/values/bufferView", 1),
        ("/bufferViews/0/buffer", 1),
        ("/bufferViews/0/byteLength", 0),
        ("/bufferViews/0/byteStride", 13),
        ("/bufferViews/0/byteStride", 256),
        ("/buffers/0/byteLength", -1),
        ("/buffers/0/uri", 5),
        ("/cameras/0/perspective/yfov", 0),
        ("/cameras/0/type", "fisheye"),
        ("/images/1/bufferView", 1),
        ("/samplers/0/wrapS", 1),
        ("/textures/0/source", 2),
        ("/skins/0/joints/0", 4),
        ("/animations/0/channels/0/sampler", 1),
        ("/animations/0/channels/0/target/node", 9),
        ("/animations/0/samplers/0/output", 2),
        ("/asset/version", "1.0"),
        ("/asset/version", "2"),
        ("/asset/version", "2.0 "),
        ("/asset/minVersion", "2.1"),
        ("/extensionsUsed/0", 1),
        ("/extensionsUsed/1", "EXT_a"),
        ("/skins/0/joints/1", 0),
    ],
)
def test_a_wrong_value_is_refused_where_it_stands(pointer: str, value: Any) -> None:
    with pytest.raises(AssetError) as caught:
        check_structure(changed(pointer, value))
    assert caught.value.pointer == pointer


@pytest.mark.parametrize(
    ("pointer", "value", "where"),
    [
        ("/asset", REMOVE, ""),
        ("/asset/version", REMOVE, "/asset"),
        ("/accessors/0/count", REMOVE, "/accessors/0"),
        ("/accessors/1/sparse/indices", REMOVE, "/accessors/1/sparse"),
        ("/meshes/0/primitives", REMOVE, "/meshes/0"),
        ("/meshes/0/primitives", [], "/meshes/0/primitives"),
        ("/cameras/0/perspective", REMOVE, "/cameras/0"),
        ("/cameras/0/orthographic", WHOLE["cameras"][1]["orthographic"], "/cameras/0"),
        ("/images/0/uri", REMOVE, "/images/0"),
        ("/images/1/uri", "b.png", "/images/1"),
        ("/nodes/2/scale", [1, 1, 1], "/nodes/2"),
        ("/nodes/1/rotation", [0, 0, 1], "/nodes/1/rotation"),
        ("/accessors/0/max", [0] * 17, "/accessors/0/max"),
    ],
)
def test_what_is_missing_or_excluded_is_named(pointer: str, value: Any, where: str) -> None:
    with pytest.raises(AssetError) as caught:
        check_structure(changed(pointer, value))
    assert caught.value.pointer == where


@pytest.mark.parametrize("root", [[], None, "glTF", 5])
def test_a_root_that_is_no_object_is_refused(root: Any) -> None:
    with pytest.raises(AssetError, match="glTF is an object"):
        check_structure(root)


@pytest.mark.parametrize(
    ("pointer", "value"),
    [
        ("/nodes/0/children", []),
        ("/extensionsUsed", []),
        ("/animations/0/channels/0/unknown", 1),
        ("/accessors/1/byteOffset", 0),
        ("/images/1/mimeType", REMOVE),
        ("/asset/version", "2.1"),
    ],
)
def test_what_cannot_hurt_is_at_most_a_note(pointer: str, value: Any) -> None:
    notes = check_structure(changed(pointer, value))
    assert len(notes) == (0 if "unknown" in pointer else 1)
    assert all(note.endswith(".") for note in notes)


def test_the_same_remark_is_made_once() -> None:
    nodes: list[dict[str, Any]] = [{"children": []} for _ in range(1000)]
    (note,) = check_structure({"asset": {"version": "2.0"}, "nodes": nodes})
    assert note.startswith("/nodes/0/children: ")
    assert "999 more" in note


def test_an_integer_written_as_float_becomes_an_integer() -> None:
    root = changed("/nodes/1/mesh", 0.0)
    root["accessors"][0]["count"] = 3.0
    check_structure(root)
    assert root == WHOLE
    assert isinstance(root["nodes"][1]["mesh"], int)
    assert isinstance(root["accessors"][0]["count"], int)


@pytest.mark.parametrize(
    ("children", "pointer"),
    [
        ({0: [0]}, "/nodes/0/children"),
        ({0: [1], 1: [0]}, "/nodes/0/children"),
        ({0: [1], 2: [3], 3: [4], 4: [2]}, "/nodes/2/children"),
        ({0: [1], 2: [1]}, "/nodes/2/children/0"),
        ({0: [1, 1]}, "/nodes/0/children/1"),
    ],
)
def test_cycles_and_second_parents_are_refused(children: dict[int, list[int]], pointer: str) -> None:
    nodes: list[dict[str, Any]] = [{"children": children[i]} if i in children else {} for i in range(5)]
    with pytest.raises(AssetError) as caught:
        check_structure({"asset": {"version": "2.0"}, "nodes": nodes})
    assert caught.value.pointer == pointer


def test_a_scene_lists_roots_only() -> None:
    root = {"asset": {"version": "2.0"}, "nodes": [{"children": [1]}, {}], "scenes": [{"nodes": [0, 1]}]}
    with pytest.raises(AssetError) as caught:
        check_structure(root)
    assert caught.value.pointer == "/scenes/0/nodes/1"


@pytest.mark.parametrize("order", [1, -1])
def test_depth_of_the_tree_is_bounded(order: int) -> None:
    def chain(length: int) -> dict[str, Any]:
        nodes: list[dict[str, Any]] = [{"children": [i + order]} for i in range(length)]
        nodes[-1 if order == 1 else 0] = {}
        return {"asset": {"version": "2.0"}, "nodes": nodes}

    assert check_structure(chain(MAX_NODE_DEPTH)) == []
    for length in (MAX_NODE_DEPTH + 1, 50_000):
        with pytest.raises(AssetError, match=f"deeper than {MAX_NODE_DEPTH}"):
            check_structure(chain(length))


def places(value: Any, pointer: str = "") -> list[str]:
    found = [pointer] if pointer else []
    items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    return found + [place for key, child in items for place in places(child, f"{pointer}/{key}")]


@given(
    st.sampled_from(places(WHOLE)),
    st.sampled_from([None, True, -1, 0, 1, 0.5, 1e30, 2**53, "", "x", [], [0], {}, {"a": 0}, REMOVE]),
)
def test_any_single_change_passes_or_is_an_asset_error(pointer: str, value: Any) -> None:
    try:
        notes = check_structure(changed(pointer, value))
    except AssetError as error:
        assert error.pointer is not None
        assert not error.what.endswith(".")
    else:
        assert all(isinstance(note, str) for note in notes)
