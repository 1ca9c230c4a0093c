from __future__ import annotations

import itertools
import math
import struct
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gltf_iri.asset import accessor as accessor_module
from gltf_iri.asset.accessor import BufferView, read_accessor
from gltf_iri.asset.document import Document
from gltf_iri.asset.guard import Budget
from gltf_iri.asset.limits import MAX_BUFFERLESS_COUNT
from gltf_iri.errors import AssetError

OpenAccessor = Callable[..., Document]

LETTERS = {5120: "b", 5121: "B", 5122: "h", 5123: "H", 5125: "I", 5126: "f"}
LARGEST = {5120: 127, 5121: 255, 5122: 32767, 5123: 65535}
TYPES = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


def places_in_element(kind: str, size: int) -> list[int]:
    """Byte offset of each component: matrices column by column, each column on a 4-byte boundary."""
    if not kind.startswith("MAT"):
        return [i * size for i in range(TYPES[kind])]
    rows = int(kind[3])
    step = math.ceil(rows * size / 4) * 4
    return [column * step + row * size for column in range(rows) for row in range(rows)]


def decoded_by_struct(
    data: bytes, kind: str, component: int, count: int, offset: int, stride: int, normalized: bool
) -> list[list[float]]:
    """Decode component by component, as the specification reads."""
    size = struct.calcsize(LETTERS[component])
    rows = []
    for element in range(count):
        values = []
        for place in places_in_element(kind, size):
            (value,) = struct.unpack_from("<" + LETTERS[component], data, offset + element * stride + place)
            if normalized:
                value = max(value / LARGEST[component], -1.0)
            values.append(value)
        rows.append(values)
    return rows


@st.composite
def accessors(draw: st.DrawFn) -> tuple[dict[str, Any], bytes, int | None]:
    """Draw an accessor, enough bytes, and the stride of its buffer view."""
    component = draw(st.sampled_from(sorted(LETTERS)))
    kind = draw(st.sampled_from(sorted(TYPES)))
    size = struct.calcsize(LETTERS[component])
    places = places_in_element(kind, size)
    tight = math.ceil((places[-1] + size) / 4) * 4 if kind.startswith("MAT") else places[-1] + size
    stride = draw(st.none() | st.integers(math.ceil(tight / 4), 63).map(lambda words: 4 * words))
    count = draw(st.integers(1, 5))
    offset = size * draw(st.integers(0, 3))
    used = offset + (stride or tight) * (count - 1) + places[-1] + size
    data = bytearray(draw(st.binary(min_size=used, max_size=used + 3)))
    if component == 5126:
        for element, place in itertools.product(range(count), places):
            value = draw(st.floats(width=32, allow_nan=False, allow_infinity=False))
            struct.pack_into("<f", data, offset + element * (stride or tight) + place, value)
    accessor = {
        "componentType": component,
        "type": kind,
        "count": count,
        "byteOffset": offset,
        "bufferView": 0,
    }
    if component in LARGEST and draw(st.booleans()):
        accessor["normalized"] = True
    return accessor, bytes(data), stride


@given(accessors())
def test_decoding_agrees_with_the_specification_read_component_by_component(
    drawn: tuple[dict[str, Any], bytes, int | None],
) -> None:
    accessor, data, stride = drawn
    component, kind, count = accessor["componentType"], accessor["type"], accessor["count"]
    normalized = accessor.get("normalized", False)
    view = BufferView(memoryview(data), stride)
    array = read_accessor(accessor, "/accessors/0", lambda index, asker: view, Budget())

    size = struct.calcsize(LETTERS[component])
    places = places_in_element(kind, size)
    tight = math.ceil((places[-1] + size) / 4) * 4 if kind.startswith("MAT") else places[-1] + size
    expected = np.array(
        decoded_by_struct(data, kind, component, count, accessor["byteOffset"], stride or tight, normalized)
    )
    if kind.startswith("MAT"):
        order = int(kind[3])
        assert array.shape == (count, order, order)
        expected = expected.reshape(count, order, order).transpose(0, 2, 1)  # stored by columns
    else:
        assert array.shape == (count, TYPES[kind])
    assert array.dtype == (np.float32 if normalized or component == 5126 else np.dtype(LETTERS[component]))
    np.testing.assert_array_equal(array, expected.astype(array.dtype))
    assert not array.flags.writeable


