"""Reference implementation of KHR_materials_iridescence: evaluator, renderer and spectral truth for glTF.

The Python face is five functions; the errors they raise stand in `gltf_iri.errors`. Importing the package
imports none of the machinery behind them.

>>> import gltf_iri
>>> gltf_iri.evaluate("spectral", cos_theta_1=1.0, thickness_nm=0.0, base_ior=1.5).rgb.round(6).tolist()
[0.04, 0.04, 0.04]
"""

from __future__ import annotations

import typing

if typing.TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence
    from os import PathLike

    from numpy.typing import ArrayLike

    from gltf_iri.baking.baked import BakedTable
    from gltf_iri.baking.baked_layers import BakedLayers
    from gltf_iri.colour.spaces import Light
    from gltf_iri.evaluation.film import Dispersion, Evaluation
    from gltf_iri.material.material import Material
    from gltf_iri.planning.material_plan import MaterialPlan
    from gltf_iri.planning.reach import Lobe
    from gltf_iri.rendering.frame import Frame
    from gltf_iri.scene.load import Model
    from gltf_iri.scene.model import Camera, Environment
    from gltf_iri.validation.report import Report

__all__ = ["__version__", "evaluate", "load", "plan", "render", "validate"]

__version__ = "0.1.0"


def load(path: str | PathLike[str]) -> Model:
    """Open a .gltf or .glb file; ``.materials`` holds its materials, ``.scene()`` its geometry.

    Raises UsageError where `path` does not exist, AssetError where the file is broken or requires an
    extension that is not supported. Geometry and images are read, and may raise, when they are asked for.
    """
    from gltf_iri.scene.load import load as open_model

    return open_model(path)


def plan(
    material: Material, *, index: int = -1, method: str | None = None, budget: float | None = None
) -> MaterialPlan:
    """Return what `material` calls for: effects, film method, and the reason for all that is left out.

    index : the material's place in its file.
    method : name of a film method; None leaves the choice to the plan.
    budget : instead of a method, the most that the p95 of CIEDE2000 against the truth may be, for light from
        one direction on a million pixels in GLSL; ``.way`` is then the cheapest that keeps it. Textures may
        hold anything here; `gltf_iri.budgets.plans.plans_within` looks at them.

    Raises UsageError where there is no such film method or no way that keeps the budget.
    """
    from gltf_iri.planning.decide import plan_material

    if budget is None:
        return plan_material(material, index, method=method)
    from gltf_iri.budgets.choose import Asked
    from gltf_iri.budgets.plans import plan_within

    _check_alone(method)
    return plan_within(material, index, Asked(budget, 1e6, "glsl"))


