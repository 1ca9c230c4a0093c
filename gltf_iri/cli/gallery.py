"""`gltf-iri gallery`: many files on one page."""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path
from typing import Literal

import click

from gltf_iri.cli.budget import budget_option, check_choice
from gltf_iri.cli.common import json_option, note, print_json, progress
from gltf_iri.cli.picture_options import SIZE, exposure_option

__all__ = ["command"]


@click.command(name="gallery")
@click.argument("folder", metavar="OUTDIR", type=click.Path(file_okay=False, path_type=Path))
@click.argument("paths", metavar="[PATH]...", nargs=-1, type=click.Path(exists=True, path_type=Path))
@click.option(
    "--size", type=SIZE, default="320x240", show_default=True, help="Size of each picture in pixels."
)
@click.option(
    "--env", default="studio", show_default=True, metavar="FILE|studio|white|none", help="Image light."
)
@exposure_option("auto")
@click.option(
    "--method", metavar="NAME", help="Method for films, or for layers; the plan chooses when left out."
)
@budget_option
@json_option
def command(
    folder: Path,
    paths: tuple[Path, ...],
    size: tuple[int, int],
    env: str,
    exposure: float | Literal["auto"] | None,
    method: str | None,
    budget: float | None,
    as_json: bool,
) -> None:
    """Draw every .gltf and .glb file of the PATHs onto one page, OUTDIR/index.html.

    PATHs are files and folders, with the folders in them. Without any, the samples are written to
    OUTDIR/samples and shown. Beside each picture stand the plan and the error; beside a broken file its
    error alone (also where nothing keeps the --budget), the rest is drawn all the same, and the exit code is
    1.
    """
    from gltf_iri.errors import AssetError
    from gltf_iri.gallery.entry import Setup, make_entry
    from gltf_iri.gallery.find import find_assets
    from gltf_iri.gallery.page import write_gallery
    from gltf_iri.rendering.context import create_context
    from gltf_iri.rendering.programs import check_method
    from gltf_iri.rendering.render import Renderer
    from gltf_iri.rendering.targets import check_size
    from gltf_iri.samples.collection import write_samples
    from gltf_iri.scene.choose import choose_environment

    check_choice(budget, method=method)
    check_method(method)
    setup = Setup(size, choose_environment(env), None if exposure == "auto" else exposure, method, budget)
    context = create_context()
    check_size(context, size, samples=4)
    if not paths:
        paths = (folder / "samples",)
        write_samples(paths[0])
    files = find_assets(paths)
    renderer = Renderer(context)
    entries = []
    with ExitStack() as put_away, progress("Drawing", len(files)) as advance:
        put_away.callback(context.release)
        for file in files:
            entries.append(make_entry(renderer, file, setup))
            advance()
    page = write_gallery(entries, setup, folder)

    if as_json:
        print_json({"page": page, "size": list(size), "files": [entry.to_json() for entry in entries]})
    else:
        for entry in entries:
            if entry.error is not None:
                note(entry.error)
        click.echo(f"The page is {page} ({_counted(len(entries))}).")
    unsound = [entry for entry in entries if not entry.is_sound]
    if unsound:
        broken = sum(entry.error is not None for entry in unsound)
        differing = len(unsound) - broken
        said = [f"{broken} could not be drawn"] * (broken > 0)
        said += [f"on {differing} GLSL and Python disagree"] * (differing > 0)
        raise AssetError(f"Of {_counted(len(entries))}, {' and '.join(said)}; see {page}")


def _counted(files: int) -> str:
    return f"{files} file" + "s" * (files != 1)
