"""GLB containers: each fault is told at its byte, and what can still be judged is."""

from __future__ import annotations

import struct

import pytest

from gltf_iri.asset.limits import MAX_GLB_CHUNKS

JSON = b'{"asset":{"version":"2.0"}} '  # 28 bytes
DATA = b"\1\2\3\4"
NO_ASSET = ("UNDEFINED_PROPERTY", "/")


def chunk(kind: bytes, data: bytes = b"", length: int | None = None) -> bytes:
    return struct.pack("<I4s", len(data) if length is None else length, kind.ljust(4, b"\0")) + data


def glb(*chunks: bytes, length: int | None = None, version: int = 2, magic: bytes = b"glTF") -> bytes:
    body = b"".join(chunks)
    return struct.pack("<4sII", magic, version, 12 + len(body) if length is None else length) + body


J, B, U = chunk(b"JSON", JSON), chunk(b"BIN", DATA), chunk(b"UNKN", DATA)
EMPTY_J, EMPTY_B = chunk(b"JSON"), chunk(b"BIN")
WHOLE = glb(J, B)


@pytest.mark.parametrize("data", [glb(J), WHOLE])
def test_a_sound_container_is_not_told_of(judge, data):
    report = judge(data)
    assert (report.mime_type, report.issues) == ("model/gltf-binary", ())


# Each as the Khronos validator 2.0.0-dev.3.10 tells it, but for the marked.
@pytest.mark.parametrize(
    ("data", "told"),
    [
        # The header
        (glb(J, magic=b"glTX"), {("GLB_INVALID_MAGIC", 0)}),
        (glb(J, magic=b"glXF", version=1, length=3), {("GLB_INVALID_MAGIC", 0)}),
        (glb(J, version=1), {("GLB_INVALID_VERSION", 4)}),
        (glb(J, version=3, length=3), {("GLB_INVALID_VERSION", 4)}),
        (glb(), {("GLB_LENGTH_TOO_SMALL", 8)}),
        (glb(J, length=12), {("GLB_LENGTH_TOO_SMALL", 8), ("GLB_EXTRA_DATA", 12)}),
        (
            glb(J, length=11),
            {("GLB_LENGTH_TOO_SMALL", 8), ("GLB_CHUNK_TOO_BIG", 12), ("GLB_LENGTH_MISMATCH", 48)},
        ),
        (glb(length=20), {("GLB_LENGTH_MISMATCH", 12)}),
        (glb(J, length=13), {("GLB_CHUNK_TOO_BIG", 12), ("GLB_LENGTH_MISMATCH", 48)}),
        (glb(J, length=2**32 - 1), {("GLB_LENGTH_MISMATCH", 48)}),
        # What follows the end
        (WHOLE + b"\0", {("GLB_EXTRA_DATA", 60)}),
        (WHOLE + U, {("GLB_EXTRA_DATA", 60)}),
        (glb(J, B, length=48), {("GLB_EXTRA_DATA", 48)}),
        (glb(J, B, length=56), {("GLB_CHUNK_TOO_BIG", 48), ("GLB_LENGTH_MISMATCH", 60)}),
        # Order and number of chunks
        (glb(J, U, B), {("GLB_UNKNOWN_CHUNK_TYPE", 48), ("GLB_UNEXPECTED_BIN_CHUNK", 60)}),
        (glb(J, B, U), {("GLB_UNKNOWN_CHUNK_TYPE", 60)}),
        (glb(J, B, B), {("GLB_DUPLICATE_CHUNK", 60)}),
        (
            glb(J, U, B, U, B),
            {
                ("GLB_UNKNOWN_CHUNK_TYPE", 48),
                ("GLB_UNEXPECTED_BIN_CHUNK", 60),
                ("GLB_UNKNOWN_CHUNK_TYPE", 72),
                ("GLB_DUPLICATE_CHUNK", 84),
            },
        ),
        (glb(J, chunk(b"JSON", b"{}  ")), {("GLB_DUPLICATE_CHUNK", 48)}),
        (glb(chunk(b"JSON", b"{}  "), J), {("GLB_DUPLICATE_CHUNK", 24), NO_ASSET}),
        (glb(B, J), {("GLB_UNEXPECTED_FIRST_CHUNK", 12)}),
        (glb(U, J), {("GLB_UNEXPECTED_FIRST_CHUNK", 12), ("GLB_UNKNOWN_CHUNK_TYPE", 12)}),
        (glb(U, B), {("GLB_UNEXPECTED_FIRST_CHUNK", 12), ("GLB_UNKNOWN_CHUNK_TYPE", 12)}),
        # Empty chunks
        (glb(EMPTY_J), {("GLB_EMPTY_CHUNK", 12)}),
        (
            glb(EMPTY_J, J),
            {("GLB_EMPTY_CHUNK", 12), ("GLB_DUPLICATE_CHUNK", 20), ("INVALID_JSON", "")},
        ),
        (glb(J, EMPTY_J), {("GLB_EMPTY_CHUNK", 48), ("GLB_DUPLICATE_CHUNK", 48)}),
        (glb(J, EMPTY_B, B), {("GLB_EMPTY_BIN_CHUNK", 48), ("GLB_DUPLICATE_CHUNK", 56)}),
        (
            glb(J, U, EMPTY_B),
            {("GLB_UNKNOWN_CHUNK_TYPE", 48), ("GLB_UNEXPECTED_BIN_CHUNK", 60), ("GLB_EMPTY_BIN_CHUNK", 60)},
        ),
        # Lengths of chunks
        (glb(chunk(b"JSON", JSON[:-1]), B), {("GLB_CHUNK_LENGTH_UNALIGNED", 12)}),
        (glb(J, chunk(b"BIN", b"abc")), {("GLB_CHUNK_LENGTH_UNALIGNED", 48)}),
        (
            glb(chunk(b"JSON", JSON, 0xFFFFFFFF)),
            {
                ("GLB_CHUNK_LENGTH_UNALIGNED", 12),
                ("GLB_CHUNK_TOO_BIG", 12),
                ("GLB_UNEXPECTED_END_OF_CHUNK_DATA", 48),
            },
        ),
        (
            glb(chunk(b"JSON", JSON, 24)),
            {("INVALID_JSON", ""), ("GLB_UNEXPECTED_END_OF_CHUNK_HEADER", 48)},
        ),
        # What the JSON chunk holds
        (glb(chunk(b"JSON", b"[]  ")), {("TYPE_MISMATCH", "")}),
        (glb(chunk(b"JSON", b"{]  "), B), {("INVALID_JSON", "")}),
        (glb(chunk(b"JSON", JSON[:-1] + b"\0")), {("INVALID_JSON", "")}),
        # The Khronos validator stops without a word where the last chunk is empty; here the rest is judged.
        (glb(chunk(b"JSON", b"{}  "), EMPTY_B), {("GLB_EMPTY_BIN_CHUNK", 24), NO_ASSET}),
        (glb(J, EMPTY_B, length=99), {("GLB_EMPTY_BIN_CHUNK", 48), ("GLB_LENGTH_MISMATCH", 56)}),
    ],
)
def test_each_fault_is_told_at_its_byte(judge, codes, data, told):
    assert codes(data) == told
    assert judge(data).mime_type == "model/gltf-binary"


