"""PNG files whose bytes are the same on every machine.

Compressors differ between versions of zlib, so the pixels are stored uncompressed: the samples' textures are
small, and a checkout can then be compared with what the code writes byte for byte.
"""

from __future__ import annotations

import struct
import zlib

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.rounding import rounded

__all__ = ["encode_png", "texel_centres", "to_bytes"]

_STORED_BLOCK = 65535  # largest stored block of a deflate stream, RFC 1951 §3.2.4
_GREY, _RGB = 0, 2  # PNG colour types


def encode_png(pixels: NDArray[np.uint8]) -> bytes:
    """Return a PNG of `pixels`: (height, width) for grey or (height, width, 3) for RGB, row 0 at the top."""
    height, width = pixels.shape[:2]
    colour_type = _GREY if pixels.ndim == 2 else _RGB
    header = struct.pack(">IIBBBBB", width, height, 8, colour_type, 0, 0, 0)
    rows = b"".join(b"\x00" + row.tobytes() for row in pixels)  # filter type 0 on every row
    return (
        b"\x89PNG\r\n\x1a\n" + _chunk(b"IHDR", header) + _chunk(b"IDAT", _stored(rows)) + _chunk(b"IEND", b"")
    )


def _chunk(kind: bytes, body: bytes) -> bytes:
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def _stored(data: bytes) -> bytes:
    """Return a zlib stream (RFC 1950) of stored blocks around `data`."""
    blocks = [data[start : start + _STORED_BLOCK] for start in range(0, len(data), _STORED_BLOCK)]
    stream = bytearray(b"\x78\x01")
    for number, block in enumerate(blocks):
        is_last = number == len(blocks) - 1
        stream += struct.pack("<BHH", is_last, len(block), len(block) ^ 0xFFFF) + block
    return bytes(stream + struct.pack(">I", zlib.adler32(data)))


def texel_centres(height: int, width: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return u and v, each (height, width), at the centres of the texels."""
    u = (np.arange(width) + 0.5) / width
    v = (np.arange(height) + 0.5) / height
    grid_u, grid_v = np.meshgrid(u, v)
    return grid_u, grid_v


def to_bytes(values: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Return `values` in [0, 1] as 8-bit texels; what lies outside is cut off."""
    return np.rint(rounded(np.clip(values, 0.0, 1.0)) * 255.0).astype(np.uint8)
