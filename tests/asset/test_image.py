from __future__ import annotations

import struct
import time
import zlib
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from gltf_iri.asset.document import Document
from gltf_iri.asset.guard import Budget
from gltf_iri.asset.image import decode_image, sniff_media_type
from gltf_iri.asset.limits import MAX_IMAGE_PIXELS
from gltf_iri.errors import AssetError

OpenImage = Callable[..., Document]
Encode = Callable[..., bytes]

GRADIENT = np.arange(6 * 5 * 4, dtype=np.uint8).reshape(6, 5, 4) * 2


def png_chunk(kind: bytes, data: bytes) -> bytes:
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def png(width: int, height: int, bits: int, colour: int, rows: bytes, *extra: tuple[bytes, bytes]) -> bytes:
    """Write a PNG by hand: rows are unfiltered, each led by its 0."""
    header = struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, 0)
    middle = b"".join(png_chunk(kind, data) for kind, data in extra)
    body = png_chunk(b"IDAT", zlib.compress(rows))
    return b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", header) + middle + body + png_chunk(b"IEND", b"")


@pytest.mark.parametrize("kind", ["PNG", "WEBP"])
def test_lossless_pictures_come_back_as_they_were(
    kind: str, encode_picture: Encode, open_image: OpenImage
) -> None:
    pixels = np.maximum(GRADIENT, 1)  # WebP may drop the colour of transparent pixels
    document = open_image(encode_picture(pixels, kind, lossless=True), name="a name")
    image = document.image(0)
    np.testing.assert_array_equal(image.pixels, pixels)
    assert image.pixels.dtype == np.uint8
    assert (image.mime_type, image.name, image.bits) == (f"image/{kind.lower()}", "a name", 8)
    assert document.notes == []
    assert document.image(0) is image


def test_jpeg_is_read_the_right_way_up(encode_picture: Encode, open_image: OpenImage) -> None:
    pixels = np.zeros((16, 8, 3), np.uint8)
    pixels[:8] = (200, 40, 40)
    image = open_image(encode_picture(pixels, "JPEG", quality=95)).image(0)
    assert image.mime_type == "image/jpeg"
    assert image.pixels.shape == (16, 8, 4)
    assert np.abs(image.pixels[:6, :, :3].astype(int) - (200, 40, 40)).max() < 8
    assert image.pixels[10:, :, :3].max() < 8
    assert (image.pixels[..., 3] == 255).all()


@pytest.mark.parametrize(
    ("data", "expected", "bits"),
    [
        (png(2, 1, 1, 0, b"\0\x40"), [(0, 0, 0, 255), (255, 255, 255, 255)], 1),
        (png(2, 1, 2, 0, b"\0\x60"), [(85, 85, 85, 255), (170, 170, 170, 255)], 2),
        (png(2, 1, 2, 0, b"\0\x60", (b"tRNS", b"\0\1")), [(85, 85, 85, 0), (170, 170, 170, 255)], 2),
        (png(2, 1, 4, 0, b"\0\x60", (b"tRNS", b"\0\6")), [(102, 102, 102, 0), (0, 0, 0, 255)], 4),
        (png(2, 1, 8, 0, b"\0\x05\xfa"), [(5, 5, 5, 255), (250, 250, 250, 255)], 8),
        (png(2, 1, 8, 4, b"\0\x05\x10\xfa\x20"), [(5, 5, 5, 16), (250, 250, 250, 32)], 8),
        (png(2, 1, 8, 2, b"\0\1\2\3\4\5\6"), [(1, 2, 3, 255), (4, 5, 6, 255)], 8),
        (
            png(2, 1, 8, 3, b"\0\0\1", (b"PLTE", b"\1\2\3\4\5\6"), (b"tRNS", b"\x80")),
            [(1, 2, 3, 128), (4, 5, 6, 255)],
            8,
        ),
        (
            png(2, 1, 8, 2, b"\0\1\2\3\4\5\6", (b"tRNS", b"\0\1\0\2\0\3")),
            [(1, 2, 3, 0), (4, 5, 6, 255)],
            8,
        ),
        (png(2, 1, 16, 0, b"\0\x12\x34\xff\xff"), [(0x12, 0x12, 0x12, 255), (255, 255, 255, 255)], 16),
        (
            png(2, 1, 16, 2, b"\0" + bytes(range(12))),
            [(0, 2, 4, 255), (6, 8, 10, 255)],
            16,
        ),
        (
            png(2, 1, 16, 6, b"\0" + bytes(range(16))),
            [(0, 2, 4, 6), (8, 10, 12, 14)],
            16,
        ),
        (png(1, 1, 16, 4, b"\0\x12\x34\x56\x78"), [(0x12, 0x12, 0x12, 0x56)], 16),
    ],
    ids=[
        "1-bit",
        "2-bit",
        "2-bit-key",
        "4-bit-key",
        "grey",
        "grey-alpha",
        "rgb",
        "palette",
        "rgb-key",
        "grey16",
        "rgb16",
        "rgba16",
        "ga16",
    ],
)
def test_every_kind_of_png_becomes_rgba(
    data: bytes, expected: list[tuple[int, ...]], bits: int, open_image: OpenImage
) -> None:
    document = open_image(data)
    image = document.image(0)
    np.testing.assert_array_equal(image.pixels[0], np.array(expected, np.uint8))
    assert image.bits == bits
    assert len(document.notes) == (1 if bits == 16 else 0)


