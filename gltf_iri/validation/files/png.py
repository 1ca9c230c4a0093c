"""PNG headers (PNG, third edition, W3C 2025): the chunks up to the first IDAT."""

from __future__ import annotations

from struct import unpack_from

from gltf_iri.validation.files.image_info import ImageDataError, ImageEndError, ImageInfo, Segments

__all__ = ["read_png"]

_SIGNATURE_BYTES = 8
# A chunk's length and type stand before its data, a checksum after it.
_HEAD_BYTES, _CHECKSUM_BYTES = 8, 4

# Chunks of a fixed length (§11.2.1, §11.3.2.1, §11.3.2.2, §11.3.2.5, §11.3.4.3).
_LENGTHS = {b"IHDR": 13, b"cHRM": 32, b"gAMA": 4, b"sRGB": 1, b"pHYs": 9}

# Colour types (§11.2.1) to formats, without and with transparency by tRNS.
_FORMATS = {
    0: ("luminance", "luminance-alpha"),
    2: ("rgb", "rgba"),
    3: ("rgb", "rgba"),
    4: ("luminance-alpha", "luminance-alpha"),
    6: ("rgba", "rgba"),
}

# 100 000 times white point and primaries x, y (table of §11.3.2.5), and the gamma that stands for sRGB.
_SRGB_CHROMATICITIES = (31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000)
_SRGB_GAMMA, _LINEAR_GAMMA = 45455, 100000


class _Header:
    """What the chunks so far said."""

    __slots__ = ("_is_oblong", "_is_transparent", "_primaries", "_size", "_transfer")

    def __init__(self) -> None:
        self._size: tuple[int, int, int, int] | None = None
        self._primaries: str | None = None
        self._transfer: str | None = None
        self._is_transparent = False
        self._is_oblong = False

    def take(self, kind: bytes, data: bytes | memoryview, start: int) -> None:
        """Note one chunk, whose data begins at `start`; of two about colour, the first counts."""
        if kind == b"IHDR":
            self._size = unpack_from(">IIBB", data, start)
        elif kind == b"sRGB":
            self._primaries = self._transfer = "srgb"
        elif kind == b"iCCP":
            self._primaries = self._transfer = "custom"
        elif kind == b"cHRM" and self._primaries is None:
            is_srgb = unpack_from(">8I", data, start) == _SRGB_CHROMATICITIES
            self._primaries = "srgb" if is_srgb else "custom"
        elif kind == b"gAMA" and self._transfer is None:
            (gamma,) = unpack_from(">I", data, start)
            self._transfer = {_SRGB_GAMMA: "srgb", _LINEAR_GAMMA: "linear"}.get(gamma, "custom")
        elif kind == b"tRNS":
            self._is_transparent = True
        elif kind == b"pHYs":
            across, down = unpack_from(">II", data, start)
            self._is_oblong = self._is_oblong or across != down

    def info(self) -> ImageInfo:
        """Return what all chunks together say."""
        if self._size is None:
            raise ImageDataError("pixels stand before the chunk IHDR")
        width, height, bits, colour_type = self._size
        formats = _FORMATS.get(colour_type, (None, None))
        return ImageInfo(
            "image/png",
            width,
            height,
            formats[self._is_transparent],
            bits,
            primaries=self._primaries or "srgb",
            transfer=self._transfer or "srgb",
            is_unsupported=self._is_oblong,
        )


def read_png(data: bytes | memoryview, segments: Segments) -> ImageInfo:
    """Return what the chunks before the pixels say; raises ImageDataError or ImageEndError."""
    header = _Header()
    position, end = _SIGNATURE_BYTES, len(data)
    while position + _HEAD_BYTES <= end:
        segments.count()
        length, kind = unpack_from(">I4s", data, position)
        if kind == b"IDAT":
            return header.info()
        if length != _LENGTHS.get(kind, length):
            raise ImageDataError(f"the chunk {kind.decode('ascii')} has {length} bytes")
        position += _HEAD_BYTES
        if position + length > end:
            break
        header.take(kind, data, position)
        position += length + _CHECKSUM_BYTES
    raise ImageEndError
