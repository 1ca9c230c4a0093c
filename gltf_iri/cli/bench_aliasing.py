"""`gltf-iri bench aliasing`: minified thickness textures, as figures and as a sheet of pictures."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from gltf_iri.cli.common import print_table, progress

if TYPE_CHECKING:
    from gltf_iri.bench.aliasing import Aliasing

__all__ = ["measure_pictures", "print_aliasing", "write_aliasing"]

_SHEET: Final = "aliasing.webp"
_FIGURES: Final = "aliasing.json"


def measure_pictures() -> tuple[Aliasing, dict[str, Any]]:
    """Draw and judge the pictures, and say on which machine; MissingCapabilityError without OpenGL."""
    from gltf_iri.bench import aliasing
    from gltf_iri.bench.machine import machine
    from gltf_iri.rendering.context import create_context, renderer_name

    context = create_context()
    try:
        with progress("aliasing", len(aliasing.ALIASING_SIZES)) as advance:
            measured = aliasing.measure_aliasing(
                context, advance, sizes=aliasing.ALIASING_SIZES, texture_rows=aliasing.TEXTURE_ROWS
            )
        return measured, {**machine(), "gl_renderer": renderer_name(context)}
    finally:
        context.release()


def print_aliasing(measured: Aliasing) -> None:
    """Print a row for each picture."""
    columns = ("pixels", "samples", "drawn with", "max abs", "ΔE mean", "ΔE p95", "ΔE max")
    cells = [
        (
            f"{row.pixels} × {row.pixels}",
            f"{row.samples:,}",
            row.way,
            f"{row.max_abs:.2g}",
            f"{row.delta_e_mean:.2f}",
            f"{row.delta_e_p95:.2f}",
            f"{row.delta_e_max:.2f}",
        )
        for row in measured.rows
    ]
    title = "A finely varying thickness against many samples a pixel, D65 white, CIEDE2000 at 4 × the light"
    print_table(columns, cells, title=title)


def write_aliasing(folder: Path, measured: Aliasing, machine: Mapping[str, Any]) -> None:
    """Write figures and sheet into `folder`; UsageError where that cannot be."""
    import json

    from gltf_iri.bench.aliasing_sheet import aliasing_sheet
    from gltf_iri.rendering.picture import webp_bytes
    from gltf_iri.whole_files import write_or_refuse

    rows = [row.to_json() for row in measured.rows]
    text = json.dumps({"white": "D65", "machine": dict(machine), "rows": rows}, indent=2)
    files = {_FIGURES: (text + "\n").encode(), _SHEET: webp_bytes(aliasing_sheet(measured))}
    write_or_refuse({folder / name: content for name, content in files.items()}, folder)
