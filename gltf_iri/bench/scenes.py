"""Workload `scenes`: what iridescence adds to the time of shading a picture, and how far its colours are off.

Every variant of a file is drawn once a round by one renderer, one sample a pixel, and its time is that of the
passes which shade: opaque and see-through surfaces. Ratios are taken within a round and then their median.
"""

from __future__ import annotations

import statistics
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.fill import bake_plans
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.budgets.plans import plans_within
from gltf_iri.comparison.run import compare
from gltf_iri.errors import UsageError
from gltf_iri.planning.decide import plan_materials
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.reach import Lobe
from gltf_iri.rendering.frame import Frame
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.choose import choose_camera, choose_environment
from gltf_iri.scene.exposure import automatic_exposure
from gltf_iri.scene.load import Model, load
from gltf_iri.scene.model import Environment, Scene

if TYPE_CHECKING:
    import moderngl

__all__ = ["BUDGET", "SCENE_ROUNDS", "STRIPPED", "VARIANTS", "SceneRow", "Variant", "draw_variant"]
__all__ += ["interleaved_ms", "measure_scene", "median_ratio", "shading_ms", "stripped_model", "variants_of"]
__all__ += ["within_name"]

Tables = Mapping[int, Mapping[Lobe, BakedTable]]

SCENE_ROUNDS: Final = 9
BUDGET: Final = 0.5
STRIPPED: Final = "stripped"
_SIZE: Final = (1024, 1024)
_METHODS: Final = ("khr-guarded", "fourier")
VARIANTS: Final = len(_METHODS) + 2
_SHADING: Final = ("opaque", "see-through")


@dataclass(frozen=True, slots=True)
class Variant:
    """One way to draw a file; `model` lacks iridescence where it is stripped."""

    name: str
    model: Model
    plans: tuple[MaterialPlan, ...]
    tables: Tables = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class SceneRow:
    """One variant of one file; backend is the OpenGL renderer.

    ms : median over the rounds; ratio : to the same scene without iridescence, median over the rounds.
    delta_e_mean, delta_e_p95 : CIEDE2000 of the picture against the spectral one, over `error_pixels` drawn
        pixels; None where it was not asked for. For a budget image light is the film's mean over the facets
        in both, for a method as published both take F(N·V).
    ways : how the film of each iridescent material is computed; filling_ms : of their tables, once.
    remark : why there are no figures, where nothing keeps the budget.
    """

    workload: str
    file: str
    method: str
    backend: str
    size: tuple[int, int]
    ms: float
    ratio: float
    ns_per_eval: float  # of one pixel of the picture
    max_abs: float | None = None
    delta_e_mean: float | None = None
    delta_e_p95: float | None = None
    error_pixels: int = 0
    ways: Mapping[str, str] = field(default_factory=dict)
    filling_ms: float = 0.0
    remark: str = ""

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return asdict(self)


def measure_scene(
    context: moderngl.Context,
    path: Path,
    rounds: int = SCENE_ROUNDS,
    size: tuple[int, int] = _SIZE,
    error_size: tuple[int, int] | None = _SIZE,
    advance: Callable[[], None] = lambda: None,
) -> list[SceneRow]:
    """Return a row for each variant of the file at `path`; advances after each round and comparison.

    error_size : of the pictures that are compared with spectral ones, a minute a megapixel; None for none.
    Raises AssetError and UsageError as `load`, MissingCapabilityError as the renderer.
    """
    model = load(path)
    environment = choose_environment("studio")
    variants = variants_of(model, environment, size, with_budget=False)
    remark = ""
    try:
        variants = variants_of(model, environment, size)
    except UsageError as error:  # no way is good enough: the other rows stand all the same
        remark = str(error)
    renderer = Renderer(context)
    try:
        times, frames = interleaved_ms(renderer, variants, environment, size, rounds, advance)
        rows = []
        for each, spent, frame in zip(variants, times, frames, strict=True):
            row = _row(path, each, frame, size, statistics.median(spent), median_ratio(spent, times[0]))
            if error_size is not None and each.name != STRIPPED:
                row = _with_error(row, renderer, each, environment, error_size)
                advance()
            rows.append(row)
        if remark:
            lost = replace(rows[0], method=within_name(BUDGET), ms=np.nan, ratio=np.nan, ns_per_eval=np.nan)
            rows.append(replace(lost, remark=remark))
    finally:
        renderer.release()
    return rows


