"""Draws the samples' pictures: `python spec/figures/samples.py` in a checkout, and then `make samples`."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import gltf_iri
from gltf_iri.rendering.picture import display_pixels, webp_bytes
from gltf_iri.scene.choose import choose_environment
from gltf_iri.scene.exposure import automatic_exposure

__all__ = ["main"]

ROOT = Path(__file__).resolve().parents[2]
SIZE = (480, 360)  # pixels
OVERSAMPLED = 2  # fine normals sparkle at one shaded sample a pixel

PICTURES = ROOT / "gltf_iri" / "samples" / "pictures"


def draw(asset: str) -> NDArray[np.uint8]:
    """Return the asset as `gltf-iri render` shows it, 8-bit sRGB, (height, width, 3)."""
    width, height = SIZE
    model = gltf_iri.load(ROOT / "samples" / asset)
    studio = choose_environment("studio")
    frame = gltf_iri.render(model, size=(width * OVERSAMPLED, height * OVERSAMPLED), environment=studio)
    rgba = frame.rgba.reshape(height, OVERSAMPLED, width, OVERSAMPLED, 4).mean(axis=(1, 3))
    return display_pixels(rgba, automatic_exposure(model.scene(), studio), "neutral")


def main() -> None:
    """Draw each sample into a file of its own, from which `gltf-iri samples` takes it."""
    PICTURES.mkdir(exist_ok=True)
    for sample in json.loads((ROOT / "samples" / "index.json").read_text(encoding="utf-8"))["samples"]:
        (PICTURES / f"{sample['name']}.webp").write_bytes(webp_bytes(draw(sample["file"])))


if __name__ == "__main__":
    main()
