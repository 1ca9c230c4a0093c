"""Paths through a scene with glass in it: where each stands, what it carries, and what it brings back."""

from __future__ import annotations

from dataclasses import fields
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.material.dispersion import Dispersion
from gltf_iri.material.ior import Ior
from gltf_iri.material.volume import Volume
from gltf_iri.optics.transmission import dispersed_iors
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.reference.cutout import coverage
from gltf_iri.reference.film_on import FilmOn
from gltf_iri.reference.gather import gather_surface
from gltf_iri.reference.glass_light import Scenery, sent, unmirrored
from gltf_iri.reference.glass_surface import cross
from gltf_iri.reference.points import Points, gather_points
from gltf_iri.reference.surface import Surface
from gltf_iri.reference.tracer import Hits

__all__ = ["Walk"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]
Mask = NDArray[np.bool_]

# A path that would add less of what it meets is given up.
_NEGLIGIBLE: Final = 1e-3

# No channel has been chosen yet.
_ALL: Final = -1


class Walk:
    """n paths from their first hits on.

    After `run`, `colour` (n, 3) is what each brought back, and `lost` (n,) the share that was given up.
    """

    def __init__(
        self, scenery: Scenery, directions: Float64, hits: Hits, depth: int, rng: np.random.Generator
    ) -> None:
        count = len(directions)
        self._scenery, self._depth, self._rng = scenery, depth, rng
        self._slots = np.asarray(scenery.stage.slots)
        self._first = hits
        self._origin = np.zeros((count, 3))
        self._direction = directions.copy()
        self._throughput = np.ones((count, 3))
        # Bodies that the path is in, the outermost first.
        self._media = np.zeros((count, depth + 1), np.int64)
        self._level = np.zeros(count, np.int64)  # how many of them
        self._is_straight = np.ones(count, np.bool_)
        self._channel = np.full(count, _ALL)
        self._is_alive = np.ones(count, np.bool_)
        self.colour = np.zeros((count, 3))
        self.lost = np.zeros(count)

    def run(self) -> None:
        """Follow all paths to their ends."""
        rows = np.arange(len(self._direction))
        for met in range(self._depth + 1):
            hits = self._cast(rows) if met else self._first
            self._escape(rows[~hits.valid])
            rows, hits = rows[hits.valid], hits.take(hits.valid)
            if met:
                self._absorb(rows, hits.distance)
            slots = self._slots[hits.primitive]
            for slot in np.unique(slots):
                chosen = np.flatnonzero(slots == slot)
                self._meet(int(slot), rows[chosen], hits.take(chosen), met)
            rows = rows[self._is_alive[rows]]
            faint = self._throughput[rows].max(axis=1, initial=0.0) < _NEGLIGIBLE
            self._give_up(rows[faint])
            rows = rows[~faint]
            if not len(rows):
                return
        self._give_up(rows)

    def _cast(self, rows: Int64) -> Hits:
        """Return what the paths meet next; back faces are there for those inside of a body only."""
        is_inside = self._level[rows] > 0
        order = np.argsort(is_inside, kind="stable")
        outside, inside = np.split(order, [int(np.sum(~is_inside))])
        tracer = self._scenery.tracer
        parts = [
            tracer.first_hits(
                self._origin[rows[chosen]],
                self._direction[rows[chosen]],
                t_min=tracer.clearance_m,
                cull_back_faces=culled,
            )
            for chosen, culled in ((outside, True), (inside, False))
        ]
        joined = Hits(**{f.name: np.concatenate([getattr(p, f.name) for p in parts]) for f in fields(Hits)})
        return joined.take(np.argsort(order))

    def _escape(self, rows: Int64) -> None:
        s = self._scenery
        light = np.zeros((len(rows), 3))
        if s.environment is not None:
            light = s.environment.radiance(self._direction[rows])
        if s.backdrop is not None:
            light = np.where(self._is_straight[rows, None], np.array(s.backdrop), light)
        self.colour[rows] += self._throughput[rows] * light
        self._is_alive[rows] = False

    def _give_up(self, rows: Int64) -> None:
        self.lost[rows] = self._throughput[rows].mean(axis=1)
        self._is_alive[rows] = False

    def _absorb(self, rows: Int64, distance_m: Float64) -> None:
        """Take off what the innermost body absorbs along the last leg."""
        inside = self._level[rows] > 0
        within, distance = rows[inside], distance_m[inside]
        slots = self._media[within, self._level[within] - 1]
        for slot in np.unique(slots):
            here = slots == slot
            volume = self._scenery.stage.materials[slot].volume or Volume()
            kept = np.exp(-np.outer(distance[here], volume.absorption_per_m))
            self._throughput[within[here]] *= kept

    def _meet(self, slot: int, rows: Int64, hits: Hits, met: int) -> None:
        """Let the paths `rows` meet the material at `slot`."""
        s, plan = self._scenery, self._scenery.stage.plans[slot]
        if met:
            passed = self._is_passed(slot, plan, hits)
            going = self._direction[rows[passed]] * hits.distance[passed, None]
            self._origin[rows[passed]] += going
            rows, hits = rows[~passed], hits.take(~passed)
        if not len(rows):
            return
        points = gather_points(s.stage.scene, hits.primitive, hits.triangle, hits.barycentric, hits.is_front)
        surface = gather_surface(s.stage, slot, points, -self._direction[rows])
        film = s.film_on(slot, surface)
        if plan.calls_for(Effect.UNLIT):
            self._end(rows, surface.base_color)
        elif not plan.calls_for(Effect.TRANSMISSION):
            self._end(rows, sent(s, surface, plan, film, self._rng))
        elif met == self._depth:
            return
        else:
            self._go_on(slot, plan, rows, points, surface, film)

    def _is_passed(self, slot: int, plan: MaterialPlan, hits: Hits) -> Mask:
        """Return where (n,) a path passes straight: culled back faces, and what blending lets through."""
        is_solid = plan.calls_for(Effect.VOLUME) or plan.calls_for(Effect.DOUBLE_SIDED)
        passed = np.zeros(len(hits.is_front), np.bool_) if is_solid else ~hits.is_front
        if self._scenery.is_blending and plan.calls_for(Effect.ALPHA_BLEND):
            alpha = coverage(self._scenery.stage, hits.primitive, hits.triangle, hits.barycentric)
            passed |= self._rng.random(len(alpha)) >= alpha
        return passed

    def _end(self, rows: Int64, light: Float64) -> None:
        self.colour[rows] += self._throughput[rows] * light
        self._is_alive[rows] = False

    def _go_on(
        self, slot: int, plan: MaterialPlan, rows: Int64, points: Points, surface: Surface, film: FilmOn
    ) -> None:
        """Collect what a transmitting surface sends by itself, and send the paths on."""
        is_thick = plan.calls_for(Effect.VOLUME)
        leaves = ~points.is_front & (self._level[rows] > 0) & is_thick
        own = unmirrored(self._scenery, surface, plan, film, self._rng)
        self.colour[rows] += np.where(leaves[:, None], 0.0, self._throughput[rows] * own)
        ior = self._iors(slot, plan, rows)
        crossing = cross(surface, plan, film, ior, leaves, self._rng)
        self._throughput[rows] *= crossing.weight
        side = np.where(points.is_front, 1.0, -1.0)[:, None] * points.geometric_normal
        wanted = np.where(crossing.passes, -1.0, 1.0)[:, None]
        # Interpolated normals may send light to the wrong side of the triangle: it is mirrored at its plane.
        astray = np.minimum(wanted * np.sum(crossing.direction * side, axis=1, keepdims=True), 0.0)
        self._direction[rows] = crossing.direction - 2.0 * astray * wanted * side
        self._origin[rows] = points.position
        self._is_straight[rows] &= crossing.passes & (not is_thick)
        if is_thick:
            out = rows[crossing.passes & leaves]
            self._level[out] -= 1
            into = rows[crossing.passes & ~leaves]
            self._media[into, self._level[into]] = slot
            self._level[into] += 1
        ended = rows[crossing.weight.max(axis=1) <= 0.0]
        self._is_alive[ended] = False

    def _iors(self, slot: int, plan: MaterialPlan, rows: Int64) -> Float64:
        """Return each path's index (n,) of the body; dispersion lets each path go on in one channel only."""
        material = self._scenery.stage.materials[slot]
        ior = (material.ior or Ior()).ior
        if not plan.calls_for(Effect.DISPERSION):
            return np.full(len(rows), ior)
        white = rows[self._channel[rows] == _ALL]
        self._channel[white] = self._rng.integers(0, 3, len(white))
        self._throughput[white] *= 3.0 * np.eye(3)[self._channel[white]]
        dispersion = (material.dispersion or Dispersion()).dispersion
        return np.asarray(dispersed_iors(ior, dispersion)[self._channel[rows]])
