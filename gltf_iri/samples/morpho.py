"""A blue butterfly after Morpho: shelves of chitin in air, rough, over brown."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.transfer import srgb_encode
from gltf_iri.samples.bragg_layer import bragg_stack, tinted_surface
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.shapes import merge
from gltf_iri.samples.sphere import ellipsoid
from gltf_iri.samples.wing import mirrored, wing

__all__ = ["FALLBACK_F0", "SHELVES", "build"]

Float64 = NDArray[np.float64]

ROUGHNESS: Final = 0.55
SHELVES: Final[dict[str, Any]] = {
    "ior2": 1.552,
    "periodMinimum": 190.0,
    "periodMaximum": 190.0,
    "fill": 0.66,
    "cells": 6,
    "roughness": ROUGHNESS,
}
BROWN: Final = (0.02, 0.012, 0.008)

# What the shelves reflect at normal incidence, linear Rec.709 under D65, cut off at 0.
FALLBACK_F0: Final = (0.0, 0.558, 1.0)
_BARE: Final = (0.045, 0.045, 0.045)  # of chitin alone

_FOREWING: Final = ((78.0, -14.0), (0.040, 0.062, 0.066, 0.062, 0.053, 0.047, 0.045, 0.040))
_HINDWING: Final = ((-8.0, -96.0), (0.030, 0.041, 0.045, 0.046, 0.043, 0.040, 0.036, 0.024))
_TEXELS: Final = 128
_SCALES, _RIDGE_SLOPE, _SCALE_SLOPE = 36.0, 0.22, 0.12


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("morpho")
    strength = _strength()
    # Rounded, so that the last bits of a power move no texel.
    blue, bare = np.round(srgb_encode((FALLBACK_F0, _BARE)), 3)
    colours = strength[::2, ::2, None] * (blue - bare) + bare
    shelves = builder.texture("shelves", encode_png(to_bytes(strength)))
    tint = builder.texture("tint", encode_png(to_bytes(colours)))
    scales = builder.texture("scales", encode_png(to_bytes(_scales())), repeat=True)
    wings = builder.material(
        "wing scales",
        base_color=BROWN,
        metallic=0.0,
        roughness=ROUGHNESS,
        normal_texture=scales,
        normal_repeats=_SCALES,
        double_sided=True,
        extensions={
            **tinted_surface((1.0, 1.0, 1.0), {"index": tint}),
            "EXT_materials_bragg": {**bragg_stack(SHELVES), "braggTexture": {"index": shelves}},
        },
    )
    body = builder.material("body", base_color=BROWN, metallic=0.0, roughness=0.7, extensions={})
    right = [
        wing(*_FOREWING, lift=0.30, arch=1.2, waves=4),
        wing(*_HINDWING, lift=0.22, arch=1.6, waves=4),
    ]
    for name, shape in zip(("forewings", "hindwings"), right, strict=True):
        builder.mesh(name, merge([shape, mirrored(shape)]), wings)
    builder.mesh("body", ellipsoid((0.0028, 0.0028, 0.0150), rings=14, segments=16), body)
    builder.perspective_camera((0.03, 0.15, 0.10), (0.0, 0.004, 0.002), 0.58)
    builder.directional_light((-0.3, -0.9, -0.35), 1.0)
    return Sample(
        name="morpho",
        title="Morpho",
        shows="Six rough shelves of chitin in air: wings that are blue from all sides.",
        look_for=(
            "The wings are blue although nothing in them is: their base is brown, and veins and "
            "margins, where the red channel of a texture takes the shelves away, show it. Chitin and "
            "air differ much, so six shelves mirror nearly all light about 451 nm, and the band is "
            "wide. The facets are rough: the blue does not lie in a highlight but over the whole wing, "
            "deeper where light and eye are far from each other, violet where the wing is grazed.\n\n"
            "A Morpho's shelves are narrow and of uneven height, and diffraction spreads their blue "
            "farther to the sides of a ridge than along it. Here roughness stands for it, alike on all "
            "sides."
        ),
        fallback=(
            "The specular colour is what the shelves reflect face on, through a texture, on a "
            "dielectric of the same roughness: a blue butterfly with brown veins and margins, blue "
            "alike under all angles and white at the silhouette. Its factor of 25 makes of the usual F0 "
            "of 0.04 the colour in the texture."
        ),
        sources=(
            "Chitin: n = 1.552 at 500 nm, Leertouwer and others, Opt. Express 19, 24061 (2011). A shelf "
            "of 64.6 nm and 125.4 nm of air under it, six of each, are chosen for their blue; so are "
            "the roughness 0.55 (α = 0.3) and the brown. The wings span 13 cm; their outline and their "
            "36 rows of scales are invented."
        ),
        files=builder.to_glb(),
    )


def _strength() -> Float64:
    """Return how much of a wing's place the shelves cover: 0 on veins and margins. (128, 128)."""
    u, v = texel_centres(_TEXELS, _TEXELS)
    margin = 0.88 + 0.015 * np.cos(2.0 * np.pi * 8.0 * u) - 0.10 * np.cos(np.pi * u) ** 8
    inside = np.clip((margin - v) / 0.03, 0.0, 1.0)
    vein = np.abs(8.0 * u - np.rint(8.0 * u)) / 8.0  # in u, from the nearest of nine
    open_wing = np.clip(vein * v / 0.004 - 0.4, 0.0, 1.0)
    return np.asarray(inside * open_wing)


def _scales() -> Float64:
    """Return (64, 64, 3) tangent-space normals of ridges and of the edge of a row of scales, as (n + 1)/2."""
    u, v = texel_centres(64, 64)
    slope_x = _RIDGE_SLOPE * np.sin(2.0 * np.pi * 4.0 * u)
    slope_y = _SCALE_SLOPE * np.sin(2.0 * np.pi * (v + 0.12 * np.cos(2.0 * np.pi * 2.0 * u)))
    normal = np.stack([-slope_x, -slope_y, np.ones_like(u)], axis=-1)
    return np.asarray(normal / np.linalg.norm(normal, axis=-1, keepdims=True) * 0.5 + 0.5)
