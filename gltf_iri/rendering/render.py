"""The renderer: a scene under its lights and an environment, through a camera, to a float picture."""

from __future__ import annotations

import time
from collections.abc import Collection, Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.material.interface import material_textures, material_uniforms
from gltf_iri.material.material import DEFAULT_MATERIAL, Material
from gltf_iri.planning.decide import complete_plans
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.permutation import permutation, plan_scene_effects, primitive_effects
from gltf_iri.rendering.background import Background
from gltf_iri.rendering.context import renderer_name
from gltf_iri.rendering.draw import Draw, draw_primitives
from gltf_iri.rendering.frame import INPUT_TARGETS, Frame
from gltf_iri.rendering.geometry import GeometryStore, placement_uniforms
from gltf_iri.rendering.image_light import ImageLightStore
from gltf_iri.rendering.programs import ProgramStore, check_method
from gltf_iri.rendering.punctual_lights import lights_texture
from gltf_iri.rendering.switches import SHADING_INPUTS
from gltf_iri.rendering.targets import Targets, check_size, shading_inputs
from gltf_iri.rendering.textures import TextureStore
from gltf_iri.rendering.view import background_uniforms, view_uniforms
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Environment, Primitive, Scene

if TYPE_CHECKING:
    import moderngl

__all__ = ["Renderer"]


class Renderer:
    """Draws with one OpenGL context; keeps programs, the DFG table and prefiltered environments."""

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context
        self._programs = ProgramStore(context)
        self._image_lights = ImageLightStore(context)
        self._background: Background | None = None

    def render(
        self,
        model: Model,
        scene: Scene,
        plans: Sequence[MaterialPlan],
        camera: Camera,
        environment: Environment | None,
        *,
        size: tuple[int, int],
        samples: int = 4,
        float_textures: bool = False,
        sharp_textures: bool = False,
        with_inputs: bool = False,
    ) -> Frame:
        """Return the picture of `scene`; its milliseconds are drawing alone, without uploads and compiling.

        Parameters
        ----------
        plans : one for each material; the default material's is added where it is missing (`complete_plans`).
        environment : image light and what is behind the scene; None for neither.
        size : width and height in pixels.
        samples : samples a pixel; 0 or 1 for its centre alone.
        float_textures : textures as linear float32 (see `TextureStore`).
        sharp_textures : textures without minification, as the CPU reference samples them.
        with_inputs : also return what each pixel's centre was shaded with. There is then no background, and
            blended materials are drawn as if opaque: an input belongs to one surface.

        Raises UsageError for a size out of range and a method without GLSL, MissingCapabilityError where
        OpenGL takes fewer samples or smaller textures than are needed.
        """
        if with_inputs:
            samples = 0
        check_size(self.context, size, samples)
        plans = complete_plans(plans, scene)
        for plan in plans:
            check_method(plan.method)
        surroundings = plan_scene_effects(scene, environment)
        geometry = GeometryStore(self.context)
        textures = TextureStore(
            self.context, model.document, float_textures=float_textures, base_level_only=sharp_textures
        )
        targets = Targets(self.context, size, samples=samples, count=len(INPUT_TARGETS) if with_inputs else 1)
        lights = lights_texture(self.context, scene.lights)
        light = {"u_lights": lights}
        try:
            if environment is not None:
                light |= self._image_lights.textures(environment)
            shared = view_uniforms(camera, size)
            shared["u_light_count"] = len(scene.lights)
            draws = []
            for primitive in scene.primitives:
                number, plan, material = _material_of(primitive, plans, model)
                defines = permutation(plan, primitive_effects(primitive), surroundings)
                if with_inputs:
                    defines = (*defines, SHADING_INPUTS)
                program = self._programs.get(defines)
                placed = placement_uniforms(primitive) | {"u_material": number}
                sampled = {n: textures.get(b) for n, b in material_textures(material, defines).items()}
                draws.append(
                    Draw(
                        primitive,
                        plan,
                        program,
                        geometry.vertex_array(primitive, program),
                        shared | placed | material_uniforms(material, defines),
                        light | sampled,
                    )
                )
            self.context.finish()
            started = time.perf_counter()
            framebuffer = targets.begin()
            if environment is not None and not with_inputs:
                shared |= background_uniforms(camera, size)
                self._draw_background(framebuffer, environment, shared, light)
            draw_primitives(framebuffer, draws, camera, is_blending=not with_inputs)
            self.context.finish()
            milliseconds = (time.perf_counter() - started) * 1000.0
            rgba = targets.read()
            return Frame(
                rgba,
                renderer_name(self.context),
                milliseconds,
                (*_notes(draws, surroundings, with_inputs=with_inputs), *_overflow(rgba)),
                shading_inputs(targets) if with_inputs else None,
            )
        finally:
            lights.release()
            targets.release()
            textures.release()
            geometry.release()

    def release(self) -> None:
        """Give everything back to OpenGL; the context stays the caller's."""
        self._programs.release()
        self._image_lights.release()
        if self._background is not None:
            self._background.release()

    def _draw_background(
        self,
        framebuffer: moderngl.Framebuffer,
        environment: Environment,
        uniforms: dict[str, Any],
        textures: dict[str, moderngl.Texture],
    ) -> None:
        if environment.backdrop is not None:
            framebuffer.clear(*environment.backdrop, 0.0, depth=1.0)
            return
        if self._background is None:
            self._background = Background(self.context)
        self._background.draw(uniforms, textures)


def _material_of(
    primitive: Primitive, plans: Sequence[MaterialPlan], model: Model
) -> tuple[int, MaterialPlan, Material]:
    """Return the place of the primitive's plan among `plans`, the plan, and the material."""
    number, plan = next((i, plan) for i, plan in enumerate(plans) if plan.index == primitive.material)
    return number, plan, Material() if plan.index == DEFAULT_MATERIAL else model.materials[plan.index]


def _overflow(rgba: NDArray[np.float32]) -> Iterable[str]:
    count = int((~np.isfinite(rgba)).any(axis=-1).sum())
    if count:
        yield f"{count} pixels are beyond single precision: a light or an emission of the file is too strong."


def _notes(draws: Sequence[Draw], surroundings: Collection[Effect], *, with_inputs: bool) -> Iterable[str]:
    if not surroundings and any(not draw.plan.calls_for(Effect.UNLIT) for draw in draws):
        yield "There is no light: neither an environment nor a light in the scene."
    if with_inputs and any(draw.is_blended for draw in draws):
        yield "Blended materials are drawn as if opaque: the inputs of a pixel belong to one surface."