@pytest.mark.parametrize("length", range(len(WHOLE)))
def test_a_container_cut_anywhere_says_where_it_ends(codes, length):
    if length < 12:
        what = "GLB_UNEXPECTED_END_OF_HEADER"
    elif length in (12, 48):
        what = "GLB_LENGTH_MISMATCH"
    elif length < 20 or 48 < length < 56:
        what = "GLB_UNEXPECTED_END_OF_CHUNK_HEADER"
    else:
        what = "GLB_UNEXPECTED_END_OF_CHUNK_DATA"
    expected = {("INVALID_JSON", "")} if length == 0 else {(what, length)}
    assert codes(WHOLE[:length]) == expected


@pytest.mark.parametrize("missing", [1, 5])
def test_of_a_file_that_breaks_off_only_the_json_is_judged(judge, codes, missing):
    text = b'{"asset":{"version":"2.0"},"scene":3,"buffers":[{"byteLength":8}]}'
    named = chunk(b"JSON", text + b" " * (-len(text) % 4))
    scene = ("UNRESOLVED_REFERENCE", "/scene")
    assert codes(glb(named, B)) == {scene, ("BUFFER_BYTE_LENGTH_MISMATCH", "/buffers/0")}
    broken = glb(named, B)[:-missing]
    end = "GLB_UNEXPECTED_END_OF_CHUNK_DATA" if missing < 4 else "GLB_UNEXPECTED_END_OF_CHUNK_HEADER"
    assert codes(broken) == {scene, (end, len(broken))}
    assert judge(broken).info is None


@pytest.mark.parametrize("empty", [EMPTY_J, EMPTY_B, chunk(b"UNKN")])
def test_after_an_empty_last_chunk_nothing_is_summed_up(judge, empty):
    assert judge(glb(J, B, empty)).info is None
    assert judge(glb(J, B, empty, U)).info is not None


def test_chunks_without_number_are_not_walked(codes):
    chunks = [J, B, *[U] * MAX_GLB_CHUNKS * 20]
    told = codes(glb(*chunks), only=frozenset({"IRI_GLB_TOO_MANY_CHUNKS", "GLB_LENGTH_MISMATCH"}))
    assert told == {("IRI_GLB_TOO_MANY_CHUNKS", 12 + len(J) + len(B) + len(U) * (MAX_GLB_CHUNKS - 2))}


def test_the_buffer_is_the_first_binary_chunk(codes):
    text = b'{"asset":{"version":"2.0"},"buffers":[{"byteLength":4}]} '
    text += b" " * (-len(text) % 4)
    named = chunk(b"JSON", text)
    assert codes(glb(named, B)) == set()
    assert codes(glb(named)) == {("BUFFER_MISSING_GLB_DATA", "/buffers/0")}
    second = 12 + len(named) + 12
    twice = {("GLB_DUPLICATE_CHUNK", second)}
    assert codes(glb(named, B, chunk(b"BIN", b"\0" * 64))) == twice
