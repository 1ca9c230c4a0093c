"""Accessors by themselves and in their buffer views; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes
from small_meshes import BUFFER, BYTE, FLOAT, SHORT, UNSIGNED_BYTE, UNSIGNED_INT, accessor, view

AT = "/accessors/0"


def in_view(element: dict[str, Any], **of_view: Any) -> dict[str, Any]:
    """Return an asset whose accessor reads a buffer view of 64 bytes."""
    views = [view(**{"byteLength": 64, **of_view})]
    return {"buffers": [BUFFER], "bufferViews": views, "accessors": [{"bufferView": 0, **element}]}


@pytest.mark.parametrize("component", [UNSIGNED_INT, FLOAT])
def test_only_small_integers_are_normalized(codes: Codes, component: int) -> None:
    asset = {"accessors": [accessor(component=component, normalized=True)]}
    assert codes(asset) == {("ACCESSOR_NORMALIZED_INVALID", f"{AT}/normalized")}
    asset["accessors"][0]["componentType"] = SHORT
    assert codes(asset) == set()


def test_components_start_on_multiples_of_their_size(codes: Codes) -> None:
    wrong = ("ACCESSOR_OFFSET_ALIGNMENT", f"{AT}/byteOffset")
    wrong_in_buffer = ("ACCESSOR_TOTAL_OFFSET_ALIGNMENT", AT)
    assert codes(in_view(accessor(byteOffset=4), byteOffset=8)) == set()
    assert codes(in_view(accessor(byteOffset=2))) == {wrong, wrong_in_buffer}
    assert codes(in_view(accessor(byteOffset=2), byteOffset=2)) == {wrong}
    assert codes(in_view(accessor(), byteOffset=2)) == {wrong_in_buffer}


def test_matrices_start_on_multiples_of_four_bytes(codes: Codes) -> None:
    assert codes(in_view(accessor("MAT2", BYTE, byteOffset=4))) == set()
    wrong = ("ACCESSOR_MATRIX_ALIGNMENT", f"{AT}/byteOffset")
    assert codes(in_view(accessor("MAT2", BYTE, byteOffset=2))) == {wrong}


def test_the_stride_holds_an_element(codes: Codes) -> None:
    assert codes(in_view(accessor(), byteStride=12)) == set()
    assert codes(in_view(accessor(), byteStride=8)) == {("ACCESSOR_SMALL_BYTESTRIDE", AT)}
    # The columns of a matrix of shorts take 8 bytes each, the last one 6.
    assert codes(in_view(accessor("MAT3", SHORT, 1), byteStride=24)) == set()
    assert codes(in_view(accessor("MAT3", SHORT, 1), byteStride=20)) == {("ACCESSOR_SMALL_BYTESTRIDE", AT)}


@pytest.mark.parametrize(
    ("element", "of_view", "where"),
    [
        (accessor(count=5, byteOffset=4), {}, None),
        (accessor(count=5, byteOffset=8), {}, AT),
        (accessor(count=4), {"byteStride": 16}, None),
        (accessor(count=5), {"byteStride": 16}, AT),
        (accessor("MAT2", BYTE, 2), {"byteLength": 14}, None),
        (accessor("MAT2", BYTE, 2), {"byteLength": 13}, AT),
        (accessor(count=1, byteOffset=64), {}, AT),
        (accessor(count=1, byteOffset=68), {}, f"{AT}/byteOffset"),
        (accessor(count=10**15), {}, AT),
        (accessor(count=2**60, byteOffset=2**60), {}, f"{AT}/byteOffset"),
    ],
)
def test_elements_fit_their_view(
    codes: Codes, element: dict[str, Any], of_view: dict[str, Any], where: str | None
) -> None:
    expected = set() if where is None else {("ACCESSOR_TOO_LONG", where)}
    assert codes(in_view(element, **of_view)) == expected


def test_a_broken_offset_is_told_once(codes: Codes) -> None:
    broken = ("VALUE_NOT_IN_RANGE", f"{AT}/byteOffset")
    assert codes(in_view(accessor(count=100, byteOffset=-1))) == {broken}


def sparse(count: int = 1, **of_view: Any) -> dict[str, Any]:
    asset = in_view(accessor(count=5), **of_view)
    asset["buffers"] = [{**BUFFER, "byteLength": 1000}]
    asset["accessors"][0] = accessor(count=5)
    asset["accessors"][0]["sparse"] = {
        "count": count,
        "indices": {"bufferView": 0, "componentType": UNSIGNED_BYTE},
        "values": {"bufferView": 0},
    }
    return asset


def test_sparse_elements_are_no_more_than_all(codes: Codes) -> None:
    assert codes(sparse(5)) == set()
    assert codes(sparse(6)) >= {("ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", f"{AT}/sparse/count")}


def test_sparse_parts_fit_their_views(codes: Codes) -> None:
    asset = sparse(5, byteLength=60)
    assert codes(asset) == set()
    asset["bufferViews"][0]["byteLength"] = 59
    assert codes(asset) == {("ACCESSOR_TOO_LONG", f"{AT}/sparse/values")}
    asset["accessors"][0]["sparse"]["indices"]["byteOffset"] = 60
    too_long = ("ACCESSOR_TOO_LONG", f"{AT}/sparse/indices/byteOffset")
    assert codes(asset) == {("ACCESSOR_TOO_LONG", f"{AT}/sparse/values"), too_long}


def test_views_of_sparse_parts_have_neither_stride_nor_target(codes: Codes) -> None:
    places = (f"{AT}/sparse/indices/bufferView", f"{AT}/sparse/values/bufferView")
    assert codes(sparse(byteStride=4)) == {("BUFFER_VIEW_INVALID_BYTE_STRIDE", place) for place in places}
    assert codes(sparse(target=34962)) == {("BUFFER_VIEW_TARGET_OVERRIDE", place) for place in places}


@pytest.mark.parametrize(
    ("element", "code"),
    [
        (accessor(min=[0, 0, 0]), None),
        (accessor(min=[0, 0]), "ARRAY_LENGTH_NOT_IN_LIST"),
        (accessor("MAT2", min=[0] * 4), None),
        (accessor("MAT2", min=[0] * 9), "ARRAY_LENGTH_NOT_IN_LIST"),
        (accessor(min=[0.5, 1e300, -1e300]), None),
        (accessor(component=BYTE, min=[-128, 127, 1.0]), None),
        (accessor(component=BYTE, min=[-129, 0, 0]), "INVALID_GL_VALUE"),
        (accessor(component=UNSIGNED_BYTE, min=[256, 0, 0]), "INVALID_GL_VALUE"),
        (accessor(component=UNSIGNED_INT, min=[2**32 - 1, 0, 0]), None),
        (accessor(component=UNSIGNED_INT, min=[1e300, 0, 0]), "INVALID_GL_VALUE"),
        (accessor(component=BYTE, normalized=True, min=[0.5, 0, 0]), "ARRAY_TYPE_MISMATCH"),
    ],
)
def test_bounds_have_a_number_of_the_type_for_each_component(
    codes: Codes, element: dict[str, Any], code: str | None
) -> None:
    assert codes({"accessors": [element]}) == ({(code, f"{AT}/min")} if code else set())


def test_infinite_bounds_of_integers_are_told(codes: Codes) -> None:
    # The Khronos validator stops with an exception of its own here.
    text = '{"asset":{"version":"2.0"},"accessors":[%s]}'
    element = '{"componentType":5121,"count":1,"type":"SCALAR","min":[1e999]}'
    assert codes(text % element) == {("VALUE_NOT_IN_RANGE", f"{AT}/min/0")}


def test_offsets_that_make_up_for_each_other_are_told_where_they_stand(codes: Codes) -> None:
    wrong = ("ACCESSOR_OFFSET_ALIGNMENT", f"{AT}/byteOffset")
    assert codes(in_view(accessor(byteOffset=1), byteOffset=3)) == {wrong}
