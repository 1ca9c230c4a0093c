"""A soap film around air: no base at all, only the film."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png, texel_centres, to_bytes
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.sphere import sphere

__all__ = ["build"]

RADIUS_M = 0.05
THICKNESS_NM = (20.0, 800.0)
WATER_IOR = 1.33


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("soap-bubble")
    thickness = builder.texture("thickness", encode_png(to_bytes(_drained_film())))
    material = builder.material(
        "soap film",
        base_color=(1.0, 1.0, 1.0),
        metallic=0.0,
        roughness=0.0,
        double_sided=True,
        extensions={
            "KHR_materials_ior": {"ior": 1.0},
            "KHR_materials_transmission": {"transmissionFactor": 1.0},
            "KHR_materials_iridescence": {
                "iridescenceFactor": 1.0,
                "iridescenceIor": WATER_IOR,
                "iridescenceThicknessMinimum": THICKNESS_NM[0],
                "iridescenceThicknessMaximum": THICKNESS_NM[1],
                "iridescenceThicknessTexture": {"index": thickness},
            },
        },
    )
    builder.mesh("bubble", sphere(RADIUS_M, rings=36, segments=72), material)
    builder.perspective_camera((0.0, 0.03, 0.25), (0.0, 0.0, 0.0), 0.5)
    return Sample(
        name="soap-bubble",
        title="Soap bubble",
        shows=(
            "A film of water around air: black where it is thinnest, pastel rings where it thickens "
            "downwards."
        ),
        look_for=(
            "The film has drained: 20 nm at the top, 800 nm at the bottom, with the swirls of a "
            "draught between. Towards the rim the light path inside the film shortens and the rings "
            "move on to thicker film. At the very top the two reflections cancel and the film all "
            "but vanishes.\n\n"
            "Inside and outside are the same medium, so the base index is 1.0 and its reflectance 0: "
            "nothing but the film reflects. The material lets the rest of the light through "
            "(KHR_materials_transmission, thin-walled); a renderer that draws transmission as opaque "
            "shows a white ball under the same colours."
        ),
        sources=(
            "Film index 1.33, that of water. Radius 5 cm. Thickness texture 128 × 128, green "
            "channel, 3.06 nm a step."
        ),
        files=builder.to_glb(),
    )


def _drained_film() -> NDArray[np.float64]:
    """Return the thickness in [0, 1]: growing downwards, stirred by waves that repeat around the bubble."""
    u, v = texel_centres(128, 128)
    around = 2.0 * np.pi * u
    away_from_poles = np.sin(np.pi * v)
    swirl = np.sin(3.0 * around + 9.0 * v) + 0.6 * np.sin(5.0 * around - 14.0 * v + np.sin(2.0 * around))
    return np.asarray(v**1.2 + 0.05 * away_from_poles * swirl)
