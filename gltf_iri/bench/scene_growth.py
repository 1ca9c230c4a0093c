"""Workload `twenty`: what three iridescent materials cost a scene of 17 others, to compile and to draw.

Compiling is what the first picture of a fresh OpenGL context takes beyond the second, for programs are
translated when they are linked and once more when they first draw. Disk caches of shaders are kept out of it.
Compiling is told in the processor's time, all threads together, which knows nothing of other processes.
"The scene with 17" is read in two ways: the three iridescent balls left out, or wearing others' materials.
"""

from __future__ import annotations

import os
import statistics
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any, Final

from gltf_iri.bench.scenes import (
    BUDGET,
    Variant,
    draw_variant,
    interleaved_ms,
    median_ratio,
    variants_of,
    within_name,
)
from gltf_iri.bench.twenty import FILMED, TWENTY, scene_files
from gltf_iri.planning.decide import plan_materials
from gltf_iri.planning.permutation import permutation, plan_scene_effects, primitive_effects
from gltf_iri.rendering.context import create_context, renderer_name
from gltf_iri.rendering.render import Renderer
from gltf_iri.rendering.switches import SWITCHES
from gltf_iri.scene.choose import choose_environment
from gltf_iri.scene.load import load
from gltf_iri.scene.model import Environment, Primitive, Scene
from gltf_iri.whole_files import write_whole

__all__ = ["GROWTH_ROUNDS", "GrowthRow", "ProgramRow", "measure_growth"]

GROWTH_ROUNDS: Final = 5
_SIZE: Final = (1024, 1024)
_FRAMES: Final = 3  # for each round of compiling, which takes some twenty times as long

# Mesa keeps compiled shaders on disk; what is found there costs no compiling.
_NO_CACHES: Final = {"MESA_SHADER_CACHE_DISABLE": "true", "MESA_GLSL_CACHE_DISABLE": "true"}


@dataclass(frozen=True, slots=True)
class GrowthRow:
    """One scene; ratios are medians over the rounds.

    compile_ms : of all programs; ratios: to 17 materials, on as many balls.
    ms : of shading one picture; ratio: to 17 materials on 20 balls, the same pixels; ratio_left_out: on 17.
    programs : how many permutations the scene has; switches : all that they define; pruned : those that no
        program of the scene defines, so that their code is not compiled.
    """

    workload: str
    method: str
    backend: str
    materials: int
    programs: int
    compile_ms: float
    compile_ratio: float
    ms: float
    ratio: float
    ratio_left_out: float
    switches: tuple[str, ...]
    pruned: tuple[str, ...]
    ns_per_eval: float
    max_abs: float | None = None
    delta_e_mean: float | None = None
    delta_e_p95: float | None = None

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return asdict(self)


@dataclass(frozen=True, slots=True)
class ProgramRow:
    """What one program costs to compile by itself, and the materials that share it."""

    defines: tuple[str, ...]
    materials: tuple[str, ...]
    compile_ms: float

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return asdict(self)


def measure_growth(
    rounds: int = GROWTH_ROUNDS,
    size: tuple[int, int] = _SIZE,
    advance: Callable[[], None] = lambda: None,
) -> tuple[list[GrowthRow], list[ProgramRow]]:
    """Return a row for each scene, that of the 17 first, and one for each program of the 20 within a budget.

    Advances once a round. Raises MissingCapabilityError without OpenGL.
    """
    environment = choose_environment("studio")
    with _variants(environment, size) as variants, _without_caches():
        cold: list[list[float]] = [[] for _ in variants]
        for _ in range(rounds):
            for each, spent in zip(variants, cold, strict=True):
                spent.append(_compile_ms(each, each.model.scene(), environment, size))
            advance()
        context = create_context()
        renderer = Renderer(context)
        name = renderer_name(context)
        try:
            warm, _ = interleaved_ms(renderer, variants, environment, size, _FRAMES * rounds)
        finally:
            renderer.release()
            context.release()
        rows = [
            _row(each, name, environment, size, (cold[k], cold[0]), (warm[k], warm[1], warm[0]))
            for k, each in enumerate(variants)
        ]
        within = next(each for each in variants if each.name == within_name(BUDGET))
        return rows, list(_programs(within, environment, size))


