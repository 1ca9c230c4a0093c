"""The samples' own PNG writer makes files that any reader understands."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from gltf_iri.samples.png import encode_png, to_bytes


@pytest.mark.parametrize("shape", [(1, 1), (4, 256), (5, 7, 3), (180, 200, 3)], ids=str)
def test_pixels_survive(shape: tuple[int, ...]) -> None:
    pixels = np.random.default_rng(3).integers(0, 256, shape, dtype=np.uint8)
    with Image.open(io.BytesIO(encode_png(pixels))) as image:
        assert image.mode == ("L" if len(shape) == 2 else "RGB")
        np.testing.assert_array_equal(np.asarray(image), pixels)


def test_texels_reach_both_ends_and_stay_inside() -> None:
    np.testing.assert_array_equal(to_bytes(np.array([-1.0, 0.0, 0.5, 1.0, 2.0])), [0, 0, 128, 255, 255])
