"""The picture beside each sample is there, small, and of the sample as it is now."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import gltf_iri
from gltf_iri.rendering.picture import display_pixels
from gltf_iri.samples.collection import NAMES, collection_files, write_samples
from gltf_iri.scene.choose import choose_environment
from gltf_iri.scene.exposure import automatic_exposure

LARGEST_BYTES = 30_000
SMALL = (80, 60)


def picture(name: str) -> Image.Image:
    return Image.open(io.BytesIO(collection_files()[f"{name}/{name}.webp"]))


@pytest.mark.parametrize("name", NAMES)
def test_each_readme_shows_a_small_picture_of_its_sample(name: str) -> None:
    files = collection_files()
    assert f"]({name}.webp)" in files[f"{name}/README.md"].decode()
    assert len(files[f"{name}/{name}.webp"]) < LARGEST_BYTES
    assert picture(name).size == (480, 360)


@pytest.mark.gl
@pytest.mark.parametrize("name", ["soap-bubble", "pearl", "jewel-beetle"])
def test_a_picture_is_of_the_sample_as_it_is_now(name: str, tmp_path: Path) -> None:
    """Some colours that change make a mean difference of more than 3 of 255; compression and few pixels 1."""
    (asset,) = [path for path in write_samples(tmp_path) if path.name in (f"{name}.glb", f"{name}.gltf")]
    model, studio = gltf_iri.load(asset), choose_environment("studio")
    frame = gltf_iri.render(model, size=SMALL, environment=studio)
    drawn = display_pixels(frame.rgba, automatic_exposure(model.scene(), studio), "neutral")[..., :3]
    shown = np.asarray(picture(name).convert("RGB").resize(SMALL, Image.Resampling.BOX))
    difference = np.abs(drawn.astype(float) - shown)
    assert difference.mean() < 3.0
    # Another sample's picture would not pass.
    other = np.asarray(picture("thickness-swatches").convert("RGB").resize(SMALL, Image.Resampling.BOX))
    assert np.abs(drawn.astype(float) - other).mean() > 6.0
