"""Draws the figures of spec/EXT_materials_bragg: `python spec/figures/bragg_proposal.py [NAME …]`.

In a checkout with OpenGL; a minute for all. Spheres are glTF materials with EXT_materials_bragg, drawn as
`gltf-iri render` draws them, by this project's studio.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

import numpy as np
from fourneau_spheres import Painter, pixels, sheet
from numpy.typing import NDArray

from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.rendering.picture import display_pixels, webp_bytes
from gltf_iri.scene.environment import studio

__all__ = ["PICTURES", "Row", "main"]

Bytes = NDArray[np.uint8]

FOLDER: Final = Path(__file__).resolve().parents[1] / "EXT_materials_bragg" / "figures"
_BACKDROP: Final = replace(studio(), backdrop=(0.0, 0.0, 0.0))
_SIDE: Final = 150  # pixels of a sphere


@dataclass(frozen=True, slots=True)
class Row:
    """A row of spheres: what each is called, its layers, its base, and a gain for all in stops."""

    name: str
    columns: Sequence[str]
    layers: Sequence[Sequence[MirrorLayer]]
    diffuse: Sequence[float]
    exposure_ev: float


def mirror(
    period_nm: float, cells: int, *, fill: float = 0.5, ior_2: float = 1.25, rough: float = 0.35
) -> MirrorLayer:
    """Return a layer of one period in a host of its own n1."""
    return MirrorLayer(None, ior_2, period_nm, period_nm, fill, cells, rough)


def single(name: str, columns: Sequence[str], layers: Sequence[MirrorLayer], exposure_ev: float = 0.0) -> Row:
    """Return spheres of one layer each, on black."""
    return Row(name, columns, [[each] for each in layers], [0.0] * len(layers), exposure_ev)


CELLS: Final = (1, 3, 10, 20, 50)
PERIODS: Final = (195, 215, 235, 255, 275, 295, 520)
FILLS: Final = (0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95)
ROUGH: Final = (0.0, 0.2, 0.4, 0.6, 0.8, 1.0)
_RED: Final = mirror(280.0, 30)
_BLUE: Final = mirror(205.0, 30)

ROWS: Final = {
    "cells.webp": single("cells", [str(n) for n in CELLS], [mirror(240.0, n) for n in CELLS]),
    "periods.webp": single("period", [f"{nm} nm" for nm in PERIODS], [mirror(nm, 30) for nm in PERIODS]),
    "fill.webp": single("fill", [f"{f:g}" for f in FILLS], [mirror(240.0, 30, fill=f) for f in FILLS]),
    "roughness.webp": single(
        "roughness", [f"{r:g}" for r in ROUGH], [mirror(240.0, 30, rough=r) for r in ROUGH]
    ),
    "stacked.webp": Row(
        "layers",
        ["red", "blue", "red over blue", "red over white", "blue over white"],
        [[_RED], [_BLUE], [_RED, _BLUE], [_RED], [_BLUE]],
        [0.0, 0.0, 0.0, 0.8, 0.8],
        -0.5,
    ),
}


def spheres(row: Row) -> Any:
    """Return a figure of one row of spheres."""
    pictures: list[Bytes] = []
    with Painter(_BACKDROP, _SIDE) as painter:
        for layers, diffuse in zip(row.layers, row.diffuse, strict=True):
            pbr = MetallicRoughness(
                (diffuse, diffuse, diffuse, 1.0), metallic_factor=0.0, roughness_factor=1.0
            )
            linear = painter.draw(Material(pbr=pbr, bragg=Bragg(factor=1.0, layers=tuple(layers))))
            pictures.append(display_pixels(linear.astype(np.float32), row.exposure_ev, "none"))
    return sheet({row.name: pictures}, row.columns)


def sketch() -> Any:
    """Return a drawing of a stack, and of one facet's films in their order."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.4, 3.5), dpi=100, facecolor="white")
    _draw_stack(figure.add_axes((0.01, 0.02, 0.50, 0.96)))
    _draw_facet(figure.add_axes((0.56, 0.02, 0.43, 0.96)))
    return figure


_FILM_1, _FILM_2, _INK = "#cfe3f5", "#2f6ea8", "#222222"


