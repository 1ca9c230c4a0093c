"""Patches tilted away from the viewer, each showing one angle."""

from __future__ import annotations

from math import cos, radians, sin

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.shapes import Shape, merge, tile

__all__ = ["build"]

ANGLES_DEG = (0, 10, 20, 30, 40, 50, 60, 70, 80)
THICKNESSES_NM = (200.0, 300.0, 400.0, 500.0)
FILM_IOR, BASE_IOR = 1.9, 1.5


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("angle-fan")
    for row, thickness_nm in enumerate(THICKNESSES_NM):
        material = builder.material(
            f"{thickness_nm:.0f} nm",
            base_color=(0.0, 0.0, 0.0),
            metallic=0.0,
            roughness=0.1,
            extensions={
                "KHR_materials_ior": {"ior": BASE_IOR},
                "KHR_materials_iridescence": {
                    "iridescenceFactor": 1.0,
                    "iridescenceIor": FILM_IOR,
                    "iridescenceThicknessMaximum": thickness_nm,
                },
            },
        )
        height = (len(THICKNESSES_NM) - 1) / 2.0 - row
        patches = [_patch(column, height, angle) for column, angle in enumerate(ANGLES_DEG)]
        builder.mesh(f"{thickness_nm:.0f} nm", merge(patches), material)
    half_width = len(ANGLES_DEG) / 2.0
    builder.orthographic_camera((0.0, 0.0, 12.0), (0.0, 0.0, 0.0), half_width + 0.25, half_width * 0.75)
    return Sample(
        name="angle-fan",
        title="Angle fan",
        shows=(
            "Nine columns of patches tilted by 0° to 80°, four rows of film thickness: colour against angle."
        ),
        look_for=(
            "From left to right the light meets the film at 0°, 10°, … 80°; from top to bottom the "
            "film is 200, 300, 400 and 500 nm thick. Along a row the colour runs towards that of a "
            "thinner film, because the path inside shortens, and pales at 80°, where every surface "
            "becomes a mirror.\n\n"
            "The patches are long in depth so that each looks equally wide, and the camera's rays "
            "are parallel, so one patch is one angle. Draw it with `--env white --tonemap none`: "
            "then a patch's colour is its reflectance and nothing else, since the base is black."
        ),
        sources=(
            "Film index 1.9 over 1.5, a black base: chosen for strong colours, no material in "
            "particular. No texture: the thickness is the material's own maximum."
        ),
        files=builder.to_glb(),
    )


def _patch(column: int, height: float, angle_deg: int) -> Shape:
    """Return the patch turned by `angle_deg` about the vertical, as wide to the eye as every other."""
    angle = radians(angle_deg)
    seen_width = 0.92
    across = (seen_width, 0.0, -seen_width * sin(angle) / cos(angle))
    return tile((column - (len(ANGLES_DEG) - 1) / 2.0, height, 0.0), across, (0.0, 0.92, 0.0), (0.0, 0.0))
