"""Renders a file with its shading inputs and has the frame judged."""

from __future__ import annotations

import platform
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from types import MappingProxyType

import numpy as np

from gltf_iri import __version__
from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.comparison.figures import TONEMAP
from gltf_iri.comparison.judge import Shot, judge
from gltf_iri.comparison.result import Comparison
from gltf_iri.material.material import Material
from gltf_iri.planning.decide import complete_plans
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.reach import Lobe
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Environment, Scene

__all__ = ["STEPS", "compare"]

STEPS = ("drawing", "drawing with 8-bit textures", "shading again in Python")


def compare(
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
    tables: Mapping[int, Mapping[Lobe, BakedTable]] = MappingProxyType({}),
    layer_tables: Mapping[int, BakedLayers] = MappingProxyType({}),
    advance: Callable[[], None] = lambda: None,
) -> Comparison:
    """Draw `scene`, shade every pixel again in float64, by the plan's method and by truth, and compare.

    Parameters
    ----------
    renderer : stays the caller's; one may serve many files.
    plans : one for each material of `model`; the default material's is added where the scene uses it.
    size : width and height in pixels; each pixel is compared, none is sampled for another.
    exposure : in EV; linear light is multiplied by 2^exposure before ΔE2000 and for the pictures.
    white : of the truth and of the methods that know one, "D65" or "E".
    tables : the films' tables of the plans whose way has some (`baking.fill.bake_plans`), under `white`.
    layer_tables : those of the plans' Bragg layers (`baking.layer_fill.bake_layer_plans`), under `white`.
    advance : called after each of STEPS.

    Of a plan with a way, image light is held against the truth's mean over the facets, not against F(N·V).

    Raises UsageError for an unknown white, a method without GLSL or a missing table,
    MissingCapabilityError without OpenGL.
    """
    plans = complete_plans(plans, scene)
    arguments = (model, scene, plans, camera, environment)
    has_textures = any(effect.value.endswith("-texture") for plan in plans for effect in plan.effects)
    draw = partial(
        renderer.render,
        *arguments,
        size=size,
        with_inputs=True,
        white=white,
        tables=tables,
        layer_tables=layer_tables,
    )
    fine = draw(float_textures=True)
    advance()
    coarse = None
    if has_textures:
        coarse = draw()
    advance()
    shot = Shot(
        file=model.path.name,
        materials=(*model.materials, Material()),  # DEFAULT_MATERIAL, −1, finds the last
        plans=plans,
        lights=scene.lights,
        camera=camera,
        white=white,
        tables=tables,
        layer_tables=layer_tables,
        exposure=2.0**exposure,
        setup={
            "size": list(size),
            "camera": camera.name,
            "environment": environment.name if environment is not None else "none",
            "exposure": exposure,
            "tonemap": TONEMAP,
        },
        program={"gltf_iri": __version__, "python": platform.python_version(), "numpy": np.__version__},
        notes=(
            *model.notes,
            *model.document.notes,  # by now with what was found in its pictures
            *scene.notes,
            *(environment.notes if environment is not None else ()),
        ),
    )
    comparison = judge(fine, shot, coarse=coarse)
    advance()
    return comparison
