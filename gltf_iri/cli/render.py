"""`gltf-iri render`: draw a file to a picture, or to pictures from all around."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import click

from gltf_iri.cli.budget import (
    baked_tables,
    budget_option,
    check_choice,
    plan_scene,
    print_ways,
    ways_json,
)
from gltf_iri.cli.common import file_argument, json_option, note, print_json, progress
from gltf_iri.cli.drawing import Drawn, opengl, rays
from gltf_iri.cli.layers import baked_layers, layers_json, print_layers
from gltf_iri.cli.picture_options import (
    SIZE,
    choose_exposure,
    exposure_option,
    reference_counts,
    reference_options,
)

if TYPE_CHECKING:
    from gltf_iri.planning.material_plan import MaterialPlan
    from gltf_iri.scene.model import Camera

__all__ = ["command"]

_TONE_MAPS = ("none", "neutral", "aces")


@click.command(name="render")
@file_argument
@click.option(
    "-o",
    "--out",
    required=True,
    type=click.Path(path_type=Path),
    help="Picture: OUT.png, OUT.webp or OUT.exr.",
)
@click.option("--size", type=SIZE, default="640x480", show_default=True, help="Size in pixels.")
@click.option(
    "--env", default="studio", show_default=True, metavar="FILE|studio|white|none", help="Image light."
)
@exposure_option("auto, in EXR 0")
@click.option(
    "--tonemap",
    type=click.Choice(_TONE_MAPS),
    help="How light becomes the colours of PNG and WebP.  [default: neutral]",
)
@click.option(
    "--camera", type=int, metavar="I", help="Camera of the file; its first, or framed if it has none."
)
@click.option(
    "--orbit",
    type=int,
    metavar="N",
    help="N pictures once around the scene: an animated WebP, or OUT-000.png and so on.",
)
@click.option(
    "--method", metavar="NAME", help="Method for films, or for layers; the plan chooses when left out."
)
@budget_option
@reference_options("Cast rays on the CPU instead: slow, without OpenGL, through the pixels' centres.")
@json_option
def command(
    file: Path,
    out: Path,
    size: tuple[int, int],
    env: str,
    exposure: float | Literal["auto"] | None,
    tonemap: str | None,
    camera: int | None,
    orbit: int | None,
    method: str | None,
    budget: float | None,
    reference: bool,
    samples: int | None,
    paths: int | None,
    as_json: bool,
) -> None:
    """Draw FILE to OUT without a window.

    PNG is 8-bit sRGB, tone mapped; WebP the same, smaller and not exact. EXR is linear float32 Rec.709, never
    tone mapped; its alpha tells how much of a pixel the model covers. Behind the model is the environment,
    out of focus (by rays it is sharp), in the studio a card.
    """
    from gltf_iri.errors import UsageError
    from gltf_iri.rendering.picture import check_picture_path, write_orbit, write_picture
    from gltf_iri.rendering.programs import check_method
    from gltf_iri.scene.choose import choose_camera, choose_environment
    from gltf_iri.scene.framing import orbit_scene
    from gltf_iri.scene.load import load

    check_picture_path(out)
    counts = reference_counts(reference, samples, paths)
    check_choice(budget, method=method, reference=reference)
    if not reference:
        check_method(method)  # rays take any method for films, the truth included
    is_linear = out.suffix.lower() == ".exr"
    if tonemap not in (None, "none") and is_linear:
        raise UsageError(f"EXR keeps linear light and is not tone mapped; leave '--tonemap {tonemap}' out.")
    if orbit is not None and camera is not None:
        raise UsageError("An orbit has its own cameras; leave '--camera' or '--orbit' out.")
    environment = choose_environment(env)
    model = load(file)
    scene = model.scene()
    if orbit is None:
        views: tuple[Camera, ...] = (choose_camera(scene, camera, size),)
    else:
        views = orbit_scene(scene, aspect=max(size[0], 1) / max(size[1], 1), count=orbit)
    plans = plan_scene(model, scene, method, budget, size=size, environment=environment)
    tables = baked_tables(plans)
    layer_tables = {} if reference else baked_layers(plans)
    exposure_ev = choose_exposure(exposure, scene, environment, default="0" if is_linear else "auto")
    subject = (model, scene, plans, environment, size)
    brush = rays(*subject, counts) if reference else opengl(*subject, tables, layer_tables)
    with ExitStack() as put_away, progress("Drawing", len(views) * brush.steps + 1) as advance:
        put_away.callback(brush.release)
        drawn = Drawn(brush.draw)
        pictures = drawn.pictures(views, advance)
        written: tuple[Path, ...] = (out,)
        if orbit is None:
            write_picture(out, next(pictures), exposure_ev, tonemap or "neutral")
        else:
            written = write_orbit(out, pictures, len(views), exposure_ev, tonemap or "neutral")
        advance()

    used = [plan for plan in plans if plan.index in {primitive.material for primitive in scene.primitives}]
    notes = dict.fromkeys(
        (
            *model.notes,
            *model.document.notes,  # by now with what was found in its pictures
            *scene.notes,
            *(environment.notes if environment else ()),
            *drawn.notes,
        )
    )
    told: dict[str, Any] = {
        "out": written[0],
        "outputs": written,
        "size": list(size),
        "renderer": drawn.renderer,
        "ms": round(drawn.milliseconds, 3),
        "passes": {name: round(spent, 3) for name, spent in drawn.passes.items()},
        "method": next((plan.method for plan in used if plan.method is not None), None),
        "budget": budget,
        "ways": ways_json(used, tables),
        "layers": layers_json(used, layer_tables),
        "environment": environment.name if environment else None,
        "exposure": exposure_ev,
        "camera": views[0].name,
        "not_drawn": [
            {"material": plan.index, "name": plan.name, "effects": dict(plan.not_drawn)}
            for plan in used
            if plan.not_drawn
        ],
        "notes": list(notes),
    }
    if as_json:
        print_json(told)
        return
    for text in (*notes, *_not_drawn(used)):
        note(text)
    print_ways(used, tables)
    print_layers(used, layer_tables)
    click.echo(_summary(told, count=len(views)))


def _summary(told: dict[str, Any], *, count: int) -> str:
    paths, (width, height), ev = told["outputs"], told["size"], told["exposure"]
    names = str(paths[0]) if len(paths) == 1 else f"{paths[0]} … {paths[-1].name}"
    size = f"{width} × {height}" if count == 1 else f"{count} pictures, {width} × {height}"
    exposed = f"{ev:+g} EV" if ev else "0 EV"
    return f"{names} ({size}, {exposed}, drawn in {told['ms']:.0f} ms by {told['renderer']})"


def _not_drawn(plans: Iterable[MaterialPlan]) -> Iterator[str]:
    """Yield a sentence for each effect that is missing, however many materials call for it."""
    missing: dict[tuple[str, str], int] = {}
    for plan in plans:
        for effect, reason in plan.not_drawn.items():
            missing[effect, reason] = missing.get((effect, reason), 0) + 1
    for (effect, reason), count in missing.items():
        yield f"{effect} is missing on {count} material{'s' if count > 1 else ''}: {reason}."
