"""Squares of silica on silicon, each of one exact thickness."""

from __future__ import annotations

import numpy as np

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.png import encode_png
from gltf_iri.samples.sample import Sample
from gltf_iri.samples.shapes import merge, tile

__all__ = ["build"]

COLUMNS, ROWS = 8, 8
STEP_NM = 16  # from one swatch to the next
COUNTS_A_STEP = 4
THICKNESS_MAX_NM = 255.0 * STEP_NM / COUNTS_A_STEP  # so that a texel value is 4 nm, exactly
SILICA_IOR = 1.48

# Schinke and others 2015, n and k of silicon, reflectance at normal incidence as linear Rec.709 under D65.
SILICON_F0 = (0.344, 0.368, 0.425)


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("thickness-swatches")
    steps = np.arange(ROWS * COLUMNS, dtype=np.uint8).reshape(ROWS, COLUMNS)
    thickness = builder.texture("thickness", encode_png(steps * np.uint8(COUNTS_A_STEP)), nearest=True)
    material = builder.material(
        "silica on silicon",
        base_color=SILICON_F0,
        metallic=1.0,
        roughness=0.2,
        extensions={
            "KHR_materials_iridescence": {
                "iridescenceFactor": 1.0,
                "iridescenceIor": SILICA_IOR,
                "iridescenceThicknessMinimum": 0.0,
                "iridescenceThicknessMaximum": THICKNESS_MAX_NM,
                "iridescenceThicknessTexture": {"index": thickness},
            }
        },
    )
    swatches = [
        tile(
            (column - (COLUMNS - 1) / 2.0, (ROWS - 1) / 2.0 - row, 0.0),
            (0.92, 0.0, 0.0),
            (0.0, 0.92, 0.0),
            ((column + 0.5) / COLUMNS, (row + 0.5) / ROWS),
        )
        for row in range(ROWS)
        for column in range(COLUMNS)
    ]
    builder.mesh("swatches", merge(swatches), material)
    builder.orthographic_camera((0.0, 0.0, 5.0), (0.0, 0.0, 0.0), COLUMNS / 2.0 + 0.25, ROWS / 2.0 + 0.25)
    return Sample(
        name="thickness-swatches",
        title="Thickness swatches",
        shows=("Sixty-four squares of silica on silicon, 0 to 1008 nm in steps of 16 nm, all seen face on."),
        look_for=(
            "Read it like a page: 0 nm top left, 16 nm to its right, 128 nm at the start of the "
            "second row, 1008 nm bottom right. It is the colour chart by which oxide on a wafer is "
            "judged by eye: brown, violet, blue, pale, gold, red-violet, blue, green, and round again, "
            "paler each time. The first swatch has no film and must look like bare silicon.\n\n"
            "Each swatch has one texture coordinate, the centre of its own texel, and the texture is "
            "not filtered: 4 counts of 8 bits a swatch, 4 nm a count, so every thickness is exact. "
            "The camera's rays are parallel, so the angle is 0 everywhere; draw it with `--env "
            "white --tonemap none` to see the film's reflectance and nothing else."
        ),
        sources=(
            "Base colour: reflectance of silicon from n and k of Schinke and others, AIP Adv. 5, "
            "067168 (2015), as linear Rec.709 under D65. Film index 1.48, silica at 550 nm: Gao and "
            "others, J. Europ. Opt. Soc. Rap. Public. 8, 13010 (2013)."
        ),
        files=builder.to_gltf(),
    )
