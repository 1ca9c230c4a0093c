from __future__ import annotations

import math

import numpy as np
import OpenEXR
import pytest

from gltf_iri.errors import AssetError, UsageError
from gltf_iri.scene.environment import RADIANCE_MAX, read_environment, studio, white
from gltf_iri.scene.studio import STUDIO_BOXES, directions


def _exr(path, planes, **header):
    OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, **header}, planes).write(str(path))
    return path


def _rgb(picture, dtype="f4"):
    return {name: np.ascontiguousarray(picture[:, :, i], dtype=dtype) for i, name in enumerate("RGB")}


def _asymmetric():
    return np.random.default_rng(2).uniform(0.1, 4, size=(4, 8, 3)).astype(np.float32)


def _uv(direction):
    """The convention of the contract: (½ + atan2(z, x)/2π, acos(y)/π)."""
    x, y, z = direction
    return 0.5 + math.atan2(z, x) / (2 * math.pi), math.acos(y) / math.pi


def test_an_exr_picture_keeps_its_floats_and_its_top_row(tmp_path):
    picture = _asymmetric()
    environment = read_environment(_exr(tmp_path / "sky.exr", _rgb(picture)))
    np.testing.assert_array_equal(environment.radiance, picture)
    assert (environment.name, environment.notes) == ("sky.exr", ())


def test_half_floats_and_luminance_alone_are_read(tmp_path):
    picture = _asymmetric()[:, :, 0].astype(np.float16)
    radiance = read_environment(_exr(tmp_path / "grey.exr", {"Y": np.ascontiguousarray(picture)})).radiance
    np.testing.assert_array_equal(radiance, np.repeat(picture[:, :, None], 3, axis=2))
    assert radiance.dtype == np.float32


def test_both_formats_put_the_same_light_in_the_same_place(tmp_path):
    bytes_of_one_bright_pixel = bytearray(bytes((128, 128, 128, 127)) * 32)
    bytes_of_one_bright_pixel[4 * 14 : 4 * 15] = bytes((128, 64, 32, 132))  # row 1, column 6
    hdr = tmp_path / "sky.hdr"
    hdr.write_bytes(b"#?RADIANCE\n\n-Y 4 +X 8\n" + bytes(bytes_of_one_bright_pixel))
    picture = np.full((4, 8, 3), 0.25)
    picture[1, 6] = (8, 4, 2)
    exr = _exr(tmp_path / "sky.exr", _rgb(picture))
    np.testing.assert_array_equal(read_environment(hdr).radiance, picture)
    np.testing.assert_array_equal(read_environment(exr).radiance, picture)


def test_pixel_centres_point_where_the_convention_says():
    height = 8
    for row, line in enumerate(directions(height)):
        for column, direction in enumerate(line):
            u, v = _uv(direction)
            assert u * 2 * height == pytest.approx(column + 0.5)
            assert v * height == pytest.approx(row + 0.5)
            assert np.linalg.norm(direction) == pytest.approx(1)


def test_negative_light_becomes_black_and_is_noted(tmp_path):
    picture = _asymmetric()
    picture[2, 3, 1] = -5
    environment = read_environment(_exr(tmp_path / "sky.exr", _rgb(picture)))
    assert environment.radiance[2, 3, 1] == 0
    assert environment.notes == ("sky.exr has 1 pixels with negative light (down to -5): set to 0.",)


@pytest.mark.parametrize("value", [math.nan, -math.inf])
def test_light_that_is_no_number_is_refused_with_its_place(tmp_path, value):
    picture = _asymmetric()
    picture[2, 3, 1] = value
    with pytest.raises(AssetError, match=r"sky\.exr: 1 pixels are not numbers, the first in row 2, column 3"):
        read_environment(_exr(tmp_path / "sky.exr", _rgb(picture)))


def test_infinite_light_becomes_the_largest_half_and_is_noted(tmp_path):
    picture = _asymmetric()
    picture[1, 2] = 1e6
    with np.errstate(over="ignore"):
        path = _exr(tmp_path / "sun.exr", _rgb(picture, "f2"))
    environment = read_environment(path)
    np.testing.assert_array_equal(environment.radiance[1, 2], [65504] * 3)
    assert environment.notes == ("sun.exr has 1 pixels of infinite light: set to 65504.",)


def test_light_beyond_what_can_be_summed_is_bounded_and_noted(tmp_path):
    picture = _asymmetric()
    picture[3, 7] = (1.0, 3e38, 2.0)
    environment = read_environment(_exr(tmp_path / "sun.exr", _rgb(picture)))
    np.testing.assert_array_equal(environment.radiance[3, 7], [1.0, RADIANCE_MAX, 2.0])
    assert environment.notes == ("sun.exr has 1 pixels beyond what single precision can sum: set to 1e+24.",)


