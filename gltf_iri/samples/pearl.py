"""A pearl: a thin aragonite film over a pale, rough dielectric."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.sphere import sphere

__all__ = ["build"]

RADIUS_M = 0.005
THICKNESS_NM = (380.0, 460.0)
ARAGONITE_IOR, CONCHIOLIN_IOR = 1.68, 1.43


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("pearl")
    thickness = builder.texture("thickness", encode_png(to_bytes(_growth())))
    material = builder.material(
        "nacre",
        base_color=(0.72, 0.66, 0.60),
        metallic=0.0,
        roughness=0.3,
        extensions={
            "KHR_materials_ior": {"ior": CONCHIOLIN_IOR},
            "KHR_materials_iridescence": {
                "iridescenceFactor": 1.0,
                "iridescenceIor": ARAGONITE_IOR,
                "iridescenceThicknessMinimum": THICKNESS_NM[0],
                "iridescenceThicknessMaximum": THICKNESS_NM[1],
                "iridescenceThicknessTexture": {"index": thickness},
            },
        },
    )
    builder.mesh("pearl", sphere(RADIUS_M, rings=36, segments=72), material)
    builder.perspective_camera((0.0, 0.004, 0.025), (0.0, 0.0, 0.0), 0.5)
    builder.directional_light((-0.5, -0.7, -0.6), 1.0)
    return Sample(
        name="pearl",
        title="Pearl",
        shows=(
            "A cream dielectric under a film of aragonite: the body colour stays, the sheen shifts "
            "to the rim."
        ),
        look_for=(
            "The body is an ordinary pale dielectric; the film tints only what it reflects, rose and "
            "green in broad patches where the layer is thinner or thicker, changing towards the rim. "
            "Where the film reflects more, less light reaches the body, so the sum never exceeds "
            "what came in.\n\n"
            "This is the dielectric layering of the extension's text without KHR_materials_specular."
        ),
        sources=(
            "Film index 1.68 (aragonite, ordinary ray) over 1.43 (an organic layer); thickness 380 "
            "to 460 nm, that of nacre's platelets. A real pearl stacks hundreds of such pairs; the "
            "extension has one. Diameter 1 cm. Thickness texture 64 × 64, 0.31 nm a step."
        ),
        files=builder.to_glb(),
    )


def _growth() -> NDArray[np.float64]:
    """Return the thickness in [0, 1]: broad patches that repeat around the pearl and fade at its poles."""
    u, v = texel_centres(64, 64)
    around, down = 2.0 * np.pi * u, np.pi * v
    patches = np.sin(2.0 * around + 3.0 * np.cos(down)) + 0.7 * np.sin(
        3.0 * around - 5.0 * np.cos(2.0 * down)
    )
    return np.asarray(0.5 + 0.29 * np.sin(down) ** 2 * patches)
