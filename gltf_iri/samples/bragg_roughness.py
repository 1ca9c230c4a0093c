"""Rougher and rougher layers: one of few cells, one of thick cells, and the first over the second."""

from __future__ import annotations

from typing import Any, Final

from gltf_iri.samples.ball_grid import add_ball_grid
from gltf_iri.samples.bragg_layer import bragg_layer, bragg_stack, tinted_surface
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.sample import Sample

__all__ = ["FALLBACK_F0", "ROUGHNESSES", "UPPER_ROUGHNESS", "build"]

ROUGHNESSES: Final = (0.0, 0.15, 0.3, 0.45, 0.6, 0.8, 1.0)
UPPER_ROUGHNESS = 0.15  # of the layer on top, where there are two
IOR_2 = 1.5
GREY: Final = (0.2, 0.2, 0.2)

# What the layers reflect face on, linear Rec.709 under D65, cut off at 0.
FALLBACK_F0: Final = {
    "thin": (0.805, 0.027, 0.23),
    "thin over thick": (0.9, 0.268, 0.509),
    "thick": (0.32, 0.342, 0.297),
}


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("bragg-roughness")
    rows = [
        [(name := f"{kind}, {r:g}", _material(builder, name, kind, r)) for r in ROUGHNESSES]
        for kind in FALLBACK_F0
    ]
    add_ball_grid(builder, rows)
    return Sample(
        name="bragg-roughness",
        title="Roughness of layers",
        shows=(
            "Layers from smooth to fully rough: a thin-celled one, a thick-celled one, and the first "
            "over the second."
        ),
        look_for=(
            "Roughness rises to the right: 0, 0.15, 0.3, 0.45, 0.6, 0.8 and 1. In the top row (3 "
            "cells of 470 nm) and the bottom row (10 cells of 980 nm) reflections soften and their "
            "rings of colour run into each other, because facets of many angles are seen at once. The "
            "thicker cells have the finer rings, and those drown first: what stays is nearly without "
            "colour.\n\n"
            "In the middle row the layer of the top row, at roughness 0.15, lies on the layer of the "
            "bottom row, whose roughness rises. Its own reflections stay sharp; around them a bluish "
            "haze spreads, light of the lower layer that the upper one has let pass.\n\n"
            "At roughness 0 a layer mirrors like glass, and a light without extent is seen in it only "
            "as a point. Balls darken at roughness 1: what would be reflected twice between facets "
            "counts as absorbed."
        ),
        sources=(
            "The layers of Fig. 12 of Fourneau, Pacanowski and Barla, Computer Graphics Forum 43 "
            "(2024), doi 10.1111/cgf.15017: n1 = 1, n2 = 1.5, d1 = 141 nm, d2 = 329 nm, 3 cells (top) "
            "and d1 = 98 nm, d2 = 882 nm, 10 cells (bottom), on a diffuse base of 0.2. The paper "
            "stops at α = 0.4, a roughness of 0.63; the series here is ours and goes to the end."
        ),
        fallback=(
            "The same series of grey balls with a red (top), pink (middle) and nearly colourless "
            "sheen that roughness spreads, but no rings and no change with the angle: "
            "KHR_materials_specular holds what the layers reflect face on. The "
            "middle row has one roughness there, that of its upper layer."
        ),
        files=builder.to_glb(),
    )


def _material(builder: GLTFBuilder, name: str, kind: str, roughness: float) -> int:
    layers = {
        "thin": [_thin(roughness)],
        "thin over thick": [_thin(UPPER_ROUGHNESS), _thick(roughness)],
        "thick": [_thick(roughness)],
    }[kind]
    return builder.material(
        name,
        base_color=GREY,
        metallic=0.0,
        roughness=layers[0]["roughness"],
        extensions={**tinted_surface(FALLBACK_F0[kind]), "EXT_materials_bragg": bragg_stack(*layers)},
    )


def _thin(roughness: float) -> dict[str, Any]:
    return bragg_layer(141.0, 329.0, IOR_2, 3, roughness**2)


def _thick(roughness: float) -> dict[str, Any]:
    return bragg_layer(98.0, 882.0, IOR_2, 10, roughness**2)
