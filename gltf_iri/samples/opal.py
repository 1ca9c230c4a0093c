"""A black opal: domains of stacked silica spheres, each with a spacing of its own, under a polish."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.transfer import srgb_encode
from gltf_iri.samples.bragg_layer import bragg_stack, tinted_surface
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.domains import nearest_points, scrambled
from gltf_iri.samples.png import encode_png, to_bytes
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.shapes import Shape, grid, solid_of_revolution

__all__ = ["FALLBACK_F0", "HOST_IOR", "LAYER", "LEVELS", "build"]

Float64 = NDArray[np.float64]

HOST_IOR: Final = 1.37
PERIOD_ENDS_NM: Final = (155.0, 245.0)
LAYER: Final[dict[str, Any]] = {
    "ior2": 1.45,
    "periodMinimum": PERIOD_ENDS_NM[0],
    "periodMaximum": PERIOD_ENDS_NM[1],
    "fill": 0.5,
    "cells": 50,
    "roughness": 0.45,
}
POTCH: Final = (0.012, 0.014, 0.022)
GOLD: Final = (1.0, 0.766, 0.336)
HALF_AXES_M: Final = (0.0075, 0.0042, 0.0055)

LEVELS: Final = (0, 51, 85, 119, 153, 187, 221, 255)  # texels of the spacings that occur
# What each reflects from its host face on, linear Rec.709 under D65, cut off at 0.
FALLBACK_F0: Final = (
    (0.04, 0.0, 0.368),
    (0.0, 0.109, 0.161),
    (0.0, 0.346, 0.0),
    (0.073, 0.364, 0.0),
    (0.527, 0.132, 0.0),
    (0.506, 0.0, 0.0),
    (0.167, 0.0, 0.0),
    (0.034, 0.0, 0.0),
)
_SIDE, _COUNT, _FAULTS_TEXELS = 128, 140, 5.0


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("opal")
    level, strength = _domains()
    domains = np.stack([strength, np.array(LEVELS)[level] / 255.0, np.zeros_like(strength)], axis=-1)
    seen = srgb_encode(np.array(FALLBACK_F0)[level] * strength[..., None])[::2, ::2]
    stone = builder.material(
        "opal",
        base_color=POTCH,
        metallic=0.0,
        roughness=0.2,
        extensions={
            **tinted_surface((1.0, 1.0, 1.0), {"index": builder.texture("seen", encode_png(to_bytes(seen)))}),
            "EXT_materials_bragg": _stack(builder.texture("domains", encode_png(to_bytes(domains)))),
        },
    )
    gold = builder.material("gold", base_color=GOLD, metallic=1.0, roughness=0.25, extensions={})
    builder.mesh("stone", _dome(rings=20, segments=48), stone)
    builder.mesh("setting", _setting(), gold)
    builder.perspective_camera((0.0, 0.034, 0.019), (0.0, 0.0004, 0.0), 0.42)
    builder.directional_light((-0.4, -1.0, -0.5), 1.0)
    return Sample(
        name="opal",
        title="Opal",
        shows="Domains of one kind of stack, each with a period of its own, under a polished surface.",
        look_for=(
            "Each domain has its own colour and keeps its own edges; turned, every one of them slides "
            "towards shorter waves, so that a domain dark face on, whose band lies beyond red, turns "
            "red at the sides. One texture holds both: green gives a domain the period between the two "
            "ends of the layer, red how much of the light meets it, faults in fine lines and none on "
            "the seams.\n\n"
            "Spheres and what lies between them differ little, so it takes 50 cells to mirror most of a "
            "narrow band. The layer lies in a host: its smooth surface gives the white image of the "
            "lights that stands over the colours, which are rough."
        ),
        fallback=(
            "A second texture of half the size holds what each domain reflects face on, as specular "
            "colour (KHR_materials_specular, its factor of 25 makes of the usual F0 of 0.04 the colour "
            "in the texture): the same patches, painted, with one colour from every side."
        ),
        sources=(
            "The spheres' layers lie 155 to 245 nm apart, within the 150 to 350 nm that are told of "
            "precious opal. Index 1.45 is that of silica; 1.37, of the layers between the spheres' "
            "middles, is taken between silica and water, and both halves of a cell are alike thick. The "
            "stone is 15 mm long; its domains come from whole numbers only, so they are the same on "
            "every machine. Texture 128 × 128, eight periods."
        ),
        files=builder.to_glb(),
    )


def _domains() -> tuple[NDArray[np.int64], Float64]:
    """Return which spacing lies where, and how much of the light meets it: none on the seams."""
    nearest = nearest_points(_SIDE, _COUNT)
    level, share, turn = (
        np.array([scrambled(start + i) % count for i in range(_COUNT)])[nearest]
        for start, count in ((1000, len(LEVELS)), (2000, 128), (3000, 360))
    )
    # Faults in the stacking run across a domain as fine lines, in a direction of its own.
    row, column = np.mgrid[:_SIDE, :_SIDE]
    along = np.cos(np.radians(turn)) * column + np.sin(np.radians(turn)) * row
    strength = (128.0 + share) / 255.0 * (0.8 + 0.2 * np.cos(along * 2.0 * np.pi / _FAULTS_TEXELS))
    is_seam = np.zeros(nearest.shape, dtype=bool)
    is_seam[1:] |= nearest[1:] != nearest[:-1]
    is_seam[:, 1:] |= nearest[:, 1:] != nearest[:, :-1]
    return level, np.where(is_seam, 0.0, strength)


def _stack(domains: int) -> dict[str, Any]:
    texture = {"index": domains}
    stack = bragg_stack(LAYER, host_ior=HOST_IOR)
    return {**stack, "braggTexture": texture, "braggPeriodTexture": texture}


def _dome(rings: int, segments: int) -> Shape:
    """Return a cabochon, the upper part of an ellipsoid; its texture is laid on from above, unrolled."""
    radius, azimuth = np.meshgrid(
        np.linspace(0.0, 1.0, rings + 1), np.linspace(0.0, 2.0 * np.pi, segments + 1), indexing="ij"
    )
    polar = 1.65 * radius  # to a little below the widest part
    cosine, sine = np.cos(azimuth), np.sin(azimuth)
    axes = np.array(HALF_AXES_M)
    ball = np.stack([np.sin(polar) * cosine, np.cos(polar), -np.sin(polar) * sine], axis=-1)
    uvs = np.stack([0.5 + 0.5 * radius * cosine, 0.5 - 0.5 * radius * sine], axis=-1)
    # ∂/∂u of the unit ball: radius grows with cos of the azimuth, and the azimuth turns by −sin / radius.
    out = np.stack([np.cos(polar) * cosine, -np.sin(polar), -np.cos(polar) * sine], axis=-1)
    around = np.stack([-sine, np.zeros_like(sine), -cosine], axis=-1)
    turn = np.sinc(polar / np.pi) * sine  # sin(polar) / polar
    along = cosine[..., None] * out - turn[..., None] * around
    return grid(ball * axes, ball / axes, along * axes, uvs)


def _setting() -> Shape:
    """Return the rim of gold that holds the stone: a ring of round section, drawn out as the stone is."""
    turn = np.linspace(0.0, 2.0 * np.pi, 13)
    profile = np.stack([np.cos(turn), np.sin(turn)], axis=-1)[::-1]
    ring = solid_of_revolution(
        1.04 + 0.10 * profile[:, 0], 0.14 * profile[:, 1], profile, turn / (2.0 * np.pi), segments=48
    )
    axes = np.array((HALF_AXES_M[0], HALF_AXES_M[2], HALF_AXES_M[2]))
    normals = ring.normals / axes
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    return Shape(ring.positions * axes, normals, ring.uvs, ring.triangles, ring.tangents)
