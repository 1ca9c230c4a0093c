"""A titanium rod whose oxide grows along its length, as anodising voltage makes it."""

from __future__ import annotations

import numpy as np

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.shapes import Shape, solid_of_revolution

__all__ = ["build"]

LENGTH_M, RADIUS_M = 0.16, 0.014
OXIDE_IOR = 2.16
THICKNESS_NM = (0.0, 255.0)

# Johnson and Christy 1974, n and k of titanium, reflectance at normal incidence as linear Rec.709 under D65.
TITANIUM_F0 = (0.619, 0.579, 0.543)


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("anodised-ramp")
    # One texel a nanometre: the texel's value is its column.
    ramp = np.tile(np.arange(256, dtype=np.uint8), (4, 1))
    thickness = builder.texture("thickness", encode_png(ramp))
    material = builder.material(
        "anodised titanium",
        base_color=TITANIUM_F0,
        metallic=1.0,
        roughness=0.3,
        extensions={
            "KHR_materials_iridescence": {
                "iridescenceFactor": 1.0,
                "iridescenceIor": OXIDE_IOR,
                "iridescenceThicknessMinimum": THICKNESS_NM[0],
                "iridescenceThicknessMaximum": THICKNESS_NM[1],
                "iridescenceThicknessTexture": {"index": thickness},
            }
        },
    )
    builder.mesh("rod", _rod(), material)
    builder.perspective_camera((0.0, 0.075, 0.275), (0.0, 0.0, 0.0), 0.45)
    return Sample(
        name="anodised-ramp",
        title="Anodised ramp",
        shows=("A titanium rod with an oxide film that grows from 0 nm on the left to 255 nm on the right."),
        look_for=(
            "Bare grey titanium on the left, then the sequence that every anodising shop knows: "
            "straw, bronze, purple, blue, pale blue, yellow, orange, pink, violet, blue, green. "
            "Around the rod the angle changes and the thickness does not: the bands bend towards "
            "thicker oxide at the silhouette, only a little, because the oxide's high index keeps "
            "the light steep inside.\n\n"
            "The texture has one texel a nanometre, so a place on the rod is a thickness: 1.6 nm a "
            "millimetre."
        ),
        sources=(
            "Base colour: reflectance of titanium from n and k of Johnson and Christy, Phys. Rev. B "
            "9, 5056 (1974), as linear Rec.709 under D65. Film index 2.16, a TiO2 film at 550 nm: "
            "Sarkar and others, ACS Appl. Mater. Interfaces 11, 13752 (2019)."
        ),
        files=builder.to_gltf(),
    )


def _rod() -> Shape:
    """Return a cylinder along X with flat ends; u follows the length from texel centre to texel centre."""
    half = LENGTH_M / 2.0
    first, last = 0.5 / 256.0, 255.5 / 256.0
    radius = [0.0, RADIUS_M, RADIUS_M, RADIUS_M, RADIUS_M, 0.0]
    height = [half, half, half, -half, -half, -half]
    slope = [(0.0, 1.0), (0.0, 1.0), (1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, -1.0)]
    upright = solid_of_revolution(radius, height, slope, [last] * 3 + [first] * 3, segments=96)
    turn = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # +Y to +X, a quarter turn about Z
    uvs = np.stack([upright.uvs[:, 1], upright.uvs[:, 0]], axis=-1)
    tangents = np.concatenate([upright.tangents[:, :3] @ turn.T, upright.tangents[:, 3:]], axis=-1)
    return Shape(upright.positions @ turn.T, upright.normals @ turn.T, uvs, upright.triangles, tangents)
