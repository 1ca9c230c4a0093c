"""The Bragg layers of a glTF material as one stack, without geometry, lights or textures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layers import LayerBase, LayerStack
from gltf_iri.evaluation.material_surface import surface_albedo, surface_brdf, transmitting_share
from gltf_iri.evaluation.planned_stack import period_nm, planned_stack
from gltf_iri.evaluation.stack_evaluation import StackEvaluation, pose_of
from gltf_iri.material.bragg import Bragg
from gltf_iri.material.material import Material
from gltf_iri.optics.microfacet import alpha_ggx
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan

__all__ = ["InMaterial", "MaterialLayers", "in_material", "material_layers"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class MaterialLayers:
    """The stack that a material's layers are, at one value of the texture that their periods run along.

    stack : layers, host and base; sources : the place of each layer in the material's own list.
    period_texel : the texture's value, 1 where no period varies. period_nm : of each layer there, and
    period_range_nm : at the least and the greatest value that the plan knows of, a number twice where nothing
    varies.
    factor : how much of the surface they are, which a texture may lower.
    transmission : (3,) what colours the light from behind that crosses the layers once; 0 without any.
    """

    stack: LayerStack
    sources: tuple[int, ...]
    period_texel: float
    period_nm: tuple[float, ...]
    period_range_nm: tuple[tuple[float, float], ...]
    factor: float
    transmission: Float64


@dataclass(frozen=True, slots=True)
class InMaterial:
    """What layers become in their material: plain, (..., 3) of the surface without them, and rgb of both."""

    plain: Float64
    rgb: Float64


def material_layers(
    material: Material, plan: MaterialPlan, period_texel: float | None = None
) -> MaterialLayers:
    """Return the layers of `material` that its plan simulates; factors stand for their textures.

    period_texel : value of the period texture, in [0, 1]; None for 1, where periods are their maxima.

    Roughness is the file's own, 0 included, where a picture has ALPHA_MIN. Raises UsageError where the plan
    has no layers, with its reason, for a value out of range, and for one where no period varies.
    """
    bragg, planned = material.bragg, plan.layers
    if bragg is None or planned is None:
        raise UsageError(f"Material '{plan.name or plan.index}' has nothing to evaluate: {_reason(plan)}.")
    if period_texel is not None:
        if not planned.varies:
            raise UsageError(
                f"No period of material '{plan.name or plan.index}' varies with a texture:"
                " leave its value out."
            )
        if not 0.0 <= period_texel <= 1.0:
            raise UsageError(f"A texture holds values from 0 to 1, not {period_texel:g}.")
    texel = 1.0 if period_texel is None else period_texel
    pbr = material.pbr
    m, colour = pbr.metallic_factor, np.array(pbr.base_color_factor[:3])
    passes = (1.0 - m) * transmitting_share(material, plan)
    base = LayerBase.of((1.0 - m - passes) * colour, colour, m, alpha_ggx(pbr.roughness_factor))
    stack = planned_stack(planned, texel, base)
    sources = tuple(layer.source for layer in planned.layers)
    layers = tuple(
        replace(layer, alpha=np.asarray(bragg.layers[source].roughness ** 2))
        for layer, source in zip(stack.layers, sources, strict=True)
    )
    return MaterialLayers(
        stack=replace(stack, layers=layers),
        sources=sources,
        period_texel=texel,
        period_nm=tuple(float(period_nm(planned, layer, texel)) for layer in planned.layers),
        period_range_nm=tuple(layer.period_nm for layer in planned.layers),
        factor=bragg.factor,
        transmission=passes * colour,
    )


def in_material(
    material: Material,
    plan: MaterialPlan,
    layers: MaterialLayers,
    evaluated: StackEvaluation,
    cos_theta: ArrayLike,
    light: Sequence[ArrayLike] | None = None,
) -> InMaterial:
    """Return mix(surface without the extension, layers over the base, factor), of `evaluated` layers.

    Both are what is reflected over all directions, or with a `light` BRDFs; `surface_brdf` says of what the
    surface without layers consists. cos_theta, light : as `evaluate_stack` had them.
    """
    if light is None:
        plain = surface_albedo(material, plan, cos_theta)
    else:
        plain = surface_brdf(material, plan, pose_of(cos_theta, light))
    return InMaterial(plain, (1.0 - layers.factor) * plain + layers.factor * evaluated.rgb)


def _reason(plan: MaterialPlan) -> str:
    """Return why a plan has no layers."""
    told = plan.not_drawn.get(Effect.BRAGG.value) or plan.skipped.get(Effect.BRAGG, f"no {Bragg.EXTENSION}")
    return f"no layers: {told}"
