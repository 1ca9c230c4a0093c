"""One layer of more and more cells, in air and under a coating."""

from __future__ import annotations

from typing import Final

from gltf_iri.samples.ball_grid import add_ball_grid
from gltf_iri.samples.bragg_layer import bragg_layer, bragg_stack, tinted_surface
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.sample import Sample

__all__ = ["CELLS", "HOSTS", "build"]

CELLS: Final = (1, 2, 5, 10, 20, 50, 200)
PERIOD_NM, FILL, IOR_2, ALPHA = 180.0, 0.3, 1.5, 0.1
HOSTS: Final = {"in air": 1.0, "coated": 1.4}
GREY: Final = (0.2, 0.2, 0.2)

# What layer and coating reflect face on, linear Rec.709 under D65, cut off at 0.
FALLBACK_F0: Final = {
    "in air": (
        (0.143, 0.104, 0.034),
        (0.292, 0.315, 0.128),
        (0.0, 0.706, 0.47),
        (0.0, 0.72, 0.637),
        (0.0, 0.723, 0.651),
        (0.0, 0.722, 0.651),
        (0.0, 0.722, 0.651),
    ),
    "coated": (
        (0.032, 0.031, 0.029),
        (0.041, 0.04, 0.03),
        (0.037, 0.091, 0.028),
        (0.0, 0.181, 0.02),
        (0.0, 0.298, 0.011),
        (0.0, 0.376, 0.004),
        (0.0, 0.379, 0.004),
    ),
}


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("bragg-cells")
    rows = []
    for where, host_ior in HOSTS.items():
        row = []
        for cells, f0 in zip(CELLS, FALLBACK_F0[where], strict=True):
            layer = bragg_layer(FILL * PERIOD_NM, (1.0 - FILL) * PERIOD_NM, IOR_2, cells, ALPHA)
            bragg = bragg_stack(layer, host_ior=host_ior)
            name = f"{cells} {'cell' if cells == 1 else 'cells'}, {where}"
            material = builder.material(
                name,
                base_color=GREY,
                metallic=0.0,
                roughness=layer["roughness"],
                extensions={**tinted_surface(f0), "EXT_materials_bragg": bragg},
            )
            row.append((name, material))
        rows.append(row)
    add_ball_grid(builder, rows)
    return Sample(
        name="bragg-cells",
        title="Number of cells",
        shows=("One layer of 1, 2, 5, 10, 20, 50 and 200 cells: in air (top) and under a coating (bottom)."),
        look_for=(
            "In air five cells already mirror all they ever will, blue-green face on and violet "
            "towards the side; one cell is a thin film and hardly has a colour. From 10 cells on the "
            "balls can hardly be told apart.\n\n"
            "Under the coating the films differ less from what they lie in. One and two cells are "
            "next to nothing, the green builds up slowly, and 200 cells still differ from 50 a "
            "little. The sharp reflection on these balls is the coating's own smooth surface; the "
            "layer's facets are rough.\n\n"
            "The grey of the base is tinted with what each layer leaves of the light that passes it "
            "twice."
        ),
        sources=(
            "After Fig. 10 of Fourneau, Pacanowski and Barla, Computer Graphics Forum 43 (2024), doi "
            "10.1111/cgf.15017: α = 0.1, a diffuse base of 0.2, d1 = 0.3 and d2 = 0.7 of the period. "
            "The paper's caption does not state periods, indices and numbers of cells: 180 nm, n2 = "
            "1.5, n1 = 1 in air and n1 = 1.4 in a coating of the same index are ours."
        ),
        fallback=(
            "Grey balls with a rough sheen that is yellowish to blue-green in the top row and grows "
            "from next to nothing to green in the bottom row, the same at every angle: "
            "KHR_materials_specular holds what layer and coating reflect face "
            "on."
        ),
        files=builder.to_glb(),
    )
