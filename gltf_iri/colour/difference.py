"""CIEDE2000 between linear Rec.709 colours, through colour-science."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.spaces import rec709_to_xyz
from gltf_iri.colour.tables import import_colour_science

__all__ = ["delta_e_2000"]

Float64 = NDArray[np.float64]


def delta_e_2000(rgb_a: ArrayLike, rgb_b: ArrayLike) -> Float64:
    """Return CIEDE2000 (...) between linear Rec.709 colours (..., 3), CIELAB/D65; (1, 1, 1) is L* = 100.

    Negative channels, which no display shows, are cut to 0 on both sides; values above 1 are kept.
    """
    colour = import_colour_science()
    white = rec709_to_xyz(np.ones(3))
    white_xy = white[:2] / white.sum()
    lab_a, lab_b = (
        colour.XYZ_to_Lab(
            rec709_to_xyz(np.maximum(np.asarray(rgb, dtype=np.float64), 0.0)) / white[1], white_xy
        )
        for rgb in (rgb_a, rgb_b)
    )
    return np.asarray(colour.delta_E(lab_a, lab_b, method="CIE 2000"), dtype=np.float64)
