"""The plans of a file's materials within a budget."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, TypeVar

from gltf_iri.budgets.choose import Asked, choose_way
from gltf_iri.budgets.layers import AskedOfLayers, choose_layers
from gltf_iri.budgets.search import Chosen, UnkeptBudgetError, check_budget
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

T = TypeVar("T", Chosen, LayersPlan)

# What materials of equal films, or of equal layers, were given: a choice, or why there is none.
FilmChoices = dict[tuple[Reach, Asked], Chosen | UnkeptBudgetError]
LayerChoices = list[tuple[LayersPlan, AskedOfLayers, LayersPlan | UnkeptBudgetError]]


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
    unkept: dict[int, UnkeptBudgetError] | None = None,
    advance: Callable[[], None] = lambda: None,
) -> tuple[MaterialPlan, ...]:
    """Return the plan of each material of `model` with the cheapest way to its colours that keeps `budget`.

    Materials of equal reach, or of equal layers, share one choice. At the end stands what `complete_plans`
    adds for `scene`.

    scene : its lights and its vertices' colours count, and materials that it does not use get no way unless
        `with_unused`; None where there is none.
    size_pixels : each pixel is wanted once for every light and for the image light.
    unkept : where given, receives why nothing keeps the budget for a material, by its index; the material is
        then planned as without a budget.
    advance : called after each material.

    Raises UsageError for a budget below 0 or NaN, and without `unkept` UnkeptBudgetError of the first
    material for which nothing keeps it.
    """
    check_budget(budget)
    used = None if scene is None or with_unused else {each.material for each in scene.primitives}
    met = {} if scene is None else vertex_colour_spans(scene)
    lamps = 0 if scene is None else sum(shines(light) for light in scene.lights)
    films: FilmChoices = {}
    layers: LayerChoices = []
    plans = []
    for index, material in enumerate(model.materials):
        if used is not None and index not in used:
            plans.append(plan_material(material, index))
        else:
            asked = Asked(
                budget, size_pixels * max(lamps + has_image_light, 1), device, white, has_image_light
            )
            textures = model.document, met.get(index)
            try:
                plan = plan_within(
                    material, index, asked, *textures, already_chosen=films, chosen_layers=layers
                )
            except UnkeptBudgetError as error:
                if unkept is None:
                    raise
                unkept[index] = error
                plan = _without_budget(material, index, *textures)[0]
            plans.append(plan)
        advance()
    return tuple(plans) if scene is None else complete_plans(plans, scene)


def plan_within(
    material: Material,
    index: int,
    asked: Asked,
    document: Document | None = None,
    vertex_colours: ColourSpans | None = None,
    *,
    already_chosen: FilmChoices | None = None,
    chosen_layers: LayerChoices | None = None,
) -> MaterialPlan:
    """Return the plan of one material with the cheapest way to its film or layers that keeps `asked.budget`.

    document : of the material's textures; without one they may hold anything.
    already_chosen, chosen_layers : what other materials were given, which is read and written.

    Raises UsageError as `choose_way` and `choose_layers`.
    """
    plan, reach, folded = _without_budget(material, index, document, vertex_colours)
    drawn, subject = plan.material or material, f"material '{material.name or index}'"
    if plan.layers is not None:  # on such a material no film is drawn
        is_crossed = plan.layers.under == "base" and plan.calls_for(Effect.TRANSMISSION)
        of_layers = AskedOfLayers(asked.budget, asked.device, asked.white, is_crossed)
        known = [] if chosen_layers is None else chosen_layers
        return replace(plan, layers=_known_layers(plan.layers, of_layers, subject, known))
    if reach is None or not plan.calls_for(Effect.IRIDESCENCE):
        return plan
    asked = replace(
        asked,
        bare_at_grazing=_bare_at_grazing(drawn),
        has_spread=asked.device == "glsl" and plan.calls_for(Effect.IRIDESCENCE_THICKNESS_TEXTURE),
    )
    way = _known_way(reach, asked, subject, {} if already_chosen is None else already_chosen)
    return plan_material(drawn, index, reach=reach, way=way.way, way_reason=way.reason, folded=folded)


def _without_budget(
    material: Material, index: int, document: Document | None, vertex_colours: ColourSpans | None
) -> tuple[MaterialPlan, Reach | None, Mapping[Effect, str]]:
    """Return the plan of `material`, what its film meets, and why some of its textures are left out."""
    drawn, folded = (material, {}) if document is None else simplified(material, document)
    reach = material_reach(drawn, document, vertex_colours)
    texel = period_texel(drawn, document)
    return plan_material(drawn, index, reach=reach, texel=texel, folded=folded), reach, folded


def _known_layers(plan: LayersPlan, asked: AskedOfLayers, subject: str, known: LayerChoices) -> LayersPlan:
    """Return `choose_layers`, of earlier materials where they asked the same; UnkeptBudgetError likewise."""
    for layers, already, found in known:
        if layers == plan and already == asked:
            return _given(found, subject)
    try:
        known.append((plan, asked, choose_layers(plan, asked, subject)))
    except UnkeptBudgetError as error:
        known.append((plan, asked, error))
    return _given(known[-1][-1], subject)


def _known_way(reach: Reach, asked: Asked, subject: str, known: FilmChoices) -> Chosen:
    """Return `choose_way`, of earlier materials where they asked the same; UnkeptBudgetError likewise."""
    if (reach, asked) not in known:
        try:
            known[reach, asked] = choose_way(reach, asked, subject)
        except UnkeptBudgetError as error:
            known[reach, asked] = error
    return _given(known[reach, asked], subject)


def _given(found: T | UnkeptBudgetError, subject: str) -> T:
    if isinstance(found, UnkeptBudgetError):
        raise found.of(subject)
    return found


def _bare_at_grazing(material: Material) -> float | None:
    """Return what the dielectric without its film reflects at grazing angles; None where that varies."""
    specular = material.specular
    if specular is None:
        return 1.0
    return specular.factor if specular.texture is None else None
