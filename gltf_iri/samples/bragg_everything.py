"""Every property of EXT_materials_bragg in one file, and the extensions that it may meet on a material."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.samples.ball_grid import RADIUS_M, add_ball_grid
from gltf_iri.samples.bragg_layer import tinted_surface
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sample import Sample

__all__ = ["TIMES_S", "TRACKS", "build"]

TEXELS = 32
REPEATS: Final = [4.0, 2.0]  # of a texture around a ball and from pole to pole
WATER, CHITIN = 1.33, 1.56

# The first layer states all it has; the second one's period falls where the texture rises; the third is all
# defaults; the last has an index of its own, in which the base then lies.
FOUR_LAYERS: Final[list[dict[str, Any]]] = [
    {
        "ior1": WATER,
        "ior2": 1.6,
        "periodMinimum": 150.0,
        "periodMaximum": 200.0,
        "fill": 0.4,
        "cells": 12,
        "roughness": 0.25,
    },
    {"ior2": 1.5, "periodMinimum": 260.0, "periodMaximum": 220.0, "cells": 6, "roughness": 0.4},
    {},
    {
        "ior1": CHITIN,
        "ior2": 1.7,
        "periodMinimum": 170.0,
        "periodMaximum": 190.0,
        "cells": 20,
        "roughness": 0.3,
    },
]
ONE_LAYER: Final[dict[str, Any]] = {
    "ior2": 1.7,
    "periodMinimum": 190.0,
    "periodMaximum": 190.0,
    "cells": 8,
    "roughness": 0.3,
}

TIMES_S: Final = (0.0, 2.0, 4.0)
_BRAGG: Final = "/materials/{}/extensions/EXT_materials_bragg/"
_MOVED: Final = "/extensions/KHR_texture_transform/"
TRACKS: Final[dict[str, ArrayLike]] = {
    _BRAGG.format(0) + "braggFactor": (1.0, 0.25, 1.0),
    _BRAGG.format(0) + "braggTexture" + _MOVED + "offset": ((0.0, 0.0), (0.5, 0.0), (1.0, 0.0)),
    _BRAGG.format(0) + "braggTexture" + _MOVED + "rotation": (0.2, 0.4, 0.2),
    _BRAGG.format(0) + "braggPeriodTexture" + _MOVED + "scale": ((1.0, 1.0), (2.0, 2.0), (1.0, 1.0)),
    _BRAGG.format(0) + "layers/0/periodMinimum": (150.0, 180.0, 150.0),
    _BRAGG.format(0) + "layers/0/periodMaximum": (200.0, 230.0, 200.0),
    _BRAGG.format(0) + "layers/0/fill": (0.4, 0.6, 0.4),
    _BRAGG.format(0) + "layers/1/ior2": (1.5, 1.6, 1.5),
    _BRAGG.format(0) + "layers/1/roughness": (0.4, 0.1, 0.4),
    _BRAGG.format(0) + "layers/3/ior1": (CHITIN, 1.5, CHITIN),
    _BRAGG.format(1) + "hostIor": (WATER, 1.5, WATER),
}


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("bragg-everything")
    mask = builder.texture("mask", encode_png(to_bytes(_mask())), repeat=True)
    periods = builder.texture("periods", encode_png(to_bytes(_waves())), repeat=True)
    ripples = builder.texture("ripples", encode_png(to_bytes(_ripples())), repeat=True)
    names = ("four layers", "coated metal", "cloth", "glass", "half a metal", "no layers")
    materials = (
        _four_layers(builder, names[0], mask, periods, ripples),
        _metal(builder, names[1], mask),
        _cloth(builder, names[2]),
        _glass(builder, names[3], periods),
        _half(builder, names[4], ripples),
        builder.material(
            names[5],
            base_color=(0.25, 0.02, 0.03),
            metallic=0.0,
            roughness=0.25,
            normal_texture=ripples,
            normal_repeats=4.0,
            extensions={"EXT_materials_bragg": {}},
        ),
    )
    balls = list(zip(names, materials, strict=True))
    switched = {"layers": materials[0], "no layers": materials[-1]}
    add_ball_grid(
        builder,
        [balls[:3], balls[3:]],
        second_uvs_scale=REPEATS,
        variants={names[0]: switched, names[-1]: switched},
    )
    builder.pointer_animation("shimmer", TIMES_S, TRACKS)
    return Sample(
        name="bragg-everything",
        title="Every property",
        shows=(
            "Every property of EXT_materials_bragg, and six materials it meets other extensions on: "
            "for loaders and validators."
        ),
        look_for=(
            "From the top left. Four layers in a host of index 1.33, with every property that a layer "
            "has: a red ball under layers with round gaps in them, whose colour wanders from yellow "
            "over green to blue because one texture moves the periods of all layers, those of the "
            "second layer the other way. The third layer is an empty object and so all defaults; the "
            "last one has an index of its own. Both textures lie on the second texture coordinates, "
            "one by its texCoord, the other by that of its KHR_texture_transform: where gaps do not "
            "repeat four times around the ball, texCoord was not read.\n\n"
            "A gold under layers and a clear coat, which has gaps too: yellow-green face on and rosy "
            "at the silhouette. Blue cloth with a sheen, violet where the layers mirror. A glass "
            "ball: what the layers mirror, light from behind has lost, a yellow and violet tinge in "
            "the middle. Half a metal of which layers cover one half (braggFactor 0.5), rippled and "
            "anisotropic. And a rippled red ball with an empty EXT_materials_bragg, which must look "
            "as if it were not there.\n\n"
            'The variants "layers" and "no layers" give the first and the last ball one material '
            'together. The animation "shimmer" moves factor, host, periods, fill, indices, roughness '
            "and both texture transforms within four seconds, through KHR_animation_pointer. This "
            "project's renderer plays no animations and chooses no variants; it draws the materials "
            "as they stand in the file, and says so."
        ),
        sources=(
            "All numbers are chosen for their look and to differ from defaults. 1.33 is water and "
            "1.56 chitin; the four layers' periods run from 150 to 260 nm. Textures are 32 × 32; each "
            "also serves the core material or a Khronos extension (the surface's tint, clearcoat, "
            "volume thickness, normals), so that validators that do not know this one find it used."
        ),
        fallback=(
            "A red ball with the same gaps in a tint of mint, coated gold, blue cloth with a sheen, "
            "plain glass, a rippled half metal and a plain red ball: what KHR extensions and the core "
            "material make of them."
        ),
        files=builder.to_glb(),
    )


def _four_layers(builder: GLTFBuilder, name: str, mask: int, periods: int, ripples: int) -> int:
    """Layers with gaps; whoever ignores them sees a tinted surface with the same gaps."""
    covered = {
        "index": mask,
        "texCoord": 1,
        "extensions": {"KHR_texture_transform": {"offset": [0.0, 0.0], "rotation": 0.2, "scale": [1.0, 1.0]}},
    }
    surface = {"KHR_materials_ior": {"ior": 1.5}, **tinted_surface((0.1, 0.3, 0.2), covered)}
    bragg = {
        "braggFactor": 1.0,
        "braggTexture": covered,
        "hostIor": WATER,
        "layers": FOUR_LAYERS,
        "braggPeriodTexture": {
            "index": periods,
            "extensions": {"KHR_texture_transform": {"scale": [1.0, 1.0], "texCoord": 1}},
        },
    }
    return builder.material(
        name,
        base_color=(0.25, 0.02, 0.03),
        metallic=0.0,
        roughness=0.25,
        normal_texture=ripples,
        normal_repeats=4.0,
        extensions={**surface, "EXT_materials_bragg": bragg},
    )


def _metal(builder: GLTFBuilder, name: str, mask: int) -> int:
    """Layers whose first index follows the host's, on a metal under a clear coat."""
    coat = {
        "clearcoatFactor": 1.0,
        "clearcoatTexture": {
            "index": mask,
            "extensions": {
                "KHR_texture_transform": {"offset": [0.0, 0.5], "rotation": 0.0, "scale": REPEATS}
            },
        },
        "clearcoatRoughnessFactor": 0.05,
    }
    return builder.material(
        name,
        base_color=(0.9, 0.6, 0.25),
        metallic=1.0,
        roughness=0.35,
        extensions={
            "KHR_materials_clearcoat": coat,
            "EXT_materials_bragg": {"braggFactor": 1.0, "hostIor": WATER, "layers": [ONE_LAYER]},
        },
    )


