"""Paints rows of a picture: casts their rays, gathers what they meet, lights it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.material.iridescence import Iridescence
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.method import DEFAULT_METHOD, find_method
from gltf_iri.reference.cutout import coverage
from gltf_iri.reference.direct import emitted, punctual_lighting
from gltf_iri.reference.edges import edge_distance_px
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.film_on import FilmMethod, FilmOn, in_one_direction
from gltf_iri.reference.film_table import TabulatedFilm
from gltf_iri.reference.gather import gather_surface
from gltf_iri.reference.glass import Scenery, Traced, trace_glass
from gltf_iri.reference.image_light import reflected
from gltf_iri.reference.layers_method import layers_method
from gltf_iri.reference.layers_on import LayersMethod
from gltf_iri.reference.points import gather_points
from gltf_iri.reference.rays import camera_rays
from gltf_iri.reference.stage import Stage
from gltf_iri.reference.surface import Surface
from gltf_iri.reference.tracer import Hits, Tracer
from gltf_iri.scene.model import Camera, Environment

__all__ = ["LIGHTINGS", "Job", "Lighting", "Painter", "Tile"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]

Lighting = Literal["punctual", "image", "all"]
LIGHTINGS: Final[tuple[Lighting, ...]] = ("punctual", "image", "all")

# Blended surfaces that a ray passes; what lies behind that many adds nothing that could be seen.
_MAX_BLENDED: Final = 64


@dataclass(frozen=True, slots=True)
class Job:
    """A picture to paint; see `render_reference`. May be sent to other processes."""

    stage: Stage
    camera: Camera
    environment: Environment | None
    size: tuple[int, int]
    film_method: str | None
    layer_method: str | None
    layer_tables: Mapping[int, BakedLayers]
    white: str
    lighting: Lighting
    is_blending: bool
    image_samples: int
    path_depth: int
    paths: int
    seed: int


@dataclass(frozen=True, slots=True)
class Tile:
    """n pixels of a picture, row by row; the fields are those of `ReferenceFrame`."""

    rgba: Float64  # (n, 4), premultiplied
    material: Int64  # (n,)
    depth_m: Float64  # (n,)
    standard_error: Float64  # (n, 3)
    edge_px: Float64  # (n,)
    lost: Float64  # (n,), share of a white environment that paths through glass gave up

    @classmethod
    def blank(cls, count: int) -> Tile:
        """Return a tile on which nothing was drawn."""
        return cls(
            rgba=np.zeros((count, 4)),
            material=np.full(count, -1),
            depth_m=np.full(count, np.inf),
            standard_error=np.zeros((count, 3)),
            edge_px=np.full(count, np.inf),
            lost=np.zeros(count),
        )


class Painter:
    """Holds what all tiles of a job need. Raises MissingCapabilityError where embreex is not installed."""

    def __init__(self, job: Job) -> None:
        self._job = job
        self._tracer = Tracer(job.stage)
        blended = [plan.calls_for(Effect.ALPHA_BLEND) for plan in job.stage.plans]
        self._is_blended = np.asarray(blended) & job.is_blending
        self._slots = np.asarray(job.stage.slots)
        self._methods: dict[int, FilmMethod] = {}
        self._layers: dict[int, LayersMethod | None] = {}
        self._environment: EnvironmentMap | None = None
        if job.environment is not None and job.lighting != "punctual":
            self._environment = EnvironmentMap(job.environment)
        self._scenery = Scenery(
            self._tracer,
            job.stage,
            self._environment,
            job.environment.backdrop if job.environment is not None else None,
            () if job.lighting == "image" else job.stage.scene.lights,
            self._film_on,
            job.is_blending,
        )

    def paint(self, index: int, rows: tuple[int, int]) -> Tile:
        """Return tile number `index`, which covers `rows` (first, one past the last)."""
        job = self._job
        rng = np.random.default_rng([job.seed, index])
        origins, directions, lengths = camera_rays(job.camera, job.size, rows)
        tile = Tile.blank(len(origins))
        left = np.arange(len(origins))
        start = np.zeros(len(origins))
        for _ in range(_MAX_BLENDED):
            hits = self._tracer.first_hits(origins[left], directions[left], t_min=start, t_max=lengths[left])
            left, hits = left[hits.valid], hits.take(hits.valid)
            if not len(left):
                break
            sent = self._colours(hits, directions[left], rng)
            alpha = self._alpha(hits)
            share = (1.0 - tile.rgba[left, 3]) * alpha
            tile.rgba[left, :3] += share[:, None] * sent.colour
            tile.rgba[left, 3] += share
            tile.lost[left] += share * sent.lost
            tile.standard_error[left] = np.hypot(
                tile.standard_error[left], share[:, None] * sent.standard_error
            )
            position = origins[left] + hits.distance[:, None] * directions[left]
            depth_m = -(position @ job.camera.view[2, :3] + job.camera.view[2, 3])
            is_first = tile.material[left] < 0
            tile.depth_m[left[is_first]] = depth_m[is_first]
            tile.material[left[is_first]] = self._slots[hits.primitive[is_first]]
            tile.edge_px[left[is_first]] = self._edge_px(hits.take(is_first), left[is_first], rows[0])
            going_on = alpha < 1.0
            start = hits.distance[going_on] + self._tracer.clearance_m
            left = left[going_on]
        return tile

    def _edge_px(self, hits: Hits, pixels: Int64, first_row: int) -> Float64:
        width = self._job.size[0]
        centres = np.column_stack([pixels % width, pixels // width + first_row]).astype(np.float64) + 0.5
        return edge_distance_px(self._job.camera, self._job.size, self._tracer.corners(hits), centres)

    def _alpha(self, hits: Hits) -> Float64:
        """Return how much (n,) of what lies behind each hit it hides."""
        alpha = np.ones(len(hits.primitive))
        rows = np.flatnonzero(self._is_blended[self._slots[hits.primitive]])
        if len(rows):
            found = hits.primitive[rows], hits.triangle[rows], hits.barycentric[rows]
            alpha[rows] = np.clip(coverage(self._job.stage, *found), 0.0, 1.0)
        return alpha

    def _colours(self, hits: Hits, directions: Float64, rng: np.random.Generator) -> Traced:
        """Return what valid hits send back along rays of these directions, (n, 3)."""
        sent = Traced(np.zeros_like(directions), np.zeros_like(directions), np.zeros(len(directions)))
        slots = self._slots[hits.primitive]
        for slot in np.unique(slots):
            rows = np.flatnonzero(slots == slot)
            here = self._material_colours(int(slot), hits.take(rows), directions[rows], rng)
            sent.colour[rows], sent.standard_error[rows] = here.colour, here.standard_error
            sent.lost[rows] = here.lost
        return sent

    def _material_colours(
        self, slot: int, hits: Hits, directions: Float64, rng: np.random.Generator
    ) -> Traced:
        job, plan = self._job, self._job.stage.plans[slot]
        nothing = np.zeros_like(directions)
        if plan.calls_for(Effect.TRANSMISSION) and job.lighting != "punctual":
            return trace_glass(
                self._scenery, directions, hits, paths=job.paths, depth=job.path_depth, rng=rng
            )
        points = gather_points(
            job.stage.scene, hits.primitive, hits.triangle, hits.barycentric, hits.is_front
        )
        surface = gather_surface(job.stage, slot, points, -directions)
        if plan.calls_for(Effect.UNLIT):
            return Traced(surface.base_color, nothing, nothing[:, 0])
        film = self._film_on(slot, surface)
        colour = emitted(surface, plan) + punctual_lighting(surface, self._scenery.lights, film, plan)
        if self._environment is None:
            return Traced(colour, nothing, nothing[:, 0])
        reflection, error = reflected(
            surface, plan, self._environment, film, samples=job.image_samples, rng=rng
        )
        return Traced(colour + reflection, error, nothing[:, 0])

    def _film_on(self, slot: int, surface: Surface) -> FilmOn:
        job, plan = self._job, self._job.stage.plans[slot]
        film_ior = (job.stage.materials[slot].iridescence or Iridescence()).film_ior
        # Without a film there is no method, and none is ever called.
        name = job.film_method or plan.method or DEFAULT_METHOD
        if slot not in self._methods:
            parameters = plan.way.parameters if plan.way is not None and name == plan.way.method else {}
            method = partial(evaluate, name, white=job.white, parameters=parameters)
            # The truth takes a hundred microseconds; a picture asks for millions of films.
            of_film = TabulatedFilm(method) if find_method(name).is_truth else method
            self._methods[slot] = in_one_direction(of_film)
        return FilmOn(surface, film_ior, self._methods[slot], self._layers_of(slot))

    def _layers_of(self, slot: int) -> LayersMethod | None:
        job, plan = self._job, self._job.stage.plans[slot]
        if slot not in self._layers:
            self._layers[slot] = layers_method(plan, job.layer_method, job.layer_tables, job.white)
        return self._layers[slot]
