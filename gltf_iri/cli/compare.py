"""`gltf-iri compare`: GLSL, Python and spectral truth on the same pixels."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gltf_iri.cli.common import file_argument, json_option, note, print_json, print_table, progress

if TYPE_CHECKING:
    from gltf_iri.comparison.result import Comparison
    from gltf_iri.scene.model import Camera, Environment, Scene

__all__ = ["command"]


@click.command(name="compare")
@file_argument
@click.option(
    "-o",
    "--out",
    type=click.Path(file_okay=False, path_type=Path),
    metavar="DIR",
    help="Folder for the pictures, report.json and index.html.  [default: FILE's name + '-compared', here]",
)
@click.option("--method", metavar="NAME", help="Film method; the plan chooses when left out.")
@click.option("--size", default="480x360", show_default=True, metavar="WxH", help="Size in pixels.")
@click.option("--env", default="studio", show_default=True, metavar="FILE|studio|white", help="Image light.")
@click.option(
    "--camera", type=int, metavar="I", help="Camera of the file; the first, or framed when there is none."
)
@click.option(
    "--exposure", type=float, default=0.0, show_default=True, metavar="EV", help="Brighter by 2^EV."
)
@click.option(
    "--white", type=click.Choice(["D65", "E"]), default="D65", show_default=True, help="White of the truth."
)
@json_option
def command(
    file: Path,
    out: Path | None,
    method: str | None,
    size: str,
    env: str,
    camera: int | None,
    exposure: float,
    white: str,
    as_json: bool,
) -> None:
    """Draw FILE, shade each pixel again in Python and by spectral truth, and say how far apart they are.

    Ends with exit code 1 where GLSL and Python disagree beyond tolerance.
    """
    from gltf_iri.comparison.report import write_report
    from gltf_iri.comparison.run import STEPS, compare
    from gltf_iri.errors import AssetError
    from gltf_iri.planning.decide import plan_materials
    from gltf_iri.rendering.context import create_context
    from gltf_iri.scene.load import load
    from gltf_iri.tolerances import GLSL_PIXEL_RELATIVE

    width_height = _size(size)
    environment = _environment(env)
    model = load(file)
    scene = model.scene()
    plans = plan_materials(model.materials, method=method)
    view = _camera(scene, camera, width_height[0] / width_height[1])
    folder = out if out is not None else Path(f"{file.stem}-compared")
    with progress("Comparing", len(STEPS) + 1) as advance:
        comparison = compare(
            create_context(),
            model,
            scene,
            plans,
            view,
            environment,
            size=width_height,
            exposure=exposure,
            white=white,
            advance=advance,
        )
        paths = write_report(comparison, folder)
        advance()
    _tell(comparison, paths, as_json=as_json)
    if not comparison.agrees:
        largest = comparison.whole.glsl_vs_python.rough.max_relative
        raise AssetError(
            f"GLSL and Python disagree by {largest or 0.0:.1e} where {GLSL_PIXEL_RELATIVE:.0e} is allowed;"
            f" see {paths['page']}",
            file=file,
        )


def _tell(comparison: Comparison, paths: Mapping[str, Path], *, as_json: bool) -> None:
    if as_json:
        print_json({**comparison.to_json(), "files": dict(paths)})
        return
    columns = (
        "material",
        "method",
        "pixels",
        "GLSL − Python",
        "ΔE film mean",
        "p95",
        "max",
        "ΔE picture mean",
    )
    print_table(columns, [_row(material) for material in comparison.to_json()["materials"]])
    for material in comparison.materials:
        for effect, reason in material.plan.not_drawn.items():
            note(
                f"{material.plan.name or f'material {material.plan.index}'}: {effect} is not drawn: {reason}"
            )
    for text in comparison.notes:
        note(text)
    click.echo(f"The page is {paths['page']}.")


def _row(material: Mapping[str, Any]) -> tuple[str, ...]:
    film, picture = material["method_vs_truth"] or {}, material["picture_vs_truth"] or {}
    figures = (
        material["glsl_vs_python"]["max_relative"],
        *(film.get(key) for key in ("delta_e_mean", "delta_e_p95", "delta_e_max")),
        picture.get("delta_e_mean"),
    )
    return (
        material["name"] or f"material {material['index']}",
        material["method"] or "no film",
        str(material["glsl_vs_python"]["pixels"]),
        *("–" if value is None else f"{value:.2g}" for value in figures),
    )


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.lower().partition("x")
    if not (width.isdecimal() and height.isdecimal() and int(width) > 0 and int(height) > 0):
        raise click.BadParameter(f"'{text}' is not a size such as 480x360.", param_hint="--size")
    return int(width), int(height)


def _environment(text: str) -> Environment:
    from gltf_iri.scene import environment

    made = {"studio": environment.studio, "white": environment.white}
    return made[text]() if text in made else environment.read_environment(text)


def _camera(scene: Scene, index: int | None, aspect: float) -> Camera:
    from gltf_iri.errors import UsageError
    from gltf_iri.scene.camera import frame_scene

    if index is None:
        return scene.cameras[0] if scene.cameras else frame_scene(scene, aspect=aspect)
    if not 0 <= index < len(scene.cameras):
        raise UsageError(f"There is no camera {index}: the scene has {len(scene.cameras)}.")
    return scene.cameras[index]
