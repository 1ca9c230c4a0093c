"""From primitives and plans to draws: programs, vertices, numbers and textures."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Final

from gltf_iri.material.interface import material_textures, material_uniforms
from gltf_iri.material.material import Material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.permutation import permutation, primitive_effects
from gltf_iri.rendering.draw import Draw, Shader
from gltf_iri.rendering.film_tables import FilmTableStore
from gltf_iri.rendering.geometry import GeometryStore, placement_uniforms
from gltf_iri.rendering.layer_tables import LayerTableStore, direct_tables
from gltf_iri.rendering.optics_tables import OpticsTableStore
from gltf_iri.rendering.programs import ProgramStore, computed_method, film_parameters
from gltf_iri.rendering.switches import BRAGG_INPUTS, LAYER_INPUTS, SHADING_INPUTS
from gltf_iri.rendering.textures import TextureStore
from gltf_iri.rendering.uniforms import Sampled
from gltf_iri.scene.model import Scene

if TYPE_CHECKING:
    import moderngl

__all__ = [
    "FIRST_INPUTS",
    "PICTURE",
    "SECOND_INPUTS",
    "THIRD_INPUTS",
    "needed_targets",
    "prepare_draws",
    "used_plans",
]

# What a frame is drawn into.
PICTURE: Final = "picture"
FIRST_INPUTS: Final = "first inputs"
SECOND_INPUTS: Final = "second inputs"
THIRD_INPUTS: Final = "third inputs"

_SWITCHES: Final[Mapping[str, tuple[str, ...]]] = {
    PICTURE: (),
    FIRST_INPUTS: (SHADING_INPUTS,),
    SECOND_INPUTS: (LAYER_INPUTS,),
    THIRD_INPUTS: (BRAGG_INPUTS,),
}

# The effects that `LAYER_INPUT_TARGETS` speak of.
_LAYERS: Final = (
    *(Effect.TRANSMISSION, Effect.CLEARCOAT, Effect.SHEEN, Effect.ANISOTROPY),
    Effect.IRIDESCENCE_THICKNESS_SPREAD,
)


def used_plans(scene: Scene, plans: Sequence[MaterialPlan]) -> list[MaterialPlan]:
    """Return those of `plans` whose materials `scene` uses."""
    materials = {primitive.material for primitive in scene.primitives}
    return [plan for plan in plans if plan.index in materials]


def needed_targets(plans: Sequence[MaterialPlan], *, with_inputs: bool) -> tuple[str, ...]:
    """Return what to draw into; the second and third inputs only where one of `plans` fills them."""
    if not with_inputs:
        return (PICTURE,)
    # A film with a way asks for the cosine of image light's facets.
    has_layers = any(
        (plan.way is not None and plan.method is not None) or any(plan.calls_for(e) for e in _LAYERS)
        for plan in plans
    )
    second = (SECOND_INPUTS,) if has_layers else ()
    third = (THIRD_INPUTS,) if any(plan.layers is not None for plan in plans) else ()
    return (PICTURE, FIRST_INPUTS, *second, *third)


def prepare_draws(
    scene: Scene,
    plans: Sequence[MaterialPlan],
    materials: Sequence[Material],
    surroundings: Collection[Effect],
    targets: Sequence[str],
    programs: ProgramStore,
    geometry: GeometryStore,
    textures: TextureStore,
    uniforms: Mapping[str, Any],
    light: Mapping[str, moderngl.Texture],
    tables: OpticsTableStore,
    film_tables: FilmTableStore,
    layer_tables: LayerTableStore,
    white: str,
) -> Iterator[Draw]:
    """Yield a draw for each primitive; `uniforms` and `light` are those that all of them share.

    tables, white : what the films' methods sample, and the illuminant that it is made for.
    film_tables : what the films are read from where their way has tables; layer_tables : the same of layers.

    Raises MissingCapabilityError for more or larger textures than OpenGL takes, UsageError where a table is
    missing that a plan's way names.
    """
    slot_of = {plan.index: slot for slot, plan in enumerate(plans)}
    for primitive in scene.primitives:
        slot = slot_of[primitive.material]
        plan = plans[slot]
        material = plan.material_in(materials)
        defines = permutation(plan, primitive_effects(primitive), surroundings)
        shaders = {}
        for target in targets:
            program = programs.get((*defines, *_SWITCHES[target]), material=plan.name or str(plan.index))
            shaders[target] = Shader(program, geometry.vertex_array(primitive, program))
        own = placement_uniforms(primitive) | {"u_material": slot} | material_uniforms(material, defines)
        sampled: dict[str, Sampled] = {
            name: textures.get(b) for name, b in material_textures(material, defines).items()
        }
        if plan.method is not None:
            own |= film_tables.uniforms(plan)
            sampled |= film_tables.textures(plan)
        own |= layer_tables.uniforms(plan)
        sampled |= layer_tables.textures(plan)
        sampled |= tables.textures(direct_tables(plan), white, {})
        method = computed_method(plan)
        if method is not None:
            has_spread = plan.calls_for(Effect.IRIDESCENCE_THICKNESS_SPREAD) and method.glsl_spread_function
            names = method.glsl_spread_tables if has_spread else method.glsl_tables
            sampled |= tables.textures(names, white, film_parameters(plan))
        yield Draw(primitive, plan, shaders, {**uniforms, **own}, {**light, **sampled})
