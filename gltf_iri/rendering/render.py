"""The renderer: a scene under its lights and an environment, through a camera, to a float picture."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.errors import MissingCapabilityError
from gltf_iri.planning.decide import complete_plans
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.permutation import plan_scene_effects
from gltf_iri.planning.reach import Lobe
from gltf_iri.rendering.background import BLUR, Background
from gltf_iri.rendering.capture import Capturing
from gltf_iri.rendering.context import renderer_name
from gltf_iri.rendering.draw import Draw, draw_faces, draw_opaque
from gltf_iri.rendering.film_tables import FilmTableStore, checked_tables
from gltf_iri.rendering.frame import BRAGG_INPUT_TARGETS, INPUT_TARGETS, LAYER_INPUT_TARGETS, Frame
from gltf_iri.rendering.geometry import GeometryStore
from gltf_iri.rendering.image_light import ImageLightStore
from gltf_iri.rendering.layer_loops import check_loops
from gltf_iri.rendering.layer_tables import LayerTableStore, checked_layers
from gltf_iri.rendering.optics_tables import OpticsTableStore
from gltf_iri.rendering.passes import PassTimes
from gltf_iri.rendering.prepare import (
    FIRST_INPUTS,
    PICTURE,
    SECOND_INPUTS,
    THIRD_INPUTS,
    needed_targets,
    prepare_draws,
    used_plans,
)
from gltf_iri.rendering.programs import ProgramStore, computed_method
from gltf_iri.rendering.punctual_lights import lights_texture
from gltf_iri.rendering.see_through import MAX_CAPTURES, group_sheets, sheets_in_order
from gltf_iri.rendering.targets import Targets, check_size, shading_inputs
from gltf_iri.rendering.textures import TextureStore
from gltf_iri.rendering.view import background_uniforms, view_uniforms
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Environment, Scene

if TYPE_CHECKING:
    import moderngl

__all__ = ["Renderer"]

_TARGET_COUNTS: Final = {
    PICTURE: 1,
    FIRST_INPUTS: len(INPUT_TARGETS),
    SECOND_INPUTS: len(LAYER_INPUT_TARGETS),
    THIRD_INPUTS: len(BRAGG_INPUT_TARGETS),
}


class Renderer:
    """Draws with one OpenGL context; keeps programs, tables and prefiltered environments."""

    def __init__(self, context: moderngl.Context) -> None:
        self.context = context
        self._programs = ProgramStore(context)
        self._image_lights = ImageLightStore(context)
        self._optics_tables = OpticsTableStore(context)
        self._background: Background | None = None
        self._capturing: Capturing | None = None

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
        white: str = "D65",
        tables: Mapping[int, Mapping[Lobe, BakedTable]] = MappingProxyType({}),
        layer_tables: Mapping[int, BakedLayers] = MappingProxyType({}),
    ) -> Frame:
        """Return the picture of `scene`; its milliseconds are drawing alone, without uploads and compiling.

        Parameters
        ----------
        plans : one for each material; the default material's is added where it is missing (`complete_plans`).
        environment : image light and what is behind the scene; None for neither.
        size : width and height in pixels.
        samples : samples a pixel; 0 or 1 for its centre alone.
        float_textures : textures as linear float32 (see `TextureStore`).
        sharp_textures : as the CPU reference samples: textures without minification, and the environment and
            what is seen through glass in the direction of the pixel's centre, not over all that it spans.
        with_inputs : also return what each pixel's centre was shaded with; the picture then has one sample a
            pixel. In the inputs blended materials are as if opaque, and what light passes through is the
            surface in front: an input belongs to one surface.
        white : the illuminant, "D65" or "E", under which film methods with a table of it integrate.
        tables : the films' tables of the plans whose way has some (`baking.fill.bake_plans`), under `white`.
        layer_tables : those of the plans' Bragg layers (`baking.layer_fill.bake_layer_plans`), under `white`.

        Raises UsageError for a size out of range, a method without GLSL and a missing table,
        MissingCapabilityError where OpenGL takes fewer samples or smaller textures than are needed.
        """
        import moderngl

        if with_inputs:
            samples = 0
        check_size(self.context, size, samples)
        plans = complete_plans(plans, scene)
        surroundings = plan_scene_effects(scene, environment)
        has_image_light = Effect.IMAGE_LIGHT in surroundings
        for plan in plans:
            check_loops(plan, renderer_name(self.context), len(scene.lights), has_image_light=has_image_light)
            computed_method(plan)
            checked_tables(plan, tables, white)
            checked_layers(plan, layer_tables, white)
        geometry = GeometryStore(self.context)
        textures = TextureStore(
            self.context, model.document, float_textures=float_textures, base_level_only=sharp_textures
        )
        used = used_plans(scene, plans)
        names = needed_targets(used, with_inputs=with_inputs)
        times = PassTimes(self.context)
        film_tables = FilmTableStore(self.context, tables, white)
        layers = LayerTableStore(self.context, layer_tables, white)
        lights = lights_texture(self.context, scene.lights)
        targets: dict[str, Targets] = {}
        try:
            for name in names:
                targets[name] = Targets(
                    self.context,
                    size,
                    samples=samples if name == PICTURE else 0,
                    count=_TARGET_COUNTS[name],
                )
            has_sheen = any(plan.calls_for(Effect.SHEEN) for plan in used)
            with times.measure("image light"):
                if environment is None:
                    light = self._image_lights.tables(with_sheen=has_sheen)
                else:
                    light = self._image_lights.textures(environment, with_sheen=has_sheen)
            light = light | {"u_lights": lights}
            shared = view_uniforms(camera, size) | _surrounding_uniforms(environment)
            shared["u_light_count"] = len(scene.lights)
            shared["u_footprint"] = 0.0 if sharp_textures else 1.0
            with times.measure("uploads"):
                draws = list(
                    prepare_draws(
                        scene,
                        plans,
                        model.materials,
                        surroundings,
                        names,
                        self._programs,
                        geometry,
                        textures,
                        shared,
                        light,
                        self._optics_tables,
                        film_tables,
                        layers,
                        white,
                    )
                )
            notes = self._draw_surfaces(draws, targets, camera, size, times)
            if environment is not None:
                if self._background is None:
                    self._background = Background(self.context)
                with times.measure("background"):
                    targets[PICTURE].drawn.use()
                    self._background.draw(shared | background_uniforms(camera, size), light)
            with times.measure("read"):
                rgba = targets[PICTURE].read()
                inputs = (
                    shading_inputs(
                        targets[FIRST_INPUTS], targets.get(SECOND_INPUTS), targets.get(THIRD_INPUTS)
                    )
                    if with_inputs
                    else None
                )
            return Frame(
                rgba,
                renderer_name(self.context),
                times.drawing,
                (*_notes(draws, surroundings, with_inputs=with_inputs), *notes, *_overflow(rgba)),
                inputs,
                times.milliseconds,
            )
        except moderngl.Error as error:  # what a driver without memory says
            raise MissingCapabilityError(
                f"This OpenGL gave up, most likely for want of memory ({error}): choose a smaller picture."
            ) from error
        finally:
            if self._capturing is not None:
                self._capturing.end()
            lights.release()
            for target in targets.values():
                target.release()
            textures.release()
            film_tables.release()
            layers.release()
            geometry.release()
            self._programs.trim()

    def release(self) -> None:
        """Give everything back to OpenGL; the context stays the caller's."""
        self._programs.release()
        self._image_lights.release()
        self._optics_tables.release()
        for used in (self._background, self._capturing):
            if used is not None:
                used.release()

    def _draw_surfaces(
        self,
        draws: Sequence[Draw],
        targets: Mapping[str, Targets],
        camera: Camera,
        size: tuple[int, int],
        times: PassTimes,
    ) -> tuple[str, ...]:
        """Draw what is opaque, then what is not from the farthest to the nearest; return notes on it."""
        for name, target in targets.items():
            with times.measure("opaque" if name == PICTURE else "shading inputs"):
                target.drawn.use()
                target.clear()
                draw_opaque(self.context, draws, name)
        captured: Mapping[str, moderngl.Texture] = {}
        groups = tuple(group_sheets(sheets_in_order(draws, camera, size)))
        for group in groups:
            if group.is_capturing:
                with times.measure("captures"):
                    captured = self._capture(targets[PICTURE], camera, size)
            for name, target in targets.items():
                with times.measure("see-through" if name == PICTURE else "shading inputs"):
                    target.drawn.use()
                    for sheet in group.sheets:
                        draw_faces(
                            target.drawn,
                            sheet.draw,
                            sheet.culled,
                            captured,
                            target=name,
                            is_blending=name == PICTURE,
                        )
        if sum(group.is_capturing for group in groups) < MAX_CAPTURES:
            return ()
        return (
            f"Transmissive surfaces lie over each other {MAX_CAPTURES} deep or more; the nearest of them see "
            "the same picture behind them.",
        )

    def _capture(
        self, target: Targets, camera: Camera, size: tuple[int, int]
    ) -> Mapping[str, moderngl.Texture]:
        if self._capturing is None:
            self._capturing = Capturing(self.context)
        return self._capturing.take(target.drawn, camera, size)


def _surrounding_uniforms(environment: Environment | None) -> dict[str, Any]:
    """Return what lies behind the scene, for the background and for what is seen through."""
    backdrop = None if environment is None else environment.backdrop
    return {
        "u_backdrop": (0.0, 0.0, 0.0, 0.0) if backdrop is None else (*backdrop, 1.0),
        "u_background_blur": BLUR,
    }


def _overflow(rgba: NDArray[np.float32]) -> Iterable[str]:
    count = int((~np.isfinite(rgba)).any(axis=-1).sum())
    if count:
        yield f"{count} pixels are beyond single precision: a light or an emission of the file is too strong."


def _notes(draws: Sequence[Draw], surroundings: Collection[Effect], *, with_inputs: bool) -> Iterable[str]:
    if not surroundings and any(not draw.plan.calls_for(Effect.UNLIT) for draw in draws):
        yield "There is no light: neither an environment nor a light in the scene."
    if with_inputs and any(draw.is_blended for draw in draws):
        yield "In the shading inputs blended materials are as if opaque: a pixel belongs to one surface."
