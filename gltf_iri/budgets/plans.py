"""The plans of a file's materials within a budget."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from gltf_iri.budgets.choose import Asked, choose_way
from gltf_iri.budgets.layers import AskedOfLayers, choose_layers
from gltf_iri.budgets.search import Chosen, check_budget
from gltf_iri.colour.spaces import Light
from gltf_iri.material.material import Material
from gltf_iri.planning.bragg import period_texel
from gltf_iri.planning.costs import Device
from gltf_iri.planning.decide import complete_plans, plan_material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.material_reach import ColourSpans, material_reach, vertex_colour_spans
from gltf_iri.planning.permutation import shines
from gltf_iri.planning.reach import Reach
from gltf_iri.planning.simplify import simplified

if TYPE_CHECKING:
    from gltf_iri.asset.document import Document
    from gltf_iri.scene.load import Model
    from gltf_iri.scene.model import Scene

__all__ = ["plan_within", "plans_within"]


def plans_within(
    model: Model,
    scene: Scene | None,
    budget: float,
    *,
    size_pixels: int,
    has_image_light: bool,
    white: str | Light = "D65",
    device: Device = "glsl",
    with_unused: bool = False,
    advance: Callable[[], None] = lambda: None,
) -> tuple[MaterialPlan, ...]:
    """Return the plan of each material of `model` with the cheapest way to its colours that keeps `budget`.

    Materials of equal reach, or of equal layers, share one choice. At the end stands what `complete_plans`
    adds for `scene`.

    scene : its lights and its vertices' colours count, and materials that it does not use get no way unless
        `with_unused`; None where there is none.
    size_pixels : each pixel is wanted once for every light and for the image light.
    advance : called after each material.

    Raises UsageError for a budget below 0 or NaN, and where nothing keeps it for a material.
    """
    check_budget(budget)
    used = None if scene is None or with_unused else {each.material for each in scene.primitives}
    met = {} if scene is None else vertex_colour_spans(scene)
    lamps = 0 if scene is None else sum(shines(light) for light in scene.lights)
    chosen: dict[tuple[Reach, Asked], Chosen] = {}
    layers: list[tuple[LayersPlan, LayersPlan]] = []
    plans = []
    for index, material in enumerate(model.materials):
        if used is not None and index not in used:
            plans.append(plan_material(material, index))
        else:
            asked = Asked(
                budget, size_pixels * max(lamps + has_image_light, 1), device, white, has_image_light
            )
            plans.append(
                plan_within(
                    material,
                    index,
                    asked,
                    model.document,
                    met.get(index),
                    already_chosen=chosen,
                    chosen_layers=layers,
                )
            )
        advance()
    return tuple(plans) if scene is None else complete_plans(plans, scene)


def plan_within(
    material: Material,
    index: int,
    asked: Asked,
    document: Document | None = None,
    vertex_colours: ColourSpans | None = None,
    *,
    already_chosen: dict[tuple[Reach, Asked], Chosen] | None = None,
    chosen_layers: list[tuple[LayersPlan, LayersPlan]] | None = None,
) -> MaterialPlan:
    """Return the plan of one material with the cheapest way to its film or layers that keeps `asked.budget`.

    document : of the material's textures; without one they may hold anything.
    already_chosen, chosen_layers : what other materials were given, which is read and written.

    Raises UsageError as `choose_way` and `choose_layers`.
    """
    drawn, folded = (material, {}) if document is None else simplified(material, document)
    reach = material_reach(drawn, document, vertex_colours)
    plan = plan_material(drawn, index, reach=reach, texel=period_texel(drawn, document), folded=folded)
    subject = f"material '{material.name or index}'"
    if plan.layers is not None:  # on such a material no film is drawn
        known_layers = [] if chosen_layers is None else chosen_layers
        found = next((after for before, after in known_layers if before == plan.layers), None)
        if found is None:
            found = choose_layers(
                plan.layers, AskedOfLayers(asked.budget, asked.device, asked.white), subject
            )
            known_layers.append((plan.layers, found))
        return replace(plan, layers=found)
    if reach is None or not plan.calls_for(Effect.IRIDESCENCE):
        return plan
    asked = replace(
        asked,
        bare_at_grazing=_bare_at_grazing(drawn),
        has_spread=asked.device == "glsl" and plan.calls_for(Effect.IRIDESCENCE_THICKNESS_TEXTURE),
    )
    known = {} if already_chosen is None else already_chosen
    if (reach, asked) not in known:
        known[reach, asked] = choose_way(reach, asked, subject)
    way = known[reach, asked]
    return plan_material(drawn, index, reach=reach, way=way.way, way_reason=way.reason, folded=folded)


def _bare_at_grazing(material: Material) -> float | None:
    """Return what the dielectric without its film reflects at grazing angles; None where that varies."""
    specular = material.specular
    if specular is None:
        return 1.0
    return specular.factor if specular.texture is None else None
