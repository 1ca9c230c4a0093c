"""The binary container (glTF 2.0 §4): header, JSON chunk, optional BIN chunk; other chunks are ignored."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from typing import Final

from gltf_iri.asset.limits import MAX_GLB_CHUNKS
from gltf_iri.errors import AssetError

__all__ = ["JSON_OFFSET", "MAGIC", "Container", "split_glb"]

MAGIC: Final = b"glTF"

_HEADER: Final = struct.Struct("<4sII")  # magic, version, length of the whole file
_CHUNK: Final = struct.Struct("<I4s")  # length of the data, type
JSON_OFFSET: Final = _HEADER.size + _CHUNK.size  # where the text of the first chunk starts
_JSON: Final = b"JSON"
_BIN: Final = b"BIN\0"


@dataclass(frozen=True, slots=True)
class Container:
    """The two chunks that glTF knows, as views of the file's bytes, and remarks in sentences."""

    json: memoryview
    binary: memoryview | None
    notes: tuple[str, ...]


def split_glb(data: bytes) -> Container:
    """Find the chunks; raise AssetError with the byte offset of the first field that is wrong."""
    if len(data) < _HEADER.size:
        raise AssetError(f"the file ends inside the {_HEADER.size}-byte GLB header", offset=len(data))
    magic, version, length = _HEADER.unpack_from(data)
    if magic != MAGIC:
        raise AssetError("the file does not start with the GLB magic 'glTF'", offset=0)
    if version != 2:
        raise AssetError(f"GLB version {version} is not read, only version 2", offset=4)
    if length < _HEADER.size + _CHUNK.size:
        raise AssetError(f"the header gives a length of {length} bytes, too short for a JSON chunk", offset=8)
    if length > len(data):
        raise AssetError(
            f"the header gives a length of {length} bytes, but the file has {len(data)}", offset=8
        )
    notes = []
    if length < len(data):
        notes.append(f"{len(data) - length} bytes after the end of the GLB are ignored.")
    json_chunk, binary = _chunks(memoryview(data)[:length])
    return Container(json_chunk, binary, tuple(notes))


def _chunks(data: memoryview) -> tuple[memoryview, memoryview | None]:
    json_chunk: memoryview | None = None
    binary: memoryview | None = None
    offset = _HEADER.size
    position = 0
    while offset < len(data):
        kind, body = _chunk(data, offset)
        if position == 0:
            if kind != _JSON:
                raise AssetError(f"the first chunk is {kind!r}, but must be JSON", offset=offset + 4)
            json_chunk = body
        elif kind == _JSON or (kind == _BIN and binary is not None):
            raise AssetError(f"a second {kind!r} chunk follows; only one may", offset=offset + 4)
        elif kind == _BIN:
            if position != 1:
                raise AssetError("the BIN chunk is not the second chunk", offset=offset + 4)
            binary = body
        offset += _CHUNK.size + len(body)
        position += 1
        if position > MAX_GLB_CHUNKS:
            raise AssetError(f"more than {MAX_GLB_CHUNKS} chunks follow each other", offset=offset)
    if not json_chunk:
        raise AssetError("the JSON chunk is empty", offset=_HEADER.size)
    return json_chunk, binary


def _chunk(data: memoryview, offset: int) -> tuple[bytes, memoryview]:
    if offset + _CHUNK.size > len(data):
        raise AssetError("the file ends inside a chunk header", offset=offset)
    length, kind = _CHUNK.unpack_from(data, offset)
    start = offset + _CHUNK.size
    if length % 4:
        raise AssetError(f"the chunk length {length} is not a multiple of 4", offset=offset)
    if length > len(data) - start:
        raise AssetError(
            f"the chunk {kind!r} claims {length} bytes, but {len(data) - start} are left", offset=offset
        )
    return kind, data[start : start + length]