@given(accessors(), st.integers(1, 60))
def test_bytes_that_end_too_early_are_refused(
    drawn: tuple[dict[str, Any], bytes, int | None], missing: int
) -> None:
    accessor, data, stride = drawn
    view = BufferView(memoryview(data[: max(len(data) - 3 - missing, 0)]), stride)
    with pytest.raises(AssetError) as caught:
        read_accessor(accessor, "/accessors/0", lambda index, asker: view, Budget())
    assert caught.value.pointer == "/accessors/0"


@pytest.mark.parametrize(
    ("component", "stored", "decoded"),
    [
        (5120, [-128, -127, 0, 127], [-1.0, -1.0, 0.0, 1.0]),
        (5121, [0, 51, 255], [0.0, 0.2, 1.0]),
        (5122, [-32768, -32767, 32767], [-1.0, -1.0, 1.0]),
        (5123, [0, 13107, 65535], [0.0, 0.2, 1.0]),
    ],
)
def test_normalised_integers_reach_both_ends(
    component: int, stored: list[int], decoded: list[float], open_accessor: OpenAccessor
) -> None:
    data = struct.pack(f"<{len(stored)}{LETTERS[component]}", *stored)
    accessor = {"bufferView": 0, "componentType": component, "type": "SCALAR", "count": len(stored)}
    array = open_accessor({**accessor, "normalized": True}, data).accessor(0)
    np.testing.assert_array_equal(array[:, 0], np.array(decoded, np.float32))


def sparse(count: int, component: int = 5121, **base: Any) -> dict[str, Any]:
    """Describe a VEC2 accessor of 5 elements whose indices are view 1 and whose values are view 2."""
    return {
        "componentType": 5126,
        "type": "VEC2",
        "count": 5,
        "sparse": {
            "count": count,
            "indices": {"bufferView": 1, "componentType": component},
            "values": {"bufferView": 2},
        },
        **base,
    }


def sparse_bytes(*indices: int, letter: str = "B") -> tuple[bytes, tuple[tuple[int, int], ...]]:
    """Lay out 5 base elements, the indices, and replacements (100 + i, 200 + i)."""
    base = struct.pack("<10f", *range(10))
    at = struct.pack(f"<{len(indices)}{letter}", *indices)
    at += b"\0" * (-len(at) % 4)
    values = b"".join(struct.pack("<2f", 100 + i, 200 + i) for i in indices)
    return base + at + values, ((40, len(at)), (40 + len(at), len(values)))


@pytest.mark.parametrize(("component", "letter"), [(5121, "B"), (5123, "H"), (5125, "I")])
@pytest.mark.parametrize("has_base", [True, False])
def test_sparse_values_replace_the_base_or_zeros(
    component: int, letter: str, has_base: bool, open_accessor: OpenAccessor
) -> None:
    data, views = sparse_bytes(1, 4, letter=letter)
    description = sparse(2, component, **({"bufferView": 0} if has_base else {}))
    array = open_accessor(description, data, None, views).accessor(0)
    expected = np.arange(10, dtype=np.float32).reshape(5, 2) * has_base
    expected[1], expected[4] = (101, 201), (104, 204)
    np.testing.assert_array_equal(array, expected)


@pytest.mark.parametrize(
    ("indices", "count", "pointer"),
    [
        ((1, 5), 2, "/accessors/0/sparse/indices"),
        ((4, 1), 2, "/accessors/0/sparse/indices"),
        ((1, 1), 2, "/accessors/0/sparse/indices"),
        ((1, 2), 6, "/accessors/0/sparse/count"),
        ((1,), 5, "/accessors/0/sparse/indices"),
    ],
)
def test_sparse_parts_must_be_ordered_in_range_and_all_there(
    indices: tuple[int, ...], count: int, pointer: str, open_accessor: OpenAccessor
) -> None:
    data, views = sparse_bytes(*indices)
    with pytest.raises(AssetError) as caught:
        open_accessor(sparse(count, bufferView=0), data, None, views).accessor(0)
    assert caught.value.pointer == pointer


