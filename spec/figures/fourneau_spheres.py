"""Spheres under Bragg layers in OpenGL, sheet by sheet: Fourneau et al. 2024, Fig. 8 and 10 to 12.

Environments are this project's own: the studio, two soft boxes, and a sun in a cloudy sky. Each sphere is a
glTF material with EXT_materials_bragg, drawn as `gltf-iri render` draws it, by image light.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.baking.layer_fill import bake_layer_plans, cosine_nodes
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.evaluation.mirror import Mirror
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.optics.layer_lobe import layer_lobe
from gltf_iri.optics.microfacet import N_DOT_V_MIN
from gltf_iri.planning.decide import plan_material
from gltf_iri.rendering.context import create_context
from gltf_iri.rendering.picture import display_pixels
from gltf_iri.rendering.render import Renderer
from gltf_iri.samples.sphere import sphere
from gltf_iri.scene.environment import studio
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Environment, Primitive, Scene
from gltf_iri.scene.studio import directions

__all__ = ["figure_8", "figure_10", "figure_11", "figure_12", "material", "pixels", "sheet", "two_boxes"]

Float64 = NDArray[np.float64]
Bytes = NDArray[np.uint8]

_DARK_STUDIO: Final = replace(studio(), backdrop=(0.0, 0.0, 0.0))
OVERSAMPLED: Final = 2  # beside four samples a pixel

# Fig. 8. Printed: n₁ 1, n₂ 1.5, Λ 500 nm, d₁ = d₂; chosen: α, N 20, a black base.
ALPHAS_8: Final = (0.025, 0.1, 0.4)
METHODS_8: Final[Mapping[str, str | None]] = {
    "reference": None,
    "app.": "landmarks",
    "sub., s = 3": "landmarks-sub",
}

# Fig. 10. Printed: α 0.1, ρ_d 0.2, d₁ = 0.3Λ, steps of 30 nm; chosen: where they begin, N, n₂ 1.5, the
# coating's n₁ 1.35.
PERIODS_10: Final = (230.0, 260.0, 290.0, 320.0, 350.0, 380.0)
CELLS_10: Final = (2, 5, 20)
HOSTS_10: Final = {"air": 1.0, "coat": 1.35}

# Fig. 11. Printed: d₁ = d₂ = 250 nm, N 20, α 0.1, two area lights; chosen: the indices, a black base.
FIRST_11: Final = (1.4, 1.5)
N2_11: Final = (1.6, 1.75, 1.95, 2.2)
N1_11: Final = (1.3, 1.2, 1.1, 1.0)

# Fig. 12. Printed: n₁ 1, n₂ 1.5, ρ_d 0.2; d₁, d₂ in nm and N of either layer; chosen: α.
ALPHAS_12: Final = (0.02, 0.05, 0.1, 0.2, 0.4)
TOP_12: Final = (141.0, 329.0, 3)
BOTTOM_12: Final = (98.0, 882.0, 10)


def layer(n1: float, n2: float, d1_nm: float, d2_nm: float, cells: int, alpha: float) -> MirrorLayer:
    """Return a glTF layer of these thicknesses; roughness is √α."""
    period_nm = d1_nm + d2_nm
    return MirrorLayer(n1, n2, period_nm, period_nm, d1_nm / period_nm, cells, float(np.sqrt(alpha)))


def material(layers: Sequence[MirrorLayer], host_ior: float = 1.0, diffuse: float = 0.0) -> Material:
    """Return layers over a diffuse base."""
    pbr = MetallicRoughness((diffuse, diffuse, diffuse, 1.0), metallic_factor=0.0, roughness_factor=1.0)
    return Material(pbr=pbr, bragg=Bragg(factor=1.0, host_ior=host_ior, layers=tuple(layers)))


class Painter:
    """Draws spheres of `size` pixels in one environment."""

    def __init__(self, environment: Environment, size: int) -> None:
        self._context = create_context()
        self._renderer = Renderer(self._context)
        self._environment, self._size = environment, size
        ball = sphere(1.0, rings=64, segments=128)
        parts = ball.positions, ball.normals, ball.triangles
        self._scene = Scene("", (Primitive("", "sphere", 0, *_typed(*parts), np.eye(4)),), (), ())
        view = np.eye(4)
        view[2, 3] = -4.0
        self._camera = Camera("", "orthographic", view, 0.1, 100.0, xmag_m=1.02, ymag_m=1.02)

    def __enter__(self) -> Painter:
        return self

    def __exit__(self, *_: object) -> None:
        self._renderer.release()
        self._context.release()

    def draw(self, of: Material, reflectance: str | None = None) -> Float64:
        """Return the linear picture (size, size, 3), 0 behind the sphere.

        reflectance : a method for mirrors that colours the first layer in place of its spectrum.
        """
        plan = plan_material(of, 0)
        tables = dict(bake_layer_plans([plan]))
        if reflectance is not None:
            tables[0] = _recoloured(tables[0], reflectance)
        side = self._size * OVERSAMPLED
        frame = self._renderer.render(
            Model(Path(), None, (of,), ()),  # type: ignore[arg-type]
            self._scene,
            [plan],
            self._camera,
            self._environment,
            size=(side, side),
            samples=4,
            layer_tables=tables,
        )
        blocks = frame.rgba[..., :3].reshape(self._size, OVERSAMPLED, self._size, OVERSAMPLED, 3)
        return np.asarray(blocks.mean(axis=(1, 3)), np.float64)


def _recoloured(baked: BakedLayers, method: str) -> BakedLayers:
    """Return tables whose first layer has the colours of a method for mirrors."""
    first = baked.plan.layers[0]
    cosines = cosine_nodes(baked.first.shape[1])
    period_nm = first.period_nm[1]
    thickness = first.fill * period_nm, (1.0 - first.fill) * period_nm
    mirror = Mirror.of(cosines, first.n1, first.n2, *thickness, first.cells, baked.plan.host_ior)
    colour = evaluate(method, mirror).rgb
    met, weights = layer_lobe(np.maximum(cosines, N_DOT_V_MIN), first.alpha)
    albedo = np.stack([np.sum(weights * np.interp(met, cosines, c), axis=-1) for c in colour.T], axis=-1)
    kept = [np.pad(each, ((0, 0), (0, 1)))[None].astype(np.float32) for each in (colour, albedo)]
    return replace(baked, first=kept[0], sent=kept[1][None])


def _typed(*arrays: NDArray[Any]) -> tuple[NDArray[Any], ...]:
    positions, normals, triangles = arrays
    return positions.astype(np.float32), normals.astype(np.float32), triangles.astype(np.uint32)


@cache
def two_boxes() -> Environment:
    """Return two soft boxes in the dark, one high on the left, one on the right."""
    at = directions(256)
    radiance = 0.02 * np.ones(at.shape[:2])
    for azimuth, elevation, half, light in ((-0.9, 0.7, 0.22, 60.0), (1.0, 0.25, 0.22, 40.0)):
        centre = np.array(
            [np.sin(azimuth) * np.cos(elevation), np.sin(elevation), np.cos(azimuth) * np.cos(elevation)]
        )
        right = np.array([np.cos(azimuth), 0.0, -np.sin(azimuth)])
        ahead = at @ centre
        across, along = (
            np.abs(at @ axis) / np.maximum(ahead, 1e-6) for axis in (right, np.cross(centre, right))
        )
        edge = np.clip((half - np.maximum(across, along)) / 0.03 + 0.5, 0.0, 1.0)
        radiance += light * edge * (ahead > 0.0)
    return Environment("two boxes", _grey(radiance), backdrop=(0.0, 0.0, 0.0))


@cache
def sun_and_clouds() -> Environment:
    """Return a sun 2° wide in a cloudy sky over a dark ground, all of it neutral."""
    at = directions(256)
    x, y, z = np.moveaxis(at, -1, 0)
    clouds = np.zeros_like(x)
    g = np.random.default_rng(12)
    for octave in range(1, 6):
        for _ in range(3):
            wave = g.normal(size=3) * 2.0**octave
            clouds += 0.5**octave * np.sin(
                wave[0] * x + wave[1] * y * 2.0 + wave[2] * z + g.uniform(0.0, 6.0)
            )
    sky = 0.40 + 0.22 * np.tanh(2.0 * clouds)
    radiance = 0.10 + (sky - 0.10) * np.clip(y / 0.3 + 0.5, 0.0, 1.0)
    sun = np.array([-0.45, 0.55, 0.70]) / np.linalg.norm([-0.45, 0.55, 0.70])
    off_rad = np.arccos(np.clip(at @ sun, -1.0, 1.0))
    radiance += 3000.0 * np.clip((0.0175 - off_rad) / 0.008 + 0.5, 0.0, 1.0)
    return Environment("sun and clouds", _grey(radiance), backdrop=(0.0, 0.0, 0.0))


def _grey(radiance: Float64) -> NDArray[np.float32]:
    return np.repeat(radiance[:, :, None], 3, axis=2).astype(np.float32)


def figure_8(size: int) -> Any:
    """RGB approximations of one layer against its spectra, for three roughnesses."""
    rows: dict[str, list[Bytes]] = {}
    references: list[Float64] = []
    with Painter(_DARK_STUDIO, size) as painter:
        for name, reflectance in METHODS_8.items():
            pictures = [
                painter.draw(material([layer(1.0, 1.5, 250.0, 250.0, 20, alpha)]), reflectance)
                for alpha in ALPHAS_8
            ]
            references = references or pictures
            told = [_difference(a, b) for a, b in zip(pictures, references, strict=True)]
            label = name if name == "reference" else f"{name}\nΔE " + ", ".join(f"{e:.1f}" for e in told)
            rows[label] = [_shown(each, -0.5) for each in pictures]
    return sheet(rows, [f"α = {alpha:g}" for alpha in ALPHAS_8])


def _difference(picture: Float64, reference: Float64) -> float:
    """Return the mean ΔE over the disc."""
    centres = (np.arange(len(picture)) + 0.5) * (2.0 / len(picture)) - 1.0
    is_inside = np.hypot(*np.meshgrid(centres, centres)) < 0.95
    return float(np.mean(delta_e_2000(picture[is_inside], reference[is_inside])))


def figure_10(size: int) -> Any:
    """Period and number of cells, in air and under a coating."""
    rows: dict[str, list[Bytes]] = {}
    with Painter(_DARK_STUDIO, size) as painter:
        for name, host in HOSTS_10.items():
            for cells in CELLS_10:
                rows[f"{name}, N {cells}"] = [
                    _shown(
                        painter.draw(_over_grey(layer(host, 1.5, 0.3 * p, 0.7 * p, cells, 0.1), host)), -0.3
                    )
                    for p in PERIODS_10
                ]
    return sheet(rows, [f"Λ = {p:g} nm" for p in PERIODS_10])


def _over_grey(of: MirrorLayer, host_ior: float = 1.0) -> Material:
    return material([of], host_ior, 0.2)


def figure_11(size: int) -> Any:
    """Contrast of indices, by a higher n₂ or a lower n₁."""
    n1, n2 = FIRST_11
    pairs = {
        "n₂ up": [FIRST_11, *((n1, each) for each in N2_11)],
        "n₁ down": [FIRST_11, *((each, n2) for each in N1_11)],
    }
    rows: dict[str, list[Bytes]] = {}
    with Painter(two_boxes(), size) as painter:
        for name, cells in pairs.items():
            # Equal ratios stand below each other, near enough.
            label = name + "\n" + " ".join(f"{b if name == 'n₂ up' else a:g}" for a, b in cells)
            rows[label] = [
                _shown(painter.draw(material([layer(a, b, 250.0, 250.0, 20, 0.1)], a)), 0.0) for a, b in cells
            ]
    return sheet(rows, ["n₁ 1.4, n₂ 1.5", *(["→"] * len(N2_11))])


def figure_12(size: int) -> Any:
    """Roughness of two layers alone, and of the second under the smoothest first."""
    upper = [layer(1.0, 1.5, TOP_12[0], TOP_12[1], TOP_12[2], alpha) for alpha in ALPHAS_12]
    lower = [layer(1.0, 1.5, BOTTOM_12[0], BOTTOM_12[1], BOTTOM_12[2], alpha) for alpha in ALPHAS_12]
    stacks = {
        "Λ 470, N 3": [[each] for each in upper],
        f"Λ 470, α {ALPHAS_12[0]:g}\nover Λ 980": [[upper[0], each] for each in lower],
        "Λ 980, N 10": [[each] for each in lower],
    }
    with Painter(sun_and_clouds(), size) as painter:
        rows = {
            name: [_shown(painter.draw(material(each, 1.0, 0.2)), 0.3) for each in row]
            for name, row in stacks.items()
        }
    return sheet(rows, [f"α = {alpha:g}" for alpha in ALPHAS_12])


def _shown(linear: Float64, exposure_ev: float) -> Bytes:
    return display_pixels(linear.astype(np.float32), exposure_ev, "none")


def sheet(rows: Mapping[str, Sequence[Bytes]], columns: Sequence[str]) -> Any:
    """Return a figure of pictures, one row for each name."""
    from matplotlib.figure import Figure

    side = len(next(iter(rows.values()))[0])
    wide, high = len(columns) * side + 110, len(rows) * side + 26
    figure = Figure(figsize=(wide / 100.0, high / 100.0), dpi=100, facecolor="black")
    for row, (name, pictures) in enumerate(rows.items()):
        top = high - 26 - (row + 1) * side
        figure.text(4 / wide, (top + 0.5 * side) / high, name, color="0.85", fontsize=7, va="center")
        for column, picture in enumerate(pictures):
            left = 110 + column * side
            axes = figure.add_axes((left / wide, top / high, side / wide, side / high))
            axes.imshow(picture, interpolation="nearest")
            axes.set_axis_off()
    for column, name in enumerate(columns):
        place = (110 + (column + 0.5) * side) / wide
        figure.text(place, 1.0 - 13 / high, name, color="0.85", fontsize=7, ha="center", va="center")
    return figure


def pixels(figure: Any) -> Bytes:
    """Return a figure as sRGB (height, width, 3)."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].copy()