def test_a_picture_of_another_shape_is_refused(tmp_path):
    with pytest.raises(AssetError, match="this picture is 8 × 3"):
        read_environment(_exr(tmp_path / "sky.exr", _rgb(_asymmetric()[:3])))


def test_other_primaries_are_refused_and_rec709_stated_is_not(tmp_path):
    rec709 = (0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329)
    acescg = (0.713, 0.293, 0.165, 0.83, 0.128, 0.044, 0.32168, 0.33767)
    picture = _rgb(_asymmetric())
    assert read_environment(_exr(tmp_path / "a.exr", picture, chromaticities=rec709)).name == "a.exr"
    with pytest.raises(AssetError, match="primaries"):
        read_environment(_exr(tmp_path / "b.exr", picture, chromaticities=acescg))


def test_an_exr_without_colour_is_refused_by_its_channels(tmp_path):
    with pytest.raises(AssetError, match="it has Z"):
        read_environment(_exr(tmp_path / "sky.exr", {"Z": np.ones((4, 8), dtype=np.float32)}))


@pytest.mark.parametrize("keep", [4, 100, 0.6])
def test_an_exr_cut_short_is_refused_and_prints_nothing(tmp_path, capsys, keep):
    path = _exr(tmp_path / "sky.exr", _rgb(np.random.default_rng(1).uniform(size=(64, 128, 3))))
    data = path.read_bytes()
    path.write_bytes(data[: keep if keep >= 1 else int(keep * len(data))])
    with pytest.raises(AssetError) as caught:
        read_environment(path)
    assert caught.value.file == path
    assert capsys.readouterr().out == ""


def test_a_broken_radiance_picture_is_refused_with_its_name(tmp_path):
    path = tmp_path / "sky.hdr"
    path.write_bytes(b"#?RADIANCE\n\n-Y 4 +X 8\n")
    with pytest.raises(AssetError) as caught:
        read_environment(path)
    assert caught.value.file == path


def test_an_exposure_that_overflows_is_bounded_and_noted(tmp_path):
    path = tmp_path / "sky.hdr"
    path.write_bytes(b"#?RADIANCE\nEXPOSURE=1e-29\n\n-Y 1 +X 2\n" + bytes((128, 128, 128, 200)) * 2)
    environment = read_environment(path)
    assert np.all(environment.radiance == RADIANCE_MAX)
    assert "2 pixels beyond" in environment.notes[0]


def test_a_path_that_does_not_exist_or_is_something_else_is_a_wrong_call(tmp_path):
    with pytest.raises(UsageError, match="absent"):
        read_environment(tmp_path / "absent.hdr")
    text = tmp_path / "notes.txt"
    text.write_text("light", encoding="utf-8")
    with pytest.raises(UsageError, match="neither"):
        read_environment(text)


def test_the_white_environment_is_one_everywhere():
    assert np.all(white().radiance == 1)


def test_the_studio_is_neutral_finite_and_on_average_as_bright_as_the_white_one():
    radiance = studio().radiance
    assert radiance.shape == (256, 512, 3)
    assert np.all(radiance == radiance[:, :, :1])
    assert radiance.min() > 0
    solid_angle = np.sin((np.arange(256) + 0.5) / 256 * math.pi)
    assert np.average(radiance[:, :, 0].mean(axis=1), weights=solid_angle) == pytest.approx(1, abs=1e-6)
    assert 8 <= radiance.max() <= 15


def test_the_studio_s_key_light_stands_in_front_to_the_right_and_above():
    radiance = studio().radiance[:, :, 0]
    brightest = directions(256)[radiance > 0.98 * radiance.max()]
    assert np.all(brightest > 0)  # +X, +Y and towards the viewer's side, +Z
    floor, ceiling = radiance[-40:].mean(), radiance[:40].mean()
    assert floor < 0.2 * ceiling


@pytest.mark.parametrize("box", STUDIO_BOXES)
def test_every_soft_box_of_the_studio_outshines_what_is_just_outside_it(box):
    radiance = studio().radiance

    def seen_at(across, along):
        sin_a, cos_a = math.sin(box.azimuth_rad), math.cos(box.azimuth_rad)
        sin_e, cos_e = math.sin(box.elevation_rad), math.cos(box.elevation_rad)
        centre = np.array([sin_a * cos_e, sin_e, cos_a * cos_e])
        right, up = np.array([cos_a, 0, -sin_a]), np.array([-sin_a * sin_e, cos_e, -cos_a * sin_e])
        direction = centre + across * box.half_width * right + along * box.half_height * up
        u, v = _uv(direction / np.linalg.norm(direction))
        return radiance[int(v * 256), int(u * 512), 0]

    middle = seen_at(0, 0)
    for outside in [(1.4, 0), (-1.4, 0), (0, 1.4), (0, -1.4)]:
        assert seen_at(*outside) < 0.75 * middle
