"""From a frame with its shading inputs to a comparison: Python's colours, truth's colours, and the figures.

No OpenGL here: a frame from any renderer that writes the inputs can be judged.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.spaces import White
from gltf_iri.comparison.methods import BRANCH, TRUTH, film_method, table_method, white_of
from gltf_iri.comparison.metric import Agreement, ColourError, agreement, colour_error, relative_deviation
from gltf_iri.comparison.pixels import image_light_of_pixels, is_rough, surface_of_pixels
from gltf_iri.comparison.result import Comparison, MaterialResult, PictureResult, Pictures, Split
from gltf_iri.comparison.shade import shade
from gltf_iri.comparison.truth import averaged_truth
from gltf_iri.errors import AssetError, UsageError
from gltf_iri.material.bragg import Bragg
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.reach import Lobe
from gltf_iri.reference.film_on import FilmMethod
from gltf_iri.reference.layers_method import LAYERS_TRUTH, layers_method
from gltf_iri.rendering.film_tables import checked_tables
from gltf_iri.rendering.frame import Frame, ShadingInputs
from gltf_iri.scene.model import Camera, Light

__all__ = ["Shot", "inputs_of", "judge"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Shot:
    """What is needed beside the frames to shade their pixels again; all tables as in `Renderer.render`."""

    file: str
    materials: Sequence[Material]
    plans: Sequence[MaterialPlan]
    lights: Sequence[Light]
    camera: Camera
    white: str
    exposure: float  # factor on linear light
    setup: Mapping[str, Any]
    program: Mapping[str, str]
    notes: tuple[str, ...] = ()
    tables: Mapping[int, Mapping[Lobe, BakedTable]] = field(default_factory=dict)
    layer_tables: Mapping[int, BakedLayers] = field(default_factory=dict)


def judge(frame: Frame, shot: Shot, *, coarse: Frame | None = None) -> Comparison:
    """Shade every drawn pixel of `frame` again and compare.

    Parameters
    ----------
    frame : rendered with float textures and with its shading inputs; UsageError without them.
    shot : materials, plans, lights and camera that it was rendered with.
    coarse : the same picture with 8-bit textures, also with inputs; None where there are no textures.
    """
    inputs = inputs_of(frame)
    coarse_inputs = None if coarse is None else inputs_of(coarse)
    canvas = np.zeros(inputs.colour.shape)
    pictures = Pictures(
        glsl=np.where((inputs.material >= 0)[..., None], inputs.colour, 0.0).astype(np.float64),
        python=canvas.copy(),
        truth=canvas.copy(),
        drawn=inputs.material >= 0,
        deviation=np.zeros(canvas.shape[:2]),
        delta_e=np.zeros(canvas.shape[:2]),
        texture_delta_e=None if coarse is None else np.zeros(canvas.shape[:2]),
    )
    compared = np.zeros(canvas.shape[:2], dtype=np.bool_)
    results = []
    for plan, mask in _masks(inputs, shot.plans):
        results.append(_judge_material(shot, plan, inputs, mask, pictures, compared, coarse_inputs))
    _draw_differences(pictures, compared, shot.exposure)
    if coarse_inputs is not None:
        _draw_texture_difference(pictures, inputs, coarse_inputs, shot.exposure)
    whole = PictureResult(
        _split(inputs, shot.plans, compared, pictures),
        colour_error(pictures.python[compared], pictures.truth[compared], exposure=shot.exposure),
        _eight_bit(inputs, coarse_inputs, compared, shot.exposure),
    )
    return Comparison(
        shot.file,
        shot.white,
        {**shot.setup, "pixels_drawn": int(pictures.drawn.sum())},
        {**shot.program, "renderer": frame.renderer},
        tuple(results),
        whole,
        pictures,
        tuple(dict.fromkeys((*shot.notes, *frame.notes))),
    )


def _judge_material(
    shot: Shot,
    plan: MaterialPlan,
    inputs: ShadingInputs,
    mask: Mask,
    pictures: Pictures,
    compared: Mask,
    coarse: ShadingInputs | None,
) -> MaterialResult:
    """Shade one material's pixels with its method and with truth; writes into `pictures` and `compared`."""
    film_ior, method, truth = _film_of(shot, plan)
    surface, image = surface_of_pixels(inputs, mask, shot.camera), image_light_of_pixels(inputs, mask)
    try:
        layers = layers_method(plan, None, shot.layer_tables, shot.white)
        mine = shade(surface, image, plan, film_ior, shot.lights, method, layers)
    except UsageError as error:  # legal in glTF, but no film: 10^30 nm
        what, extension = str(error).rstrip("."), (Bragg if plan.layers else Iridescence).EXTENSION
        raise AssetError(what, pointer=f"/materials/{plan.index}/extensions/{extension}") from None
    pictures.python[mask] = mine.rgb
    left_out = _left_out(mine.undefined, mine.rgb, pictures.glsl[mask])
    compared[mask] = ~left_out
    judged = mask & compared
    result = MaterialResult(
        plan=plan,
        glsl_vs_python=_split(inputs, shot.plans, judged, pictures),
        method_white=None,
        truth_white=None,
        method_vs_truth=None,
        picture_vs_truth=None,
        eight_bit_textures=_eight_bit(inputs, coarse, judged, shot.exposure),
        undefined={case: int(rows.sum()) for case, rows in sorted(mine.undefined.items()) if rows.any()},
        left_out=int(left_out.sum()),
    )
    if not mine.has_film.any():
        pictures.truth[mask] = mine.rgb
        return result
    true_layers = layers_method(plan, LAYERS_TRUTH, {}, shot.white)
    exact = shade(surface, image, plan, film_ior, shot.lights, truth, true_layers)
    pictures.truth[mask] = exact.rgb
    filmed, seen = mine.has_film & ~left_out, ~left_out
    return replace(
        result,
        method_white=shot.white if plan.layers is not None else white_of(plan.method or "", mine.white),
        truth_white=shot.white if plan.layers is not None else exact.white,
        method_vs_truth=colour_error(mine.film[filmed].reshape(-1, 3), exact.film[filmed].reshape(-1, 3)),
        picture_vs_truth=colour_error(mine.rgb[seen], exact.rgb[seen], exposure=shot.exposure),
    )


