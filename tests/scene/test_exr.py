"""Against an encoder written here from the format's description, and against the OpenEXR package's writer.

Layout: https://openexr.com/en/latest/OpenEXRFileLayout.html
"""

from __future__ import annotations

import struct
import zlib

import numpy as np
import OpenEXR
import pytest

from gltf_iri.errors import AssetError
from gltf_iri.scene.exr import read_exr

HALF, FLOAT = 1, 2
NONE, ZIPS = 0, 2
HEIGHT, WIDTH = 6, 12


def _attribute(name, kind, data):
    return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data


def _header(planes, data_window, display_window, compression, tile=None, line_order=0):
    channels = b"".join(
        name.encode() + b"\0" + struct.pack("<iB3xii", FLOAT if plane.dtype == "f4" else HALF, 0, 1, 1)
        for name, plane in sorted(planes.items())
    )
    attributes = [
        _attribute("channels", "chlist", channels + b"\0"),
        _attribute("compression", "compression", bytes([compression])),
        _attribute("dataWindow", "box2i", struct.pack("<4i", *data_window)),
        _attribute("displayWindow", "box2i", struct.pack("<4i", *display_window)),
        _attribute("lineOrder", "lineOrder", bytes([line_order])),
        _attribute("pixelAspectRatio", "float", struct.pack("<f", 1.0)),
        _attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0.0, 0.0)),
        _attribute("screenWindowWidth", "float", struct.pack("<f", 1.0)),
    ]
    if tile:
        attributes.append(_attribute("tiles", "tiledesc", struct.pack("<IIB", *tile, 0)))
    version = 2 | (0x200 if tile else 0)
    return struct.pack("<ii", 20000630, version) + b"".join(attributes) + b"\0"


def _zipped(raw):
    """Even bytes first, then odd ones, each as its difference to the one before, plus 128."""
    split = np.frombuffer(raw[0::2] + raw[1::2], np.uint8).astype(int)
    differences = np.concatenate([split[:1], np.diff(split) + 128 + 256]) % 256
    packed = zlib.compress(differences.astype(np.uint8).tobytes())
    return packed if len(packed) < len(raw) else raw