def _cloth(builder: GLTFBuilder, name: str) -> int:
    return builder.material(
        name,
        base_color=(0.03, 0.04, 0.12),
        metallic=0.0,
        roughness=0.5,
        extensions={
            "KHR_materials_sheen": {"sheenColorFactor": [0.4, 0.35, 0.5], "sheenRoughnessFactor": 0.4},
            "EXT_materials_bragg": {
                "braggFactor": 0.8,
                "layers": [{"periodMinimum": 160.0, "periodMaximum": 160.0, "cells": 4, "roughness": 0.5}],
            },
        },
    )


def _glass(builder: GLTFBuilder, name: str, periods: int) -> int:
    """Light from behind crosses the layers once; the volume is as thick as the periods' texture says."""
    waves = {"index": periods, "extensions": {"KHR_texture_transform": {"scale": REPEATS}}}
    return builder.material(
        name,
        base_color=(1.0, 1.0, 1.0),
        metallic=0.0,
        roughness=0.05,
        extensions={
            "KHR_materials_transmission": {"transmissionFactor": 1.0},
            "KHR_materials_volume": {
                "thicknessFactor": 2.0 * RADIUS_M,
                "thicknessTexture": waves,
                "attenuationDistance": 0.1,
                "attenuationColor": [0.8, 0.95, 0.9],
            },
            "EXT_materials_bragg": {
                "braggFactor": 1.0,
                "layers": [
                    {
                        "ior2": 1.4,
                        "periodMinimum": 200.0,
                        "periodMaximum": 240.0,
                        "cells": 6,
                        "roughness": 0.15,
                    }
                ],
                "braggPeriodTexture": waves,
            },
        },
    )


