"""Images made in code, which stand for a document's."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike

from gltf_iri.asset.texture import Texture
from gltf_iri.errors import AssetError
from gltf_iri.material.texture import TextureInfo


class Images:
    """Stands for a document: only its textures are asked for. `asked` counts how often each image was."""

    def __init__(self) -> None:
        self.pixels: list[Any] = []
        self.asked: list[int] = []

    def add(self, pixels: ArrayLike | None, **where: Any) -> TextureInfo:
        """Append an image (h, w, 4) of uint8, None for a broken one, and return what reads it."""
        self.pixels.append(None if pixels is None else np.asarray(pixels, np.uint8))
        self.asked.append(0)
        return TextureInfo(len(self.pixels) - 1, **where)

    def texture(self, index: int) -> Texture:
        return Texture(index)

    def image(self, index: int) -> SimpleNamespace:
        self.asked[index] += 1
        if self.pixels[index] is None:
            raise AssetError("the image/png is cut off or broken at its start", pointer=f"/images/{index}")
        return SimpleNamespace(pixels=self.pixels[index])


@pytest.fixture
def images() -> Images:
    return Images()


@pytest.fixture(scope="session")
def make_images() -> Callable[[], Images]:
    """For tests that need many."""
    return Images
