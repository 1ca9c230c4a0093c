"""The CPU reference: the renderer's picture, cast and shaded in float64."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.registry import EVALUATORS
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.method import find_method
from gltf_iri.reference.layers_method import LAYERS_TRUTH, check_layers
from gltf_iri.reference.paint import LIGHTINGS, Job, Lighting, Tile
from gltf_iri.reference.stage import build_stage
from gltf_iri.reference.tiles import paint_tiles, tile_rows
from gltf_iri.scene.load import Model
from gltf_iri.scene.model import Camera, Environment, Scene

__all__ = ["ReferenceFrame", "render_reference"]

Float64 = NDArray[np.float64]

# As large a picture as the renderer draws: 8K.
_MAX_PIXELS: Final = 7680 * 4320

# A row is painted at once: a wider one would not fit into memory with all that is known of its pixels.
_MAX_SIDE: Final = 1 << 14

# Far beyond any use, and within memory: a point's samples are drawn at once, and a path keeps what it is in.
_MAX_SAMPLES: Final = 1 << 20
_MAX_PATH_DEPTH: Final = 1024


@dataclass(frozen=True, slots=True)
class ReferenceFrame:
    """A picture in linear Rec.709, before exposure and tone mapping; row 0 is the top.

    rgba : (height, width, 4), premultiplied; alpha is 1 where an opaque surface was hit, 0 where nothing was.
    material : (height, width), place of the plan of the nearest surface, −1 where there is none.
    depth_m : (height, width), its distance from the eye along the view's axis, ∞ where there is none.
    standard_error : (height, width, 3), of the estimate in `rgba`; 0 where nothing was estimated.
    edge_px : (height, width), distance of the pixel's centre from the nearest edge of the triangle that it
        sees, ∞ where there is none; where it is less than some 1/256, OpenGL may see the neighbour.
    """

    rgba: Float64
    material: NDArray[np.int64]
    depth_m: Float64
    standard_error: Float64
    edge_px: Float64
    notes: tuple[str, ...]


def render_reference(
    model: Model,
    scene: Scene,
    plans: Sequence[MaterialPlan],
    camera: Camera,
    environment: Environment | None,
    *,
    size: tuple[int, int],
    lighting: Lighting = "all",
    film_method: str | None = None,
    layer_method: str | None = LAYERS_TRUTH,
    layer_tables: Mapping[int, BakedLayers] = MappingProxyType({}),
    white: str = "D65",
    is_blending: bool = True,
    image_samples: int = 256,
    path_depth: int = 32,
    paths: int = 64,
    seed: int = 0,
    processes: int | None = None,
    advance: Callable[[], None] = lambda: None,
) -> ReferenceFrame:
    """Return `scene` as rays through the pixels' centres see it, textures without minification.

    Punctual light casts no shadows and image light is not occluded by the scene, as in the rasteriser.

    Parameters
    ----------
    plans : one for each material; the default material's is added where it is missing (`complete_plans`).
    environment : image light; None for none. It is not drawn behind the scene.
    size : width and height in pixels.
    lighting : "punctual", "image" or "all"; emission is always there.
    film_method, white : a method for every film in place of the plans' own, and the white it works under.
    layer_method : a method for all Bragg layers; the truth unless told otherwise. None: the plans' own, from
        `layer_tables` (`baking.layer_fill.bake_layer_plans`, under `white`) where they have tables.
    is_blending : False draws blended materials as if opaque, as the renderer does with its shading inputs.
    image_samples : samples a pixel of the integral over the environment.
    path_depth, paths : surfaces along a path through glass, and paths a pixel. Dense bodies keep light long:
        of rough glass of index 2.4, 8 surfaces lose up to half, 32 a few percent.
    seed : of all random numbers; the picture does not depend on `processes`.
    processes : None for one a processor.
    advance : called after each of `count_tiles(size)` tiles.

    Raises UsageError for a size, method or number out of range, AssetError for a broken image, and
    MissingCapabilityError without embreex or where a process dies.
    """
    _check(size, lighting, film_method, image_samples, path_depth, paths, seed)
    stage = build_stage(model, scene, plans)
    for plan in stage.plans:
        check_layers(plan, layer_method, layer_tables, white)
    job = Job(
        stage=stage,
        camera=camera,
        environment=environment,
        size=size,
        film_method=film_method,
        layer_method=layer_method,
        layer_tables=dict(layer_tables),
        white=white,
        lighting=lighting,
        is_blending=is_blending,
        image_samples=image_samples,
        path_depth=path_depth,
        paths=paths,
        seed=seed,
    )
    width, height = size
    count = width * height
    whole = Tile.blank(count)
    rows = tile_rows(size)
    for index, tile in paint_tiles(job, processes):
        pixels = slice(rows[index][0] * width, rows[index][1] * width)
        whole.rgba[pixels], whole.material[pixels] = tile.rgba, tile.material
        whole.depth_m[pixels], whole.standard_error[pixels] = tile.depth_m, tile.standard_error
        whole.edge_px[pixels], whole.lost[pixels] = tile.edge_px, tile.lost
        advance()
    return ReferenceFrame(
        whole.rgba.reshape(height, width, 4),
        whole.material.reshape(height, width),
        whole.depth_m.reshape(height, width),
        whole.standard_error.reshape(height, width, 3),
        whole.edge_px.reshape(height, width),
        (*_notes(job), *_losses(whole, path_depth)),
    )


def _check(
    size: tuple[int, int],
    lighting: str,
    film_method: str | None,
    image_samples: int,
    path_depth: int,
    paths: int,
    seed: int,
) -> None:
    width, height = size
    if not (1 <= width <= _MAX_SIDE and 1 <= height <= _MAX_SIDE and width * height <= _MAX_PIXELS):
        raise UsageError(
            f"The size {width} × {height} is out of range: 1 to {_MAX_SIDE} pixels a side, "
            f"and {_MAX_PIXELS} in all."
        )
    if lighting not in LIGHTINGS:
        raise UsageError(f"There is no lighting '{lighting}'; choose one of: {', '.join(LIGHTINGS)}.")
    if film_method is not None and find_method(film_method, "film").name not in EVALUATORS:
        raise UsageError(f"The method '{film_method}' does not compute films.")
    for number, name, most in (
        (image_samples, "image samples", _MAX_SAMPLES),
        (path_depth, "surfaces a path", _MAX_PATH_DEPTH),
        (paths, "paths", _MAX_SAMPLES),
    ):
        if not 1 <= number <= most:
            raise UsageError(f"{number} {name} are out of range; ask for 1 to {most}.")
    if seed < 0:
        raise UsageError(f"The seed {seed} is negative; choose a whole number from 0.")


def _notes(job: Job) -> Iterator[str]:
    plans = job.stage.plans
    if job.lighting != "image" and job.stage.scene.lights:
        yield "Punctual light casts no shadows, as in the rasteriser."
    if job.lighting != "punctual" and job.environment is not None:
        yield "Image light is not occluded by the scene, as in the rasteriser."
    if not job.is_blending and any(plan.calls_for(Effect.ALPHA_BLEND) for plan in plans):
        yield "Blended materials are drawn as if opaque."


def _losses(whole: Tile, path_depth: int) -> Iterator[str]:
    seen = whole.lost > 0.0
    if seen.any():
        mean, most = 100.0 * whole.lost[seen].mean(), 100.0 * whole.lost.max()
        yield (
            f"Paths through glass end after {path_depth} surfaces: it makes {int(seen.sum())} pixels darker, "
            f"under a white environment by {mean:.2g} % on average and {most:.2g} % at most."
        )
