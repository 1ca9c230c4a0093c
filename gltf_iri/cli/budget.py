"""The option `--budget` of the verbs that compute colours, and the plans that it makes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.cli.common import note

if TYPE_CHECKING:
    from gltf_iri.baking.baked import BakedTable
    from gltf_iri.planning.costs import Device
    from gltf_iri.planning.material_plan import MaterialPlan
    from gltf_iri.planning.reach import Lobe
    from gltf_iri.scene.load import Model
    from gltf_iri.scene.model import Environment, Scene

__all__ = ["baked_tables", "budget_option", "check_choice", "plan_scene", "way_rows"]

_BOTH = "either chooses the method"
_WHY = {"reference": "rays take any method at its full length, and a --method names it"}

budget_option = click.option(
    "--budget",
    type=float,
    metavar="ΔE",
    help="Choose the cheapest way whose p95 of CIEDE2000 against the truth stays within ΔE; 0 is the truth.",
)


def check_choice(budget: float | None, **others: object) -> None:
    """Raise UsageError where a budget is no ΔE or stands beside one of `others`, options that choose too."""
    if budget is None:
        return
    from gltf_iri.budgets.search import check_budget
    from gltf_iri.errors import UsageError

    check_budget(budget)
    for name, given in others.items():
        if given:
            raise UsageError(f"--budget and --{name} do not go together: {_WHY.get(name, _BOTH)}.")


def plan_scene(
    model: Model,
    scene: Scene | None,
    method: str | None,
    budget: float | None,
    *,
    size: tuple[int, int],
    environment: Environment | None,
    white: str = "D65",
    device: Device = "glsl",
    with_unused: bool = False,
    advance: Callable[[], None] = lambda: None,
) -> tuple[MaterialPlan, ...]:
    """Return the plans of `model` for a picture of `size`, by `method` or within `budget`."""
    if budget is None:
        from gltf_iri.planning.decide import plan_materials

        return plan_materials(
            model.materials, method=method, document=model.document, scene=scene, with_unused=with_unused
        )
    from gltf_iri.budgets.plans import plans_within

    return plans_within(
        model,
        scene,
        budget,
        size_pixels=size[0] * size[1],
        has_image_light=environment is not None and bool(environment.radiance.any()),
        white=white,
        device=device,
        with_unused=with_unused,
        advance=advance,
    )


def baked_tables(
    plans: Sequence[MaterialPlan], white: str = "D65", advance: Callable[[], None] = lambda: None
) -> Mapping[int, Mapping[Lobe, BakedTable]]:
    """Return the filled tables of `plans`, from the cache where they lie there; what ails it is noted."""
    if not any(plan.way is not None and plan.way.tables for plan in plans):
        return {}
    from gltf_iri.baking.cache import TableCache
    from gltf_iri.baking.fill import bake_plans

    cache = TableCache()
    tables = bake_plans(plans, white, cache=cache, advance=advance)
    for text in cache.notes:
        note(text)
    return tables


def way_rows(plan: MaterialPlan) -> list[tuple[str, str]]:
    """Return what `plan` prints of a material's way: its cost and error, and each table."""
    way: Any = plan.way
    if way is None:
        return []
    rows = [("way", f"{way.label}: ΔE ≤ {way.delta_e:.2g}, {way.ns_per_colour:.3g} ns a colour")]
    for table in way.tables:
        axes = " × ".join(f"{axis.quantity} {axis.nodes}" for axis in table.axes)
        texel = table.to_json()["texel"]
        rows.append(("table", f"{table.lobe}: {axes}, {texel}, {table.bytes / 1024:.0f} KiB"))
    return rows
