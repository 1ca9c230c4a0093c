"""A butterfly's wing: a fan of veins from its root, arched between them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from gltf_iri.samples.shapes import Shape, grid

__all__ = ["mirrored", "wing"]

Float64 = NDArray[np.float64]

_COLUMNS, _ROWS = 24, 10


def wing(
    azimuths_deg: tuple[float, float], lengths_m: Sequence[float], lift: float, arch: float, waves: int
) -> Shape:
    """Return a wing that spreads from the origin towards +X, seen from above (+Y).

    azimuths_deg : of its first and last edge, from +X towards −Z.
    lengths_m : from the root to the margin at equal steps between the edges, joined by a smooth curve.
    lift : slope of the whole towards the tip; arch : how far it droops towards the margin, 1/m; waves : folds
    between veins.

    u runs from the first edge to the last, v from the root to the margin.
    """
    share, radius = np.linspace(0.0, 1.0, _COLUMNS + 1), np.linspace(0.0, 1.0, _ROWS + 1)
    azimuth = np.radians(azimuths_deg[0] + (azimuths_deg[1] - azimuths_deg[0]) * share)
    margin = _smooth_curve(lengths_m, share)
    reach = radius[:, None] * margin
    x, z = reach * np.cos(azimuth), -reach * np.sin(azimuth)
    fold = 0.012 * reach * np.cos(2.0 * np.pi * waves * share)
    y = lift * x - arch * reach**2 + fold
    positions = np.stack([x, y, z], axis=-1)
    outward = np.stack(
        [
            np.broadcast_to(np.cos(azimuth), x.shape),
            lift * np.cos(azimuth) - 2.0 * arch * reach + 0.012 * np.cos(2.0 * np.pi * waves * share),
            np.broadcast_to(-np.sin(azimuth), x.shape),
        ],
        axis=-1,
    )
    across = np.gradient(positions, axis=1)
    across[0] = across[1]  # at the root all columns meet
    normals = np.cross(outward, across)
    u, v = np.meshgrid(share, radius)
    return grid(positions, normals, across, np.stack([u, v], axis=-1))


def mirrored(shape: Shape) -> Shape:
    """Return the shape seen in a mirror across X = 0; its texture is mirrored with it."""
    flip = np.array([-1.0, 1.0, 1.0])
    tangents = shape.tangents * np.array([-1.0, 1.0, 1.0, -1.0])
    return Shape(shape.positions * flip, shape.normals * flip, shape.uvs, shape.triangles[:, ::-1], tangents)


def _smooth_curve(values: Sequence[float], share: Float64) -> Float64:
    """Return the cubic through `values`, at equal steps of [0, 1]; its slopes there are their neighbours'."""
    knots = np.asarray(values, dtype=np.float64)
    slopes = np.gradient(knots)
    place = share * (len(knots) - 1)
    left = np.minimum(place.astype(np.int64), len(knots) - 2)
    t = place - left
    a, b, slope_a, slope_b = knots[left], knots[left + 1], slopes[left], slopes[left + 1]
    cubic = (2.0 * t + 1.0) * (1.0 - t) ** 2 * a + t * (1.0 - t) ** 2 * slope_a
    return np.asarray(cubic + t**2 * (3.0 - 2.0 * t) * b + t**2 * (t - 1.0) * slope_b)