def test_sparse_values_must_all_be_there(open_accessor: OpenAccessor) -> None:
    data, (indices, (start, length)) = sparse_bytes(1, 4)
    with pytest.raises(AssetError) as caught:
        open_accessor(sparse(2), data, None, (indices, (start, length - 1))).accessor(0)
    assert caught.value.pointer == "/accessors/0/sparse/values"


def test_sparse_normalised_values_are_decoded_too(open_accessor: OpenAccessor) -> None:
    description = sparse(1, componentType=5121, normalized=True)
    array = open_accessor(description, bytes([3, 0, 0, 0, 255, 51]), None, ((0, 4), (4, 2))).accessor(0)
    np.testing.assert_array_equal(array[3], np.array([1.0, 0.2], np.float32))
    assert not array[[0, 1, 2, 4]].any()


def test_an_accessor_without_bytes_is_zeros(open_accessor: OpenAccessor) -> None:
    array = open_accessor({"componentType": 5123, "type": "MAT3", "count": 2}, b"....").accessor(0)
    assert array.shape == (2, 3, 3)
    assert array.dtype == np.uint16
    assert not array.any()


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_floats_that_are_not_finite_are_refused(value: float, open_accessor: OpenAccessor) -> None:
    data = struct.pack("<4f", 0, 1, 2, value)
    document = open_accessor({"bufferView": 0, "componentType": 5126, "type": "VEC2", "count": 2}, data)
    with pytest.raises(AssetError, match=f"element 1 .* is {value}") as caught:
        document.accessor(0)
    assert caught.value.pointer == "/accessors/0"


@pytest.mark.parametrize("count", [10**10, 2**31, 10**15, 2**53])
@pytest.mark.parametrize("base", [{}, {"bufferView": 0}])
def test_absurd_counts_cost_nothing(count: int, base: dict[str, int], open_accessor: OpenAccessor) -> None:
    document = open_accessor({"componentType": 5126, "type": "MAT4", "count": count, **base}, b"\0" * 64)
    start = time.process_time()
    with pytest.raises(AssetError):
        document.accessor(0)
    assert time.process_time() - start < 0.5


def test_zeros_are_bounded_by_count(open_accessor: OpenAccessor) -> None:
    description = {"componentType": 5121, "type": "SCALAR", "count": MAX_BUFFERLESS_COUNT + 1}
    with pytest.raises(AssetError) as caught:
        open_accessor(description, b"....").accessor(0)
    assert caught.value.pointer == "/accessors/0/count"


def test_sparse_parts_are_tightly_packed() -> None:
    def views(index: int, asker: str) -> BufferView:
        return BufferView(memoryview(b"\0" * 40), 4 if index == 1 else None)

    with pytest.raises(AssetError, match="byteStride"):
        read_accessor(sparse(1), "/accessors/0", views, Budget())


def test_many_accessors_over_the_same_bytes_are_bounded_by_their_sum(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(accessor_module, "MAX_BUFFERLESS_COUNT", 2**40)
    description = {"componentType": 5126, "type": "MAT4", "count": 2**30}
    with pytest.raises(AssetError, match="the most that is held"):
        read_accessor(description, "/accessors/7", lambda index, asker: pytest.fail("no view"), Budget())


def test_elements_may_not_overlap(open_accessor: OpenAccessor) -> None:
    description = {"bufferView": 0, "componentType": 5126, "type": "VEC4", "count": 2}
    with pytest.raises(AssetError, match="overlap"):
        open_accessor(description, b"\0" * 64, 12).accessor(0)


def test_wide_integers_are_not_normalised(open_accessor: OpenAccessor) -> None:
    description = {"bufferView": 0, "componentType": 5125, "type": "SCALAR", "count": 1, "normalized": True}
    with pytest.raises(AssetError, match="normalised"):
        open_accessor(description, b"\0" * 4).accessor(0)


def test_a_buffer_view_may_not_reach_beyond_its_buffer(open_accessor: OpenAccessor) -> None:
    description = {"bufferView": 1, "componentType": 5121, "type": "SCALAR", "count": 4}
    with pytest.raises(AssetError) as caught:
        open_accessor(description, b"\0" * 8, None, ((6, 4),)).accessor(0)
    assert caught.value.pointer == "/bufferViews/1"
