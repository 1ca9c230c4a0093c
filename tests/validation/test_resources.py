"""Buffers and pictures beside the JSON; expectations are the Khronos validator's and the guard's."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from judging import Codes, Judge
from small_data import UNSIGNED_BYTE, Data, binary

OCTETS = "data:application/octet-stream;base64,"


def resources(judge: Judge, asset: Any, folder: Path | None = None, **options: Any) -> list[dict[str, Any]]:
    """Return what the report says of each resource."""
    info = judge(asset, folder, **options).info
    assert info is not None
    told: list[dict[str, Any]] = info["resources"]
    return told


@pytest.mark.parametrize(
    ("declared", "chunk", "code"),
    [
        (4, b"1234", None),
        (1, b"1234", None),
        (5, b"12345678", None),
        (4, b"12345678", "BUFFER_GLB_CHUNK_TOO_BIG"),
        (5, b"1234", "BUFFER_BYTE_LENGTH_MISMATCH"),
        (4, None, "BUFFER_MISSING_GLB_DATA"),
    ],
)
def test_the_bin_chunk_is_the_first_buffer_and_its_padding(
    declared: int, chunk: bytes | None, code: str | None, codes: Codes
) -> None:
    told = codes(binary({"buffers": [{"byteLength": declared}, {"byteLength": 9}]}, chunk))
    assert told == ({(code, "/buffers/0")} if code else set())


def test_the_first_buffer_is_not_the_bin_chunk_where_it_has_a_uri(codes: Codes) -> None:
    uri = OCTETS + "AAAAAAA="
    told = codes(binary({"buffers": [{"byteLength": 5, "uri": uri}]}, b"1234"))
    assert told == {("URI_GLB", "/buffers/0/uri"), ("DATA_URI_GLB", "/buffers/0/uri")}


def test_what_is_left_of_a_buffer_that_is_cut_off_is_not_looked_at(codes: Codes) -> None:
    data = Data()
    data.accessor("SCALAR", UNSIGNED_BYTE, [1, 2, 3, 4], min=[0], max=[4])
    for declared, expected in (
        (4, ("ACCESSOR_MIN_MISMATCH", "/accessors/0/min/0")),
        (5, ("BUFFER_BYTE_LENGTH_MISMATCH", "/buffers/0")),
    ):
        asset = data.asset | {"buffers": [{"byteLength": declared}]}
        assert codes(binary(asset, data.blob)) == {expected}


@pytest.mark.parametrize("declared", [None, "a", 0, 5])
def test_the_bytes_of_a_data_uri_are_looked_at_however_many_they_should_be(
    declared: Any, codes: Codes
) -> None:
    data = Data()
    data.accessor("SCALAR", UNSIGNED_BYTE, [1, 2, 3, 4], min=[0], max=[4])
    asset = data.asset
    asset["buffers"][0]["byteLength"] = declared
    assert ("ACCESSOR_MIN_MISMATCH", "/accessors/0/min/0") in codes(asset)


@pytest.mark.parametrize(("declared", "is_enough"), [(1, True), (2, True), (3, False)])
def test_a_file_has_at_least_the_declared_bytes(
    declared: int, is_enough: bool, tmp_path: Path, judge: Judge
) -> None:
    (tmp_path / "a b.bin").write_bytes(b"12")
    asset = {"buffers": [{"byteLength": declared, "uri": "x/../a%20b.bin"}]}
    told = {(i.code, i.pointer) for i in judge(asset, tmp_path).issues if i.code != "UNUSED_OBJECT"}
    assert told == (set() if is_enough else {("BUFFER_BYTE_LENGTH_MISMATCH", "/buffers/0")})
    assert resources(judge, asset, tmp_path) == [
        {
            "pointer": "/buffers/0",
            "mimeType": "application/gltf-buffer",
            "storage": "external",
            "uri": "a%20b.bin",
            "byteLength": 2,
        }
    ]


@pytest.mark.parametrize(
    "uri", ["missing.bin", "../a.bin", "%2e%2e/a.bin", "%2Fetc%2Fpasswd", "a%00", "%ff", "", "."]
)
def test_a_file_that_is_missing_or_out_of_the_folder_is_an_io_error(
    uri: str, tmp_path: Path, judge: Judge
) -> None:
    inside = tmp_path / "inside"
    inside.mkdir()
    (tmp_path / "a.bin").write_bytes(b"1")
    for name, array in (("buffers", [{"byteLength": 1, "uri": uri}]), ("images", [{"uri": uri}])):
        told = [i for i in judge({name: array}, inside).issues if i.code != "UNUSED_OBJECT"]
        assert [(i.code, i.pointer) for i in told] == [("IO_ERROR", f"/{name}/0/uri")]


def test_absolute_uris_are_never_read(tmp_path: Path, judge: Judge) -> None:
    (tmp_path / "a.bin").write_bytes(b"1")
    for uri in (str(tmp_path / "a.bin"), (tmp_path / "a.bin").as_uri()):
        told = [i.code for i in judge({"buffers": [{"byteLength": 1, "uri": uri}]}, tmp_path).issues]
        assert told == ["NON_RELATIVE_URI", "UNUSED_OBJECT", "IO_ERROR"]


def test_bytes_without_a_folder_have_no_files(codes: Codes) -> None:
    assert codes({"buffers": [{"byteLength": 1, "uri": "a"}]}) == {("IO_ERROR", "/buffers/0/uri")}


def test_nothing_is_read_where_resources_are_not_wanted(tmp_path: Path, judge: Judge) -> None:
    asset = {"buffers": [{"byteLength": 1, "uri": "missing"}], "images": [{"uri": "missing.png"}]}
    report = judge(asset, tmp_path, resources=False)
    assert {i.code for i in report.issues} == {"UNUSED_OBJECT"}


def test_a_broken_byte_length_leaves_the_buffer_alone(judge: Judge, codes: Codes) -> None:
    asset = {"buffers": [{"byteLength": 0, "uri": "missing"}]}
    assert codes(asset) == {("VALUE_NOT_IN_RANGE", "/buffers/0/byteLength")}
    assert resources(judge, asset) == [{"pointer": "/buffers/0", "mimeType": "application/gltf-buffer"}]


def test_a_file_is_read_once_however_often_it_is_named(
    tmp_path: Path, judge: Judge, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gltf_iri.asset import guard

    read: list[str] = []
    real = guard.read_inside

    def counting(folder: Path, uri: str, pointer: str, most: int) -> bytes:
        read.append(uri)
        return real(folder, uri, pointer, most)

    monkeypatch.setattr(guard, "read_inside", counting)
    (tmp_path / "a.bin").write_bytes(b"1")
    uris = ["a.bin", "./a.bin", "x/../a.bin", "%61.bin", "missing", "missing"]
    judge({"buffers": [{"byteLength": 1, "uri": uri} for uri in uris]}, tmp_path)
    assert read == ["a.bin", "missing"]