def _file(path, planes, *, data_window=None, display_window=None, compression=NONE, tile=None, line_order=0):
    height, width = next(iter(planes.values())).shape
    data_window = data_window or (0, 0, width - 1, height - 1)
    display_window = display_window or data_window
    head = _header(planes, data_window, display_window, compression, tile, line_order)
    chunks = []
    step_y, step_x = tile[::-1] if tile else (1, width)
    for top in range(0, height, step_y):
        for left in range(0, width, step_x):
            rows = range(top, min(top + step_y, height))
            raw = b"".join(
                plane[row, left : left + step_x].tobytes()
                for row in rows
                for _, plane in sorted(planes.items())
            )
            body = _zipped(raw) if compression == ZIPS else raw
            place = (left // step_x, top // step_y, 0, 0) if tile else (data_window[1] + top,)
            chunks.append(struct.pack(f"<{len(place)}i", *place) + struct.pack("<i", len(body)) + body)
    order = range(len(chunks))[:: -1 if line_order else 1]
    offsets, end = [0] * len(chunks), len(head) + 8 * len(chunks)
    for number in order:
        offsets[number] = end
        end += len(chunks[number])
    path.write_bytes(
        head + struct.pack(f"<{len(offsets)}Q", *offsets) + b"".join(chunks[number] for number in order)
    )
    return path


def _planes(dtype="f4", names="RGB", height=HEIGHT, width=WIDTH):
    g = np.random.default_rng(4)
    return {name: np.exp(g.normal(size=(height, width)) * 3).astype(dtype) for name in names}


def _picture(planes, names="RGB"):
    return np.stack([planes[name] for name in names], axis=2).astype(np.float32)


@pytest.mark.parametrize("dtype", ["f2", "f4"])
@pytest.mark.parametrize(
    "how",
    [{}, {"compression": ZIPS}, {"tile": (5, 4)}, {"tile": (16, 16)}, {"line_order": 1}],
    ids=["scanlines", "zipped", "tiles", "one tile", "from below"],
)
def test_bytes_written_by_hand_come_back_exactly(tmp_path, dtype, how):
    planes = _planes(dtype)
    np.testing.assert_array_equal(read_exr(_file(tmp_path / "sky.exr", planes, **how)), _picture(planes))


def test_halves_and_floats_stand_side_by_side(tmp_path):
    planes = _planes("f4") | {"G": _planes("f2")["G"], "A": _planes("f2", "A")["A"]}
    np.testing.assert_array_equal(read_exr(_file(tmp_path / "sky.exr", planes)), _picture(planes))


@pytest.mark.parametrize("name", ["NO", "RLE", "ZIPS", "ZIP", "PIZ"])
@pytest.mark.parametrize("storage", [OpenEXR.scanlineimage, OpenEXR.tiledimage])
def test_every_lossless_compression_gives_the_floats_back_exactly(tmp_path, name, storage):
    planes = _planes(height=40, width=80)
    header = {"compression": getattr(OpenEXR, f"{name}_COMPRESSION"), "type": storage}
    if storage == OpenEXR.tiledimage:
        header["tiles"] = OpenEXR.TileDescription()
        header["tiles"].xSize = header["tiles"].ySize = 32
    path = tmp_path / "sky.exr"
    OpenEXR.File(header, dict(planes)).write(str(path))
    np.testing.assert_array_equal(read_exr(path), _picture(planes))


def test_a_data_window_inside_the_display_window_leaves_the_rest_dark(tmp_path):
    planes = _planes()
    path = _file(tmp_path / "sky.exr", planes, data_window=(3, 2, 14, 7), display_window=(0, 0, 19, 9))
    expected = np.zeros((10, 20, 3), np.float32)
    expected[2:8, 3:15] = _picture(planes)
    np.testing.assert_array_equal(read_exr(path), expected)


def test_pixels_outside_the_display_window_are_left_out(tmp_path):
    planes = _planes()
    path = _file(tmp_path / "sky.exr", planes, data_window=(-2, -1, 9, 4), display_window=(0, 0, 7, 3))
    np.testing.assert_array_equal(read_exr(path), _picture(planes)[1:5, 2:10])


def test_windows_that_do_not_meet_hold_no_light(tmp_path):
    path = _file(tmp_path / "sky.exr", _planes(), data_window=(50, 50, 61, 55), display_window=(0, 0, 7, 3))
    assert not read_exr(path).any()


def test_luminance_alone_becomes_grey_and_chroma_is_refused(tmp_path):
    grey = _planes(names=["Y"])
    np.testing.assert_array_equal(read_exr(_file(tmp_path / "grey.exr", grey)), _picture(grey, "YYY"))
    with pytest.raises(AssetError, match="luminance and chroma"):
        read_exr(_file(tmp_path / "chroma.exr", _planes(names=["Y", "RY", "BY"])))


def test_colour_without_a_layer_comes_before_layers(tmp_path):
    planes = _planes(names=["R", "G", "B", "glow.R", "glow.G", "glow.B"])
    np.testing.assert_array_equal(read_exr(_file(tmp_path / "sky.exr", planes)), _picture(planes))


def test_the_only_layer_with_colour_is_read_and_one_of_two_is_not_guessed(tmp_path):
    names = ["sky.R", "sky.G", "sky.B"]
    planes = _planes(names=[*names, "depth.Z"])
    read = read_exr(_file(tmp_path / "one.exr", planes))
    np.testing.assert_array_equal(read, _picture(planes, names))
    two = _planes(names=[*names, "glow.R", "glow.G", "glow.B"])
    with pytest.raises(AssetError, match=r"several layers with R, G and B \(glow, sky\)"):
        read_exr(_file(tmp_path / "two.exr", two))


def test_the_first_part_with_colour_is_read(tmp_path):
    depth, first, second = {"Z": _planes(names="Z")["Z"]}, _planes(), _planes("f2")
    parts = [
        OpenEXR.Part({"type": OpenEXR.scanlineimage}, dict(planes), name)
        for name, planes in (("depth", depth), ("left", first), ("right", second))
    ]
    path = tmp_path / "parts.exr"
    OpenEXR.File(parts).write(str(path))
    np.testing.assert_array_equal(read_exr(path), _picture(first))


def test_a_channel_s_name_that_is_no_text_is_refused(tmp_path):
    path = _file(tmp_path / "sky.exr", _planes(names="RGBQ"))
    path.write_bytes(path.read_bytes().replace(b"Q\0", b"\xde\0", 1))
    with pytest.raises(AssetError, match="UTF-8"):
        read_exr(path)


def test_the_library_s_own_complaints_are_not_printed(tmp_path, capfd):
    path = _file(tmp_path / "sky.exr", _planes())
    path.write_bytes(path.read_bytes()[:-40])
    with pytest.raises(AssetError):
        read_exr(path)
    assert capfd.readouterr() == ("", "")
