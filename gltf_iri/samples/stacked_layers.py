"""Two Bragg layers, each alone and one on the other, over black, grey and blue."""

from __future__ import annotations

from typing import Any, Final

from gltf_iri.samples.ball_grid import add_ball_grid
from gltf_iri.samples.bragg_layer import BLACK, bragg_layer, bragg_stack, tinted_surface
from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.sample import Sample

__all__ = ["ALPHA", "BASES", "FILMS_NM", "build"]

ALPHA: Final = 0.1
IOR_2, CELLS = 1.5, 20
FILMS_NM: Final = {"A": (125.0, 375.0), "B": (101.0, 143.0)}
LAYERS: Final[dict[str, dict[str, Any]]] = {
    name: bragg_layer(*films_nm, IOR_2, CELLS, ALPHA) for name, films_nm in FILMS_NM.items()
}
STACKS: Final = {"A": "A", "B": "B", "A over B": "AB", "B over A": "BA"}  # outermost first
BASES: Final = {"black": BLACK, "grey": (0.5, 0.5, 0.5), "blue": (0.1, 0.2, 0.6)}

# What the layers reflect towards normal incidence, linear Rec.709 under D65, cut off at 0 and at 0.9.
FALLBACK_F0: Final = {
    "A": (0.16, 0.0, 0.813),
    "B": (0.9, 0.273, 0.0),
    "A over B": (0.9, 0.259, 0.762),
    "B over A": (0.9, 0.258, 0.741),
}


def build() -> Sample:
    """Build the asset."""
    builder = GLTFBuilder("stacked-layers")
    rows = []
    for base, colour in BASES.items():
        row = []
        for stack, layers in STACKS.items():
            name = f"{stack}, on {base}"
            material = builder.material(
                name,
                base_color=colour,
                metallic=0.0,
                roughness=LAYERS["A"]["roughness"],
                extensions={
                    **tinted_surface(FALLBACK_F0[stack]),
                    "EXT_materials_bragg": bragg_stack(*(LAYERS[layer] for layer in layers)),
                },
            )
            row.append((name, material))
        rows.append(row)
    add_ball_grid(builder, rows)
    return Sample(
        name="stacked-layers",
        title="Stacked layers",
        shows=("Two layers, each alone and one over the other, on black, grey and blue: order is visible."),
        look_for=(
            "Columns from the left: A alone, B alone, A over B, B over A. A is violet face on and "
            "runs through magenta and yellow to green towards the silhouette; B is orange face on, "
            "then yellow and pale green, and blue at the edge.\n\n"
            "What a layer does not mirror it lets pass, and only that reaches the layer below: both "
            "stacks hold the same two layers, and each lacks what the upper one has taken. Towards "
            "the middle of the balls the two mirror different parts of the spectrum and simply add up "
            "to pink; halfway out they meet in the red, and there the order shows.\n\n"
            "Rows from the top: a black base, so that all light comes from layers; a grey one, which "
            "shines through in the complement of what was mirrored; and a blue one, of which B's "
            "complement leaves much and A's hardly anything."
        ),
        sources=(
            "The layers of Fig. 1 of Fourneau, Pacanowski and Barla, Computer Graphics Forum 43 "
            "(2024), doi 10.1111/cgf.15017: n2 = 1.5, d1 = 125 nm and d2 = 375 nm (A), d1 = 101 nm "
            "and d2 = 143 nm (B), n1 = 1, 20 cells, α = 0.1, which is a roughness of 0.316. The paper "
            "does not state the colours of its Lambertian bases; these are ours."
        ),
        fallback=(
            "Balls with a rough coloured sheen, violet, orange, pink and pink, that do not change "
            "colour with the angle: KHR_materials_specular holds what the layers "
            "reflect face on. A renderer without it shows plain black, grey and blue balls."
        ),
        files=builder.to_glb(),
    )
