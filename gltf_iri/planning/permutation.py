"""From plans to shader permutations; the key of a permutation is the ordered tuple of its defines."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING, Final

from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.method import find_method

if TYPE_CHECKING:
    from gltf_iri.scene.model import Environment, Primitive, Scene

__all__ = ["LAYERING_SPECULAR", "permutation", "plan_scene_effects", "primitive_effects"]

# The dielectric layering of the text's KHR_materials_specular section; without it, the core section's.
LAYERING_SPECULAR: Final = "LAYERING_SPECULAR"

# What is laid out along the tangents.
_TANGENT_READERS: Final = (Effect.NORMAL_TEXTURE, Effect.ANISOTROPY, Effect.CLEARCOAT_NORMAL_TEXTURE)

_LIGHTS: Final = (Effect.PUNCTUAL_LIGHTS, Effect.IMAGE_LIGHT)


def plan_scene_effects(scene: Scene, environment: Environment | None) -> frozenset[Effect]:
    """Return the kinds of light that `scene` under `environment` holds; a light of intensity 0 is none."""
    effects = set()
    if any(light.intensity > 0.0 and any(light.colour) for light in scene.lights):
        effects.add(Effect.PUNCTUAL_LIGHTS)
    if environment is not None and environment.radiance.any():
        effects.add(Effect.IMAGE_LIGHT)
    return frozenset(effects)


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

    Effects that cannot be seen together are dropped: lights on unlit materials, tangents that
    nothing is laid out along, occlusion without image light.
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
        defines.append(find_method(plan.method).define)
    if plan.layering == "specular" and Effect.DIELECTRIC in seen:
        defines.append(LAYERING_SPECULAR)
    return tuple(defines)
