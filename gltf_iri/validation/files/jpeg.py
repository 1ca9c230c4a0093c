"""JPEG headers (ITU-T T.81, annex B): the marker segments up to the frame header."""

from __future__ import annotations

import re
from struct import unpack_from

from gltf_iri.validation.files.image_info import ImageDataError, ImageEndError, ImageInfo, Segments

__all__ = ["read_jpeg"]

# What stands before a marker's last byte: fill bytes, and markers that no segment follows: TEM, RSTm, SOI
# and EOI (B.1.1.2, table B.1).
_BEFORE_SEGMENT = re.compile(rb"[\xff\x01\xd0-\xd9]*")

# SOF0 to SOF15 without DHT, JPG and DAC; DHP has the same form (B.2.2, B.3.2).
_FRAME_MARKERS = frozenset(range(0xC0, 0xD0)) - {0xC4, 0xC8, 0xCC} | {0xDE}

_LENGTH_BYTES = 2
# Precision, height, width, and the number of components.
_FRAME_HEAD_BYTES = 6

_FORMATS = {1: "luminance", 3: "rgb"}


def read_jpeg(data: bytes | memoryview, segments: Segments) -> ImageInfo:
    """Return what the frame header says; raises ImageDataError or ImageEndError."""
    position, end = 0, len(data)
    while True:
        segments.count()
        found = _BEFORE_SEGMENT.match(data, position)
        start = found.end() if found else position
        segments.count_fill(start - position)
        position = start
        if position + 1 + _LENGTH_BYTES > end:
            raise ImageEndError
        marker, length = unpack_from(">BH", data, position)
        if length < _LENGTH_BYTES:
            raise ImageDataError(
                f"the length of a segment is {length}, less than its own {_LENGTH_BYTES} bytes"
            )
        data_at = position + 1 + _LENGTH_BYTES
        position += 1 + length
        if position > end:
            raise ImageEndError
        if marker in _FRAME_MARKERS:
            return _frame(data[data_at:position])


def _frame(header: bytes | memoryview) -> ImageInfo:
    if len(header) < _FRAME_HEAD_BYTES:
        raise ImageDataError("the frame header is too short")
    bits, height, width, components = unpack_from(">BHHB", header)
    if components not in _FORMATS:
        raise ImageDataError(f"it has {components} colour channels, which are neither grey nor RGB")
    return ImageInfo("image/jpeg", width, height, _FORMATS[components], bits)