@contextmanager
def _variants(environment: Environment | None, size: tuple[int, int]) -> Iterator[tuple[Variant, ...]]:
    """Yield 17 materials on 17 balls and on 20; 20 without films, and with films; the same of films alike."""
    plain_count = TWENTY - FILMED
    with tempfile.TemporaryDirectory() as folder:
        models = []
        for materials, balls, are_alike in (
            (plain_count, plain_count, False),
            (plain_count, TWENTY, False),
            (TWENTY, TWENTY, False),
            (TWENTY, TWENTY, True),
        ):
            place = Path(folder) / f"{materials} on {balls}, {are_alike}"
            contents = scene_files(materials, balls, are_films_alike=are_alike)
            files = {place / name: data for name, data in contents.items()}
            write_whole(files)
            models.append(load(next(iter(files))))
        left_out, worn, whole, alike = models
        yield (
            Variant("17, the others left out", left_out, plan_materials(left_out.materials)),
            Variant("17 on 20 balls", worn, plan_materials(worn.materials)),
            *variants_of(whole, environment, size, methods=("khr-guarded",)),
            *(
                replace(each, name=f"{each.name}, three alike")
                for each in variants_of(alike, environment, size, methods=())
            ),
        )


@contextmanager
def _without_caches() -> Iterator[None]:
    before = {name: os.environ.get(name) for name in _NO_CACHES}
    os.environ.update(_NO_CACHES)
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                os.environ.pop(name, None)
            else:
                os.environ[name] = value


def _compile_ms(
    variant: Variant, scene: Scene, environment: Environment | None, size: tuple[int, int]
) -> float:
    """Return what the first picture of a fresh context costs beyond the second."""
    context = create_context()
    renderer = Renderer(context)
    try:
        # Image light is prepared with the first picture, too, which here is an empty one.
        draw_variant(renderer, variant, environment, size, replace(scene, primitives=()))
        clock = []
        for _ in range(2):
            started = time.process_time()
            draw_variant(renderer, variant, environment, size, scene)
            clock.append(time.process_time() - started)
        return 1e3 * (clock[0] - clock[1])
    finally:
        renderer.release()
        context.release()


def _row(
    variant: Variant,
    renderer: str,
    environment: Environment | None,
    size: tuple[int, int],
    cold: tuple[Sequence[float], Sequence[float]],
    warm: tuple[Sequence[float], Sequence[float], Sequence[float]],
) -> GrowthRow:
    scene = variant.model.scene()
    programs = {_defines(variant, scene, each, environment) for each in scene.primitives}
    used = {define for defines in programs for define in defines}
    ms = statistics.median(warm[0])
    return GrowthRow(
        "twenty",
        variant.name,
        renderer,
        len(variant.model.materials),
        len(programs),
        statistics.median(cold[0]),
        median_ratio(*cold),
        ms,
        median_ratio(warm[0], warm[1]),
        median_ratio(warm[0], warm[2]),
        tuple(sorted(used)),
        tuple(sorted(SWITCHES - used)),
        1e6 * ms / (size[0] * size[1]),
    )


def _defines(
    variant: Variant, scene: Scene, primitive: Primitive, environment: Environment | None
) -> tuple[str, ...]:
    plan = variant.plans[primitive.material]
    return permutation(plan, primitive_effects(primitive), plan_scene_effects(scene, environment))


def _programs(
    variant: Variant, environment: Environment | None, size: tuple[int, int]
) -> Iterator[ProgramRow]:
    """Yield each program of the scene, compiled for a scene of one ball that it draws."""
    scene = variant.model.scene()
    sharing: dict[tuple[str, ...], list[Primitive]] = {}
    for primitive in scene.primitives:
        sharing.setdefault(_defines(variant, scene, primitive, environment), []).append(primitive)
    for defines, primitives in sharing.items():
        alone = replace(scene, primitives=(primitives[0],))
        names = tuple(variant.plans[each.material].name for each in primitives)
        yield ProgramRow(defines, names, _compile_ms(variant, alone, environment, size))
