"""The cheapest way to the colours of Bragg layers whose measured error keeps a budget.

Surfaces are drawn out of tables: of colours, or of so many bands; the fewer a look-up reads, the cheaper it
is. Stacks alone are computed by the methods themselves. What is stated is a number that the p95 of CIEDE2000
against `layers-single` lies below, over poses whose cosines are uniform (`gltf_iri.colour.quantile`).
"""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from typing import Final

from gltf_iri.baking.layer_resolution import fit_layer_tables
from gltf_iri.budgets.search import UnkeptBudgetError, check_budget, figure
from gltf_iri.colour.spaces import WHITES, Light
from gltf_iri.errors import UsageError
from gltf_iri.planning.costs import Device, shipped_costs
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables
from gltf_iri.planning.method import truth_of
from gltf_iri.tolerances import GLSL_FILM_DELTA_E

__all__ = ["AskedOfLayers", "choose_layers", "layer_table_ns", "look_ups"]

# What the map of costs calls them.
_WORKLOAD: Final = "layers"
_OF_COLOURS: Final = "table of colours"
_OF_BANDS: Final = re.compile(r"table of (\d+) bands")


@dataclass(frozen=True, slots=True)
class AskedOfLayers:
    """What the layers of one material are wanted for: the budget, on what, under which white.

    is_crossed : their base lets light through, which crosses all layers once: that colour is judged too.
    """

    budget: float
    device: Device = "glsl"
    white: str | Light = "D65"
    is_crossed: bool = False


def choose_layers(plan: LayersPlan, asked: AskedOfLayers, subject: str) -> LayersPlan:
    """Return `plan` with the cheapest tables that keep the budget, the truth's method for a budget of 0.

    subject : stands in the error. Raises UsageError for a budget below 0 or NaN, and UnkeptBudgetError where
    no tables keep it.
    """
    budget = check_budget(asked.budget)
    if budget == 0.0:
        ns = shipped_costs().ns_per_colour(asked.device, _WORKLOAD, truth_of("layers"))
        return replace(
            plan,
            method=truth_of("layers"),
            parameters={},
            tables=None,
            delta_e=0.0,
            ns_per_colour=ns or 0.0,
            reason="the truth itself, as a budget of 0 asks",
        )
    floor = GLSL_FILM_DELTA_E if asked.device == "glsl" else 0.0
    if isinstance(asked.white, Light) or asked.white not in WHITES:
        raise UsageError(
            f"Tables of layers are filled under {' or '.join(WHITES)}; ask for 0, the truth itself."
        )
    # What no tables keep is asked for all the same, so that the error names the best.
    aim = max(budget - floor, 0.5 * budget)
    try:
        fit = fit_layer_tables(plan, aim, white=asked.white, is_crossed=asked.is_crossed)
    except UsageError as error:  # their fringes are too fine to be judged
        raise UnkeptBudgetError(f"No ΔE {budget:g} can be promised", subject, f"{error}") from None
    if fit.tables is None or fit.tables.delta_e + floor > budget:
        raise UnkeptBudgetError(
            f"No tables of layers keep ΔE {budget:g}",
            subject,
            f"the best err by about {figure(fit.best)}. Ask for more, or for 0, the truth itself.",
            fit.best,
        )
    tables = fit.tables
    ns, delta_e = layer_table_ns(plan, tables, asked.device), tables.delta_e + floor
    size = tables.bytes(plan) / 1024.0
    what = "colours" if tables.is_colour else f"{tables.bands} bands"
    return replace(
        plan,
        method="layers-rgb" if tables.is_colour else "layers-bands",
        parameters={"reflectance": "yeh-spectral"} if tables.is_colour else {"bands": tables.bands},
        tables=tables,
        delta_e=delta_e,
        ns_per_colour=ns,
        reason=f"{what} are the fewest that keep ΔE {budget:g}: ΔE ≤ {figure(delta_e)} for"
        f" {look_ups(plan, tables)} look-ups, {figure(ns)} ns a colour, in {size:.3g} KiB",
    )


def look_ups(plan: LayersPlan, tables: LayerTables) -> int:
    """Return how many texels one light's colour takes: a colour, then four bands of each factor at a time."""
    quads, count = -(-tables.bands // 4), len(plan.layers)
    crossed = count if plan.under == "base" else count - 1
    # The first layer's reflection is a colour; the others' are bands, as what each passes either way.
    return 1 + quads * (count - 1) + 2 * quads * crossed


def layer_table_ns(plan: LayersPlan, tables: LayerTables, device: Device) -> float:
    """Return what one light's colour costs out of `tables`: its look-ups, each at what the map's cost.

    The map has tables of colours and of some numbers of bands; the nearest one's look-ups stand for these.
    """
    known = shipped_costs().ns.get(device, {}).get(_WORKLOAD) or shipped_costs().ns["numpy"][_WORKLOAD]
    held = {3: known[_OF_COLOURS]}
    if not tables.is_colour:
        found = {label: _OF_BANDS.fullmatch(label) for label in known}
        held = {int(match[1]): known[label] for label, match in found.items() if match}
    nearest = min(held, key=lambda bands: abs(bands - tables.bands))
    # Two layers over a base, whose three terms the map counts as colours.
    quads = -(-nearest // 4)
    return 3.0 * held[nearest] / (1 + quads + 4 * quads) * look_ups(plan, tables)
