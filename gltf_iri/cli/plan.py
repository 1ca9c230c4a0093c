"""`gltf-iri plan`: what each material calls for, what is left out, why, and what that saves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.cli.budget import budget_option, check_choice, plan_scene, way_rows
from gltf_iri.cli.common import (
    file_argument,
    json_option,
    material_label,
    note,
    print_json,
    print_table,
)
from gltf_iri.cli.layers import layer_rows
from gltf_iri.cli.picture_options import SIZE

if TYPE_CHECKING:
    from gltf_iri.budgets.search import UnkeptBudgetError
    from gltf_iri.planning.material_plan import MaterialPlan
    from gltf_iri.scene.model import Scene

__all__ = ["command"]

_LISTED_MAX = 8  # materials that the error names


@click.command(name="plan")
@file_argument
@click.option(
    "--method", metavar="NAME", help="Method to plan films or layers for; left out, the plan chooses."
)
@budget_option
@click.option(
    "--size", type=SIZE, default="640x480", show_default=True, help="Size of the picture a budget is for."
)
@json_option
def command(
    file: Path, method: str | None, budget: float | None, size: tuple[int, int], as_json: bool
) -> None:
    """Say which effects each material of FILE calls for, which it does not, and why.

    Materials are planned from the JSON and the textures, which may hold the same everywhere. The shader
    permutations depend on the geometry too (under image light, as `render` draws unless told otherwise) and
    are listed where the buffers are there. What is saved is told in nanoseconds a pixel that the material
    covers, as `bench accuracy` measured them.

    A material for which nothing keeps the budget is told, with the best that is known, and planned as without
    one; the exit code is then 2.
    """
    from gltf_iri.errors import AssetError, UsageError
    from gltf_iri.planning.texels import unread_images
    from gltf_iri.scene.environment import white
    from gltf_iri.scene.load import load

    check_choice(budget, method=method)
    model = load(file)
    notes = list(model.notes)
    scene: Scene | None = None
    try:
        scene = model.scene()
    except AssetError as error:
        notes.append(f"The shader permutations are left out: {error}")
        notes.append("Colours of vertices may be any, for all the plan knows.")
    unkept: dict[int, UnkeptBudgetError] = {}
    plans = plan_scene(
        model, scene, method, budget, size=size, environment=white(), with_unused=True, unkept=unkept
    )
    unread = [
        f"{told} It may hold anything, for all the plan knows." for told in unread_images(model.document)
    ]
    notes += [*model.document.notes, *(() if scene is None else scene.notes), *unread]
    saved = _saved(plans, scene, method)
    if as_json:
        rows = [
            {
                **plan.to_json(),
                "budget_unkept": _unkept_json(unkept.get(plan.index)),
                "saved_ns_per_pixel": saved[plan.index],
            }
            for plan in plans
        ]
        permutations = [] if scene is None else _permutations(scene, {plan.index: plan for plan in plans})
        print_json(
            {
                "file": file,
                "materials": rows,
                "permutations": permutations,
                "notes": list(dict.fromkeys(notes)),
            }
        )
    else:
        print_table(
            ("material", "", ""),
            [row for plan in plans for row in _rows(plan, saved[plan.index], unkept.get(plan.index))],
        )
        for text in dict.fromkeys(notes):
            note(text)
    if len(unkept) == 1:
        raise next(iter(unkept.values()))
    if unkept:
        labels = ", ".join(material_label(index, plans[index].name) for index in list(unkept)[:_LISTED_MAX])
        more = f" and {len(unkept) - _LISTED_MAX} more" if len(unkept) > _LISTED_MAX else ""
        raise UsageError(
            f"Nothing keeps ΔE {budget:g} for {len(unkept)} of {len(plans)} materials, {labels}{more}:"
            " the plan tells what comes nearest."
        )


def _saved(
    plans: Sequence[MaterialPlan], scene: Scene | None, method: str | None
) -> Mapping[int, Mapping[str, float]]:
    """Return what each plan saves, by the material's index, under the scene's lights and image light."""
    from gltf_iri.planning.costs import shipped_costs
    from gltf_iri.planning.permutation import shines
    from gltf_iri.planning.savings import saved_ns_per_pixel

    lamps = 0 if scene is None else sum(shines(light) for light in scene.lights)
    costs = shipped_costs()
    return {plan.index: saved_ns_per_pixel(plan, lamps + 1, costs, method=method) for plan in plans}


def _permutations(scene: Scene, plans: Mapping[int, MaterialPlan]) -> list[dict[str, Any]]:
    """Return one row for each shader that the scene needs: its defines and the materials drawn with it."""
    from gltf_iri.planning.permutation import permutation, plan_scene_effects, primitive_effects
    from gltf_iri.planning.savings import pruned_defines
    from gltf_iri.scene.environment import white

    lights = plan_scene_effects(scene, white())
    users: dict[tuple[str, ...], dict[int, None]] = {}
    for primitive in scene.primitives:
        defines = permutation(plans[primitive.material], primitive_effects(primitive), lights)
        users.setdefault(defines, {})[primitive.material] = None
    return [
        {
            "defines": defines,
            "pruned_defines": pruned_defines([plans[index] for index in used], defines),
            "materials": sorted(used),
        }
        for defines, used in users.items()
    ]


def _unkept_json(error: UnkeptBudgetError | None) -> Mapping[str, Any] | None:
    return None if error is None else {"reason": f"{error.what}: {error.why}", "delta_e": error.delta_e}


def _rows(
    plan: MaterialPlan, saved: Mapping[str, float], unkept: UnkeptBudgetError | None
) -> Iterator[Sequence[str]]:
    label = material_label(plan.index, plan.name)
    yield label, "calls for", ", ".join(effect.value for effect in plan.effects) or "nothing"
    if unkept is not None:
        yield "", "budget", f"{unkept.what}: {unkept.why} Planned without it."
    if plan.method is not None:
        yield "", "method", f"{plan.method} ({plan.method_reason})"
        for what, told in way_rows(plan):
            yield "", what, told
    if plan.layers is not None:
        for what, told in layer_rows(plan.layers):
            yield "", what, told
    for effect, reason in plan.skipped.items():
        if effect not in plan.absent:
            yield "", "left out", f"{effect.value}: {reason}{_saving(saved, effect.value)}"
    for lobe in sorted(plan.grey):
        told = f"the {lobe}'s base reflects red, green and blue alike{_saving(saved, f'grey-{lobe}')}"
        yield "", "one channel", told
    for name, reason in plan.not_drawn.items():
        yield "", "not drawn", f"{name}: {reason}"


def _saving(saved: Mapping[str, float], what: str) -> str:
    ns = saved.get(what)
    return "" if ns is None else f" (saves {ns:.3g} ns a pixel)"
