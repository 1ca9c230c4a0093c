"""A beetle's wing case: dark, dimpled, with a film that its specular colour tints."""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.sphere import ellipsoid

__all__ = ["build"]

HALF_AXES_M = (0.007, 0.011, 0.005)  # upright; the node lays it down
CHITIN_IOR, FILM_IOR = 1.56, 2.0
THICKNESS_NM = 345.0
DIMPLES, DIMPLE_SLOPE = 24, 0.2


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("beetle")
    normals = builder.texture("dimples", encode_png(to_bytes(_dimples())), repeat=True)
    material = builder.material(
        "wing case",
        base_color=(0.02, 0.025, 0.015),
        metallic=0.0,
        roughness=0.3,
        normal_texture=normals,
        normal_repeats=DIMPLES,
        extensions={
            "KHR_materials_ior": {"ior": CHITIN_IOR},
            "KHR_materials_specular": {"specularFactor": 0.9, "specularColorFactor": [0.55, 1.0, 0.6]},
            "KHR_materials_iridescence": {
                "iridescenceFactor": 0.9,
                "iridescenceIor": FILM_IOR,
                "iridescenceThicknessMaximum": THICKNESS_NM,
            },
        },
    )
    # A quarter turn about X: the poles, where the texture is pinched, become head and tail.
    lying = (sqrt(0.5), 0.0, 0.0, sqrt(0.5))
    builder.mesh("wing case", ellipsoid(HALF_AXES_M, rings=32, segments=64), material, rotation=lying)
    builder.perspective_camera((0.017, 0.0235, 0.0235), (0.0, 0.0, 0.0), 0.5)
    builder.directional_light((-0.2, -0.9, -0.4), 1.0)
    return Sample(
        name="beetle",
        title="Beetle",
        shows=(
            "A dimpled dark shell: each dimple shows many angles at once, and the specular colour "
            "tints the film."
        ),
        look_for=(
            "Green on the back, moving to blue and violet towards the silhouette; every dimple "
            "repeats that run in small. Nothing is textured but the normals: all colour comes from "
            "the film and its base.\n\n"
            "The material carries KHR_materials_specular, whose text mixes the film before the "
            "layers are weighed; a renderer that ignores this draws it slightly differently from the "
            "variant without."
        ),
        sources=(
            "Base index 1.56, that of chitin. A real wing case is a stack of many layers; one film "
            "of index 2.0 and 345 nm stands for it, chosen for its green. Length 22 mm. Normal tile "
            "64 × 64, laid 24 times along each coordinate (KHR_texture_transform)."
        ),
        files=builder.to_glb(),
    )


def _dimples() -> NDArray[np.float64]:
    """Return (64, 64, 3) tangent-space normals of round dimples, x to the right and y up, as (n + 1)/2."""
    u, v = texel_centres(64, 64)
    across, down = 2.0 * np.pi * u, 2.0 * np.pi * v
    # The height −cos(across)·cos(down) has dimples and bumps in turn; v runs down, y up.
    slope_x = DIMPLE_SLOPE * np.sin(across) * np.cos(down)
    slope_y = -DIMPLE_SLOPE * np.cos(across) * np.sin(down)
    normal = np.stack([-slope_x, -slope_y, np.ones_like(u)], axis=-1)
    return np.asarray(normal / np.linalg.norm(normal, axis=-1, keepdims=True) * 0.5 + 0.5)
