"""Where a material of mode MASK has holes (glTF 2.0 §3.9.4)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.reference.points import interpolated
from gltf_iri.reference.slots import sample_slot
from gltf_iri.reference.stage import Stage

__all__ = ["coverage", "is_cut_out"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]


def is_cut_out(stage: Stage, primitive: Int64, triangle: Int64, barycentric: Float64) -> NDArray[np.bool_]:
    """Return where (n,) the alpha lies below the cutoff; only for materials of mode MASK."""
    cutoff = np.array([stage.materials[slot].alpha_cutoff for slot in stage.slots])
    return coverage(stage, primitive, triangle, barycentric) < cutoff[primitive]


def coverage(stage: Stage, primitive: Int64, triangle: Int64, barycentric: Float64) -> Float64:
    """Return alpha (n,): the base colour's factor, times texture, times vertex colour."""
    alpha = np.ones(len(primitive))
    for index in np.unique(primitive):
        rows = np.flatnonzero(primitive == index)
        p, slot = stage.scene.primitives[index], stage.slots[index]
        corners, weights = p.triangles[triangle[rows]], barycentric[rows]
        here = np.full(len(rows), stage.materials[slot].pbr.base_color_factor[3])
        if p.colours is not None:
            here = here * interpolated(p.colours, corners, weights)[:, 3]
        uv = np.zeros((len(rows), 2, 2))
        for number, uvs in enumerate(p.uvs):
            uv[:, number] = interpolated(uvs, corners, weights)
        texel = sample_slot(stage, slot, "base_color", uv)
        alpha[rows] = here if texel is None else here * texel[:, 3]
    return alpha