def evaluate(
    method: str | None = None,
    *,
    cos_theta_1: ArrayLike,
    thickness_nm: ArrayLike | None = None,
    film_ior: ArrayLike | Dispersion | None = None,
    base_f0: ArrayLike | None = None,
    base_ior: ArrayLike | Dispersion | None = None,
    base_nk: ArrayLike | None = None,
    base_edge_tint: ArrayLike | None = None,
    outside_ior: ArrayLike | None = None,
    bragg: tuple[ArrayLike, ArrayLike, ArrayLike, ArrayLike, ArrayLike] | None = None,
    layers: Sequence[Sequence[ArrayLike]] | None = None,
    base_diffuse: ArrayLike | None = None,
    base_metal: ArrayLike | None = None,
    base_alpha: float | None = None,
    light: Sequence[ArrayLike] | None = None,
    host_ior: ArrayLike | None = None,
    white: str | Light = "D65",
    backend: str = "auto",
    parameters: Mapping[str, float | str] | None = None,
    budget: float | None = None,
) -> Evaluation:
    """Return the reflectance colour of a film over a base, a Bragg mirror, or rough layers of such mirrors.

    ``.rgb`` (..., 3) is linear Rec.709 at factor 1, not gamut-clamped: truth may be negative in a channel.
    All arrays of shape (...) broadcast together. Equation and source stand with each method in
    `gltf_iri.evaluation`.

    Parameters
    ----------
    method : one of gltf_iri.planning.method.METHODS; None takes "khr-guarded" for a film, "yeh-spectral" for
        a mirror and "layers-single" for layers.
    cos_theta_1 : (...) cosine of the angle outside, in [0, 1].
    thickness_nm : (...) thickness of the film in nanometres, ≥ 0; a film needs it.
    film_ior, outside_ior : (...) real refractive indices; without them glTF's default 1.3, and air's 1. The
        film's may be a function of wavelength, (k,) nm → (k,).
    base_f0 : a number or (..., 3), reflectance of the base at normal incidence under air, in [0, 1].
    base_ior : (...) real refractive index of the base, or a function of wavelength, n or n + ik.
    base_nk : (..., 2) index and extinction n, k of the base, k ≥ 0.
    base_edge_tint : (..., 3) in [0, 1], with base_f0: the metal of both colours (Gulbrandsen 2014).
    bragg : n1, n2, d1_nm, d2_nm and the number of cells of a mirror, each (...): the light meets the n1 film
        of each cell first, and beyond the last cell lies n1. Complex indices n + ik, k ≥ 0, absorb; only
        "yeh-spectral" takes them.
    layers : outermost first, each n1, n2, d1_nm, d2_nm, cells and α (perceptual roughness squared): what the
        stack reflects over all directions, with ``.transmitted``, ``.absorbed`` and ``.from_base`` beside it.
    base_diffuse, base_metal, base_alpha : under the layers a Lambertian share, a number or (3,), and beside
        it a metal of that F0 and roughness α (0.1); without them nothing comes back from below.
    light : of layers, its cosine and cosφ of the turn to the viewer (−1, the mirror's side, without it):
        ``.rgb`` is then the BRDF f_r in 1/sr, lit from there and seen at cos_theta_1. Only then numbers in
        `layers` may be (...).
    host_ior : (...) real index outside the mirror, or of what the layers lie in; without it n1, of the first.
    white : "D65", "E", or a `gltf_iri.colour.spaces.Light`: any illuminant, with any RGB space.
    backend : "auto", "numpy" or "numba" (compiled loops, the extra `fast`); the result names the one used.
    parameters : of the method, by name (``Method.parameters``).
    budget : instead of a method, the most that the p95 of CIEDE2000 against the truth may be: the cheapest
        method that keeps it is taken, and the result tells its bound as ``.delta_e``; 0 is the truth.

    At most one of the three bases; without any, glTF's default index 1.5. Raises UsageError for an unknown
    method, white, backend or parameter, for two bases, for film, mirror or layers at once, for values out of
    range, shapes that do not broadcast and budgets that nothing keeps; MissingCapabilityError for "numba"
    where it is not installed.
    """
    from gltf_iri.evaluation.described import SeenStack, described
    from gltf_iri.evaluation.mirror import Mirror
    from gltf_iri.evaluation.registry import evaluate as evaluate_subject
    from gltf_iri.evaluation.stack_evaluation import evaluate_stack
    from gltf_iri.planning.method import DEFAULT_LAYERS_METHOD, DEFAULT_METHOD, DEFAULT_MIRROR_METHOD

    subject = described(
        cos_theta_1,
        thickness_nm=thickness_nm,
        film_ior=film_ior,
        outside_ior=outside_ior,
        base_f0=base_f0,
        base_ior=base_ior,
        base_nk=base_nk,
        base_edge_tint=base_edge_tint,
        bragg=bragg,
        host_ior=host_ior,
        layers=layers,
        base_diffuse=base_diffuse,
        base_metal=base_metal,
        base_alpha=base_alpha,
        light=light,
    )
    if budget is not None:
        from gltf_iri.budgets.stacks import evaluate_stack_within
        from gltf_iri.budgets.subjects import evaluate_within

        _check_alone(method or parameters)
        if isinstance(subject, SeenStack):
            seen = (subject.stack, subject.cos_theta, budget, subject.light)
            return evaluate_stack_within(*seen, white=white, backend=backend)
        return evaluate_within(subject, budget, white=white, backend=backend)
    set_to = parameters or {}
    if isinstance(subject, SeenStack):
        name = DEFAULT_LAYERS_METHOD if method is None else method
        of_stack = (subject.stack, subject.cos_theta, subject.light)
        return evaluate_stack(name, *of_stack, white=white, backend=backend, parameters=set_to)
    default = DEFAULT_MIRROR_METHOD if isinstance(subject, Mirror) else DEFAULT_METHOD
    name = default if method is None else method
    return evaluate_subject(name, subject, white=white, backend=backend, parameters=set_to)