def _draw_stack(axes: Any) -> None:
    axes.set(xlim=(0, 10), ylim=(0, 7))
    axes.set_axis_off()
    axes.fill_between([0.2, 9.8], 1.1, 5.6, color=_FILM_1, lw=0)
    axes.fill_between([0.2, 9.8], 0.2, 1.1, color="#9a9a9a", lw=0)
    axes.plot([0.2, 9.8], [5.6, 5.6], color=_INK, lw=1.2)
    g = np.random.default_rng(3)
    for middle, hue in ((4.4, _FILM_2), (2.4, "#a8402f")):
        for x in np.arange(0.9, 9.4, 1.05):
            _draw_mirror(axes, x, middle, g.normal(0.0, 0.22), hue)
    arrow = {"arrowstyle": "-|>", "color": "#d18b00", "lw": 1.6}
    axes.annotate("", (7.2, 4.55), (6.15, 6.9), arrowprops=arrow)
    axes.annotate("", (8.75, 6.9), (7.2, 4.55), arrowprops=arrow)
    axes.annotate("", (9.05, 1.1), (7.2, 4.4), arrowprops={**arrow, "ls": "--"})
    told = (
        (0.35, 6.05, "outside, index 1"),
        (0.35, 5.15, "host, hostIor: its surface is smooth"),
        (0.35, 3.45, "layers[0]: met first"),
        (0.35, 1.45, "layers[1]"),
        (0.35, 0.5, "base material"),
    )
    for x, y, text in told:
        axes.text(x, y, text, fontsize=9, color=_INK)


def _draw_mirror(axes: Any, x: float, y: float, tilt_rad: float, hue: str) -> None:
    along = 0.4 * np.array([np.cos(tilt_rad), np.sin(tilt_rad)])
    down = 0.13 * np.array([np.sin(tilt_rad), -np.cos(tilt_rad)])
    for k in range(3):
        at = np.array([x, y]) + k * down
        ends = np.stack([at - along, at + along])
        axes.plot(ends[:, 0], ends[:, 1], color=hue, lw=2.2, solid_capstyle="butt")


def _draw_facet(axes: Any) -> None:
    axes.set(xlim=(0, 10), ylim=(0, 10))
    axes.set_axis_off()
    top, thick, thin = 8.2, 1.1, 0.8
    axes.fill_between([0.3, 5.2], top, 9.6, color="#eef5fb", lw=0)
    axes.text(0.5, 8.9, "hostIor", fontsize=9, color=_INK, va="center")
    for cell in range(3):
        below = top - thick
        axes.fill_between([0.3, 5.2], below, top, color=_FILM_1, lw=0)
        axes.text(0.5, 0.5 * (top + below), "film 1: ior1, d1", fontsize=9, color=_INK, va="center")
        axes.fill_between([0.3, 5.2], below - thin, below, color=_FILM_2, lw=0)
        axes.text(0.5, below - 0.5 * thin, "film 2: ior2, d2", fontsize=9, color="white", va="center")
        axes.annotate(
            "", (5.6, top), (5.6, below - thin), arrowprops={"arrowstyle": "<->", "color": _INK, "lw": 1.0}
        )
        axes.text(
            5.85, 0.5 * (top + below - thin), f"cell {cell + 1}: period", fontsize=9, color=_INK, va="center"
        )
        top = below - thin
    axes.fill_between([0.3, 5.2], top - 1.4, top, color=_FILM_1, lw=0)
    axes.text(0.5, top - 0.7, "behind: ior1", fontsize=9, color=_INK, va="center")
    axes.annotate("", (4.6, 8.2), (4.6, 9.8), arrowprops={"arrowstyle": "-|>", "color": "#d18b00", "lw": 1.8})
    axes.text(5.85, 9.2, "d1 = fill · period\nd2 = (1 − fill) · period", fontsize=9, color=_INK, va="center")


def _png(figure: Any, path: Path) -> None:
    # No date and no version of the writer: drawn again it is the same file.
    figure.savefig(path, metadata={"Software": None})


def _webp(row: Row) -> Callable[[Path], None]:
    return lambda path: path.write_bytes(webp_bytes(pixels(spheres(row)))) and None


PICTURES: Final[dict[str, Callable[[Path], None]]] = {
    "cell.png": lambda path: _png(sketch(), path),
    **{name: _webp(row) for name, row in ROWS.items()},
}


def main() -> None:
    """Draw the named figures, or all."""
    FOLDER.mkdir(exist_ok=True)
    for name in sys.argv[1:] or PICTURES:
        PICTURES[name](FOLDER / name)


if __name__ == "__main__":
    main()
