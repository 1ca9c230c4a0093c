"""The option `--budget` of the verbs that compute colours, and the plans that it makes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.cli.common import material_label, note, print_table, progress

if TYPE_CHECKING:
    from gltf_iri.baking.baked import BakedTable
    from gltf_iri.budgets.search import UnkeptBudgetError
    from gltf_iri.planning.costs import Device
    from gltf_iri.planning.material_plan import MaterialPlan
    from gltf_iri.planning.reach import Lobe
    from gltf_iri.scene.load import Model
    from gltf_iri.scene.model import Environment, Scene

__all__ = ["baked_tables", "budget_option", "check_choice", "nanoseconds", "plan_scene", "print_ways"]
__all__ += ["way_rows", "ways_json"]

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
    unkept: dict[int, UnkeptBudgetError] | None = None,
) -> tuple[MaterialPlan, ...]:
    """Return the plans of `model` for a picture of `size`, by `method` or within `budget`, with progress.

    unkept : as in `plans_within`.
    """
    if budget is None:
        from gltf_iri.planning.decide import plan_materials

        return plan_materials(
            model.materials, method=method, document=model.document, scene=scene, with_unused=with_unused
        )
    from gltf_iri.budgets.plans import plans_within

    with progress("Planning", len(model.materials)) as advance:
        return plans_within(
            model,
            scene,
            budget,
            size_pixels=size[0] * size[1],
            has_image_light=environment is not None and bool(environment.radiance.any()),
            white=white,
            device=device,
            with_unused=with_unused,
            unkept=unkept,
            advance=advance,
        )


def baked_tables(
    plans: Sequence[MaterialPlan], white: str = "D65"
) -> Mapping[int, Mapping[Lobe, BakedTable]]:
    """Return the filled tables of `plans`, from the cache where they lie there; what ails it is noted."""
    count = sum(len(plan.way.tables) for plan in plans if plan.way is not None)
    if not count:
        return {}
    from gltf_iri.baking.cache import TableCache
    from gltf_iri.baking.fill import bake_plans

    cache = TableCache()
    with progress("Filling tables", count) as advance:
        tables = bake_plans(plans, white, cache=cache, advance=advance)
    for text in cache.notes:
        note(text)
    return tables


def way_rows(
    plan: MaterialPlan, tables: Mapping[Lobe, BakedTable] | None = None
) -> Iterator[tuple[str, str]]:
    """Yield what is printed of a material's way: its cost and error, and each table.

    tables : those filled for it, which tell whether they lay in the cache.
    """
    from gltf_iri.budgets.search import figure

    way: Any = plan.way
    if way is None:
        return
    yield "way", f"{way.label}: ΔE ≤ {figure(way.delta_e)}, {nanoseconds(way.ns_per_colour)} a colour"
    for table in way.tables:
        axes = " × ".join(f"{axis.quantity} {axis.nodes}" for axis in table.axes)
        size = f"{table.bytes} bytes" if table.bytes < 1024 else f"{table.bytes / 1024:.0f} KiB"
        whence = ""
        if tables is not None:
            baked = tables[table.lobe]
            whence = (
                ", from the cache" if baked.is_cached else f", filled in {1e3 * baked.filled_in_s:.3g} ms"
            )
        yield "table", f"{table.lobe}: {axes}, {table.to_json()['texel']}, {size}{whence}"


def print_ways(plans: Sequence[MaterialPlan], tables: Mapping[int, Mapping[Lobe, BakedTable]]) -> None:
    """Print how each film of `plans` was computed, and why so, where a budget chose it."""
    rows = [
        (label if row == 0 else "", what, told)
        for plan in plans
        if plan.way is not None
        for label in [material_label(plan.index, plan.name)]
        for row, (what, told) in enumerate(
            [*way_rows(plan, tables.get(plan.index, {})), ("why", plan.method_reason)]
        )
    ]
    if rows:
        print_table(("material", "", ""), rows)


def ways_json(
    plans: Sequence[MaterialPlan], tables: Mapping[int, Mapping[Lobe, BakedTable]]
) -> list[dict[str, Any]]:
    """Return what `print_ways` prints; each table tells its filling, now or when it came into the cache."""
    return [
        {
            "material": plan.index,
            "name": plan.name,
            **plan.way.to_json(),
            "reason": plan.method_reason,
            "tables": [
                table.to_json() | {"is_cached": baked.is_cached, "filled_in_s": baked.filled_in_s}
                for table in plan.way.tables
                for baked in [tables[plan.index][table.lobe]]
            ],
        }
        for plan in plans
        if plan.way is not None
    ]


def nanoseconds(ns: float) -> str:
    """Return a price in words."""
    return f"{ns:.3g} ns" if ns < 1000.0 else f"{ns:,.0f} ns"