def _half(builder: GLTFBuilder, name: str, ripples: int) -> int:
    """Layers over half of the surface, on half a metal; anisotropy belongs to the surface beside them."""
    return builder.material(
        name,
        base_color=(0.5, 0.5, 0.55),
        metallic=0.5,
        roughness=0.4,
        normal_texture=ripples,
        normal_repeats=4.0,
        extensions={
            "KHR_materials_anisotropy": {"anisotropyStrength": 0.6, "anisotropyRotation": 1.0},
            "EXT_materials_bragg": {"braggFactor": 0.5, "layers": [ONE_LAYER]},
        },
    )


def _waves() -> NDArray[np.float64]:
    u, v = texel_centres(TEXELS, TEXELS)
    return np.asarray(0.5 + 0.25 * np.sin(2.0 * np.pi * (u + v)) + 0.25 * np.cos(2.0 * np.pi * v))


def _mask() -> NDArray[np.float64]:
    """Return round gaps of 0 in 1, (TEXELS, TEXELS)."""
    u, v = texel_centres(TEXELS, TEXELS)
    height = np.cos(2.0 * np.pi * u) * np.cos(2.0 * np.pi * v)
    return np.asarray(np.clip(1.5 + 4.0 * height, 0.0, 1.0))


def _ripples() -> NDArray[np.float64]:
    """Return (TEXELS, TEXELS, 3) tangent-space normals of ripples across u, as (n + 1)/2."""
    u, _ = texel_centres(TEXELS, TEXELS)
    normal = np.stack([0.15 * np.sin(2.0 * np.pi * u), np.zeros_like(u), np.ones_like(u)], axis=-1)
    return np.asarray(normal / np.linalg.norm(normal, axis=-1, keepdims=True) * 0.5 + 0.5)
