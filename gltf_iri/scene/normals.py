"""Normals where a file has none, or none that can be used."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["face_normals", "repaired_normals", "unit"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]
UInt32 = NDArray[np.uint32]


def unit(vectors: NDArray[np.floating]) -> tuple[Float32, NDArray[np.bool_]]:
    """Return `vectors` (n, 3) at length 1, and the mask (n,) of those that have no direction.

    Those become +Z, so that no zero reaches a normalisation on the GPU.
    """
    wide = np.asarray(vectors, dtype=np.float64)
    # Scaled first: the squares of components around 1e-200 would vanish.
    largest = np.abs(wide).max(axis=1, initial=0.0)
    lost = ~(largest > 0.0)
    scaled = wide / np.where(lost, 1.0, largest)[:, None]
    scaled[lost] = (0.0, 0.0, 1.0)
    return (scaled / np.linalg.norm(scaled, axis=1)[:, None]).astype(np.float32), lost


def face_normals(positions: Float32, triangles: UInt32) -> Float64:
    """Return (m, 3) normals of the triangles, as long as twice their area; (p₁ − p₀) × (p₂ − p₀)."""
    corner = positions.astype(np.float64)[triangles]
    return np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])


def repaired_normals(positions: Float32, normals: Float32, triangles: UInt32) -> tuple[Float32, int]:
    """Return `normals` (n, 3) at length 1 and how many had none.

    A vertex whose normal is zero gets the area-weighted mean of its triangles' instead.
    """
    length_one, lost = unit(normals)
    if not lost.any():
        return length_one, 0
    summed = np.zeros((len(positions), 3))
    faces = face_normals(positions, triangles)
    for corner in range(3):
        np.add.at(summed, triangles[:, corner], faces)
    length_one[lost] = unit(summed[lost])[0]
    return length_one, int(lost.sum())