def render(
    model: Model,
    *,
    size: tuple[int, int] = (640, 480),
    scene: int | None = None,
    camera: Camera | int | None = None,
    environment: Environment | str | PathLike[str] | None = "studio",
    method: str | None = None,
    samples: int = 4,
    budget: float | None = None,
) -> Frame:
    """Draw one scene of `model` without a window; ``.rgba`` is float32 (height, width, 4), row 0 at the top.

    Linear Rec.709 radiance before exposure and tone mapping.

    Parameters
    ----------
    size : width and height in pixels.
    scene : index of the scene; None for the file's default scene.
    camera : a camera, an index of the scene's, or None for its first or, without any, to frame it.
    environment : image light and background: "studio", "white", a .hdr or .exr file, or None for neither.
    method : name of the film method; None leaves the choice to the plan.
    samples : per pixel, a power of two; 1 for its centre alone.
    budget : instead of a method, the most that the p95 of CIEDE2000 against the truth may be: each film is
        drawn the cheapest way that keeps it over all that its textures hold; 0 is the truth.

    Raises AssetError where geometry or images are broken, UsageError for a camera, file, size or method that
    does not exist or cannot be drawn and for a budget that nothing keeps, MissingCapabilityError where the
    machine has no OpenGL.
    """
    import os

    from gltf_iri.planning.decide import plan_materials
    from gltf_iri.rendering.context import create_context
    from gltf_iri.rendering.render import Renderer
    from gltf_iri.scene.choose import choose_camera, choose_environment
    from gltf_iri.scene.model import Camera

    shown = model.scene(scene)
    seen_from = camera if isinstance(camera, Camera) else choose_camera(shown, camera, size)
    light = choose_environment(environment) if isinstance(environment, str | os.PathLike) else environment
    tables: Mapping[int, Mapping[Lobe, BakedTable]] = {}
    if budget is None:
        plans = plan_materials(model.materials, method=method, document=model.document, scene=shown)
    else:
        from gltf_iri.baking.fill import bake_plans
        from gltf_iri.budgets.plans import plans_within

        _check_alone(method)
        pixels, is_lit = size[0] * size[1], light is not None and bool(light.radiance.any())
        plans = plans_within(model, shown, budget, size_pixels=pixels, has_image_light=is_lit)
        tables = bake_plans(plans)
    layer_tables: Mapping[int, BakedLayers] = {}
    if any(plan.layers is not None for plan in plans):
        from gltf_iri.baking.layer_fill import bake_layer_plans

        layer_tables = bake_layer_plans(plans)
    context = create_context()
    try:
        return Renderer(context).render(
            model,
            shown,
            plans,
            seen_from,
            light,
            size=size,
            samples=samples,
            tables=tables,
            layer_tables=layer_tables,
        )
    finally:
        context.release()


def validate(
    source: str | PathLike[str] | bytes,
    *,
    uri: str | None = None,
    folder: str | PathLike[str] | None = None,
    ignore: Iterable[str] = (),
    only: Iterable[str] = (),
    override: Mapping[str, int | str] | None = None,
    max_issues: int = 0,
    resources: bool = True,
    optics: bool = False,
) -> Report:
    """Tell what is wrong with a glTF file, as the Khronos validator does, and what its films and layers do.

    ``.issues`` are the remarks, from severity 0, an error, to 3, a hint; ``.has_errors`` is the verdict, and
    ``.to_json()`` the report in the Khronos validator's format. Codes that begin with IRI_ are our own.

    Parameters
    ----------
    source : path of a .gltf or .glb file, or its bytes.
    uri : what the report calls the file; without it the path.
    folder : where the files that it names lie; without it the file's own folder, for bytes none.
    ignore, only : codes to leave out, or to tell alone.
    override : code to severity, 0 to 3 or "error", "warning", "information", "hint".
    max_issues : stop after so many remarks; 0 for all.
    resources : whether buffers and pictures beside the file are read.
    optics : measure in ΔE what the remarks on films and layers mean, which takes seconds.

    Raises UsageError where `source` cannot be read or a code is unknown, AssetError where it is too large.
    """
    from pathlib import Path

    from gltf_iri.validation.options import Options
    from gltf_iri.validation.validate import validate as validate_file

    options = Options(max_issues=max_issues, resources=resources, optics=optics)
    if ignore or only or override or max_issues:
        from gltf_iri.validation.config import settings_of

        said = settings_of(ignore, only, override or {}, max_issues)
        options.ignore, options.only, options.override = said.ignore, said.only, said.override
    return validate_file(source, uri=uri, folder=None if folder is None else Path(folder), options=options)


def _check_alone(chosen: object) -> None:
    from gltf_iri.errors import UsageError

    if chosen:
        raise UsageError("A budget chooses method and parameters: give it alone.")
