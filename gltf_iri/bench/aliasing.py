"""What a finely varying thickness looks like in few pixels, against a picture of many samples a pixel."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.bench.fine_film import HALF_WIDTH, fine_film
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.planning.decide import plan_materials
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.rendering.render import Renderer
from gltf_iri.scene.environment import white
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Scene

if TYPE_CHECKING:
    import moderngl

__all__ = ["ALIASING_SIZES", "EXPOSURE_EV", "TEXTURE_ROWS", "WAYS", "Aliasing", "AliasingRow"]
__all__ += ["measure_aliasing"]

Float64 = NDArray[np.float64]
Advance = Callable[[], None]

# Pixels a side, and samples a side of each pixel in the reference: some of every texel.
ALIASING_SIZES: Final[Mapping[int, int]] = {16: 64, 64: 32, 256: 16, 1024: 8}

WAYS: Final = ("one texel a pixel", "mean thickness", "mean and spread")

# The film reflects up to 0.12 of the white sky; colours are judged as they are shown, four times as bright.
EXPOSURE_EV: Final = 2.0

TEXTURE_ROWS: Final = 1024
_TILE: Final = 2048  # pixels a side drawn at once
_METHOD: Final = "fourier"


@dataclass(frozen=True, slots=True)
class AliasingRow:
    """CIEDE2000 of one picture against the reference, over the pixels that lie wholly on the sphere."""

    pixels: int  # a side of the picture
    samples: int  # a pixel of the reference
    way: str  # one of WAYS
    max_abs: float  # of a linear channel
    delta_e_mean: float
    delta_e_p95: float
    delta_e_max: float

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return {
            "workload": "aliasing",
            "pixels": self.pixels,
            "reference_samples": self.samples,
            "method": _METHOD,
            "backend": "glsl",
            "way": self.way,
            "ns_per_eval": None,
            "max_abs": self.max_abs,
            "delta_e_mean": self.delta_e_mean,
            "delta_e_p95": self.delta_e_p95,
            "delta_e_max": self.delta_e_max,
        }


@dataclass(frozen=True, slots=True)
class Aliasing:
    """The rows, and for each size the pictures they judge: linear (n, n, 3) by way, and the reference."""

    rows: tuple[AliasingRow, ...]
    pictures: Mapping[int, Mapping[str, Float64]]
    references: Mapping[int, Float64]


def measure_aliasing(
    context: moderngl.Context,
    advance: Advance = lambda: None,
    *,
    sizes: Mapping[int, int] = ALIASING_SIZES,
    texture_rows: int = TEXTURE_ROWS,
) -> Aliasing:
    """Draw the sphere of `fine_film` at each of `sizes` in each of WAYS, under a white sky.

    advance : called after each size. Raises what `Renderer.render` raises.
    """
    rows: list[AliasingRow] = []
    pictures: dict[int, dict[str, Float64]] = {}
    references: dict[int, Float64] = {}
    renderer = Renderer(context)
    try:
        with fine_film(texture_rows) as model:
            stage = _Stage(renderer, model, model.scene())
            for size, samples in sizes.items():
                references[size] = stage.reference(size, samples)
                pictures[size] = {way: stage.draw(size, way) for way in WAYS}
                rows += _judged(pictures[size], references[size], samples)
                advance()
    finally:
        renderer.release()
    return Aliasing(tuple(rows), pictures, references)


def _judged(pictures: Mapping[str, Float64], reference: Float64, samples: int) -> Sequence[AliasingRow]:
    size = len(reference)
    edges = HALF_WIDTH * np.linspace(-1.0, 1.0, size + 1)
    farthest = np.maximum(np.abs(edges[:-1]), np.abs(edges[1:]))
    # The sphere's outline is a polygon, which lies within 1e-3 of the circle.
    whole = np.hypot(farthest[:, None], farthest[None, :]) < 0.999
    scale = 2.0**EXPOSURE_EV
    rows = []
    for way, picture in pictures.items():
        error = delta_e_2000(scale * picture[whole], scale * reference[whole])
        max_abs = float(np.abs(picture[whole] - reference[whole]).max())
        figures = float(error.mean()), float(np.percentile(error, 95)), float(error.max())
        rows.append(AliasingRow(size, samples * samples, way, max_abs, *figures))
    return rows


class _Stage:
    """Draws the one scene, textures in float32, so that filtering is all that differs."""

    def __init__(self, renderer: Renderer, model: Model, scene: Scene) -> None:
        self._renderer, self._model, self._scene = renderer, model, scene
        self._camera = scene.cameras[0]
        self._sky = white()
        (self._spread,) = plan_materials(model.materials, method=_METHOD)
        effects = (e for e in self._spread.effects if e is not Effect.IRIDESCENCE_THICKNESS_SPREAD)
        self._mean = replace(self._spread, effects=tuple(effects))

    def draw(self, size: int, way: str) -> Float64:
        """Return the linear picture (size, size, 3), one sample a pixel."""
        plan = self._spread if way == WAYS[2] else self._mean
        return self._picture(plan, self._camera, size, is_sharp=way == WAYS[0])

    def reference(self, size: int, samples: int) -> Float64:
        """Return the mean of samples² pixels a pixel, each of one texel, drawn tile by tile."""
        tiles = max(1, size * samples // _TILE)
        side = size // tiles
        whole = np.zeros((size, size, 3))
        for row in range(tiles):
            for column in range(tiles):
                fine = self._picture(
                    self._mean, self._tile(tiles, row, column), side * samples, is_sharp=True
                )
                coarse = fine.reshape(side, samples, side, samples, 3).mean(axis=(1, 3))
                whole[row * side : (row + 1) * side, column * side : (column + 1) * side] = coarse
        return whole

    def _tile(self, tiles: int, row: int, column: int) -> Camera:
        view = self._camera.view.copy()
        view[0, 3] -= HALF_WIDTH * (2.0 * (column + 0.5) / tiles - 1.0)
        view[1, 3] += HALF_WIDTH * (2.0 * (row + 0.5) / tiles - 1.0)
        half = HALF_WIDTH / tiles
        return replace(self._camera, view=view, xmag_m=half, ymag_m=half)

    def _picture(self, plan: MaterialPlan, camera: Camera, size: int, *, is_sharp: bool) -> Float64:
        frame = self._renderer.render(
            self._model,
            self._scene,
            [plan],
            camera,
            self._sky,
            size=(size, size),
            samples=1,
            float_textures=True,
            sharp_textures=is_sharp,
        )
        return frame.rgba[..., :3].astype(np.float64)
