"""What headers of pictures say; expectations are the Khronos validator's, but where it breaks itself."""

from __future__ import annotations

from struct import pack
from typing import Any

import pytest
from small_pictures import (
    APP0,
    IDAT,
    PNG_SIGNATURE,
    SOI,
    chunk,
    ihdr,
    jpeg,
    png,
    riff,
    segment,
    sof,
    vp8,
    vp8l,
    vp8x,
)

from gltf_iri.validation.files.image_info import ImageDataError, ImageEndError, ImageInfo, Segments
from gltf_iri.validation.files.images import read_image


def read(data: bytes) -> ImageInfo:
    info = read_image(data, Segments())
    if info is None:
        raise LookupError("no picture that is known")
    return info


def told(data: bytes) -> dict[str, Any]:
    return read(data).to_json()


@pytest.mark.parametrize(
    ("colour_type", "plain", "transparent"),
    [
        (0, "luminance", "luminance-alpha"),
        (2, "rgb", "rgba"),
        (3, "rgb", "rgba"),
        (4, "luminance-alpha", "luminance-alpha"),
        (6, "rgba", "rgba"),
    ],
)
def test_the_format_of_a_png_follows_from_colour_type_and_transparency(
    colour_type: int, plain: str, transparent: str
) -> None:
    assert told(png(colour_type=colour_type))["format"] == plain
    assert told(png(chunk(b"tRNS", bytes(2)), colour_type=colour_type))["format"] == transparent


def test_an_unknown_colour_type_has_no_format() -> None:
    assert "format" not in told(png(colour_type=5))


@pytest.mark.parametrize("bits", [1, 2, 4, 8, 16])
def test_a_png_says_its_size_and_bits(bits: int) -> None:
    assert told(png(width=3, height=70_000, bits=bits)) == {
        "width": 3,
        "height": 70_000,
        "format": "rgba",
        "primaries": "srgb",
        "transfer": "srgb",
        "bits": bits,
    }


def test_no_bits_are_left_out() -> None:
    assert "bits" not in told(png(bits=0))


GAMMA = chunk(b"gAMA", pack(">I", 45455))
LINEAR = chunk(b"gAMA", pack(">I", 100_000))
OTHER_GAMMA = chunk(b"gAMA", pack(">I", 45456))
PRIMARIES = chunk(b"cHRM", pack(">8I", 31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000))
OTHER_PRIMARIES = chunk(b"cHRM", bytes(32))
SRGB = chunk(b"sRGB", b"\0")
PROFILE = chunk(b"iCCP", b"a\0\0b")


@pytest.mark.parametrize(
    ("chunks", "primaries", "transfer"),
    [
        ((), "srgb", "srgb"),
        ((SRGB,), "srgb", "srgb"),
        ((GAMMA,), "srgb", "srgb"),
        ((LINEAR,), "srgb", "linear"),
        ((OTHER_GAMMA,), "srgb", "custom"),
        ((PRIMARIES,), "srgb", "srgb"),
        ((OTHER_PRIMARIES,), "custom", "srgb"),
        ((PROFILE,), "custom", "custom"),
        # sRGB and a profile are above the others, and the later of them counts.
        ((OTHER_GAMMA, OTHER_PRIMARIES, SRGB), "srgb", "srgb"),
        ((SRGB, OTHER_GAMMA, OTHER_PRIMARIES), "srgb", "srgb"),
        ((PROFILE, GAMMA, PRIMARIES), "custom", "custom"),
        ((PROFILE, SRGB), "srgb", "srgb"),
        ((SRGB, PROFILE), "custom", "custom"),
        # Of two statements the first counts.
        ((LINEAR, GAMMA), "srgb", "linear"),
        ((GAMMA, LINEAR), "srgb", "srgb"),
        ((OTHER_PRIMARIES, PRIMARIES), "custom", "srgb"),
    ],
)
def test_colours_of_a_png(chunks: tuple[bytes, ...], primaries: str, transfer: str) -> None:
    info = read(png(*chunks))
    assert (info.primaries, info.transfer) == (primaries, transfer)
    assert info.is_unsupported == ("custom" in (primaries, transfer))


@pytest.mark.parametrize(("across", "down"), [(1, 2), (2, 1)])
def test_oblong_pixels_are_unsupported(across: int, down: int) -> None:
    assert read(png(chunk(b"pHYs", pack(">IIB", across, down, 0)))).is_unsupported
    assert not read(png(chunk(b"pHYs", pack(">IIB", down, down, 1)))).is_unsupported


@pytest.mark.parametrize(("kind", "length"), [(b"sRGB", 1), (b"gAMA", 4), (b"cHRM", 32), (b"pHYs", 9)])
def test_chunks_of_fixed_length_have_it(kind: bytes, length: int) -> None:
    assert read(png(chunk(kind, bytes(length))))
    for wrong in (length - 1, length + 1, 2**32 - 1):
        with pytest.raises(ImageDataError, match=kind.decode()):
            read(png(chunk(kind, bytes(length), wrong)))


def test_a_header_chunk_of_another_length_is_broken() -> None:
    with pytest.raises(ImageDataError, match="IHDR"):
        read(PNG_SIGNATURE + chunk(b"IHDR", bytes(12)) + IDAT)


def test_pixels_before_the_header_are_broken() -> None:
    """Here the Khronos validator falls over, with the process that it runs in."""
    with pytest.raises(ImageDataError, match="IHDR"):
        read(PNG_SIGNATURE + IDAT)


