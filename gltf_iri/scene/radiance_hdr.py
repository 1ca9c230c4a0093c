"""Radiance pictures (.hdr, .pic): the header, three ways of packing scanlines, and RGBE pixels.

Ward, "Real Pixels", Graphics Gems II (1991); the file format of the Radiance reference manual.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.asset.limits import MAX_IMAGE_PIXELS
from gltf_iri.errors import AssetError

__all__ = ["read_radiance"]

Float32 = NDArray[np.float32]
UInt8 = NDArray[np.uint8]

_MAGIC: Final = (b"#?RADIANCE", b"#?RGBE")
_RESOLUTION: Final = re.compile(rb"([+-])([XY]) (\d{1,9}) ([+-])([XY]) (\d{1,9})\r?")
_MAX_HEADER_BYTES: Final = 65536

# Scanlines outside these widths are never packed channel by channel.
_LEAST_PACKED, _MOST_PACKED = 8, 0x7FFF


@dataclass(frozen=True, slots=True)
class _Header:
    axes: bytes  # b"YX" where scanlines are rows, b"XY" where they are columns
    signs: bytes  # of the two axes, in the same order
    scanlines: int
    length: int  # pixels in a scanline
    exposure: tuple[float, float, float]  # what the writer multiplied each channel by
    end: int  # offset of the first scanline


def read_radiance(data: bytes) -> Float32:
    """Return the picture (height, width, 3), linear, row 0 at the top, with the header's exposure undone.

    A pixel is mantissa · 2^(E − 136), black where E = 0: bytes (128, 128, 128, 129) are exactly 1. (Radiance
    itself adds half a step to each mantissa; most other programs do not, and so white stays white.) PRIMARIES
    are passed over: writers leave zeros there, or Radiance's own, and mean Rec.709.
    Raises AssetError where the bytes are not such a picture, not RGBE, or fewer than the header promises.
    """
    header = _read_header(data)
    rgbe = np.zeros((header.scanlines, header.length, 4), dtype=np.uint8)
    offset = header.end
    for scanline in rgbe:
        offset = _read_scanline(data, offset, scanline)
    # "-Y h +X w" is the common order, rows from the top; each other sign turns its axis around.
    for axis in range(2):
        usual = b"-" if header.axes[axis : axis + 1] == b"Y" else b"+"
        if header.signs[axis : axis + 1] != usual:
            rgbe = np.flip(rgbe, axis)
    if header.axes == b"XY":
        rgbe = rgbe.transpose(1, 0, 2)
    # float32 holds every mantissa · 2^(E − 136) exactly, so a table of the 256 scales loses nothing.
    scale: Float32 = np.ldexp(np.float32(1.0), np.arange(256) - 136)
    scale[0] = 0.0
    linear: Float32 = scale[rgbe[:, :, 3:]] * rgbe[:, :, :3]
    if header.exposure != (1.0, 1.0, 1.0):
        with np.errstate(
            over="ignore"
        ):  # a minute exposure overflows to ∞, which becomes the largest float32
            linear /= np.array(header.exposure, dtype=np.float32)
        np.minimum(linear, np.finfo(np.float32).max, out=linear)
    return linear


def _read_header(data: bytes) -> _Header:
    if not data.startswith(_MAGIC):
        raise AssetError("this is not a Radiance picture, which begins with #?RADIANCE", offset=0)
    exposure = [1.0, 1.0, 1.0]
    offset = 0
    while True:
        end = data.find(b"\n", offset, _MAX_HEADER_BYTES)
        if end < 0:
            raise AssetError("the header has no end", offset=offset)
        line, here, offset = data[offset:end].strip(), offset, end + 1
        if not line:
            break
        key, _, value = line.partition(b"=")
        if key == b"FORMAT" and value.strip() != b"32-bit_rle_rgbe":
            raise AssetError(
                "only the format 32-bit_rle_rgbe is read; convert the picture to it", offset=here
            )
        if key in (b"EXPOSURE", b"COLORCORR"):
            factors = _numbers(value, 1 if key == b"EXPOSURE" else 3, here)
            exposure = [e * f for e, f in zip(exposure, factors * (3 // len(factors)), strict=True)]
    end = data.find(b"\n", offset, _MAX_HEADER_BYTES)
    resolution = _RESOLUTION.fullmatch(data[offset : max(end, offset)])
    if resolution is None or resolution[2] == resolution[5]:
        raise AssetError("the header does not end in a resolution such as '-Y 512 +X 1024'", offset=offset)
    scanlines, length = int(resolution[3]), int(resolution[6])
    if not 0 < scanlines * length <= MAX_IMAGE_PIXELS:
        raise AssetError(
            f"the picture has {scanlines} × {length} pixels; 1 to {MAX_IMAGE_PIXELS} are read", offset=offset
        )
    return _Header(
        axes=resolution[2] + resolution[5],
        signs=resolution[1] + resolution[4],
        scanlines=scanlines,
        length=length,
        exposure=(exposure[0], exposure[1], exposure[2]),
        end=end + 1,
    )


def _numbers(value: bytes, count: int, offset: int) -> list[float]:
    try:
        numbers = [float(word) for word in value.split()]
    except ValueError:
        numbers = []
    if len(numbers) != count or not all(0.0 < n < 1e30 for n in numbers):
        raise AssetError("the header's exposure is not made of positive numbers", offset=offset)
    return numbers


def _read_scanline(data: bytes, offset: int, scanline: UInt8) -> int:
    """Fill `scanline` (width, 4) from `offset` and return the offset behind it."""
    width = len(scanline)
    packed = data[offset : offset + 2] == b"\x02\x02" and _LEAST_PACKED <= width <= _MOST_PACKED
    if packed and data[offset + 2 : offset + 4] == width.to_bytes(2, "big"):
        return _read_packed(data, offset + 4, scanline)
    return _read_pixels(data, offset, scanline)


def _read_packed(data: bytes, offset: int, scanline: UInt8) -> int:
    """One channel after the other, in runs: a count above 128 repeats one byte, any other copies as many."""
    width = len(scanline)
    channels = bytearray(4 * width)
    filled = 0
    try:
        for channel_end in range(width, 5 * width, width):
            while filled < channel_end:
                count = data[offset]
                if count > 128:
                    count -= 128
                    channels[filled : filled + count] = data[offset + 1 : offset + 2] * count
                    offset += 2
                else:
                    channels[filled : filled + count] = data[offset + 1 : offset + 1 + count]
                    offset += 1 + count
                filled += count
                if count == 0 or filled > channel_end:
                    raise AssetError("a run of pixels is empty or leaves its scanline", offset=offset)
    except IndexError:
        offset = len(data) + 1
    if offset > len(data):
        raise AssetError("the picture ends before its last scanline", offset=len(data))
    scanline[:] = np.frombuffer(bytes(channels), dtype=np.uint8).reshape(4, width).T
    return offset


def _read_pixels(data: bytes, offset: int, scanline: UInt8) -> int:
    """Pixel after pixel; (1, 1, 1, n) repeats the one before, n · 256ᵏ times for the k-th in a row."""
    width = len(scanline)
    available = min(width, max(len(data) - offset, 0) // 4)
    pixels = np.frombuffer(data, dtype=np.uint8, count=4 * available, offset=min(offset, len(data)))
    pixels = pixels.reshape(-1, 4)
    repeats = np.all(pixels[:, :3] == 1, axis=1)
    if repeats[:1].any():
        raise AssetError("a scanline begins by repeating a pixel that is not there", offset=offset)
    place = np.arange(available)
    # Position in its row of repetitions, 0 for the first; beyond 3 the count exceeds any width.
    in_row = place - np.maximum.accumulate(np.where(repeats, -1, place)) - 1
    times = pixels[:, 3].astype(np.int64) << (8 * np.clip(in_row, 0, 3))
    counts = np.where(repeats, times, 1)
    filled = np.cumsum(counts)
    last = int(np.searchsorted(filled, width))
    if last >= available:
        raise AssetError("the picture ends before its last scanline", offset=len(data))
    if filled[last] != width:
        raise AssetError("a run of pixels leaves its scanline", offset=offset + 4 * last)
    source = np.maximum.accumulate(np.where(repeats, 0, place))
    scanline[:] = pixels[np.repeat(source[: last + 1], counts[: last + 1])]
    return offset + 4 * (last + 1)
