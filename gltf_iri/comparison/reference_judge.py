"""The rasteriser's picture against the CPU reference's: where both are exact, and where one approximates.

No OpenGL and no rays here: pictures from any two renderers can be judged.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.comparison.metric import agreement, colour_error
from gltf_iri.comparison.pixels import is_rough
from gltf_iri.comparison.reference_result import NoisyError, SameProblem
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.render import ReferenceFrame
from gltf_iri.rendering.frame import ShadingInputs
from gltf_iri.scene.model import Camera
from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE, REFERENCE_DEPTH_RELATIVE, REFERENCE_EDGE_PX

__all__ = ["delta_e_picture", "is_see_through", "noisy_error", "same_problem", "same_surface"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]


def is_see_through(plan: MaterialPlan) -> bool:
    """True where what lies behind a surface shows through it."""
    return plan.calls_for(Effect.TRANSMISSION) or plan.calls_for(Effect.ALPHA_BLEND)


def same_surface(inputs: ShadingInputs, reference: ReferenceFrame, camera: Camera) -> Mask:
    """Return where (height, width) both renderers met the same material at the same depth, off any edge.

    OpenGL moves vertices by up to half of its smallest step of a pixel before it asks which pixels a triangle
    covers, so along an edge the two may see what is on either side of it.
    """
    position = inputs.position.astype(np.float64)
    depth_m = -(position @ camera.view[2, :3] + camera.view[2, 3])
    apart = np.abs(depth_m - np.where(np.isfinite(reference.depth_m), reference.depth_m, 0.0))
    is_near = apart <= REFERENCE_DEPTH_RELATIVE * np.abs(depth_m)
    is_inside = reference.edge_px > REFERENCE_EDGE_PX
    return np.asarray((inputs.material >= 0) & (inputs.material == reference.material) & is_near & is_inside)


def same_problem(
    inputs: ShadingInputs,
    plans: Sequence[MaterialPlan],
    reference: ReferenceFrame,
    mask: Mask,
    is_same: Mask,
    steepness: Float64,
) -> SameProblem:
    """Compare the pixels (height, width) of `mask` on which both renderers met the same surface.

    Both pictures are of punctual light and emission alone, on surfaces drawn as if opaque. Pixels whose
    `steepness` exceeds the tolerance are left out.
    """
    is_steep = steepness > GLSL_PIXEL_RELATIVE
    is_judged = is_rough(inputs, plans)
    rough = mask & is_same & ~is_steep & is_judged
    smooth = mask & is_same & ~is_steep & ~is_judged
    glsl, exact = inputs.colour.astype(np.float64), reference.rgba[..., :3]
    return SameProblem(
        agreement(glsl[rough], exact[rough]),
        agreement(glsl[smooth], exact[smooth]),
        int((mask & ~is_same).sum()),
        int((mask & is_same & is_steep).sum()),
    )


def noisy_error(
    glsl: Float64, mean: Float64, standard_error: Float64, mask: Mask, exposure: float
) -> NoisyError:
    """Compare pictures (height, width, 3) on `mask`; `mean` is known to within `standard_error`.

    exposure : factor on linear light.
    """
    error = colour_error(glsl[mask], mean[mask], exposure=exposure)
    moved = mean[mask] + standard_error[mask]
    noise = colour_error(moved, mean[mask], exposure=exposure)
    return NoisyError(error, noise.delta_e_mean, noise.delta_e_p95)


def delta_e_picture(glsl: Float64, mean: Float64, mask: Mask, exposure: float) -> Float64:
    """Return ΔE2000 (height, width) after exposure; 0 outside of `mask` and where a side is no number."""
    rows = mask & np.all(np.isfinite(glsl) & np.isfinite(mean), axis=-1)
    result = np.zeros(mask.shape)
    result[rows] = delta_e_2000(exposure * glsl[rows], exposure * mean[rows])
    return result