def test_a_png_is_read_up_to_the_head_of_its_pixels() -> None:
    whole = PNG_SIGNATURE + ihdr() + GAMMA + PROFILE + IDAT
    enough = len(whole) - len(IDAT) + 8
    for end in range(14, enough):
        with pytest.raises(ImageEndError):
            read(whole[:end])
    assert read(whole[:enough]).is_unsupported


@pytest.mark.parametrize("kind", [b"tEXt", b"ABCD", b"\0\0\0\0", b"acTL", b"IEND"])
def test_other_chunks_are_passed_over(kind: bytes) -> None:
    assert told(png(chunk(kind, b"xyz"))) == told(png())
    with pytest.raises(ImageEndError):
        read(png(chunk(kind, b"xyz", 2**31)))


@pytest.mark.parametrize(("components", "pixel_format"), [(1, "luminance"), (3, "rgb")])
def test_a_jpeg_is_grey_or_rgb(components: int, pixel_format: str) -> None:
    data = jpeg(APP0, sof(components=components, width=3, height=5))
    assert told(data) == {"width": 3, "height": 5, "format": pixel_format, "bits": 8}


@pytest.mark.parametrize("components", [0, 2, 4, 255])
def test_other_channels_of_a_jpeg_are_broken(components: int) -> None:
    with pytest.raises(ImageDataError, match="channels"):
        read(jpeg(sof(components=components)))


@pytest.mark.parametrize("marker", [*range(0xC0, 0xC4), *range(0xC5, 0xC8), *range(0xC9, 0xCC), 0xCD, 0xCF])
def test_every_kind_of_frame_says_its_size(marker: int) -> None:
    assert told(jpeg(sof(marker, bits=12)))["bits"] == 12


@pytest.mark.parametrize("marker", [0xC4, 0xC8, 0xCC])
def test_tables_are_no_frames(marker: int) -> None:
    assert told(jpeg(sof(marker, width=9), sof(width=3)))["width"] == 3


def test_fill_bytes_and_lone_markers_may_stand_between_segments() -> None:
    between = b"\xff\xff\xff\x01\xff\xd0\xff\xd7"
    assert told(jpeg(between, APP0, between, sof())) == told(jpeg(sof()))


@pytest.mark.parametrize("length", [0, 1])
def test_a_segment_is_as_long_as_its_own_length_at_least(length: int) -> None:
    with pytest.raises(ImageDataError, match="length"):
        read(jpeg(segment(0xE0, b"", length), sof()))
    assert read(jpeg(segment(0xE0, b"", 2), sof()))


def test_a_jpeg_is_read_up_to_the_end_of_its_frame_header() -> None:
    whole = SOI + APP0 + sof()
    for end in range(14, len(whole)):
        with pytest.raises(ImageEndError):
            read(whole[:end])
    assert read(whole)


def test_a_short_frame_header_is_broken() -> None:
    with pytest.raises(ImageDataError, match="short"):
        read(jpeg(APP0, segment(0xC0, bytes(5))))


@pytest.mark.parametrize("make", [vp8, vp8l, vp8x])
def test_a_webp_says_its_size(make: Any) -> None:
    assert told(make(width=16383, height=5)) == {
        "width": 16383,
        "height": 5,
        "format": "rgb",
        "primaries": "srgb",
        "transfer": "srgb",
        "bits": 8,
    }


def test_an_extended_webp_may_be_large() -> None:
    info = read(vp8x(width=2**24, height=2**24))
    assert (info.width, info.height) == (2**24, 2**24)


@pytest.mark.parametrize("data", [vp8l(alpha=1), vp8x(flags=0x10)])
def test_a_webp_may_have_alpha(data: bytes) -> None:
    assert told(data)["format"] == "rgba"


@pytest.mark.parametrize(("flags", "is_unsupported"), [(0, False), (0x0C, False), (0x02, True), (0x20, True)])
def test_animation_and_profile_of_a_webp_are_unsupported(flags: int, is_unsupported: bool) -> None:
    assert read(vp8x(flags=flags)).is_unsupported == is_unsupported


@pytest.mark.parametrize(("data", "enough"), [(vp8(), 30), (vp8l(), 25), (vp8x(), 30)])
def test_a_webp_is_read_up_to_its_size(data: bytes, enough: int) -> None:
    for end in range(15, enough):
        with pytest.raises(ImageEndError):
            read(data[:end])
    assert read(data[:enough])


def test_another_first_chunk_of_a_webp_is_broken() -> None:
    with pytest.raises(ImageDataError, match="VP8"):
        read(riff(b"VP8?", bytes(20)))


@pytest.mark.parametrize("data", [b"GIF89a" + bytes(20), b"", PNG_SIGNATURE, png()[:13], b"\xff\xd8\xff"])
def test_other_and_too_few_bytes_are_no_picture(data: bytes) -> None:
    assert read_image(data, Segments()) is None


@pytest.mark.parametrize(
    "data",
    [
        PNG_SIGNATURE + ihdr() + chunk(b"abcD") * 600_000 + IDAT,
        SOI + segment(0xE0) * 600_000 + sof(),
    ],
)
def test_segments_without_end_are_given_up(data: bytes) -> None:
    segments = Segments()
    for _ in range(3):
        with pytest.raises(ImageDataError, match="more than"):
            read_image(data, segments)


def test_bytes_between_segments_are_not_searched_again_and_again() -> None:
    data, segments = SOI + b"\xff" * 40_000_000 + sof(), Segments()
    for _ in range(4):
        assert read_image(data, segments) is not None
    with pytest.raises(ImageDataError, match="more than"):
        read_image(png(), segments)
