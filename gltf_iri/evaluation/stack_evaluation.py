"""A stack of Bragg layers on its base as numbers: what it sends back over all directions, or its BRDF."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.backends import choose_backend
from gltf_iri.colour.spaces import Light, White
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Evaluation
from gltf_iri.evaluation.layer_energy import stack_energy
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import (
    BraggLayer,
    LayerBase,
    LayeredSurface,
    LayerStack,
    Pose,
    coating_reflectance,
)
from gltf_iri.evaluation.parameters import checked_parameters
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.method import ParameterValue, find_method

__all__ = ["StackEvaluation", "evaluate_stack", "pose_of", "stack_of"]

Float64 = NDArray[np.float64]

_BASE_ALPHA = 0.1  # of a metal whose roughness nobody says


@dataclass(frozen=True, slots=True, kw_only=True)
class StackEvaluation(Evaluation):
    """Colours of a stack at cosines (...); `rgb` (..., 3) is one of two things.

    Without a light, what the stack reflects over all directions: a share, white 1, the host's own mirror
    image in it. transmitted, absorbed, from_base : (..., 3) as `StackEnergy` has them.

    Lit from one direction, the BRDF f_r in 1/sr, without the host's mirror image; the other three are None.

    mirrored : (...) share of light at those cosines that the smooth surface of the host mirrors, 1 − T_c.
    """

    mirrored: Float64
    transmitted: Float64 | None = None
    absorbed: Float64 | None = None
    from_base: Float64 | None = None


def stack_of(
    layers: Sequence[Sequence[ArrayLike]],
    host_ior: ArrayLike | None = None,
    base_diffuse: ArrayLike | None = None,
    base_metal: ArrayLike | None = None,
    base_alpha: ArrayLike | None = None,
) -> LayerStack:
    """Return the stack that people describe; None stands for what they leave out.

    layers : outermost first, each n1, n2, d1_nm, d2_nm, cells and α = perceptual roughness squared.
    host_ior : without it n1 of the first layer.
    base_diffuse : a number or (3,), of a Lambertian base; none without it. base_metal : F0, a number or (3,),
        of a GGX metal beside it, of roughness base_alpha (0.1).

    Raises UsageError where a layer has not six numbers, for values out of range and for bases that send back
    more than they receive.
    """
    rows = [tuple(layer) for layer in layers]
    if not rows or any(len(row) != 6 for row in rows):
        raise UsageError("Each of one or more layers wants six: n1, n2, d1_nm, d2_nm, cells and α.")
    if base_alpha is not None and base_metal is None:
        raise UsageError("The roughness of a base is that of its metal: give both.")
    diffuse = 0.0 if base_diffuse is None else base_diffuse
    metal = 0.0 if base_metal is None else base_metal
    alpha = _BASE_ALPHA if base_alpha is None else base_alpha
    base = LayerBase.of(diffuse, metal, 0.0 if base_metal is None else 1.0, alpha)
    if base_metal is not None and np.any(base.diffuse + base.metal_f0 > 1.0):
        raise UsageError(
            "A diffuse base and a metal lie side by side: no channel of both may add up to more than 1."
        )
    stacked = tuple(BraggLayer.of(*row) for row in rows)
    # Layers lie in their host: where nobody names it, it is what the first of them says.
    return LayerStack.of(stacked, stacked[0].n1 if host_ior is None else host_ior, base)


def pose_of(cos_theta: ArrayLike, light: Sequence[ArrayLike]) -> Pose:
    """Return viewers at `cos_theta` (...) under a `light`: its cosine, and cosφ of the turn between them.

    Without the latter −1: the viewer stands in the plane and on the side of the mirrored light. Raises
    UsageError for other than one or two numbers and for cosines out of range.
    """
    given = tuple(light)
    if len(given) not in (1, 2):
        raise UsageError("A light wants the cosine of its angle and, at most, the cosine of the turn to it.")
    return Pose.of(given[0], cos_theta, given[1] if len(given) == 2 else -1.0)


def evaluate_stack(
    method: str,
    stack: LayerStack,
    cos_theta: ArrayLike,
    light: Sequence[ArrayLike] | None = None,
    *,
    white: str | Light = "D65",
    backend: str = "auto",
    parameters: Mapping[str, ParameterValue] = MappingProxyType({}),
) -> StackEvaluation:
    """Evaluate `stack` at `cos_theta` (...) outside: the light's angles, or with a `light` the viewer's.

    What is transmitted comes of spectra whatever the method. Raises UsageError for an unknown method, white,
    backend or parameter, for cosines out of range, and without `light` for stacks of arrays.
    """
    descriptor = find_method(method, "layers")
    cosine = np.asarray(cos_theta, np.float64)
    chosen = choose_backend(backend, cosine.size, descriptor.backends, method)
    if light is not None:
        surface = LayeredSurface(stack, pose_of(cosine, light))
        done = evaluate(method, surface, white=white, backend=backend, parameters=parameters)
        return StackEvaluation(
            done.rgb,
            method,
            done.white,
            chosen,
            done.undefined,
            done.parameters,
            mirrored=coating_reflectance(stack.host_ior, cosine),
        )
    Pose.of(cosine, 1.0)  # says what is wrong with a cosine
    colours = layer_colours(method, stack, white=white, parameters=parameters)
    known: White = white if isinstance(white, Light) else "E" if white == "E" else "D65"  # or we had raised
    energy = stack_energy(stack, cosine.reshape(-1), colours, known)
    shape = (*cosine.shape, 3)
    return StackEvaluation(
        energy.reflected.reshape(shape),
        method,
        str(white),
        chosen,
        parameters=checked_parameters(descriptor, parameters),
        mirrored=coating_reflectance(stack.host_ior, cosine),
        transmitted=energy.transmitted.reshape(shape),
        absorbed=energy.absorbed.reshape(shape),
        from_base=energy.from_base.reshape(shape),
    )
