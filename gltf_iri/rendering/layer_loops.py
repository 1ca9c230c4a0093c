"""How far shaders that compute layers directly loop, which one renderer does not bear."""

from __future__ import annotations

from typing import Final

from gltf_iri.colour.quadrature import SPECTRAL_DEGREE
from gltf_iri.errors import MissingCapabilityError
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.rendering.constants import FILTER_POINTS
from gltf_iri.rendering.optics_tables import SPECTRAL_COARSE_DEGREE

__all__ = ["check_loops", "loop_turns"]

# llvmpipe ends all loops of a shader after 65535 turns, without a word: colours then lack a part. A tenth is
# for the lamps of an environment and for what is counted too low.
_TURNS_MAX: Final = 60000
_RENDERER: Final = "llvmpipe"

_QUADS: Final = SPECTRAL_COARSE_DEGREE // 4 + 1
_PANELS: Final = 3


def loop_turns(plan: MaterialPlan, lights: int, *, has_image_light: bool) -> int:
    """Return about how many turns the loops of a pixel of `plan` take; 0 where layers come out of tables."""
    layers = plan.layers
    if layers is None or layers.tables is not None:
        return 0
    # The first layer is summed over all wavelengths, and both polarisations double the cell once a bit of N.
    first = (SPECTRAL_DEGREE + 1) * (1 + 2 * layers.layers[0].cells.bit_length())
    factor = (_PANELS * FILTER_POINTS + 3) * _QUADS
    count = len(layers.layers)
    behind = sum(2 * above * factor + 7 * _QUADS for above in range(1, count))
    passed = 2 * count * factor + 4 * _QUADS if layers.under == "base" else 0
    turns = (lights + has_image_light) * (first + behind + passed)
    if has_image_light and plan.calls_for(Effect.METAL):
        turns += passed
    if plan.calls_for(Effect.TRANSMISSION):
        # What comes from behind, and of a thin wall any of the lights may.
        turns += passed // 2 * (1 if plan.calls_for(Effect.VOLUME) else 1 + lights)
    return turns


def check_loops(plan: MaterialPlan, renderer: str, lights: int, *, has_image_light: bool) -> None:
    """Raise MissingCapabilityError where `renderer`, OpenGL's own name, would end the loops too early."""
    turns = loop_turns(plan, lights, has_image_light=has_image_light)
    if _RENDERER in renderer and turns > _TURNS_MAX and plan.layers is not None:
        raise MissingCapabilityError(
            f"Computed directly the layers of material {plan.index} take {turns} turns of loops a pixel, and "
            f"{_RENDERER} ends them after {_TURNS_MAX}: draw them from tables, by '--method layers-bands' or "
            "'--method layers-single-table', or by rays."
        )