def test_colour_profile_and_gamma_do_not_change_the_values(open_image: OpenImage) -> None:
    data = png(1, 1, 8, 2, b"\0\x10\x80\xf0", (b"gAMA", struct.pack(">I", 100000)), (b"sRGB", b"\0"))
    np.testing.assert_array_equal(open_image(data).image(0).pixels[0, 0], (0x10, 0x80, 0xF0, 255))


def test_the_bytes_decide_and_a_wrong_media_type_is_noted(
    encode_picture: Encode, open_image: OpenImage
) -> None:
    document = open_image(encode_picture(GRADIENT, "PNG"), mimeType="image/jpeg")
    assert document.image(0).mime_type == "image/png"
    (note,) = document.notes
    assert "image/jpeg" in note
    assert note.startswith("/images/0: ")


@pytest.mark.parametrize(
    "data", [b"", b"GIF89a......", b"<svg/>", b"\xabKTX 20\xbb\r\n\x1a\n", b"RIFF1234WAVE"]
)
def test_other_formats_are_refused(data: bytes, open_image: OpenImage) -> None:
    with pytest.raises(AssetError, match="PNG, JPEG and WebP are read") as caught:
        open_image(data).image(0)
    assert caught.value.pointer == "/images/0"


@pytest.mark.parametrize("kind", ["PNG", "JPEG", "WEBP"])
def test_truncated_pictures_are_refused(kind: str, encode_picture: Encode, open_image: OpenImage) -> None:
    data = encode_picture(np.ascontiguousarray(GRADIENT[..., :3]), kind)
    for length in (16, len(data) // 2):
        with pytest.raises(AssetError, match=r"cannot be decoded|cut off or broken"):
            open_image(data[:length]).image(0)


@pytest.mark.parametrize("side", [8193, 13_000, 20_000, 60_000, 2**31 - 1])
def test_bombs_are_refused_before_they_are_decoded(side: int, open_image: OpenImage) -> None:
    start = time.process_time()
    with pytest.raises(AssetError, match=f"more than .*{MAX_IMAGE_PIXELS}"):
        open_image(png(side, side, 8, 6, b"\0" * 1000)).image(0)
    assert time.process_time() - start < 0.5


def test_pictures_count_against_the_budget(encode_picture: Encode) -> None:
    data = encode_picture(GRADIENT, "PNG")
    size = GRADIENT.size
    decode_image(data, None, "", "/images/0", Budget(size))
    with pytest.raises(AssetError):
        decode_image(data, None, "", "/images/0", Budget(size - 1))


def test_animation_is_noted_and_its_first_frame_used(open_image: OpenImage) -> None:
    import io

    import PIL.Image

    frames = [PIL.Image.new("RGB", (4, 4), colour) for colour in ("red", "blue")]
    target = io.BytesIO()
    frames[0].save(target, "PNG", save_all=True, append_images=frames[1:])
    document = open_image(target.getvalue())
    np.testing.assert_array_equal(document.image(0).pixels[0, 0], (255, 0, 0, 255))
    assert len(document.notes) == 1


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    kind=st.sampled_from(["PNG", "JPEG", "WEBP"]),
    edits=st.lists(st.tuples(st.integers(0), st.integers(0, 255))),
)
def test_damaged_pictures_are_pixels_or_an_asset_error(
    kind: str, edits: list[tuple[int, int]], encode_picture: Encode
) -> None:
    data = bytearray(encode_picture(np.ascontiguousarray(GRADIENT[..., :3]), kind))
    for position, value in edits:
        data[position % len(data)] = value
    try:
        image, _ = decode_image(bytes(data), None, "", "/images/0", Budget())
    except AssetError as error:
        assert error.pointer == "/images/0"
        assert "\n" not in str(error)
    else:
        assert image.pixels.ndim == 3


@given(st.binary(max_size=20))
def test_sniffing_never_fails(data: bytes) -> None:
    known: tuple[Any, ...] = (None, "image/png", "image/jpeg", "image/webp", "image/ktx2")
    assert sniff_media_type(data) in known
