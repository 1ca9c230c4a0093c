"""Balls with layers of Bragg mirrors, as files that a loader reads."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sphere import sphere

# Layers of Fourneau et al. 2024, Figure 7, and the first row of their Table 3; α = roughness².
A = {"ior1": 1.0, "ior2": 1.5, "periodMaximum": 500.0, "fill": 0.5, "cells": 10, "roughness": 0.1**0.5}
B = A | {"periodMaximum": 988.0, "roughness": 0.05**0.5}
CUTICLE = {"ior1": 1.59, "ior2": 1.67, "periodMaximum": 160.0, "fill": 0.51, "cells": 8}

# Base colour, metalness, roughness of the base, and the extension.
MATERIALS: dict[str, tuple[tuple[float, float, float], float, float, dict[str, Any]]] = {
    "beetle": ((0.0, 0.0, 0.0), 0.0, 0.5, {"layers": [CUTICLE | {"roughness": 0.05**0.5}]}),
    "bright under cuticle": ((0.9, 0.8, 0.7), 0.0, 0.5, {"layers": [CUTICLE | {"roughness": 0.05**0.5}]}),
    "painted": (
        (0.6, 0.25, 0.1),
        0.0,
        0.4,
        {
            "braggFactor": 0.9,
            "braggTexture": {"index": 0},
            "layers": [A | {"periodMinimum": 300.0}],
            "braggPeriodTexture": {"index": 0},
        },
    ),
    "two over metal": ((0.9, 0.7, 0.3), 1.0, 0.5, {"layers": [A, B]}),
    "coated": ((0.5, 0.5, 0.5), 0.0, 0.5, {"hostIor": 1.35, "layers": [A | {"ior1": 1.35}]}),
}


def bragg_ball(folder: Path, name: str, *, darkest_texel: float = 0.0, **changes: Any) -> Path:
    """Write a ball of radius 1 m with one of MATERIALS, its extension changed, and return its file."""
    colour, metallic, roughness, layers = MATERIALS[name]
    builder = GLTFBuilder(name.replace(" ", "-"))
    u, v = texel_centres(32, 16)
    # Few full turns, so that the seam does not show; steps of a byte are far below what lobes tell apart.
    waves = [0.5 + 0.5 * np.sin(2.0 * np.pi * (turns * u + v)) for turns in (1, 2, 3)]
    texels = darkest_texel + (1.0 - darkest_texel) * np.stack(waves, axis=-1)
    builder.texture("waves", encode_png(to_bytes(texels)), repeat=True)
    extension = {"braggFactor": 1.0} | layers | changes
    material = builder.material(
        name,
        base_color=colour,
        metallic=metallic,
        roughness=roughness,
        extensions={"EXT_materials_bragg": extension},
    )
    builder.mesh("ball", sphere(1.0, rings=48, segments=96), material)
    builder.perspective_camera((0.0, 0.0, 3.4), (0.0, 0.0, 0.0), 0.7)
    for towards, lux in (((-0.5, -0.7, -0.8), 3.0), ((0.9, 0.1, -0.35), 2.0)):
        builder.directional_light(towards, lux)
    folder.mkdir(parents=True, exist_ok=True)
    for file, content in builder.to_gltf().items():
        (folder / file).write_bytes(content)
    return folder / f"{name.replace(' ', '-')}.gltf"
