"""What the verbs that draw do and tell about layers of Bragg mirrors."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from gltf_iri.cli.common import material_label, note, print_table, progress

if TYPE_CHECKING:
    from gltf_iri.baking.baked_layers import BakedLayers
    from gltf_iri.colour.spaces import White
    from gltf_iri.planning.layer_plan import LayersPlan
    from gltf_iri.planning.material_plan import MaterialPlan

__all__ = ["baked_layers", "layer_rows", "layers_json", "print_layers"]


def baked_layers(plans: Sequence[MaterialPlan], white: White = "D65") -> Mapping[int, BakedLayers]:
    """Return the filled tables of the layers of `plans`, out of the cache where they lie there."""
    count = sum(plan.layers is not None and plan.layers.tables is not None for plan in plans)
    if not count:
        return {}
    from gltf_iri.baking.cache import TableCache
    from gltf_iri.baking.layer_fill import bake_layer_plans

    cache = TableCache()
    with progress("Filling layers' tables", count) as advance:
        tables = bake_layer_plans(plans, white, cache=cache, advance=advance)
    for text in cache.notes:
        note(text)
    return tables


def layer_rows(layers: LayersPlan, baked: BakedLayers | None = None) -> list[tuple[str, str]]:
    """Return what is printed of a material's layers: how many, by which method and why, and out of what."""
    count = len(layers.layers)
    rows = [("layers", f"{count} in a host of index {layers.host_ior:g}, by {layers.method}")]
    tables = layers.tables
    if tables is not None:
        held = "colours" if tables.is_colour else f"{tables.bands} bands"
        whence = ""
        if baked is not None:
            filled = f", filled in {1e3 * baked.filled_in_s:.3g} ms"
            whence = ", from the cache" if baked.is_cached else filled
        size = f"{tables.bytes(layers) / 1024:.0f} KiB"
        rows.append(
            ("tables", f"{held}, {tables.cos_nodes} cosines × {tables.period_nodes} periods, {size}{whence}")
        )
    rows.append(("why", layers.reason))
    return [*rows, *(("simpler", told) for told in layers.simpler)]


def print_layers(plans: Sequence[MaterialPlan], tables: Mapping[int, BakedLayers]) -> None:
    """Print how the layers of `plans` were drawn."""
    rows = [
        (material_label(plan.index, plan.name) if row == 0 else "", what, told)
        for plan in plans
        if plan.layers is not None
        for row, (what, told) in enumerate(layer_rows(plan.layers, tables.get(plan.index)))
    ]
    if rows:
        print_table(("material", "", ""), rows)


def layers_json(plans: Sequence[MaterialPlan], tables: Mapping[int, BakedLayers]) -> list[dict[str, Any]]:
    """Return what `print_layers` prints; tables tell their filling, now or when it came into the cache."""
    told = []
    for plan in plans:
        if plan.layers is not None:
            row = {"material": plan.index, "name": plan.name, **plan.layers.to_json()}
            baked = tables.get(plan.index)
            if baked is not None:
                row["tables"] |= {"is_cached": baked.is_cached, "filled_in_s": baked.filled_in_s}
            told.append(row)
    return told