def variants_of(
    model: Model,
    environment: Environment | None,
    size: tuple[int, int],
    *,
    methods: Sequence[str] = _METHODS,
    with_budget: bool = True,
) -> tuple[Variant, ...]:
    """Return the file without iridescence, by each of `methods` as published, and within BUDGET.

    Raises UsageError where nothing keeps it.
    """
    plain = stripped_model(model)
    published = (
        Variant(STRIPPED, plain, plan_materials(plain.materials)),
        *(Variant(name, model, plan_materials(model.materials, method=name)) for name in methods),
    )
    if not with_budget:
        return published
    plans = plans_within(
        model,
        model.scene(),
        BUDGET,
        size_pixels=size[0] * size[1],
        has_image_light=environment is not None,
        white=WHITE,
    )
    return (*published, Variant(within_name(BUDGET), model, plans, bake_plans(plans, WHITE)))


def within_name(budget: float) -> str:
    """Return what a variant within `budget` is called."""
    return f"budget {budget:g}"


def interleaved_ms(
    renderer: Renderer,
    variants: Sequence[Variant],
    environment: Environment | None,
    size: tuple[int, int],
    rounds: int,
    advance: Callable[[], None] = lambda: None,
) -> tuple[list[list[float]], list[Frame]]:
    """Return the milliseconds of shading, a list of rounds for each variant, and a frame of each."""
    frames = [draw_variant(renderer, each, environment, size) for each in variants]  # compiles
    times: list[list[float]] = [[] for _ in variants]
    for _ in range(rounds):
        for each, spent in zip(variants, times, strict=True):
            spent.append(shading_ms(draw_variant(renderer, each, environment, size)))
        advance()
    return times, frames


def median_ratio(mine: Sequence[float], other: Sequence[float]) -> float:
    """Return the median of the ratios round by round."""
    return statistics.median(a / b for a, b in zip(mine, other, strict=True))


def draw_variant(
    renderer: Renderer,
    variant: Variant,
    environment: Environment | None,
    size: tuple[int, int],
    scene: Scene | None = None,
) -> Frame:
    """Draw a variant, or a part of its scene, one sample a pixel, seen from the file's first camera."""
    whole = variant.model.scene()
    return renderer.render(
        variant.model,
        whole if scene is None else scene,
        variant.plans,
        choose_camera(whole, None, size),
        environment,
        size=size,
        samples=1,
        white=WHITE,
        tables=variant.tables,
    )


def stripped_model(model: Model) -> Model:
    """Return `model` with no film on any material."""
    return replace(model, materials=tuple(replace(each, iridescence=None) for each in model.materials))


def shading_ms(frame: Frame) -> float:
    """Return the milliseconds that shading the surfaces of `frame` took."""
    return sum(frame.passes.get(name, 0.0) for name in _SHADING)


def _row(
    path: Path, variant: Variant, frame: Frame, size: tuple[int, int], ms: float, ratio: float
) -> SceneRow:
    return SceneRow(
        workload="scenes",
        file=path.name,
        method=variant.name,
        backend=frame.renderer,
        size=size,
        ms=ms,
        ratio=ratio,
        ns_per_eval=1e6 * ms / (size[0] * size[1]),
        ways=_ways(variant.plans),
        filling_ms=sum(
            1e3 * table.filled_in_s for lobes in variant.tables.values() for table in lobes.values()
        ),
    )


def _ways(plans: Sequence[MaterialPlan]) -> dict[str, str]:
    """Return how each film is computed, by the material's number and name, which alone may be another's."""
    ways = {}
    for plan in plans:
        label = plan.method if plan.way is None else plan.way.label
        if label is not None:
            ways[f"{plan.index} {plan.name}".strip()] = label
    return ways


def _with_error(
    row: SceneRow,
    renderer: Renderer,
    variant: Variant,
    environment: Environment | None,
    size: tuple[int, int],
) -> SceneRow:
    scene = variant.model.scene()
    camera = choose_camera(scene, None, size)
    found = compare(
        renderer,
        variant.model,
        scene,
        variant.plans,
        camera,
        environment,
        size=size,
        exposure=automatic_exposure(scene, environment),
        white=WHITE,
        tables=variant.tables,
    ).whole.picture_vs_truth
    return replace(
        row,
        max_abs=found.max_abs,
        delta_e_mean=found.delta_e_mean,
        delta_e_p95=found.delta_e_p95,
        error_pixels=found.pixels,
    )
