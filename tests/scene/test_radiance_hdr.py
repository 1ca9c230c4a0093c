"""Against an encoder written here from the format's description."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from gltf_iri.errors import AssetError
from gltf_iri.scene.radiance_hdr import read_radiance


def _encode_pixel(rgb):
    """Shared exponent of the brightest channel; mantissas rounded down."""
    brightest = max(rgb)
    if brightest < 1e-32:
        return (0, 0, 0, 0)
    _, exponent = math.frexp(brightest)
    return (*(int(math.ldexp(c, 8 - exponent)) for c in rgb), exponent + 128)


def _flat(rows):
    return b"".join(bytes(pixel) for row in rows for pixel in row)


def _old_runs(rows):
    out = bytearray()
    for row in rows:
        for pixel, same in itertools.groupby(row):
            repeats = len(list(same)) - 1
            out += bytes(pixel)
            while repeats:  # low byte first, each marker worth 256 times the one before
                out += bytes((1, 1, 1, repeats & 255))
                repeats >>= 8
    return bytes(out)


def _new_runs(rows):
    out = bytearray()
    for row in rows:
        out += bytes((2, 2)) + len(row).to_bytes(2, "big")
        for channel in range(4):
            for value, same in itertools.groupby(pixel[channel] for pixel in row):
                left = len(list(same))
                while left:
                    count = min(left, 127)
                    out += bytes((128 + count, value)) if count > 2 else bytes((count, *[value] * count))
                    left -= count
    return bytes(out)


def _picture(height=6, width=300):
    """Runs of every length, dark and very bright pixels, black; no pixel looks like a run marker."""
    g = np.random.default_rng(8)
    values = np.exp(g.normal(size=(height, width, 3)) * 4)
    values[0, 10:290] = values[0, 10]
    values[1, 5:9] = 0.0
    values[2] = values[2, 0]
    values[3, :128] = values[3, 0]
    return [[_encode_pixel(pixel) for pixel in row] for row in values.tolist()]


def _file(body, height, width, header=b"", order=b"-Y %d +X %d"):
    return b"#?RADIANCE\n" + header + b"FORMAT=32-bit_rle_rgbe\n\n" + order % (height, width) + b"\n" + body


def _decoded(rows):
    return np.array([[[m * 2.0 ** (e - 136) for m in (r, g, b)] for r, g, b, e in row] for row in rows])


@pytest.mark.parametrize(
    ("encode", "width"),
    # The packing by channels begins at a width of 8.
    [*itertools.product([_flat, _old_runs], [1, 7, 8, 300]), (_new_runs, 8), (_new_runs, 300)],
)
def test_all_three_ways_of_packing_give_the_pixels_back_exactly(encode, width):
    rows = [row[:width] for row in _picture()]
    np.testing.assert_array_equal(read_radiance(_file(encode(rows), 6, width)), _decoded(rows))


def test_a_run_of_more_than_255_pixels_in_the_old_packing_takes_several_markers():
    rows = [[(10, 20, 30, 128)] * 70000]
    np.testing.assert_array_equal(read_radiance(_file(_old_runs(rows), 1, 70000)), _decoded(rows))


def test_white_is_exactly_one_and_exponent_zero_is_black():
    picture = read_radiance(_file(bytes((128, 128, 128, 129, 255, 255, 255, 0)), 1, 2))
    np.testing.assert_array_equal(picture, [[[1, 1, 1], [0, 0, 0]]])


def test_a_colour_survives_to_the_precision_of_its_mantissa():
    values = np.exp(np.random.default_rng(9).normal(size=(1, 500, 3)) * 3)
    rows = [[_encode_pixel(pixel) for pixel in values[0].tolist()]]
    error = np.abs(read_radiance(_file(_flat(rows), 1, 500)) - values)
    assert np.all(error <= values.max(axis=2, keepdims=True) / 128)


@pytest.mark.parametrize("signs", ["++", "+-", "-+", "--"])
@pytest.mark.parametrize("columns_first", [False, True])
def test_every_order_of_scanlines_gives_the_same_upright_picture(signs, columns_first):
    upright = [row[:9] for row in _picture()]
    expected = _decoded(upright)
    vertical, horizontal = signs
    rows = upright if vertical == "-" else upright[::-1]
    rows = rows if horizontal == "+" else [row[::-1] for row in rows]
    order = f"{vertical}Y 6 {horizontal}X 9"
    if columns_first:
        rows = [list(column) for column in zip(*rows, strict=True)]
        order = f"{horizontal}X 9 {vertical}Y 6"
    data = b"#?RGBE\n\n" + order.encode() + b"\n" + _flat(rows)
    np.testing.assert_array_equal(read_radiance(data), expected)


def test_exposures_of_the_header_multiply_and_are_undone():
    rows = [[(128, 128, 128, 129)]]
    header = b"EXPOSURE=2\nEXPOSURE= 4.0\nCOLORCORR=1 2 0.5\n"
    picture = read_radiance(_file(_flat(rows), 1, 1, header))
    np.testing.assert_allclose(picture, [[[1 / 8, 1 / 16, 1 / 4]]])


@pytest.mark.parametrize("encode", [_flat, _old_runs, _new_runs])
def test_a_picture_cut_anywhere_is_refused(encode):
    whole = _file(encode([row[:20] for row in _picture()]), 6, 20)
    for length in range(0, len(whole), 7):
        with pytest.raises(AssetError):
            read_radiance(whole[:length])
    with pytest.raises(AssetError):
        read_radiance(whole[:-1])


@pytest.mark.parametrize(
    "data",
    [
        b"P6 2 2 255\n",
        b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd",
        b"#?RADIANCE\nEXPOSURE=0\n\n-Y 1 +X 1\nabcd",
        b"#?RADIANCE\nCOLORCORR=1 x 2\n\n-Y 1 +X 1\nabcd",
        b"#?RADIANCE\n\n-Y 1 +Y 1\nabcd",
        b"#?RADIANCE\n\n-Y 0 +X 1\nabcd",
        b"#?RADIANCE\n\n-Y 999999999 +X 999999999\nabcd",
        b"#?RADIANCE\n\n-Y 1 +X 2\n\1\1\1\2abcd",
        b"#?RADIANCE\n\n-Y 1 +X 2\nabcd\1\1\1\5",
        b"#?RADIANCE\n\n-Y 1 +X 8\n\2\2\0\10" + b"\0" * 64,
        b"#?RADIANCE\n\n-Y 1 +X 8\n\2\2\0\10" + b"\211a" * 4,
    ],
    ids=[
        "another format", "XYZE", "no exposure", "words for numbers", "one axis twice", "no pixels",
        "too many", "repeats nothing", "run beyond the scanline", "empty run",
        "packed run beyond the scanline",
    ],
)  # fmt: skip
def test_what_is_no_such_picture_is_refused_with_the_byte(data):
    with pytest.raises(AssetError) as caught:
        read_radiance(data)
    assert caught.value.offset is not None
