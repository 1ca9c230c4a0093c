"""``gltf-iri samples [DIR]``: write the sample assets."""

from __future__ import annotations

from pathlib import Path

import click

from gltf_iri.cli.common import json_option, print_json

__all__ = ["command"]


@click.command("samples")
@click.argument("folder", metavar="[DIR]", type=click.Path(path_type=Path), default=Path("samples"))
@json_option
def command(folder: Path, as_json: bool) -> None:
    """Write the sample assets into DIR (samples), each with a README that says what to look for."""
    from gltf_iri.samples.collection import write_samples

    written = write_samples(folder)
    if as_json:
        print_json({"written": written})
        return
    for path in written:
        click.echo(path)
