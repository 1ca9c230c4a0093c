"""How much is looked at: hostile counts cost nothing, and nothing that was left out goes untold."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes, Judge
from small_data import FLOAT, UNSIGNED_BYTE, Data

from gltf_iri.validation.data import access, elements
from gltf_iri.validation.data.elements import Elements


@pytest.mark.parametrize("count", [2**21, 10**15, 2**60])
def test_a_count_without_bytes_costs_nothing(
    count: int, codes: Codes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(elements, "BLOCK", 1)
    data = Data()
    data.accessor("VEC3", FLOAT, [0, 0, 1], count=count, min=[5, 5, 5])
    data.accessor("VEC3", FLOAT, [0, 0, 1], count=count, bufferView=None)
    data.accessor(
        "VEC3", FLOAT, [0, 0, 1], count=count, bufferView=None, sparse=data.sparse([0], FLOAT, [9, 9, 9])
    )
    attributes = {"POSITION": 2, "NORMAL": 2, "COLOR_0": 1}
    data.root["meshes"] = [{"primitives": [{"attributes": attributes}]}]
    found = codes(data.asset)
    assert ("IRI_DATA_NOT_CHECKED", "/accessors/2/count") in found
    assert not {code for code, _ in found} & {"ACCESSOR_MIN_MISMATCH", "ACCESSOR_VECTOR3_NON_UNIT"}


def test_numbers_beyond_what_the_bytes_vouch_for_are_told_once_and_left(
    judge: Judge, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(access, "_UNVOUCHED_NUMBERS", 0)
    data = Data()
    data.accessor("SCALAR", UNSIGNED_BYTE, [1] * 64, max=[1])
    data.accessors += [data.accessors[0]] * 20
    found = [(i.code, i.pointer) for i in judge(data.asset).issues if i.code != "UNUSED_OBJECT"]
    # 64 bytes vouch for 256 numbers, four accessors; of those that nobody looks at, one is told.
    assert found == [("IRI_DATA_NOT_CHECKED", "/accessors/4")]


def test_what_primitives_share_is_looked_at_once(codes: Codes, monkeypatch: pytest.MonkeyPatch) -> None:
    decoded: list[int] = []
    real = Elements.columns

    def counting(self: Elements, first: int) -> list[list[Any]]:
        decoded.append(first)
        return real(self, first)

    monkeypatch.setattr(Elements, "columns", counting)
    data = Data()
    attributes = {"POSITION": data.positions(3), "NORMAL": data.accessor("VEC3", FLOAT, [0, 0, 1] * 3)}
    indices = data.accessor("SCALAR", UNSIGNED_BYTE, [0, 1, 2])
    data.root["meshes"] = [{"primitives": [{"attributes": attributes, "indices": indices}] * 50}]
    assert not {code for code, _ in codes(data.asset) if code.startswith("ACCESSOR")}
    assert len(decoded) == 3


def test_remarks_stop_where_the_user_has_enough(judge: Judge, monkeypatch: pytest.MonkeyPatch) -> None:
    decoded: list[int] = []
    real = Elements.columns

    def counting(self: Elements, first: int) -> list[list[Any]]:
        decoded.append(first)
        return real(self, first)

    monkeypatch.setattr(Elements, "columns", counting)
    data = Data()
    data.accessor("SCALAR", FLOAT, [float("nan")] * 50_000)
    report = judge(data.asset, max_issues=10)
    assert report.is_truncated
    assert len(report.issues) == 10
    assert decoded == [0]


def test_bytes_of_a_buffer_are_let_go_with_its_report(judge: Judge) -> None:
    import gc
    import weakref

    from gltf_iri.validation.files.resources import Resources

    alive: list[weakref.ref[Resources]] = []
    real = Resources.load

    def noting(self: Resources) -> Any:
        alive.append(weakref.ref(self))
        return real(self)

    data = Data()
    data.accessor("SCALAR", FLOAT, [1, 2], min=[1])
    gc.disable()
    try:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Resources, "load", noting)
            judge(data.asset)
        assert [ref() for ref in alive] == [None]
    finally:
        gc.enable()
