"""Angles counted in turns. Twins: shaders/optics/turns.glsl and gltf_iri/compiled/sincos.py."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["sincos_turns"]

Float64 = NDArray[np.float64]


def sincos_turns(turns: ArrayLike) -> tuple[Float64, Float64]:
    """Return sin(2πt) and cos(2πt) of t = `turns` (...).

    Whole turns come off before π is multiplied in: a phase of some thousand turns keeps its digits.
    """
    t = np.asarray(turns, dtype=np.float64)
    angle = (2.0 * np.pi) * (t - np.rint(t))
    return np.sin(angle), np.cos(angle)
