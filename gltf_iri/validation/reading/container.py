"""The binary container, walked to its end whatever it holds: all that is wrong is told with its byte offset.

glTF 2.0 §4.4: a header of 12 bytes, then chunks, each with a header of 8. Our own loader stops at the first
fault (`gltf_iri.asset.glb`); here each is told, as the Khronos validator tells it.
"""

from __future__ import annotations

from struct import unpack_from
from typing import TYPE_CHECKING

from gltf_iri.asset.limits import MAX_GLB_CHUNKS
from gltf_iri.validation.codes import issue
from gltf_iri.validation.reading import codes as _codes  # noqa: F401  # makes them known

if TYPE_CHECKING:
    from collections.abc import Callable

    from gltf_iri.validation.issue import Issue

__all__ = ["MAGIC", "Container", "read_container"]

MAGIC = b"glTF"

_HEADER_BYTES = 12
_CHUNK_HEADER_BYTES = 8
_JSON, _BIN = b"JSON", b"BIN\0"


class Container:
    """What a GLB holds.

    json, binary : the first chunk of either kind; None where there is none, or none that is all there.
    is_whole : the file does not end within a chunk.
    ends_empty : its last chunk holds nothing.
    """

    __slots__ = ("binary", "ends_empty", "is_whole", "json")

    def __init__(self) -> None:
        self.json: memoryview | None = None
        self.binary: memoryview | None = None
        self.is_whole = True
        self.ends_empty = False


def read_container(data: bytes, tell: Callable[[Issue], None]) -> Container:
    """Find the chunks; `tell` hears what is wrong."""
    container = Container()
    if len(data) < _HEADER_BYTES:
        tell(issue("GLB_UNEXPECTED_END_OF_HEADER", offset=len(data)))
        return container
    version, length = unpack_from("<II", data, 4)
    if data[:4] != MAGIC:
        tell(issue("GLB_INVALID_MAGIC", offset=0, magic=_named(data[:4])))
    elif version != 2:
        tell(issue("GLB_INVALID_VERSION", offset=4, version=version))
    else:
        if length < _HEADER_BYTES + 1:
            tell(issue("GLB_LENGTH_TOO_SMALL", offset=8, declared=length))
        _read_chunks(data, length, container, tell)
    return container


def _read_chunks(data: bytes, length: int, container: Container, tell: Callable[[Issue], None]) -> None:
    """Walk from chunk to chunk; one that claims more than the header's `length` is read all the same."""
    whole = memoryview(data)
    offset = _HEADER_BYTES
    for place in range(MAX_GLB_CHUNKS + 1):
        if offset == len(data):
            if offset != length:
                tell(issue("GLB_LENGTH_MISMATCH", offset=offset, declared=length, length=offset))
            return
        if offset == length:
            tell(issue("GLB_EXTRA_DATA", offset=offset))
            return
        if offset + _CHUNK_HEADER_BYTES > len(data):
            tell(issue("GLB_UNEXPECTED_END_OF_CHUNK_HEADER", offset=len(data)))
            container.is_whole = False
            return
        if place == MAX_GLB_CHUNKS:
            tell(issue("IRI_GLB_TOO_MANY_CHUNKS", offset=offset, most=MAX_GLB_CHUNKS))
            return
        size, kind = unpack_from("<I4s", data, offset)
        _check_chunk(offset, size, kind, place, length, container, tell)
        start, offset = offset + _CHUNK_HEADER_BYTES, offset + _CHUNK_HEADER_BYTES + size
        if offset > len(data):
            tell(issue("GLB_UNEXPECTED_END_OF_CHUNK_DATA", offset=len(data)))
            container.is_whole = False
            return
        container.ends_empty = not size and offset == len(data)
        # Of an empty chunk at the very end it was told already that nothing is in it.
        if kind == _JSON and container.json is None and (size or offset < len(data)):
            container.json = whole[start:offset]
        elif kind == _BIN and container.binary is None:
            container.binary = whole[start:offset]


def _check_chunk(
    offset: int,
    size: int,
    kind: bytes,
    place: int,
    length: int,
    container: Container,
    tell: Callable[[Issue], None],
) -> None:
    """Tell what the header of one chunk has wrong; `container` holds the chunks before it."""
    name = _named(kind)
    if size % 4:
        tell(issue("GLB_CHUNK_LENGTH_UNALIGNED", offset=offset, chunk=name))
    if offset + _CHUNK_HEADER_BYTES + size > length:
        tell(issue("GLB_CHUNK_TOO_BIG", offset=offset, chunk=name, length=size))
    if place == 0 and kind != _JSON:
        tell(issue("GLB_UNEXPECTED_FIRST_CHUNK", offset=offset, chunk=name))
    if kind == _JSON:
        if size == 0:
            tell(issue("GLB_EMPTY_CHUNK", offset=offset, chunk=name))
        if container.json is not None:
            tell(issue("GLB_DUPLICATE_CHUNK", offset=offset, chunk=name))
    elif kind == _BIN:
        if size == 0:
            tell(issue("GLB_EMPTY_BIN_CHUNK", offset=offset))
        if container.binary is not None:
            tell(issue("GLB_DUPLICATE_CHUNK", offset=offset, chunk=name))
        elif place > 1:
            tell(issue("GLB_UNEXPECTED_BIN_CHUNK", offset=offset))
    else:
        tell(issue("GLB_UNKNOWN_CHUNK_TYPE", offset=offset, chunk=name))


def _named(kind: bytes) -> str:
    """Show four bytes that are meant to be letters."""
    letters = kind.rstrip(b"\0").decode("latin-1")
    return f"'{letters}'" if letters.isascii() and letters.isprintable() else f"0x{kind[::-1].hex()}"
