"""The plans of a file's materials within a budget."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from gltf_iri.budgets.choose import Asked, choose_way
from gltf_iri.budgets.search import Chosen, check_budget
from gltf_iri.colour.spaces import White
from gltf_iri.material.material import Material
from gltf_iri.planning.costs import Device
from gltf_iri.planning.decide import complete_plans, plan_material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.material_reach import material_reach, vertex_colour_spans
from gltf_iri.planning.reach import Reach
from gltf_iri.planning.simplify import simplified

if TYPE_CHECKING:
    from gltf_iri.scene.load import Model
    from gltf_iri.scene.model import Scene

__all__ = ["plans_within"]


def plans_within(
    model: Model,
    scene: Scene | None,
    budget: float,
    *,
    size_pixels: int,
    has_image_light: bool,
    white: White = "D65",
    device: Device = "glsl",
    with_unused: bool = False,
    advance: Callable[[], None] = lambda: None,
) -> tuple[MaterialPlan, ...]:
    """Return the plan of each material of `model` with the cheapest way to its film that keeps `budget`.

    Materials of equal reach share one choice. At the end stands what `complete_plans` adds for `scene`.

    scene : its lights and its vertices' colours count, and materials that it does not use get no way unless
        `with_unused`; None where there is none.
    size_pixels : each pixel is wanted once for every light and for the image light.
    advance : called after each material.

    Raises UsageError for a budget below 0 or NaN, and where nothing keeps it for a material.
    """
    check_budget(budget)
    used = None if scene is None or with_unused else {each.material for each in scene.primitives}
    colours = {} if scene is None else vertex_colour_spans(scene)
    lights = (0 if scene is None else len(scene.lights)) + has_image_light
    chosen: dict[tuple[Reach, Asked], Chosen] = {}
    plans = []
    for index, material in enumerate(model.materials):
        if used is not None and index not in used:
            plans.append(plan_material(material, index))
            advance()
            continue
        drawn, folded = simplified(material, model.document)
        reach = material_reach(drawn, model.document, colours.get(index))
        plan = plan_material(drawn, index, reach=reach, folded=folded)
        if reach is not None and plan.calls_for(Effect.IRIDESCENCE):
            asked = Asked(
                budget,
                size_pixels * max(lights, 1),
                device,
                white,
                has_image_light,
                _bare_at_grazing(drawn),
                has_spread=device == "glsl" and plan.calls_for(Effect.IRIDESCENCE_THICKNESS_TEXTURE),
            )
            key = (reach, asked)
            if key not in chosen:
                chosen[key] = choose_way(reach, asked, f"material '{material.name or index}'")
            way, reason = chosen[key].way, chosen[key].reason
            plan = plan_material(drawn, index, reach=reach, way=way, way_reason=reason, folded=folded)
        plans.append(plan)
        advance()
    return tuple(plans) if scene is None else complete_plans(plans, scene)


def _bare_at_grazing(material: Material) -> float | None:
    """Return what the dielectric without its film reflects at grazing angles; None where that varies."""
    specular = material.specular
    if specular is None:
        return 1.0
    return specular.factor if specular.texture is None else None
