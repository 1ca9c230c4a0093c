"""A puddle of oil on iron: where it lies and how thick it is, in two channels of one texture."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.shapes import sheet

__all__ = ["build"]

SIDE_M = 0.2
OIL_IOR = 1.47
THICKNESS_NM = (0.0, 900.0)

# Johnson and Christy 1974, n and k of iron, reflectance at normal incidence as linear Rec.709 under D65.
IRON_F0 = (0.530, 0.513, 0.494)


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("oil-on-metal")
    film = builder.texture("film", encode_png(to_bytes(_puddle())))
    material = builder.material(
        "oil on iron",
        base_color=IRON_F0,
        metallic=1.0,
        roughness=0.25,
        extensions={
            "KHR_materials_iridescence": {
                "iridescenceFactor": 1.0,
                "iridescenceIor": OIL_IOR,
                "iridescenceTexture": {"index": film},
                "iridescenceThicknessMinimum": THICKNESS_NM[0],
                "iridescenceThicknessMaximum": THICKNESS_NM[1],
                "iridescenceThicknessTexture": {"index": film},
            }
        },
    )
    builder.mesh("plate", sheet(SIDE_M, SIDE_M, 32, _dented), material)
    builder.perspective_camera((0.0, 0.20, 0.26), (0.0, 0.0, 0.0), 0.7)
    return Sample(
        name="oil-on-metal",
        title="Oil on metal",
        shows=(
            "A puddle of oil on a dented iron plate: bare metal outside, rings of colour towards its middle."
        ),
        look_for=(
            "Outside the puddle the plate is plain iron: the red channel of the texture is 0 there "
            "and switches the film off. Inside, the green channel gives the thickness, and lines of "
            "equal colour are lines of equal thickness. The colours are muted: iron reflects so much "
            "by itself that the film can take little away and add little.\n\n"
            "Both iridescence textures are the same image, read in different channels."
        ),
        sources=(
            "Base colour: reflectance of iron from n and k of Johnson and Christy, Phys. Rev. B 9, "
            "5056 (1974), as linear Rec.709 under D65. Film index 1.47, a light mineral oil. "
            "Thickness 0 to 900 nm, 3.53 nm a step. The plate is 20 cm wide and its dents are 2 mm "
            "deep."
        ),
        files=builder.to_gltf(),
    )


def _dented(x: NDArray[np.float64], z: NDArray[np.float64]) -> tuple[NDArray[np.float64], ...]:
    """Return the height and its two slopes: a product of cosines, 2 mm from top to bottom."""
    depth, wave = 0.001, 2.0 * np.pi / 0.16
    y = depth * np.cos(wave * x) * np.cos(wave * z)
    return (
        y,
        -depth * wave * np.sin(wave * x) * np.cos(wave * z),
        -depth * wave * np.cos(wave * x) * np.sin(wave * z),
    )


def _puddle() -> NDArray[np.float64]:
    """Return (128, 128, 3): red where there is oil, green its thickness, blue unused."""
    u, v = texel_centres(128, 128)
    x, y = 2.0 * u - 1.0, 2.0 * v - 1.0
    angle = np.arctan2(y, x)
    shore = 0.72 + 0.10 * np.sin(3.0 * angle + 0.5) + 0.05 * np.sin(5.0 * angle + 2.0)
    inland = np.clip(1.0 - np.hypot(x, y) / shore, 0.0, 1.0)
    streaks = 0.04 * np.sin(9.0 * x + 3.0 * np.sin(4.0 * y)) + 0.03 * np.sin(11.0 * y + 2.0 * np.sin(5.0 * x))
    thickness = inland**0.8 + streaks * np.clip(4.0 * inland, 0.0, 1.0)
    presence = np.clip(inland / 0.03, 0.0, 1.0)  # the shore is as sharp as the texture allows
    return np.stack([presence, thickness, np.zeros_like(u)], axis=-1)
