"""Renders a scene twice with OpenGL and twice by casting rays, and has the pictures judged."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.comparison.judge import inputs_of
from gltf_iri.comparison.reference_judge import (
    delta_e_picture,
    is_see_through,
    noisy_error,
    same_problem,
    same_surface,
)
from gltf_iri.comparison.reference_result import NoisyError, ReferenceMaterial, ReferenceResult, SameProblem
from gltf_iri.comparison.rig import RIG, rig
from gltf_iri.comparison.steepness import steepness
from gltf_iri.planning.decide import complete_plans
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.render import ReferenceFrame, render_reference
from gltf_iri.reference.tiles import count_tiles
from gltf_iri.rendering.frame import ShadingInputs
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Environment, Scene

__all__ = ["against_reference", "count_steps"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]


def count_steps(size: tuple[int, int]) -> int:
    """Return how often `against_reference` calls `advance` for a picture of this size."""
    return 4 * count_tiles(size)


def against_reference(
    renderer: Renderer,
    model: Model,
    scene: Scene,
    plans: Sequence[MaterialPlan],
    camera: Camera,
    environment: Environment | None,
    *,
    size: tuple[int, int],
    exposure: float = 0.0,
    white: str = "D65",
    layer_tables: Mapping[int, BakedLayers] = MappingProxyType({}),
    image_samples: int = 256,
    paths: int = 64,
    advance: Callable[[], None] = lambda: None,
) -> ReferenceResult:
    """Hold what OpenGL draws of `scene` against what rays see of it from the same camera.

    Parameters
    ----------
    plans : one for each material of `model`; the default material's is added where the scene uses it.
    exposure : in EV; linear light is multiplied by 2^exposure before ΔE2000.
    white, layer_tables : as in `Renderer.render`, for both.
    image_samples, paths : of the reference, a pixel (`render_reference`).

    Raises MissingCapabilityError without OpenGL or embreex, and what `render_reference` raises.
    """
    started = time.perf_counter()
    plans = complete_plans(plans, scene)
    factor = 2.0**exposure
    exact = _draw_exactly(renderer, model, scene, plans, camera, size, white, layer_tables, advance)
    estimate = render_reference(
        model,
        scene,
        plans,
        camera,
        environment,
        size=size,
        layer_method=None,
        layer_tables=layer_tables,
        white=white,
        image_samples=image_samples,
        paths=paths,
        advance=advance,
    )
    # Without smaller copies of the textures, which rays do not see either: what differs then is the light.
    draw = partial(
        renderer.render,
        model,
        size=size,
        samples=0,
        float_textures=True,
        sharp_textures=True,
        white=white,
        layer_tables=layer_tables,
    )
    glsl = draw(scene, plans, camera, environment).rgba[..., :3].astype(np.float64)
    behind = draw(replace(scene, primitives=()), plans, camera, environment).rgba[..., :3]
    mean = estimate.rgba[..., :3] + (1.0 - estimate.rgba[..., 3:]) * behind

    def error(mask: Mask) -> NoisyError:
        return noisy_error(glsl, mean, estimate.standard_error, mask & exact.is_same, factor)

    material = exact.inputs.material
    drawn = material >= 0
    through = np.isin(material, [slot for slot, plan in enumerate(plans) if is_see_through(plan)])
    materials = tuple(
        ReferenceMaterial(
            plan.index,
            plan.name,
            is_see_through(plan),
            exact.compare((material == slot) & ~through),
            error(material == slot),
        )
        for slot, plan in enumerate(plans)
        if (material == slot).any()
    )
    return ReferenceResult(
        lights=exact.lights,
        samples={"image_samples": image_samples, "paths": paths},
        seconds=time.perf_counter() - started,
        same_problem=exact.compare(drawn & ~through),
        opaque=error(drawn & ~through),
        see_through=error(through),
        whole=error(drawn),
        materials=materials,
        glsl=glsl,
        picture=mean,
        drawn=drawn,
        delta_e=delta_e_picture(glsl, mean, drawn & exact.is_same, factor),
    )


@dataclass(frozen=True, slots=True)
class _Exact:
    """Both renderers' pictures of what both solve exactly."""

    inputs: ShadingInputs
    plans: Sequence[MaterialPlan]
    reference: ReferenceFrame
    is_same: Mask  # (height, width), both met the same surface
    steepness: Float64  # (height, width)
    lights: str  # in words

    def compare(self, mask: Mask) -> SameProblem:
        return same_problem(self.inputs, self.plans, self.reference, mask, self.is_same, self.steepness)


def _draw_exactly(
    renderer: Renderer,
    model: Model,
    scene: Scene,
    plans: Sequence[MaterialPlan],
    camera: Camera,
    size: tuple[int, int],
    white: str,
    layer_tables: Mapping[int, BakedLayers],
    advance: Callable[[], None],
) -> _Exact:
    lights = "the scene's own lights"
    if not scene.lights:
        scene, lights = replace(scene, lights=rig(scene, camera)), RIG

    def cast(from_camera: Camera) -> ReferenceFrame:
        return render_reference(
            model,
            scene,
            plans,
            from_camera,
            None,
            size=size,
            layer_method=None,
            layer_tables=layer_tables,
            white=white,
            lighting="punctual",
            is_blending=False,
            advance=advance,
        )

    reference = cast(camera)
    frame = renderer.render(
        model,
        scene,
        plans,
        camera,
        None,
        size=size,
        float_textures=True,
        sharp_textures=True,
        with_inputs=True,
        white=white,
        layer_tables=layer_tables,
    )
    inputs = inputs_of(frame)
    changes = steepness(lambda other: cast(other).rgba[..., :3], camera, size, reference.rgba[..., :3])
    return _Exact(inputs, plans, reference, same_surface(inputs, reference, camera), changes, lights)
