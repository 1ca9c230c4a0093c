"""`gltf-iri bench` of whole scenes, arrays and files: what is measured, and how it is printed."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gltf_iri.cli.bench_tables import figure
from gltf_iri.cli.common import print_table, progress

if TYPE_CHECKING:
    from gltf_iri.bench.arrays import ArrayRow
    from gltf_iri.bench.image_light_error import ImageLightRow
    from gltf_iri.bench.scene_growth import GrowthRow, ProgramRow
    from gltf_iri.bench.scenes import SceneRow

__all__ = ["WHOLE", "measure_whole"]

WHOLE = ("scenes", "twenty", "image-light", "arrays", "layers", "layers-agreement", "validator")

# The rows, and what prints them.
Measured = tuple[list[Any], Callable[[], None]]


def measure_whole(name: str, files: Sequence[Path], rounds: int | None, count: int | None) -> Measured:
    """Measure one of WHOLE; raises as what it measures does, MissingCapabilityError without OpenGL."""
    if name == "scenes":
        return _scenes(files, rounds)
    if name == "twenty":
        return _twenty(rounds)
    if name == "layers":
        from gltf_iri.cli.bench_layers import measure_layers

        return measure_layers(rounds)
    if name == "layers-agreement":
        from gltf_iri.cli.bench_layers import measure_layers_agreement

        return measure_layers_agreement()
    if name == "validator":
        from gltf_iri.cli.bench_validator import measure_validator

        return measure_validator(rounds)
    return _image_light() if name == "image-light" else _arrays(count)


def _scenes(files: Sequence[Path], rounds: int | None) -> Measured:
    from gltf_iri.bench.scenes import SCENE_ROUNDS, VARIANTS, measure_scene
    from gltf_iri.rendering.context import create_context

    context = create_context()
    rows: list[SceneRow] = []
    turns = rounds or SCENE_ROUNDS
    with _or_samples(files) as paths:
        try:
            with progress("scenes", len(paths) * (turns + VARIANTS - 1)) as advance:
                for path in paths:
                    rows += measure_scene(context, path, turns, advance=advance)
        finally:
            context.release()
    return rows, lambda: _print_scenes(rows)


@contextmanager
def _or_samples(files: Sequence[Path]) -> Iterator[list[Path]]:
    """Yield `files`, or where there are none the samples, in a temporary folder."""
    if files:
        yield list(files)
        return
    from gltf_iri.samples.collection import build_samples
    from gltf_iri.whole_files import write_whole

    with tempfile.TemporaryDirectory() as folder:
        paths = []
        for sample in build_samples():
            write_whole({Path(folder) / sample.name / name: data for name, data in sample.files.items()})
            paths.append(Path(folder) / sample.file)
        yield paths


def _print_scenes(rows: Sequence[SceneRow]) -> None:
    columns = ("file", "variant", "ms", "× stripped", "ΔE mean", "ΔE p95", "pixels", "films")
    cells = [
        (
            row.file,
            row.method,
            f"{row.ms:.1f}",
            f"{row.ratio:.3f}",
            figure(row.delta_e_mean, ".3f"),
            figure(row.delta_e_p95, ".3f"),
            figure(row.error_pixels or None, ","),
            row.remark or "; ".join(dict.fromkeys(row.ways.values())),
        )
        for row in rows
    ]
    width, height = rows[0].size
    print_table(columns, cells, title=f"Shading {width} × {height} pixels by {rows[0].backend}")


def _twenty(rounds: int | None) -> Measured:
    from gltf_iri.bench.scene_growth import GROWTH_ROUNDS, measure_growth

    turns = rounds or GROWTH_ROUNDS
    with progress("twenty", turns) as advance:
        rows, programs = measure_growth(turns, advance=advance)
    return [*rows, *programs], lambda: _print_twenty(rows, programs)


def _print_twenty(rows: Sequence[GrowthRow], programs: Sequence[ProgramRow]) -> None:
    columns = ("scene", "programs", "compile ms", "× 17", "ms", "× 17 on 20 balls", "× 17 on 17")
    cells = [
        (
            row.method,
            row.programs,
            f"{row.compile_ms:,.0f}",
            f"{row.compile_ratio:.3f}",
            f"{row.ms:.1f}",
            f"{row.ratio:.3f}",
            f"{row.ratio_left_out:.3f}",
        )
        for row in rows
    ]
    print_table(columns, cells, title=f"20 materials, 3 of them iridescent, by {rows[0].backend}")
    costs = [(f"{row.compile_ms:,.0f}", ", ".join(row.materials), " ".join(row.defines)) for row in programs]
    from gltf_iri.bench.scenes import BUDGET, within_name

    within = next(row for row in rows if row.method == within_name(BUDGET))
    title = f"Programs within the budget, the three of different kinds; none has {', '.join(within.pruned)}"
    print_table(("compile ms", "materials", "defines"), costs, title=title)


def _image_light() -> Measured:
    from gltf_iri.bench.image_light_error import ROUGHNESSES, measure_image_light

    with progress("image-light", len(ROUGHNESSES)) as advance:
        rows = measure_image_light(advance=advance)
    return rows, lambda: _print_image_light(rows)


def _print_image_light(rows: Sequence[ImageLightRow]) -> None:
    by_place = {(row.film, row.way, row.roughness): row for row in rows}
    roughnesses = sorted({row.roughness for row in rows})
    cells = [
        (film, way, *(f"{by_place[film, way, r].delta_e_p95:.2f}" for r in roughnesses))
        for film, way in dict.fromkeys((row.film, row.way) for row in rows)
    ]
    moved = max(row.convergence for row in rows)
    title = f"A white sky on rough films: ΔE p95 against the mean over facets (converged to {moved:.1g})"
    print_table(("film", "way", *(f"{r:g}" for r in roughnesses)), cells, title=title)


def _arrays(count: int | None) -> Measured:
    from gltf_iri.bench.arrays import ARRAY_COUNT, ARRAY_STEPS, measure_arrays

    with progress("arrays", ARRAY_STEPS) as advance:
        rows = measure_arrays(count or ARRAY_COUNT, advance=advance)
    return rows, lambda: _print_arrays(rows)


def _print_arrays(rows: Sequence[ArrayRow]) -> None:
    columns = ("asked", "way", "rows", "backend", "s", "ns/colour", "× faster", "MB", "ΔE mean", "ΔE p95")
    cells = [
        (
            row.asked,
            row.method,
            f"{row.rows:,}",
            row.backend,
            f"{row.seconds:.2f}",
            f"{row.ns_per_eval:,.1f}",
            f"{1.0 / row.ratio:,.0f}",
            figure(None if row.anonymous_bytes is None else 1e-6 * row.anonymous_bytes, ".0f"),
            f"{row.delta_e_mean:.2g}",
            f"{row.delta_e_p95:.2g}",
        )
        for row in rows
    ]
    title = f"Films from one .npy file to another, {rows[0].threads} threads; times over brute force's"
    print_table(columns, cells, title=title)
