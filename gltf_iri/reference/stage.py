"""Everything of a model that rays and shading need, as plain arrays that may be sent to other processes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from gltf_iri.material.interface import material_textures
from gltf_iri.material.material import Material
from gltf_iri.planning.decide import complete_plans
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.texture import Texels
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Scene

__all__ = ["Stage", "build_stage"]


@dataclass(frozen=True, slots=True)
class Stage:
    """A scene with its plans, materials and textures.

    plans, materials : slot by slot, the default material's at the end where the scene uses it.
    slots : of each primitive, the place of its plan.
    textures : by their index in the file; only those that a plan calls for.
    """

    scene: Scene
    plans: tuple[MaterialPlan, ...]
    materials: tuple[Material, ...]
    slots: tuple[int, ...]
    textures: Mapping[int, Texels]


def build_stage(model: Model, scene: Scene, plans: Sequence[MaterialPlan]) -> Stage:
    """Gather what `scene` needs of `model` under `plans` (`complete_plans`).

    Raises UsageError for a material without a plan, AssetError for a broken image.
    """
    plans = complete_plans(plans, scene)
    slot_of = {plan.index: slot for slot, plan in enumerate(plans)}
    slots = tuple(slot_of[primitive.material] for primitive in scene.primitives)
    materials = tuple(plan.material_in(model.materials) for plan in plans)
    textures: dict[int, Texels] = {}
    for slot in set(slots):
        for binding in material_textures(materials[slot], _defines(plans[slot])).values():
            if binding.texture not in textures:
                sampler = model.document.texture(binding.texture)
                pixels = model.document.image(sampler.image).pixels
                textures[binding.texture] = Texels(pixels, sampler.wrap_s, sampler.wrap_t, sampler.mag_filter)
    return Stage(scene, tuple(plans), materials, slots, textures)


def _defines(plan: MaterialPlan) -> tuple[str, ...]:
    """Return what a shader under image light would be compiled with: it samples the most textures."""
    return tuple(effect.define for effect in (*plan.effects, Effect.IMAGE_LIGHT))
