"""Headers of pictures, byte by byte, for tests of what is read from them."""

from __future__ import annotations

import base64
import zlib
from struct import pack

__all__ = [
    "APP0",
    "IDAT",
    "PNG_SIGNATURE",
    "SOI",
    "chunk",
    "data_uri",
    "ihdr",
    "jpeg",
    "png",
    "riff",
    "segment",
]
__all__ += ["sof", "vp8", "vp8l", "vp8x", "webp"]

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def data_uri(data: bytes, media_type: str = "image/png") -> str:
    """Return the bytes as a URI."""
    return f"data:{media_type};base64,{base64.b64encode(data).decode()}"


def chunk(kind: bytes, data: bytes = b"", length: int | None = None) -> bytes:
    """Return a PNG chunk with its checksum; `length` may lie."""
    return (
        pack(">I", len(data) if length is None else length)
        + kind
        + data
        + pack(">I", zlib.crc32(kind + data))
    )


IDAT = chunk(b"IDAT", zlib.compress(bytes(68)))


def ihdr(width: int = 4, height: int = 4, bits: int = 8, colour_type: int = 6) -> bytes:
    """Return the chunk that says how large a PNG is."""
    return chunk(b"IHDR", pack(">IIBBBBB", width, height, bits, colour_type, 0, 0, 0))


def png(*chunks: bytes, width: int = 4, height: int = 4, bits: int = 8, colour_type: int = 6) -> bytes:
    """Return a PNG with `chunks` before its pixels."""
    head = ihdr(width, height, bits, colour_type)
    return PNG_SIGNATURE + head + b"".join(chunks) + IDAT + chunk(b"IEND")


SOI = b"\xff\xd8"


def segment(marker: int, data: bytes = b"", length: int | None = None) -> bytes:
    """Return a JPEG marker segment; `length` may lie."""
    return bytes((0xFF, marker)) + pack(">H", len(data) + 2 if length is None else length) + data


APP0 = segment(0xE0, b"JFIF\0\1\1\0\0\1\0\1\0\0")


def sof(marker: int = 0xC0, *, bits: int = 8, width: int = 4, height: int = 4, components: int = 3) -> bytes:
    """Return a JPEG frame header."""
    return segment(marker, pack(">BHHB", bits, height, width, components) + bytes(3 * components))


def jpeg(*segments: bytes) -> bytes:
    """Return a JPEG of these segments and a scan."""
    return SOI + b"".join(segments) + segment(0xDA, bytes(10)) + b"\0\0\xff\xd9"


def riff(name: bytes, data: bytes) -> bytes:
    """Return a WebP of one chunk."""
    body = b"WEBP" + name + pack("<I", len(data)) + data
    return b"RIFF" + pack("<I", len(body)) + body


def vp8(width: int = 4, height: int = 4) -> bytes:
    """Return a lossy WebP."""
    return riff(b"VP8 ", b"\x10\0\0\x9d\x01\x2a" + pack("<HH", width, height) + bytes(8))


def vp8l(width: int = 4, height: int = 4, *, alpha: int = 0) -> bytes:
    """Return a lossless WebP."""
    return riff(b"VP8L", b"\x2f" + pack("<I", width - 1 | height - 1 << 14 | alpha << 28) + bytes(8))


def vp8x(width: int = 4, height: int = 4, *, flags: int = 0) -> bytes:
    """Return an extended WebP."""
    sides = pack("<I", width - 1)[:3] + pack("<I", height - 1)[:3]
    return riff(b"VP8X", bytes((flags, 0, 0, 0)) + sides)


def webp(**more: int) -> bytes:
    """Return a WebP of the simplest kind."""
    return vp8(**more)
