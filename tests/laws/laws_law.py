"""What a law is: a sentence, and how far a subject is from keeping it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.spaces import rec709_to_xyz

__all__ = ["Law", "colourfulness", "distance", "luminance"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True)
class Law:
    """`departure(subject)` is how far a subject leaves the law, on films or mirrors that are hard for it."""

    says: str
    departure: Callable[[str], float]
    bound: float  # what rounding and quadrature may add


def colourfulness(rgb: Float64) -> float:
    """Return the greatest difference between two channels of one colour (..., 3)."""
    return float(np.ptp(rgb, axis=-1).max())


def distance(a: Float64, b: Float64 | float) -> float:
    """Return the greatest difference of two arrays."""
    return float(np.abs(a - b).max())


def luminance(rgb: Float64) -> Float64:
    """Return Y (...) of linear Rec.709 (..., 3), 1 for white: the printed matrix is 1e-8 off that."""
    return np.asarray(rec709_to_xyz(rgb)[..., 1] / rec709_to_xyz(np.ones(3))[1])
