"""Files hold what was drawn, and are there whole or not at all."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.errors import UsageError
from gltf_iri.rendering.picture import display_pixels, write_picture


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
    with pytest.raises(UsageError, match=r"\.png or \.exr"):
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
