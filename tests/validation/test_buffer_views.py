"""Buffer views in their buffers, and what they are used for; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes
from small_meshes import (
    BUFFER,
    INDICES,
    INDICES_TARGET,
    POSITIONS,
    TIMES,
    VERTICES_TARGET,
    accessor,
    animation,
    mesh,
    view,
)

AT = "/bufferViews/0"
PRIMITIVE = "/meshes/0/primitives/0"


@pytest.mark.parametrize(
    ("given", "code", "key"),
    [
        ({"byteOffset": 999, "byteLength": 1}, None, ""),
        ({"byteOffset": 1000, "byteLength": 1}, "BUFFER_VIEW_TOO_LONG", "byteOffset"),
        ({"byteLength": 1001}, "BUFFER_VIEW_TOO_LONG", "byteLength"),
        ({"byteLength": 2**60}, "BUFFER_VIEW_TOO_LONG", "byteLength"),
        ({"byteLength": 12, "byteStride": 12}, None, ""),
        ({"byteLength": 8, "byteStride": 12}, "BUFFER_VIEW_TOO_BIG_BYTE_STRIDE", "byteStride"),
        ({"byteStride": 4, "target": VERTICES_TARGET}, None, ""),
        ({"byteStride": 4, "target": INDICES_TARGET}, "BUFFER_VIEW_INVALID_BYTE_STRIDE", "byteStride"),
    ],
)
def test_a_view_lies_in_its_buffer(codes: Codes, given: dict[str, Any], code: str | None, key: str) -> None:
    expected = {(code, f"{AT}/{key}")} if code else set()
    assert codes({"buffers": [BUFFER], "bufferViews": [view(**given)]}) == expected


def test_a_view_may_be_too_long_wherever_it_starts(codes: Codes) -> None:
    broken = ("TYPE_MISMATCH", f"{AT}/byteOffset")
    for length, others in ((1000, set()), (1002, {("BUFFER_VIEW_TOO_LONG", f"{AT}/byteLength")})):
        asset = {"buffers": [BUFFER], "bufferViews": [view(byteOffset="a", byteLength=length)]}
        assert codes(asset) == {broken, *others}


def stored(views: list[dict[str, Any]], **more: Any) -> dict[str, Any]:
    return {"buffers": [BUFFER], "bufferViews": views, **more}


def drawn(*views: dict[str, Any], indices: int = 1, **more: Any) -> dict[str, Any]:
    """Return an asset whose vertices read view 0, and its indices the view `indices`."""
    accessors = [{**POSITIONS, "bufferView": 0}, {**INDICES, "bufferView": indices}]
    return stored([*views], accessors=accessors, meshes=[mesh({"POSITION": 0}, indices=1)], **more)


VERTICES_VIEW, INDICES_VIEW = view(target=VERTICES_TARGET), view(target=INDICES_TARGET)


def test_views_of_vertices_and_indices_say_so(codes: Codes) -> None:
    assert codes(drawn(VERTICES_VIEW, INDICES_VIEW)) == set()
    missing = "BUFFER_VIEW_TARGET_MISSING"
    places = (f"{PRIMITIVE}/attributes/POSITION", f"{PRIMITIVE}/indices")
    assert codes(drawn(view(), view())) == {(missing, place) for place in places}


def test_a_view_serves_one_purpose(codes: Codes) -> None:
    overridden = "BUFFER_VIEW_TARGET_OVERRIDE"
    at_vertices, at_indices = f"{PRIMITIVE}/attributes/POSITION", f"{PRIMITIVE}/indices"
    assert codes(drawn(VERTICES_VIEW, indices=0)) == {(overridden, at_indices)}
    assert codes(drawn(INDICES_VIEW, indices=0)) == {(overridden, at_vertices)}
    first_come = {("BUFFER_VIEW_TARGET_MISSING", at_vertices), (overridden, at_indices)}
    assert codes(drawn(view(), indices=0)) == first_come


def test_images_come_before_meshes_wherever_they_stand_in_the_file(codes: Codes) -> None:
    images = [{"bufferView": 0, "mimeType": "image/png"}]
    found = codes(drawn(view(), INDICES_VIEW, images=images))
    assert found == {("BUFFER_VIEW_TARGET_OVERRIDE", f"{PRIMITIVE}/attributes/POSITION")}
    found = codes(drawn(VERTICES_VIEW, INDICES_VIEW, images=images))
    assert found == {("BUFFER_VIEW_TARGET_OVERRIDE", "/images/0/bufferView")}


def test_keyframes_and_matrices_have_views_without_target(codes: Codes) -> None:
    accessors = [{**TIMES, "bufferView": 0}, accessor(count=2, bufferView=0)]
    asset = stored([view()], accessors=accessors, animations=[animation("translation")], nodes=[{}])
    assert not {code for code, _ in codes(asset) if code.startswith("BUFFER_VIEW")}
    asset["bufferViews"] = [VERTICES_VIEW]
    places = {f"/animations/0/samplers/0/{key}" for key in ("input", "output")}
    assert codes(asset) >= {("BUFFER_VIEW_TARGET_OVERRIDE", place) for place in places}

    skins = [{"joints": [0], "inverseBindMatrices": 0}]
    asset = stored([VERTICES_VIEW], accessors=[accessor("MAT4", bufferView=0)], skins=skins, nodes=[{}])
    assert ("BUFFER_VIEW_TARGET_OVERRIDE", "/skins/0/inverseBindMatrices") in codes(asset)


def test_an_accessor_serves_one_purpose(codes: Codes) -> None:
    asset = {"accessors": [POSITIONS, INDICES], "meshes": [mesh({"POSITION": 0, "_OWN": 1}, indices=1)]}
    assert codes(asset) == {("ACCESSOR_USAGE_OVERRIDE", f"{PRIMITIVE}/indices")}
    moved = {"accessors": [TIMES], "animations": [animation("weights", node=None, output=0)]}
    assert codes(moved) == {("ACCESSOR_USAGE_OVERRIDE", "/animations/0/samplers/0/output")}


def test_attributes_that_share_a_view_are_strided(codes: Codes) -> None:
    accessors = [{**POSITIONS, "bufferView": 0}, {**POSITIONS, "bufferView": 0}]
    asset = stored([VERTICES_VIEW], accessors=accessors, meshes=[mesh({"POSITION": 0, "_OWN": 1})])
    without = ("MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE", f"{PRIMITIVE}/attributes/_OWN")
    assert codes(asset) == {without}
    asset["bufferViews"] = [{**VERTICES_VIEW, "byteStride": 12}]
    assert codes(asset) == set()
    asset["bufferViews"] = [VERTICES_VIEW]
    asset["meshes"] = [mesh({"POSITION": 0, "_OWN": 0})]
    assert codes(asset) == set()


def test_two_meshes_that_share_a_view_are_told_of_at_the_second(codes: Codes) -> None:
    accessors = [{**POSITIONS, "bufferView": 0}, {**POSITIONS, "bufferView": 0}]
    meshes = [mesh({"POSITION": 0}), mesh({"POSITION": 1}), mesh({"POSITION": 0})]
    without = "MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE"
    found = codes(stored([VERTICES_VIEW], accessors=accessors, meshes=meshes))
    assert found == {(without, "/meshes/1/primitives/0/attributes/POSITION")}
