"""The plan: every effect that a material can call for, simulated or left out with its reason."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

from gltf_iri.errors import UsageError
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import DEFAULT_MATERIAL, SPECULAR_GLOSSINESS, Material
from gltf_iri.planning.bragg import period_texel
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.film import DRAWS_PHANTOM_FRINGES, idle_film, verdicts_without_film
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.planning.layers import plan_layers
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.material_reach import ANY_COLOURS, material_reach, vertex_colour_spans
from gltf_iri.planning.method import DEFAULT_METHOD, METHODS, Method, find_method
from gltf_iri.planning.reach import Lobe, Reach, Span
from gltf_iri.planning.simplify import simplified
from gltf_iri.planning.verdict import NotDrawn, Skip, Verdict
from gltf_iri.planning.verdicts import material_verdicts
from gltf_iri.planning.way import Way

if TYPE_CHECKING:
    from gltf_iri.asset.document import Document
    from gltf_iri.scene.model import Scene

__all__ = ["complete_plans", "plan_material", "plan_materials"]

_NOTHING: Final[Mapping[Effect, str]] = MappingProxyType({})


def plan_materials(
    materials: Sequence[Material],
    *,
    method: str | None = None,
    document: Document | None = None,
    scene: Scene | None = None,
    with_unused: bool = False,
) -> tuple[MaterialPlan, ...]:
    """Return the plan of each material, and at their end what `complete_plans` adds for `scene`.

    document : of the materials: their textures are decoded and looked at, and those that hold one value are
        folded into factors. Without, or where an image is broken, textures may hold anything.
    scene : the colours of its vertices count; without one, they may be any.
    with_unused : decode the textures of materials that `scene` does not use, too.

    Raises what `plan_material` does.
    """
    used = None if scene is None or with_unused else {p.material for p in scene.primitives}
    colours = {} if scene is None else vertex_colour_spans(scene)
    unknown = ANY_COLOURS if scene is None else None
    plans = []
    for index, material in enumerate(materials):
        if document is None or (used is not None and index not in used):
            plans.append(plan_material(material, index, method=method))
            continue
        drawn, folded = simplified(material, document)
        reach = material_reach(drawn, document, colours.get(index, unknown))
        texel = period_texel(drawn, document)
        plans.append(plan_material(drawn, index, method=method, reach=reach, texel=texel, folded=folded))
    return tuple(plans) if scene is None else complete_plans(plans, scene)


def complete_plans(plans: Sequence[MaterialPlan], scene: Scene) -> tuple[MaterialPlan, ...]:
    """Return `plans`, and at their end the plan of glTF's default material where `scene` uses it.

    Raises UsageError where `scene` uses another material that has no plan.
    """
    missing = {primitive.material for primitive in scene.primitives} - {plan.index for plan in plans}
    if DEFAULT_MATERIAL in missing:
        plans = (*plans, plan_material(Material(name="default material"), DEFAULT_MATERIAL))
        missing.remove(DEFAULT_MATERIAL)
    if missing:
        raise UsageError(f"There is no plan for material {min(missing)}, which the scene uses.")
    return tuple(plans)


def plan_material(
    material: Material,
    index: int,
    *,
    method: str | None = None,
    reach: Reach | None = None,
    way: Way | None = None,
    way_reason: str = "",
    texel: Span | None = None,
    layers: LayersPlan | None = None,
    folded: Mapping[Effect, str] = _NOTHING,
) -> MaterialPlan:
    """Return what `material` calls for.

    index : its place in the file, DEFAULT_MATERIAL for glTF's default material.
    method : the method for films, or for layers, that was asked for; None leaves the choice to the plan.
    reach : what the film meets (`material_reach`); None where the textures are unknown: they may then hold
        anything that the format allows.
    way : how the film is computed, `way_reason` why; its method goes before `method`, and without one the
        film is left out for that reason. None: the method is computed directly.
    texel : what the texture of the layers' periods holds (`period_texel`); None where nobody knows.
    layers : how layers are computed where a budget chose it; None for `plan_layers` without one.
    folded : reasons for what `simplified` has taken out of `material`.

    Raises UsageError where the method does not exist or computes neither films nor layers.
    """
    method, layers_method = _by_domain(method)
    name = method if way is None else way.method
    descriptor = find_method(DEFAULT_METHOD if name is None else name, "film")
    verdicts = material_verdicts(material, descriptor, reach, way, folded)
    if way is not None and way.method is None and material.iridescence and not verdicts[Effect.IRIDESCENCE]:
        verdicts |= verdicts_without_film(material.iridescence, Skip(way_reason), folded)
    film = verdicts[Effect.IRIDESCENCE]
    if film is None and way is not None:
        method_reason = way_reason
    else:
        method_reason = _method_reason(material, reach, film, descriptor, is_asked=method is not None)
    return MaterialPlan(
        index=index,
        name=material.name,
        effects=tuple(e for e, v in verdicts.items() if v is None),
        method=descriptor.name if film is None else None,
        method_reason=method_reason,
        layering=_layering(material, descriptor if film is None else None),
        skipped={e: v.reason for e, v in verdicts.items() if isinstance(v, Skip)},
        not_drawn=_not_drawn(material, verdicts),
        absent=frozenset(e for e, v in verdicts.items() if isinstance(v, Skip) and v.is_absent),
        material=material,
        way=way,
        grey=_grey(reach, verdicts) if film is None else frozenset(),
        layers=layers or plan_layers(material, method=layers_method, texel=texel, folded=folded),
    )


def _by_domain(method: str | None) -> tuple[str | None, str | None]:
    """Return `method` as the one for films or as the one for layers; the other is left to the plan."""
    if method is not None and method in METHODS and METHODS[method].domain == "layers":
        return None, method
    return method, None


def _grey(reach: Reach | None, verdicts: Mapping[Effect, Verdict]) -> frozenset[Lobe]:
    if reach is None:
        return frozenset()
    lobes: tuple[tuple[Lobe, Effect, bool], ...] = (
        ("dielectric", Effect.DIELECTRIC, reach.is_dielectric_grey),
        ("metal", Effect.METAL, reach.is_metal_grey),
    )
    return frozenset(lobe for lobe, effect, is_grey in lobes if is_grey and verdicts[effect] is None)


def _method_reason(
    material: Material, reach: Reach | None, film: Verdict, method: Method, *, is_asked: bool
) -> str:
    if film is not None:
        return f"no film: {film.reason}"
    reason = "asked for" if is_asked else "the default: the text's formula with its undefined cases closed"
    idle = idle_film(material, reach)
    if idle is not None and method.name in DRAWS_PHANTOM_FRINGES:
        reason += f"; drawn to the letter although {idle}: the text shows fringes where physics has none"
    return reason


def _layering(material: Material, method: Method | None) -> str:
    """Choose between the text's two dielectric layerings.

    With KHR_materials_specular its own section applies. Without, the core section blends the film in after
    two separate layerings, so that adding the extension with neutral values changes the picture; khr-guarded
    closes that gap by always blending first.
    """
    is_guarded = method is not None and method.name == "khr-guarded"
    return "specular" if material.specular is not None or is_guarded else "core"


def _not_drawn(material: Material, verdicts: dict[Effect, Verdict]) -> dict[str, str]:
    missing = {e.value: v.reason for e, v in verdicts.items() if isinstance(v, NotDrawn)}
    for name in material.unread_extensions:
        missing[name] = "not read by this program, drawn without it"
    if SPECULAR_GLOSSINESS in missing:
        missing[SPECULAR_GLOSSINESS] = "not read by this program, drawn with the metallic-roughness values"
        if material.iridescence is not None:
            missing[SPECULAR_GLOSSINESS] += f"; {Iridescence.EXTENSION} excludes it on the same material"
    return missing
