"""Files hold what was drawn, and are there whole or not at all."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.errors import UsageError
from gltf_iri.rendering.picture import (
    TURN_MS,
    display_pixels,
    orbit_paths,
    webp_bytes,
    write_orbit,
    write_picture,
)


@pytest.fixture
def frame():
    rng = np.random.default_rng(11)
    return rng.normal(0.5, 2.0, (7, 5, 4)).astype(np.float32)


def read_exr(path):
    import OpenEXR

    with OpenEXR.File(str(path)) as file:
        return file.channels()["RGBA"].pixels


def read_png(path):
    from PIL import Image

    with Image.open(path) as picture:
        return picture.mode, np.asarray(picture)


def test_exr_keeps_every_bit(tmp_path, frame):
    write_picture(tmp_path / "a.exr", frame)
    assert read_exr(tmp_path / "a.exr").dtype == np.float32
    assert np.array_equal(read_exr(tmp_path / "a.exr"), frame)


def test_exr_is_exposed_but_never_tone_mapped(tmp_path, frame):
    write_picture(tmp_path / "a.exr", frame, 1.0, "aces")
    assert np.array_equal(read_exr(tmp_path / "a.exr")[..., :3], 2.0 * frame[..., :3])
    assert np.array_equal(read_exr(tmp_path / "a.exr")[..., 3], frame[..., 3])


def test_png_is_opaque_srgb_with_the_first_row_on_top(tmp_path):
    frame = np.zeros((2, 1, 4), np.float32)
    frame[0] = [1.0, 0.215861, 0.0, 0.5]  # sRGB 255, 128, 0
    write_picture(tmp_path / "a.png", frame)
    mode, pixels = read_png(tmp_path / "a.png")
    assert mode == "RGB"
    assert pixels.tolist() == [[[255, 128, 0]], [[0, 0, 0]]]


def test_exposure_counts_in_stops():
    frame = np.full((1, 1, 4), 0.25, np.float32)
    assert np.array_equal(display_pixels(frame, 1.0, "none"), display_pixels(2 * frame, 0.0, "none"))


@pytest.mark.parametrize("name", ["a.jpg", "a", "a.png.txt"])
def test_other_endings_are_refused(tmp_path, frame, name):
    with pytest.raises(UsageError, match=r"\.png, \.webp or \.exr"):
        write_picture(tmp_path / name, frame)


def test_a_missing_folder_is_named(tmp_path, frame):
    with pytest.raises(UsageError, match="nowhere"):
        write_picture(tmp_path / "nowhere" / "a.png", frame)


def test_a_failure_leaves_the_old_picture_and_no_litter(tmp_path, frame):
    write_picture(tmp_path / "a.png", frame)
    before = (tmp_path / "a.png").read_bytes()
    with pytest.raises(UsageError):
        write_picture(tmp_path / "a.png", frame, 0.0, "no such tone map")
    assert (tmp_path / "a.png").read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["a.png"]


def test_a_full_disk_becomes_a_sentence(tmp_path, frame, monkeypatch):
    from PIL import Image

    def fail(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Image.Image, "save", fail)
    with pytest.raises(UsageError, match="No space left"):
        write_picture(tmp_path / "a.png", frame)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_in_the_pictures_place_is_called_a_folder(tmp_path, frame):
    (tmp_path / "a.png").mkdir()
    with pytest.raises(UsageError, match="is a folder"):
        write_picture(tmp_path / "a.png", frame)


def read_webp(path):
    """Return the pictures (count, height, width, 3), the durations in ms, and the count of loops."""
    from PIL import Image, ImageSequence

    with Image.open(path) as animation:
        assert animation.format == "WEBP"
        frames, durations = [], []
        for picture in ImageSequence.Iterator(animation):
            picture.load()  # tells the duration of this picture, not of the one before
            frames.append(np.asarray(picture.convert("RGB")))
            durations.append(picture.info.get("duration"))
        return np.stack(frames), durations, animation.info.get("loop")


@pytest.fixture
def turn():
    """Seven pictures, each with its own grey."""
    return [np.full((6, 8, 4), 0.1 * (i + 1), np.float32) for i in range(7)]


def test_a_webp_looks_like_the_png(tmp_path):
    ramp = np.zeros((24, 32, 4), np.float32)
    ramp[..., :3] = np.linspace(0, 1, 32)[:, None]
    write_picture(tmp_path / "a.webp", ramp, -0.5, "neutral")
    shown, _, _ = read_webp(tmp_path / "a.webp")
    want = display_pixels(ramp, -0.5, "neutral")
    assert shown.shape == (1, *want.shape)
    assert np.abs(shown[0].astype(int) - want).max() <= 8
    assert webp_bytes(want) == (tmp_path / "a.webp").read_bytes()


def test_an_orbit_becomes_one_animation_that_loops_in_its_order(tmp_path, turn):
    paths = write_orbit(tmp_path / "a.webp", turn, 7)
    assert paths == (tmp_path / "a.webp",)
    shown, durations, loops = read_webp(paths[0])
    assert shown.shape == (7, 6, 8, 3)
    want = [display_pixels(frame, 0.0, "none").mean() for frame in turn]
    np.testing.assert_allclose(shown.mean(axis=(1, 2, 3)), want, atol=4)
    assert durations == [round(TURN_MS / 7)] * 7
    assert loops == 0


@pytest.mark.parametrize("ending", ["png", "exr"])
def test_an_orbit_becomes_numbered_files_in_its_order(tmp_path, turn, ending):
    paths = write_orbit(tmp_path / f"a.{ending}", turn, 7)
    assert [path.name for path in paths] == [f"a-00{i}.{ending}" for i in range(7)]
    assert sorted(tmp_path.iterdir()) == list(paths)
    for path, frame in zip(paths, turn, strict=True):
        if ending == "exr":
            assert np.array_equal(read_exr(path), frame)
        else:
            assert np.array_equal(read_png(path)[1], display_pixels(frame, 0.0, "none"))


def test_names_of_a_long_orbit_sort_in_its_order(tmp_path):
    names = [path.name for path in orbit_paths(tmp_path / "a.png", 1001)]
    assert names == sorted(names) and len(set(names)) == 1001


@pytest.mark.parametrize("name", ["a.webp", "a.png", "a.exr"])
def test_an_orbit_that_fails_midway_leaves_nothing(tmp_path, turn, name):
    def drawn():
        yield from turn[:4]
        raise UsageError("the fifth cannot be drawn")

    with pytest.raises(UsageError, match="the fifth"):
        write_orbit(tmp_path / name, drawn(), 7)
    assert list(tmp_path.iterdir()) == []


def test_an_orbit_that_fails_keeps_the_one_before(tmp_path, turn):
    paths = write_orbit(tmp_path / "a.png", turn, 7)
    before = [path.read_bytes() for path in paths]
    with pytest.raises(UsageError):
        write_orbit(tmp_path / "a.png", [2 * frame for frame in turn], 7, 0.0, "no such tone map")
    assert [path.read_bytes() for path in paths] == before


def test_an_animation_that_no_memory_holds_is_refused(tmp_path):
    frame = np.zeros((2000, 1000, 4), np.float32)
    with pytest.raises(UsageError, match="fewer, smaller or numbered"):
        write_orbit(tmp_path / "a.webp", iter([frame]), 360)
    assert list(tmp_path.iterdir()) == []


def test_a_side_that_webp_cannot_count_is_refused(tmp_path):
    with pytest.raises(UsageError, match="16383"):
        write_picture(tmp_path / "a.webp", np.zeros((1, 16384, 4), np.float32))
    assert list(tmp_path.iterdir()) == []


def test_an_exr_that_does_not_fit_on_the_disk_is_told(tmp_path, monkeypatch):
    import OpenEXR

    def full(*_):
        raise RuntimeError("No space left on device.")

    monkeypatch.setattr(OpenEXR.File, "write", full)
    with pytest.raises(UsageError, match="cannot be written: No space left"):
        write_picture(tmp_path / "out.exr", np.zeros((2, 2, 4), np.float32), 0.0, "none")
    assert not list(tmp_path.iterdir())
