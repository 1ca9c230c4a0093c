"""Colours of stacks of Bragg layers by GLSL, as calls that are drawn for their time or their colours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Final

import numpy as np

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layers import LayerStack
from gltf_iri.optics.layer_stack import Sight
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.layer_switches import layer_defines
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.method import ParameterValue, find_method
from gltf_iri.planning.settings import with_defaults
from gltf_iri.rendering.layer_tables import LayerTableStore
from gltf_iri.rendering.optics_tables import optics_table
from gltf_iri.rendering.timed_calls import TimedCall
from gltf_iri.rendering.twins import ResultType

if TYPE_CHECKING:
    import moderngl

__all__ = ["layer_table_call", "layer_twin_call"]

_COLOURED_BY: Final = "reflectance"  # the parameter that names a method for mirrors

# Layers come as (n1, n2, α) and (d1, d2, cells), directions as (cosθ_h, cosθ_i, cosθ_o) in the host.
_LAYER: Final = (
    "    stack[{k}] = BraggLayer("
    "films_{k}.x, films_{k}.y, cells_{k}.x, cells_{k}.y, cells_{k}.z, films_{k}.z);"
)


def layer_twin_call(
    method: str,
    stack: LayerStack,
    sight: Sight,
    wanted: Sequence[int],
    *,
    white: str = "D65",
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
) -> TimedCall:
    """Return the call of the GLSL twin of a method for layers on each row of `stack` and `sight` (n,).

    wanted : layers by their numbers, whose reflections are summed; their count for what passes all both
        ways, one more for what crosses all once.
    Raises UsageError where the method or a parameter is unknown, and for a method without a twin.
    """
    descriptor = find_method(method, "layers")
    if descriptor.glsl_function is None:
        raise UsageError(f"The method '{method}' has no GLSL twin.")
    chosen, count = with_defaults(method, parameters), len(stack.layers)
    given = ", ".join(f"vec3 films_{k}, vec3 cells_{k}" for k in range(count))
    of_all = {
        count: f"stack_passed(host, stack, {count}, at.y, at.z)",
        count + 1: f"stack_entering(host, stack, {count}, at.z)",
    }
    calls = [
        of_all.get(number, f"stack_reflected(host, stack, {number}, at.x, at.y, at.z)") for number in wanted
    ]
    tables = {name: optics_table(name, white, chosen) for name in descriptor.glsl_tables}
    defines: tuple[str, ...] = ()
    if _COLOURED_BY in chosen:
        mirror = find_method(str(chosen[_COLOURED_BY]), "mirror")
        of_mirror = with_defaults(mirror.name, {})
        tables |= {name: optics_table(name, white, of_mirror) for name in mirror.glsl_tables}
        defines = () if mirror.is_truth else (mirror.define,)
    columns = [np.stack([sight.cos_h, sight.cos_i, sight.cos_o], axis=-1)]
    for layer in stack.layers:
        for each in ((layer.n1, layer.n2, layer.alpha), (layer.d1_nm, layer.d2_nm, layer.cells)):
            columns.append(np.stack(np.broadcast_arrays(*each), axis=-1).astype(np.float64))
    arguments = ", ".join(f"a{i}" for i in range(len(columns) + 1))
    vectors: list[ResultType] = ["vec3"] * len(columns)
    return TimedCall(
        method,
        (
            f'#include "optics/{method.replace("-", "_")}.glsl"',
            f"vec3 timed_layers(float host, vec3 at, {given}) {{",
            "    BraggLayer stack[BRAGG_LAYERS_MAX];",
            *(_LAYER.format(k=k) for k in range(count)),
            f"    return {' + '.join(calls)};",
            "}",
        ),
        f"timed_layers({arguments})",
        ("float", *vectors),
        (stack.host_ior, *columns),
        tables=tables,
        defines=defines,
    )


def layer_table_call(
    context: moderngl.Context, baked: BakedLayers, sight: Sight, wanted: Sequence[int]
) -> TimedCall:
    """Return the look-up of each row of `sight` (n,) in filled tables, as surfaces look them up.

    wanted : as of `layer_twin_call`. The texture is the caller's to release. Raises
    MissingCapabilityError where OpenGL takes none so large.
    """
    plan = MaterialPlan(0, "", (Effect.BRAGG,), None, "", "core", layers=baked.plan)
    store = LayerTableStore(context, {0: baked}, baked.white)
    count = len(baked.plan.layers)
    of_all = {count: "layers_passed(s, at.y, at.z)", count + 1: "layers_entering(s, at.z)"}
    calls = [of_all.get(number, f"layer_reflected(s, {number}, at.x, at.y, at.z)") for number in wanted]
    through = (Effect.TRANSMISSION.define,) if count + 1 in wanted else ()
    return TimedCall(
        "a table of layers",
        (
            '#include "material/surface.glsl"',
            '#include "lighting/layer_colours.glsl"',
            "vec3 timed_layers(vec3 at) {",
            "    Surface s;",
            "    s.bragg_period_texel = u_bragg_texel.x;",
            f"    return {' + '.join(calls)};",
            "}",
        ),
        "timed_layers(a0)",
        ("vec3",),
        (np.stack([sight.cos_h, sight.cos_i, sight.cos_o], axis=-1),),
        textures=store.textures(plan),
        uniforms=store.uniforms(plan),
        defines=(Effect.BRAGG.define, *through, *layer_defines(plan)),
    )
