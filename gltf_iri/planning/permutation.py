"""From plans to shader permutations; the key of a permutation is the ordered tuple of its defines."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import TYPE_CHECKING, Final

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.film_table import FilmTable, Quantity
from gltf_iri.planning.layer_switches import layer_defines
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.method import find_method
from gltf_iri.planning.reach import Lobe

if TYPE_CHECKING:
    from gltf_iri.scene.model import Environment, Light, Primitive, Scene

__all__ = ["AXIS_WORDS", "FILM_FACET_MEAN", "FILM_SWITCHES", "LAYERING_SPECULAR", "film_lobes"]
__all__ += ["permutation", "plan_scene_effects", "primitive_effects", "shines"]

# The dielectric layering of the text's KHR_materials_specular section; without it, the core section's.
LAYERING_SPECULAR: Final = "LAYERING_SPECULAR"

# What is laid out along the tangents.
_TANGENT_READERS: Final = (Effect.NORMAL_TEXTURE, Effect.ANISOTROPY, Effect.CLEARCOAT_NORMAL_TEXTURE)

# Image light asks for the film at the mean cosine of the facets that send it, in place of N·V.
FILM_FACET_MEAN: Final = "FILM_FACET_MEAN"

_LOBES: Final[Mapping[Lobe, Effect]] = {"dielectric": Effect.DIELECTRIC, "metal": Effect.METAL}

# What GLSL calls the axes of a table, in the names of uniforms and of switches.
AXIS_WORDS: Final[Mapping[Quantity, str]] = {
    "cos_theta": "cos_theta",
    "thickness_nm": "thickness",
    "base_f0": "base",
    "roughness": "roughness",
    "spread_nm": "spread",
}

# What a table's switches end in, for each axis beside cosθ; then for three and for four axes.
_AXES: Final[Mapping[Quantity, str]] = {
    axis: f"_{word.upper()}" for axis, word in AXIS_WORDS.items() if axis != "cos_theta"
}
_SHAPES: Final = {3: ("_3D",), 4: ("_3D", "_4D")}

# All that `permutation` may define about a film beside its effects and its method.
FILM_SWITCHES: Final = frozenset(
    {FILM_FACET_MEAN}
    | {f"GREY_{lobe.upper()}" for lobe in _LOBES}
    | {f"{lobe.upper()}_TABLE{end}" for lobe in _LOBES for end in ("", *_AXES.values(), *_SHAPES[4])}
)

_LIGHTS: Final = (Effect.PUNCTUAL_LIGHTS, Effect.IMAGE_LIGHT)


def plan_scene_effects(scene: Scene, environment: Environment | None) -> frozenset[Effect]:
    """Return the kinds of light that `scene` under `environment` holds; a light of intensity 0 is none."""
    effects = set()
    if any(shines(light) for light in scene.lights):
        effects.add(Effect.PUNCTUAL_LIGHTS)
    if environment is not None and environment.radiance.any():
        effects.add(Effect.IMAGE_LIGHT)
    return frozenset(effects)


def shines(light: Light) -> bool:
    """True where `light` sends any light at all."""
    return light.intensity > 0.0 and any(light.colour)


def primitive_effects(primitive: Primitive) -> frozenset[Effect]:
    """Return what the vertices of `primitive` bring beside positions, normals and UVs."""
    effects = set()
    if primitive.colours is not None:
        effects.add(Effect.VERTEX_COLOR)
    if primitive.tangents is not None:
        effects.add(Effect.TANGENTS)
    return frozenset(effects)


def permutation(
    plan: MaterialPlan, primitive: Collection[Effect], scene: Collection[Effect]
) -> tuple[str, ...]:
    """Return the defines of the shader that draws a primitive with this plan under these lights, in order.

    Some have a value, "NAME value"; the others are switches.

    Effects that cannot be seen together are dropped: lights on unlit materials, tangents that
    nothing is laid out along, occlusion without image light, layers without any light, also from behind.
    """
    seen = {*plan.effects, *primitive, *scene}
    if Effect.UNLIT in seen:
        seen -= set(_LIGHTS)
    if seen.isdisjoint(_TANGENT_READERS):
        seen.discard(Effect.TANGENTS)
    if Effect.IMAGE_LIGHT not in seen:
        seen.discard(Effect.OCCLUSION_TEXTURE)
    defines = [effect.define for effect in Effect if effect in seen]
    if plan.method is not None:
        defines += _film_defines(plan, plan.method, seen)
    if not seen.isdisjoint((*_LIGHTS, Effect.TRANSMISSION)):
        defines += layer_defines(plan)
    if plan.layering == "specular" and Effect.DIELECTRIC in seen:
        defines.append(LAYERING_SPECULAR)
    return tuple(defines)


def film_lobes(plan: MaterialPlan) -> dict[Lobe, FilmTable | None]:
    """Return the lobes that carry the film, each with its table; None where the film is computed directly."""
    return {lobe: plan.table(lobe) for lobe, effect in _LOBES.items() if plan.calls_for(effect)}


def _film_defines(plan: MaterialPlan, method: str, seen: Collection[Effect]) -> Iterator[str]:
    tables = film_lobes(plan)
    if None in tables.values():
        yield find_method(method).define
    for lobe, table in tables.items():
        if table is not None:
            shape = _SHAPES.get(len(table.axes), ())
            axes = (_AXES[axis.quantity] for axis in table.axes[1:])
            yield from (f"{lobe.upper()}_TABLE{end}" for end in ("", *axes, *shape))
    # The metal's base is the base colour, which vertices tint.
    is_tinted: Mapping[Lobe, bool] = {"dielectric": False, "metal": Effect.VERTEX_COLOR in seen}
    yield from (f"GREY_{lobe.upper()}" for lobe in tables if lobe in plan.grey and not is_tinted[lobe])
    is_mean = any(table is None or table.axis("roughness") is None for table in tables.values())
    if plan.way is not None and is_mean and not {Effect.IMAGE_LIGHT, Effect.TRANSMISSION}.isdisjoint(seen):
        yield FILM_FACET_MEAN
