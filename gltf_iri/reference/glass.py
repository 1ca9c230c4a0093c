"""Light that transmitting surfaces send to the viewer: the mean of random paths, mirrored and bent by facets.

What the rasteriser takes from its own picture and from one assumed path length is followed here through the
scene: to the other side of the body, to what stands before or behind it, to the environment. At a
transmitting surface (gltf_iri/reference/glass_surface.py) a path goes on; at any other it ends in that
surface's emission, punctual light and image light, all without shadows, as everywhere. What a body absorbs
follows Beer's law over the way that the path took, in world metres; nothing is taken off where an open mesh
lets a path escape.

A path that has met `depth` surfaces is given up, and so is one that would add less than 1e-3 of what it
meets; both make the picture darker, and `Traced.lost` says by how much of a white environment.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.reference.glass_light import Scenery
from gltf_iri.reference.glass_walk import Walk
from gltf_iri.reference.tracer import Hits

__all__ = ["Scenery", "Traced", "trace_glass"]

Float64 = NDArray[np.float64]

# Paths at once: some 200 MB of arrays.
_CHUNK: Final = 1 << 16


@dataclass(frozen=True, slots=True)
class Traced:
    """Linear colours (n, 3), their standard errors (n, 3), and the share of light (n,) that was given up."""

    colour: Float64
    standard_error: Float64
    lost: Float64


def trace_glass(
    scenery: Scenery,
    directions: Float64,
    hits: Hits,
    *,
    paths: int,
    depth: int,
    rng: np.random.Generator,
) -> Traced:
    """Return what the points that n rays met first send back along them; transmitting or not.

    Parameters
    ----------
    directions : (n, 3), unit, of the rays.
    hits : all of them valid.
    paths : for each ray; at least two, so that their spread is known.
    depth : surfaces that a path may meet, those of blended materials and culled ones included.
    """
    count = len(directions)
    total, squares, lost = np.zeros((count, 3)), np.zeros((count, 3)), np.zeros(count)
    paths = max(paths, 2)
    for start in range(0, count, _CHUNK):
        here = np.arange(start, min(start + _CHUNK, count))
        at_once = max(_CHUNK // len(here), 1)
        for done in range(0, paths, at_once):
            rows = np.tile(here, min(at_once, paths - done))
            walk = Walk(scenery, directions[rows], hits.take(rows), depth, rng)
            walk.run()
            brought = walk.colour.reshape(-1, len(here), 3)
            total[here] += brought.sum(axis=0)
            squares[here] += (brought * brought).sum(axis=0)
            lost[here] += walk.lost.reshape(-1, len(here)).sum(axis=0)
    mean = total / paths
    variance = np.maximum(squares / paths - mean * mean, 0.0) / (paths - 1)
    return Traced(mean, np.sqrt(variance), lost / paths)
