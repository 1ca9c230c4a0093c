"""`gltf-iri plan`: what each material calls for, what is left out, and why."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.cli.common import file_argument, json_option, material_label, note, print_json, print_table

if TYPE_CHECKING:
    from gltf_iri.planning.material_plan import MaterialPlan
    from gltf_iri.scene.model import Scene

__all__ = ["command"]


@click.command(name="plan")
@file_argument
@click.option("--method", metavar="NAME", help="Film method to plan for; left out, the plan chooses.")
@json_option
def command(file: Path, method: str | None, as_json: bool) -> None:
    """Say which effects each material of FILE calls for, which it does not, and why.

    Materials are planned from the JSON alone. The shader permutations depend on the geometry too (under
    image light, as `render` draws unless told otherwise) and are listed where the buffers are there.
    """
    from gltf_iri.errors import AssetError
    from gltf_iri.planning.decide import complete_plans, plan_materials
    from gltf_iri.scene.load import load

    model = load(file)
    plans = plan_materials(model.materials, method=method)
    notes = list(model.notes)
    permutations: list[dict[str, Any]] = []
    try:
        scene = model.scene()
    except AssetError as error:
        notes.append(f"The shader permutations are left out: {error}")
    else:
        notes += scene.notes
        plans = complete_plans(plans, scene)
        permutations = _permutations(scene, {plan.index: plan for plan in plans})

    if as_json:
        rows = [plan.to_json() for plan in plans]
        print_json({"file": file, "materials": rows, "permutations": permutations, "notes": notes})
        return
    print_table(("material", "", ""), [row for plan in plans for row in _rows(plan)])
    for text in notes:
        note(text)


def _permutations(scene: Scene, plans: dict[int, MaterialPlan]) -> list[dict[str, Any]]:
    """Return one row for each shader that the scene needs: its defines and the materials drawn with it."""
    from gltf_iri.planning.permutation import permutation, plan_scene_effects, primitive_effects
    from gltf_iri.scene.environment import white

    lights = plan_scene_effects(scene, white())
    users: dict[tuple[str, ...], dict[int, None]] = {}
    for primitive in scene.primitives:
        defines = permutation(plans[primitive.material], primitive_effects(primitive), lights)
        users.setdefault(defines, {})[primitive.material] = None
    return [{"defines": defines, "materials": sorted(used)} for defines, used in users.items()]


def _rows(plan: MaterialPlan) -> Iterator[Sequence[str]]:
    label = material_label(plan.index, plan.name)
    yield label, "calls for", ", ".join(effect.value for effect in plan.effects) or "nothing"
    if plan.method is not None:
        yield "", "method", f"{plan.method} ({plan.method_reason})"
    for effect, reason in plan.skipped.items():
        if effect not in plan.absent:
            yield "", "left out", f"{effect.value}: {reason}"
    for name, reason in plan.not_drawn.items():
        yield "", "not drawn", f"{name}: {reason}"
