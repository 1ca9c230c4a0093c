"""`gltf-iri compare`: GLSL, Python, spectral truth and, if asked for, rays on the same pixels."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from contextlib import ExitStack
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, cast

import click

from gltf_iri.cli.budget import baked_tables, budget_option, check_choice, plan_scene, print_ways
from gltf_iri.cli.common import (
    file_argument,
    json_option,
    material_label,
    note,
    print_json,
    print_table,
    progress,
)
from gltf_iri.cli.layers import baked_layers, print_layers
from gltf_iri.cli.picture_options import (
    EMPTY_PICTURE,
    SIZE,
    choose_exposure,
    exposure_option,
    reference_counts,
    reference_options,
)

if TYPE_CHECKING:
    from gltf_iri.colour.spaces import White
    from gltf_iri.comparison.reference_result import ReferenceResult
    from gltf_iri.comparison.result import Comparison

__all__ = ["command"]


@click.command(name="compare")
@file_argument
@click.option(
    "-o",
    "--out",
    type=click.Path(file_okay=False),
    metavar="DIR",
    help="Folder for the pictures, report.json and index.html.  [default: FILE's name + '-compared', here]",
)
@click.option(
    "--method", metavar="NAME", help="Method for films, or for layers; the plan chooses when left out."
)
@budget_option
@click.option("--size", type=SIZE, default="480x360", show_default=True, help="Size in pixels.")
@click.option(
    "--env", default="studio", show_default=True, metavar="FILE|studio|white|none", help="Image light."
)
@click.option(
    "--camera", type=int, metavar="I", help="Camera of the file; its first, or framed if it has none."
)
@exposure_option("auto")
@click.option(
    "--white", type=click.Choice(["D65", "E"]), default="D65", show_default=True, help="White of the truth."
)
@reference_options("Also cast rays on the CPU and compare with what they see.")
@json_option
def command(
    file: Path,
    out: str | None,
    method: str | None,
    budget: float | None,
    size: tuple[int, int],
    env: str,
    camera: int | None,
    exposure: float | Literal["auto"] | None,
    white: str,
    reference: bool,
    samples: int | None,
    paths: int | None,
    as_json: bool,
) -> None:
    """Draw FILE, shade each pixel again in Python and by spectral truth, and say how far apart they are.

    Ends with exit code 1 where GLSL and Python disagree beyond tolerance; with --reference also where OpenGL
    and the rays do, on what both solve exactly.
    """
    from gltf_iri.comparison.reference_run import against_reference, count_steps
    from gltf_iri.comparison.report import write_report
    from gltf_iri.comparison.run import STEPS, compare
    from gltf_iri.errors import AssetError, UsageError
    from gltf_iri.rendering.context import create_context
    from gltf_iri.rendering.render import Renderer
    from gltf_iri.scene.choose import choose_camera, choose_environment
    from gltf_iri.scene.load import load

    if out == "":
        raise UsageError("The name of the folder is empty; write '.' for this one.")
    counts = reference_counts(reference, samples, paths)
    check_choice(budget, method=method)
    environment = choose_environment(env)
    model = load(file)
    scene = model.scene()
    plans = plan_scene(model, scene, method, budget, size=size, environment=environment, white=white)
    tables, layer_tables = baked_tables(plans, white), baked_layers(plans, cast("White", white))
    view = choose_camera(scene, camera, size)
    folder = Path(f"{file.stem}-compared" if out is None else out)
    # matplotlib warns where there is no home to keep its fonts' list in; the figures are the same.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    steps = len(STEPS) + 1 + (count_steps(size) if reference else 0)
    context = create_context()
    with ExitStack() as put_away, progress("Comparing", steps) as advance:
        put_away.callback(context.release)
        arguments = (Renderer(context), model, scene, plans, view, environment)
        shown: dict[str, Any] = {
            "size": size,
            "exposure": choose_exposure(exposure, scene, environment),
            "white": white,
            "layer_tables": layer_tables,
            "advance": advance,
        }
        # First, for it may lack a package.
        held = against_reference(*arguments, **{**shown, **counts}) if reference else None
        comparison = replace(compare(*arguments, **shown, tables=tables), reference=held)
        if not comparison.materials:
            comparison = replace(comparison, notes=(*comparison.notes, EMPTY_PICTURE))
        files = write_report(comparison, folder)
        advance()
    if not as_json:
        shown_plans = [material.plan for material in comparison.materials]
        print_ways(shown_plans, tables)
        print_layers(shown_plans, layer_tables)
    _tell(comparison, files, as_json=as_json)
    if not comparison.agrees:
        raise AssetError(f"GLSL and Python disagree beyond tolerance; see {files['page']}", file=file)
    if held is not None and not held.agrees:
        raise AssetError(
            f"OpenGL and the reference disagree beyond tolerance; see {files['page']}", file=file
        )


def _tell(comparison: Comparison, files: Mapping[str, Path], *, as_json: bool) -> None:
    if as_json:
        print_json({**comparison.to_json(), "files": dict(files)})
        return
    from gltf_iri.comparison.report import what_is_judged

    what = what_is_judged(comparison)
    columns = (
        "material",
        "method",
        "pixels",
        "GLSL − Python",
        f"ΔE {what} mean",
        "p95",
        "max",
        "ΔE picture mean",
    )
    print_table(columns, [_row(material, what) for material in comparison.to_json()["materials"]])
    if comparison.reference is not None:
        _tell_reference(comparison.reference)
    for material in comparison.materials:
        for effect, reason in material.plan.not_drawn.items():
            label = material_label(material.plan.index, material.plan.name)
            note(f"material {label}: {effect} is not drawn: {reason}.")
    for text in comparison.notes:
        note(text)
    if comparison.materials and not comparison.whole.glsl_vs_python.rough.pixels:
        note("No pixel is rough enough to be judged; the agreement above is reported only.")
    click.echo(f"The page is {files['page']}.")


def _tell_reference(held: ReferenceResult) -> None:
    columns = (
        *("material", "same problem: pixels", "max", "left out"),
        *("whole picture: ΔE mean", "p95", "max", "noise mean"),
    )
    result = held.to_json()
    rows = [
        (
            material_label(m["index"], m["name"]) + ", see-through" * m["see_through"],
            m["same_problem"],
            m["picture"],
        )
        for m in result["materials"]
    ]
    rows += [("all opaque", result["same_problem"], result["opaque"])]
    rows += [("all see-through", None, result["see_through"]), ("all", None, result["whole"])]
    print_table(columns, [_reference_row(*row) for row in rows], title="Against the CPU reference")
    note(f"The same problem is lit by {held.lights}; it is judged at the tolerance's roughness and above.")


def _reference_row(label: str, same: Mapping[str, Any] | None, picture: Mapping[str, Any]) -> tuple[str, ...]:
    names = ("delta_e_mean", "delta_e_p95", "delta_e_max", "noise_delta_e_mean")
    exact = ("–", "–", "–")
    if same is not None:
        exact = (
            str(same["rough"]["pixels"]),
            _figure(same["rough"]["max_relative"]),
            str(same["edges"] + same["steep"]),
        )
    return (label, *exact, *(_figure(picture[name]) for name in names))


def _row(material: Mapping[str, Any], what: str) -> tuple[str, ...]:
    film, picture = material["method_vs_truth"] or {}, material["picture_vs_truth"] or {}
    figures = (
        material["glsl_vs_python"]["max_relative"],
        *(film.get(key) for key in ("delta_e_mean", "delta_e_p95", "delta_e_max")),
        picture.get("delta_e_mean"),
    )
    return (
        material_label(material["index"], material["name"]),
        _method(material, what),
        str(material["glsl_vs_python"]["pixels"]),
        *map(_figure, figures),
    )


def _method(material: Mapping[str, Any], what: str) -> str:
    if material["layers"]:
        return str(material["layers"]["method"])
    return material["way"]["label"] if material["way"] else material["method"] or f"no {what}"


def _figure(value: float | None) -> str:
    return "–" if value is None else f"{value:.2g}"
