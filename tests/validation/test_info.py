"""The report's numbers about an asset; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Judge
from small_meshes import INDICES, POSITIONS, UNSIGNED_BYTE, accessor, mesh
from small_pictures import data_uri, jpeg, png, sof

NOTHING = {
    "version": "2.0",
    "animationCount": 0,
    "materialCount": 0,
    "hasMorphTargets": False,
    "hasSkins": False,
    "hasTextures": False,
    "hasDefaultScene": False,
    "drawCallCount": 0,
    "totalVertexCount": 0,
    "totalTriangleCount": 0,
    "maxUVs": 0,
    "maxInfluences": 0,
    "maxAttributes": 0,
}
POSITION, UV, VEC4, JOINTS, INDEX = range(5)


def info(judge: Judge, asset: dict[str, Any]) -> dict[str, Any]:
    return judge(asset).info or {}


def of(attributes: dict[str, Any], count: int = 10, **more: Any) -> dict[str, Any]:
    accessors = [
        {**POSITIONS, "count": count},
        accessor("VEC2", count=count),
        accessor("VEC4", count=count),
        accessor("VEC4", UNSIGNED_BYTE, count=count),
        {**INDICES, "count": 7},
    ]
    return {"accessors": accessors, "meshes": [mesh({"POSITION": POSITION, **attributes}, **more)]}


def test_an_empty_asset_has_all_numbers_in_their_order(judge: Judge) -> None:
    assert list(info(judge, {}).items()) == list(NOTHING.items())


@pytest.mark.parametrize("version", ["3.0", "1.0", "2", "2.0.0", "a", 2, None])
def test_of_an_unknown_version_nothing_is_said(judge: Judge, version: Any) -> None:
    assert judge({"asset": {"version": version}}).info is None


def test_a_later_minor_version_is_looked_at(judge: Judge) -> None:
    assert info(judge, {"asset": {"version": "2.1"}})["version"] == "2.1"


def test_what_the_file_says_of_itself_is_repeated_where_it_is_sound(judge: Judge) -> None:
    stated = {"version": "2.0", "minVersion": "2.0", "generator": ""}
    names = {"extensionsUsed": ["X_a", "X_b", "X_a"], "extensionsRequired": ["X_b"]}
    told = info(judge, {"asset": {**stated, "copyright": "c"}, **names})
    assert list(told)[:5] == ["version", "minVersion", "generator", "extensionsUsed", "extensionsRequired"]
    assert (told["generator"], told["extensionsUsed"], told["extensionsRequired"]) == (
        "",
        ["X_a", "X_b"],
        ["X_b"],
    )
    broken = {"asset": {"version": "2.0", "minVersion": "a", "generator": 5}, "extensionsUsed": ["X_a", 5]}
    assert info(judge, broken) == NOTHING


@pytest.mark.parametrize(
    ("asset", "told"),
    [
        ({"animations": [5, {}]}, {"animationCount": 2}),
        ({"materials": [{}, 5, {}]}, {"materialCount": 3}),
        ({"skins": [5]}, {"hasSkins": True}),
        ({"skins": []}, {}),
        ({"textures": [{}]}, {"hasTextures": True}),
        ({"textures": 5}, {}),
        ({"scene": 0, "scenes": [{}]}, {"hasDefaultScene": True}),
        ({"scene": 1, "scenes": [{}]}, {}),
        ({"scenes": [{}]}, {}),
    ],
)
def test_arrays_are_counted_with_what_is_broken_in_them(
    judge: Judge, asset: dict[str, Any], told: dict[str, Any]
) -> None:
    assert info(judge, asset) == {**NOTHING, **told}


@pytest.mark.parametrize(
    ("mode", "triangles", "indexed_triangles"),
    [(0, 0, 0), (1, 0, 0), (3, 0, 0), (4, 3, 2), (5, 8, 5), (6, 8, 5), (7, 0, 0), ("a", 0, 0)],
)
def test_triangles_follow_from_mode_and_count(
    judge: Judge, mode: Any, triangles: int, indexed_triangles: int
) -> None:
    assert info(judge, of({}, mode=mode))["totalTriangleCount"] == triangles
    indexed = of({}, mode=mode)
    indexed["meshes"][0]["primitives"][0]["indices"] = INDEX
    told = info(judge, indexed)
    assert (told["totalVertexCount"], told["totalTriangleCount"]) == (10, indexed_triangles)


@pytest.mark.parametrize("mode", [4, 5, 6])
@pytest.mark.parametrize(("count", "strip"), [(1, 0), (2, 0), (3, 1), (4, 2)])
def test_too_few_vertices_make_no_triangle(judge: Judge, mode: int, count: int, strip: int) -> None:
    expected = count // 3 if mode == 4 else strip
    assert info(judge, of({}, count, mode=mode))["totalTriangleCount"] == expected


def test_huge_counts_are_numbers(judge: Judge) -> None:
    assert info(judge, of({}, 3 * 10**15))["totalTriangleCount"] == 10**15


@pytest.mark.parametrize(
    ("attributes", "uvs", "influences", "attribute_count"),
    [
        ({}, 0, 0, 1),
        ({"TEXCOORD_0": UV, "TEXCOORD_1": UV}, 2, 0, 3),
        ({"TEXCOORD_0": UV, "TEXCOORD_2": UV}, 0, 0, 3),
        ({"TEXCOORD_0": 99}, 1, 0, 1),
        ({"TEXCOORD_0": UV, "TEXCOORD_01": UV, "_OWN": UV}, 1, 0, 4),
        ({"JOINTS_0": JOINTS, "WEIGHTS_0": VEC4}, 0, 4, 3),
        ({"JOINTS_0": JOINTS, "WEIGHTS_0": VEC4, "JOINTS_1": JOINTS, "WEIGHTS_1": VEC4}, 0, 8, 5),
        ({"JOINTS_0": JOINTS, "WEIGHTS_0": VEC4, "JOINTS_1": JOINTS}, 0, 0, 4),
        ({"JOINTS_1": JOINTS, "WEIGHTS_1": VEC4}, 0, 0, 3),
    ],
)
def test_sets_of_attributes_are_counted_where_they_have_no_gap(
    judge: Judge, attributes: dict[str, int], uvs: int, influences: int, attribute_count: int
) -> None:
    told = info(judge, of(attributes))
    assert (told["maxUVs"], told["maxInfluences"], told["maxAttributes"]) == (
        uvs,
        influences,
        attribute_count,
    )


def test_the_first_attribute_with_a_count_says_how_many_vertices_there_are(judge: Judge) -> None:
    accessors = [accessor(count=0), accessor(count=5), accessor(count=6)]
    primitive = {"attributes": {"NORMAL": 0, "TANGENT": 99, "POSITION": 1, "_OWN": 2}}
    told = info(judge, {"accessors": accessors, "meshes": [{"primitives": [primitive]}]})
    assert told["totalVertexCount"] == 5


def test_every_primitive_is_one_draw_call_however_often_it_is_shown(judge: Judge) -> None:
    asset = of({})
    asset["meshes"] = [*asset["meshes"], *asset["meshes"], {"primitives": [{}]}]
    asset["nodes"] = [{"mesh": 0}, {"mesh": 0}]
    told = info(judge, asset)
    assert (told["drawCallCount"], told["totalVertexCount"]) == (3, 20)


@pytest.mark.parametrize(
    ("targets", "has_targets"),
    [
        ([{"POSITION": POSITION}], True),
        ([{"POSITION": 99}], True),
        ([{}], False),
        ([{"POSITION": 0}, {}], False),
    ],
)
def test_morph_targets_are_there_where_none_is_empty(judge: Judge, targets: Any, has_targets: bool) -> None:
    assert info(judge, of({}, targets=targets))["hasMorphTargets"] is has_targets


def test_resources_say_what_and_where_they_are(judge: Judge) -> None:
    picture = jpeg(sof())
    asset = {
        "buffers": [
            {"byteLength": 9, "uri": data_uri(bytes(9), "application/octet-stream")},
            {"byteLength": 1},
        ],
        "images": [
            {"uri": data_uri(png(bits=16))},
            {"uri": "a.png"},
            {"uri": data_uri(picture, "image/jpeg")},
        ],
    }
    told = info(judge, asset)["resources"]
    assert [list(one.items()) for one in told] == [
        [
            ("pointer", "/buffers/0"),
            ("mimeType", "application/gltf-buffer"),
            ("storage", "data-uri"),
            ("byteLength", 9),
        ],
        [("pointer", "/buffers/1"), ("mimeType", "application/gltf-buffer")],
        [
            ("pointer", "/images/0"),
            ("mimeType", "image/png"),
            ("storage", "data-uri"),
            (
                "image",
                {
                    "width": 4,
                    "height": 4,
                    "format": "rgba",
                    "primaries": "srgb",
                    "transfer": "srgb",
                    "bits": 16,
                },
            ),
        ],
        [("pointer", "/images/1"), ("storage", "external"), ("uri", "a.png")],
        [
            ("pointer", "/images/2"),
            ("mimeType", "image/jpeg"),
            ("storage", "data-uri"),
            ("image", {"width": 4, "height": 4, "format": "rgb", "bits": 8}),
        ],
    ]


def test_a_report_that_is_cut_short_has_no_numbers(judge: Judge) -> None:
    assert judge({"foo": 1, "bar": 2}, max_issues=1).info is None
