"""`gltf-iri render`: draw a file to a picture."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gltf_iri.cli.common import file_argument, json_option, note, print_json, progress
from gltf_iri.cli.picture_options import EMPTY_PICTURE, SIZE, exposure_option

if TYPE_CHECKING:
    from gltf_iri.planning.material_plan import MaterialPlan

__all__ = ["command"]

_TONE_MAPS = ("none", "neutral", "aces")


@click.command(name="render")
@file_argument
@click.option(
    "-o", "--out", required=True, type=click.Path(path_type=Path), help="Picture: OUT.png or OUT.exr."
)
@click.option("--size", type=SIZE, default="640x480", show_default=True, help="Size in pixels.")
@click.option(
    "--env", default="studio", show_default=True, metavar="FILE|studio|white|none", help="Image light."
)
@exposure_option
@click.option(
    "--tonemap", type=click.Choice(_TONE_MAPS), help="How light becomes a PNG's colours.  [default: neutral]"
)
@click.option(
    "--camera", type=int, metavar="I", help="Camera of the file; its first, or framed if it has none."
)
@click.option("--method", metavar="NAME", help="Film method; the plan chooses when left out.")
@json_option
def command(
    file: Path,
    out: Path,
    size: tuple[int, int],
    env: str,
    exposure: float,
    tonemap: str | None,
    camera: int | None,
    method: str | None,
    as_json: bool,
) -> None:
    """Draw FILE to OUT without a window.

    PNG is 8-bit sRGB, tone mapped. EXR is linear float32 Rec.709, never tone mapped; its alpha tells how much
    of a pixel the model covers. Behind the model is the environment out of focus, in the studio a grey card.
    """
    from gltf_iri.errors import UsageError
    from gltf_iri.planning.decide import complete_plans, plan_materials
    from gltf_iri.rendering.context import create_context
    from gltf_iri.rendering.picture import check_picture_path, write_picture
    from gltf_iri.rendering.programs import check_method
    from gltf_iri.rendering.render import Renderer
    from gltf_iri.scene.choose import choose_camera, choose_environment
    from gltf_iri.scene.load import load

    check_picture_path(out)
    check_method(method)
    if tonemap not in (None, "none") and out.suffix.lower() == ".exr":
        raise UsageError(f"EXR keeps linear light and is not tone mapped; leave '--tonemap {tonemap}' out.")
    with progress("Drawing", 3) as advance:
        environment = choose_environment(env)
        model = load(file)
        scene = model.scene()
        view = choose_camera(scene, camera, size)
        plans = complete_plans(plan_materials(model.materials, method=method), scene)
        advance()
        frame = Renderer(create_context()).render(model, scene, plans, view, environment, size=size)
        advance()
        write_picture(out, frame.rgba, exposure, tonemap or "neutral")
        advance()

    used = [plan for plan in plans if plan.index in {primitive.material for primitive in scene.primitives}]
    notes = dict.fromkeys(
        (
            *model.notes,
            *model.document.notes,  # by now with what was found in its pictures
            *scene.notes,
            *(environment.notes if environment else ()),
            *frame.notes,
        )
    )
    if not frame.rgba[..., 3].any():
        notes[EMPTY_PICTURE] = None
    if as_json:
        print_json(
            {
                "out": out,
                "size": list(size),
                "renderer": frame.renderer,
                "ms": round(frame.milliseconds, 3),
                "method": next((plan.method for plan in used if plan.method is not None), None),
                "environment": environment.name if environment else None,
                "camera": view.name,
                "not_drawn": [
                    {"material": plan.index, "name": plan.name, "effects": dict(plan.not_drawn)}
                    for plan in used
                    if plan.not_drawn
                ],
                "notes": list(notes),
            }
        )
        return
    for text in (*notes, *_not_drawn(used)):
        note(text)
    click.echo(f"{out} ({size[0]} × {size[1]}, drawn in {frame.milliseconds:.0f} ms by {frame.renderer})")


def _not_drawn(plans: Iterable[MaterialPlan]) -> Iterator[str]:
    """Yield a sentence for each effect that is missing, however many materials call for it."""
    missing: dict[tuple[str, str], int] = {}
    for plan in plans:
        for effect, reason in plan.not_drawn.items():
            missing[effect, reason] = missing.get((effect, reason), 0) + 1
    for (effect, reason), count in missing.items():
        yield f"{effect} is missing on {count} material{'s' if count > 1 else ''}: {reason}."
