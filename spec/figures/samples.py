"""Draws samples.png, the picture of the README: `python spec/figures/samples.py` in a checkout."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import gltf_iri
from gltf_iri.rendering.picture import display_pixels

__all__ = ["main"]

ROOT = Path(__file__).resolve().parents[2]
CELL = (240, 180)  # pixels

# Row by row: asset, image light, exposure in EV, cells across.
ROWS = (
    (
        ("soap-bubble/soap-bubble.glb", "studio", -0.3, 1),
        ("oil-on-metal/oil-on-metal.gltf", "studio", -0.3, 1),
        ("pearl/pearl.glb", "studio", -0.3, 1),
        ("beetle/beetle.glb", "studio", -0.3, 1),
    ),
    (
        ("anodised-ramp/anodised-ramp.gltf", "studio", -0.3, 2),
        ("thickness-swatches/thickness-swatches.gltf", "white", 0.0, 1),
        ("angle-fan/angle-fan.glb", "white", 0.0, 1),
    ),
)


def draw(asset: str, light: str, exposure: float, across: int) -> NDArray[np.uint8]:
    """Return one cell as 8-bit sRGB, (height, width, 3); a wide one is the middle of a taller picture."""
    size = (CELL[0] * across, CELL[1] * across)
    model = gltf_iri.load(ROOT / "samples" / asset)
    frame = gltf_iri.render(model, size=size, camera=0, environment=light)
    tonemap = "none" if light == "white" else "neutral"
    top = (size[1] - CELL[1]) // 2
    return display_pixels(frame.rgba, exposure, tonemap)[top : top + CELL[1], :, :3]


def main() -> None:
    """Draw every sample once and put the cells together."""
    rows = [np.concatenate([draw(*cell) for cell in row], axis=1) for row in ROWS]
    Image.fromarray(np.concatenate(rows)).save(Path(__file__).with_name("samples.png"), optimize=True)


if __name__ == "__main__":
    main()