def _film_of(shot: Shot, plan: MaterialPlan) -> tuple[float, FilmMethod, FilmMethod]:
    """Return the film's index, the plan's method and the truth; without a film, none of them is used."""
    white = cast(White, shot.white)  # evaluators refuse names that they do not know
    is_averaged = plan.way is not None or plan.calls_for(Effect.IRIDESCENCE_THICKNESS_SPREAD)
    truth = averaged_truth(white) if is_averaged else film_method(TRUTH, white)
    if not plan.calls_for(Effect.IRIDESCENCE) or plan.method is None:
        return 1.0, truth, truth
    iridescence = plan.material_in(shot.materials).iridescence
    if iridescence is None:
        raise UsageError(f"The plan of material {plan.index} has a film, but the material has none.")
    # The shader receives the index as float32, and a film of 10 µm shows the rounding.
    parameters = {} if plan.way is None else plan.way.parameters
    method = film_method(plan.method, white, parameters)
    tables = checked_tables(plan, shot.tables, shot.white)
    if tables:
        method = table_method(tables, method)
    return float(np.float32(iridescence.film_ior)), method, truth


def _left_out(undefined: Mapping[str, Mask], python: Float64, glsl: Float64) -> Mask:
    """Return the pixels (n,) that are not compared: on a branch, or undefined and no number."""
    is_number = np.all(np.isfinite(python) & np.isfinite(glsl), axis=-1)
    touched = np.zeros(is_number.shape, dtype=np.bool_)
    for case, rows in undefined.items():
        touched |= rows if case == BRANCH else rows & ~is_number
    return touched


def _masks(inputs: ShadingInputs, plans: Sequence[MaterialPlan]) -> Iterator[tuple[MaterialPlan, Mask]]:
    """Yield each plan that is on the picture with its pixels (height, width)."""
    for slot, plan in enumerate(plans):
        mask = inputs.material == slot
        if mask.any():
            yield plan, mask


def _split(inputs: ShadingInputs, plans: Sequence[MaterialPlan], mask: Mask, pictures: Pictures) -> Split:
    def over(rows: Mask) -> Agreement:
        return agreement(pictures.glsl[rows], pictures.python[rows])

    rough = is_rough(inputs, plans)
    return Split(over(mask), over(mask & rough), over(mask & ~rough))


def _eight_bit(
    inputs: ShadingInputs, coarse: ShadingInputs | None, mask: Mask, exposure: float
) -> ColourError | None:
    if coarse is None:
        return None
    both = mask & (coarse.material == inputs.material)
    return colour_error(
        coarse.colour[both].astype(np.float64), inputs.colour[both].astype(np.float64), exposure=exposure
    )


def _draw_differences(pictures: Pictures, compared: Mask, exposure: float) -> None:
    rows = compared & np.all(np.isfinite(pictures.glsl) & np.isfinite(pictures.truth), axis=-1)
    pictures.deviation[rows] = relative_deviation(pictures.glsl[rows], pictures.python[rows])
    pictures.delta_e[rows] = delta_e_2000(exposure * pictures.python[rows], exposure * pictures.truth[rows])


def _draw_texture_difference(
    pictures: Pictures, inputs: ShadingInputs, coarse: ShadingInputs, exposure: float
) -> None:
    if pictures.texture_delta_e is None:
        return
    rows = pictures.drawn & (coarse.material == inputs.material)
    rows &= np.all(np.isfinite(coarse.colour) & np.isfinite(inputs.colour), axis=-1)
    pictures.texture_delta_e[rows] = delta_e_2000(
        exposure * coarse.colour[rows], exposure * inputs.colour[rows]
    )


def inputs_of(frame: Frame) -> ShadingInputs:
    """Return what the pixels of `frame` were shaded with; UsageError where it was drawn without that."""
    if frame.inputs is None:
        raise UsageError("This frame holds no shading inputs; render it with with_inputs=True.")
    return frame.inputs
