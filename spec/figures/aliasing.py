"""Draws aliasing.webp, Belcour & Barla 2017, Fig. 15: `python spec/figures/aliasing.py` in a checkout."""

from __future__ import annotations

from pathlib import Path

from gltf_iri.bench.aliasing import measure_aliasing
from gltf_iri.bench.aliasing_sheet import aliasing_sheet
from gltf_iri.rendering.context import create_context
from gltf_iri.rendering.picture import webp_bytes

__all__ = ["main"]


def main() -> None:
    """Draw the sheet beside this file."""
    context = create_context()
    sheet = aliasing_sheet(measure_aliasing(context))
    Path(__file__).with_name("aliasing.webp").write_bytes(webp_bytes(sheet))
    context.release()


if __name__ == "__main__":
    main()
