"""What a ray meets first: Embree proposes triangles, float64 decides.

Culled back faces and cut-out texels are stepped past. Two surfaces closer together than what float32
resolves in the whole scene (`RESOLUTION` of its radius) may be met in the wrong order, unless they have
the same corners.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, fields
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.planning.effects import Effect
from gltf_iri.reference.candidates import RESOLUTION, Candidates
from gltf_iri.reference.cutout import is_cut_out
from gltf_iri.reference.stage import Stage
from gltf_iri.reference.triangles import intersect, nearest_point, world_triangles

__all__ = ["Hits", "Tracer"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]
Mask = NDArray[np.bool_]

# Rays at once: some 200 MB of arrays.
_CHUNK: Final = 1 << 18

# A ray that has passed so many culled or cut-out surfaces has met nothing; bounds hostile stacks of them.
_MAX_LAYERS: Final = 256

# Rays around an undecided one, at these multiples of the resolution: a triangle that it meets in float64 and
# misses in float32 lies closer than that.
_RING: Final = (2.0, 8.0, 32.0)
_RING_DIRECTIONS: Final = 6

# Where dozens of triangles share a corner, rounding can leave a ray through it with none of them, and the
# ring need not find the right one. A ray this close to the one that Embree named, in resolutions, takes it.
_SLACK: Final = 4.0

# Where the second ray of each query runs, in resolutions: off any axis, so that it meets no row of corners.
_BESIDE: Final = (1.3, 0.7)


@dataclass(frozen=True, slots=True)
class Hits:
    """What n rays met first; where `valid` is False, distance is ∞, indices −1 and the rest 0."""

    valid: Mask
    distance: Float64  # (n,), metres along the unit direction
    primitive: Int64  # (n,), index into the scene's primitives
    triangle: Int64  # (n,), index into the primitive's triangles
    barycentric: Float64  # (n, 3), ≥ 0, sum 1
    is_front: Mask  # seen from the side from which the winding is counter-clockwise

    def take(self, rows: Mask | Int64) -> Hits:
        """Return the hits of the rays `rows`, in that order."""
        return Hits(**{field.name: getattr(self, field.name)[rows] for field in fields(self)})


@dataclass(frozen=True, slots=True)
class _Query:
    """Rays, and what is known of each so far."""

    origins: Float64
    directions: Float64
    near: Float64
    far: Float64
    cull_back_faces: bool
    found: Hits


class Tracer:
    """Casts rays into a `Stage`; make one in each process.

    clearance_m : how far off a surface a ray should start (`t_min`) so as not to meet that surface again.
    Raises MissingCapabilityError where embreex is not installed.
    """

    def __init__(self, stage: Stage) -> None:
        self._stage = stage
        self._triangles = world_triangles(stage.scene)
        self._candidates = Candidates(self._triangles)
        self._resolution_m = RESOLUTION * self._candidates.radius_m
        self.clearance_m = 4.0 * self._resolution_m
        slots = np.asarray(stage.slots)
        both = [plan.calls_for(Effect.DOUBLE_SIDED) for plan in stage.plans]
        cut = [plan.calls_for(Effect.ALPHA_MASK) for plan in stage.plans]
        self._is_double_sided = np.asarray(both)[slots]
        self._is_masked = np.asarray(cut)[slots]

    def first_hits(
        self,
        origins: Float64,
        directions: Float64,
        *,
        t_min: float | Float64 = 0.0,
        t_max: float | Float64 = np.inf,
        cull_back_faces: bool = True,
    ) -> Hits:
        """Return what each ray meets first, between `t_min` and `t_max` metres, both included.

        Parameters
        ----------
        origins, directions : (n, 3), any number of rays; directions of length 1.
        cull_back_faces : pass through the back faces of single-sided materials, as the rasteriser does; a
            path inside of a body wants False.
        """
        count = len(origins)
        nothing = Hits(
            np.zeros(count, np.bool_),
            np.full(count, np.inf),
            np.full(count, -1),
            np.full(count, -1),
            np.zeros((count, 3)),
            np.zeros(count, np.bool_),
        )
        near = np.broadcast_to(np.asarray(t_min, np.float64), (count,))
        far = np.broadcast_to(np.asarray(t_max, np.float64), (count,))
        query = _Query(origins, directions, near, far, cull_back_faces, nothing)
        for start in range(0, count, _CHUNK):
            self._trace(query, np.arange(start, min(start + _CHUNK, count)))
        return query.found

    def corners(self, hits: Hits) -> Float64:
        """Return the corners (n, 3, 3), in the world, of the triangles that valid `hits` lie on."""
        first = np.searchsorted(self._triangles.primitive, hits.primitive)
        return np.asarray(self._triangles.corners[first + hits.triangle])

    def _trace(self, query: _Query, rows: Int64) -> None:
        """Find what the rays at `rows` meet."""
        start = self._candidates.entry_m(query.origins[rows], query.directions[rows])
        start = np.maximum(query.near[rows], start)
        for _ in range(_MAX_LAYERS):
            place, ahead = self._ask(query, rows, start)
            going_on = (place >= 0) & (start + ahead <= query.far[rows] + self._resolution_m)
            rows, place, there = rows[going_on], place[going_on], (start + ahead)[going_on]
            if not len(rows):
                return
            reached = self._meet(query, rows, place, there)
            missed = np.isnan(reached)
            if missed.any():
                for beside in self._around(query, rows[missed], there[missed]):
                    known = beside >= 0
                    self._meet(query, rows[missed][known], beside[known], there[missed][known])
                closed = missed & ~query.found.valid[rows]
                reached[closed] = self._meet(query, rows[closed], place[closed], there[closed], _SLACK)
            is_open = ~query.found.valid[rows]
            start = np.fmax(np.maximum(start[going_on], there), reached)[is_open] + self._resolution_m
            rows = rows[is_open]

    def _ask(self, query: _Query, rows: Int64, start: Float64) -> tuple[Int64, Float64]:
        """Return the place that each ray of `rows` seems to meet next after `start`, and how far from there.

        Through an exact corner Embree may slip; a second ray right beside the first then tells.
        """
        directions = query.directions[rows]
        origins = query.origins[rows] + start[:, None] * directions
        place, ahead = self._candidates.ask(origins, directions)
        across, up = _axes_across(directions)
        offset = _BESIDE[0] * across + _BESIDE[1] * up
        other_place, other = self._candidates.ask(origins + self._resolution_m * offset, directions)
        is_nearer = (other_place >= 0) & (other < ahead - _SLACK * self._resolution_m)
        return np.where(is_nearer, other_place, place), np.where(is_nearer, other, ahead)

    def _meet(self, query: _Query, rows: Int64, place: Int64, there: Float64, slack: float = 0.0) -> Float64:
        """Keep what each ray of `rows` meets at its `place`, if it is seen and nearer than what is known.

        `there` is roughly how far that is; a ray that passes by within `slack` resolutions meets it too.
        Returns how far it is, kept or not; NaN where the ray passes by.
        """
        found = query.found
        directions = query.directions[rows]
        # From a point close by, the volumes of the exact test keep their digits.
        origins = query.origins[rows] + there[:, None] * directions
        reached = np.full(len(rows), np.nan)
        waiting = np.arange(len(rows))
        member, past = self._triangles.first[place], self._triangles.first[place + 1]
        for _ in range(_MAX_LAYERS):
            if not len(waiting):
                break
            triangle = self._triangles.members[member]
            given = self._triangles.corners[triangle], origins[waiting], directions[waiting]
            ahead, weights, turns_left = intersect(*given)
            if slack:
                ahead, weights, beside = nearest_point(*given, weights)
                ahead[beside > slack * self._resolution_m] = np.nan
            distance = there[waiting] + ahead
            reached[waiting] = distance
            row = rows[waiting]
            is_between = (distance >= query.near[row]) & (distance <= query.far[row])
            is_wanted = is_between & (distance < found.distance[row])
            is_front = turns_left ^ self._triangles.mirrored[triangle]
            is_kept = is_wanted & self._is_seen(triangle, weights, is_front, query.cull_back_faces)
            for known, value in (
                (found.valid, is_kept),
                (found.distance, distance),
                (found.primitive, self._triangles.primitive[triangle]),
                (found.triangle, self._triangles.triangle[triangle]),
                (found.barycentric, weights),
                (found.is_front, is_front),
            ):
                known[row[is_kept]] = value[is_kept]
            member = member + 1
            others = is_wanted & ~is_kept & (member < past)
            waiting, member, past = waiting[others], member[others], past[others]
        return reached

    def _is_seen(self, triangle: Int64, weights: Float64, is_front: Mask, cull_back_faces: bool) -> Mask:
        """Return where (n,) a triangle is neither culled nor cut out."""
        primitive, index = self._triangles.primitive[triangle], self._triangles.triangle[triangle]
        is_seen = is_front | self._is_double_sided[primitive] if cull_back_faces else np.ones_like(is_front)
        tested = np.flatnonzero(is_seen & self._is_masked[primitive])
        if len(tested):
            cut_out = is_cut_out(self._stage, primitive[tested], index[tested], weights[tested])
            is_seen[tested] = ~cut_out
        return is_seen

    def _around(self, query: _Query, rows: Int64, there: Float64) -> Iterator[Int64]:
        """Yield the places (n,) that rays right beside those of `rows` meet, −1 for none."""
        directions = query.directions[rows]
        across, up = _axes_across(directions)
        # Back from the surface, so that what stands a little before it is met too.
        behind = query.origins[rows] + (there - 2.0 * _RING[-1] * self._resolution_m)[:, None] * directions
        for size in _RING:
            for turn in np.arange(_RING_DIRECTIONS) * (2.0 * np.pi / _RING_DIRECTIONS):
                offset = size * self._resolution_m * (np.cos(turn) * across + np.sin(turn) * up)
                yield self._candidates.ask(behind + offset, directions)[0]


def _axes_across(directions: Float64) -> tuple[Float64, Float64]:
    """Return two unit vectors (n, 3) across each direction and across each other."""
    # Made from the axis to which the direction is least parallel.
    across = np.cross(directions, np.eye(3)[np.argmin(np.abs(directions), axis=1)])
    across /= np.linalg.norm(across, axis=1, keepdims=True)
    return across, np.cross(directions, across)
