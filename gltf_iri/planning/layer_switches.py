"""What the shader of a material with Bragg layers is told at compile time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.planning.material_plan import MaterialPlan

__all__ = ["LAYER_SWITCHES", "is_whole", "layer_defines", "quads"]

# Colours of the layers come out of tables, in place of layers-single; and there as colours, not as bands.
_TABLES: Final = "BRAGG_TABLES"
_COLOURS: Final = "BRAGG_COLOURS"
# More than one layer: light passes those above on its way.
_MANY: Final = "BRAGG_MANY"
# Something lies below the layers that sends light back; their host is not air.
_BASE: Final = "BRAGG_BASE"
_COATING: Final = "BRAGG_COATING"
# The roughness of the metal below varies.
_METAL_ROUGHNESS: Final = "BRAGG_METAL_ROUGHNESS"
# Nothing of the plain material is seen beside the layers.
_WHOLE: Final = "BRAGG_WHOLE"

LAYER_SWITCHES: Final = frozenset({_TABLES, _COLOURS, _MANY, _BASE, _COATING, _METAL_ROUGHNESS, _WHOLE})

_BANDS_A_TEXEL: Final = 4


def quads(layers: LayersPlan) -> int:
    """Return how many texels hold the bands of one factor of one layer; 0 without tables."""
    return 0 if layers.tables is None else -(-layers.tables.bands // _BANDS_A_TEXEL)


def is_whole(plan: MaterialPlan) -> bool:
    """True where the layers stand in place of the plain base everywhere."""
    if plan.material is None or plan.material.bragg is None or plan.calls_for(Effect.BRAGG_TEXTURE):
        return False
    return plan.material.bragg.factor == 1.0


def layer_defines(plan: MaterialPlan) -> Iterator[str]:
    """Yield the defines of the layers of `plan`; BRAGG_LAYERS and BRAGG_QUADS have values."""
    layers = plan.layers
    if layers is None:
        return
    yield f"BRAGG_LAYERS {len(layers.layers)}"
    if layers.tables is not None:
        yield _TABLES
        yield f"BRAGG_QUADS {quads(layers)}"
        if layers.metal_nodes > 1:
            yield _METAL_ROUGHNESS
        if layers.tables.is_colour:
            yield _COLOURS
    if len(layers.layers) > 1:
        yield _MANY
    if layers.under == "base":
        yield _BASE
    if layers.host_ior != 1.0:
        yield _COATING
    if is_whole(plan):
        yield _WHOLE
