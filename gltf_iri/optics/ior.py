"""Refractive indices from reflectances at normal incidence, and back (KHR_materials_iridescence).

Twin: shaders/optics/ior.glsl.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["fresnel0_to_ior", "ior_to_fresnel0"]

Float64 = NDArray[np.float64]


def fresnel0_to_ior(f0: ArrayLike) -> Float64:
    """Return the real index under air (1 + √F₀)/(1 − √F₀); F₀ = 1 gives ∞, F₀ > 1 a negative number."""
    root = np.sqrt(np.asarray(f0, dtype=np.float64))
    with np.errstate(divide="ignore"):  # the text divides by zero here, and method `khr` records where
        return np.asarray((1.0 + root) / (1.0 - root))


def ior_to_fresnel0(transmitted_ior: ArrayLike, incident_ior: ArrayLike) -> Float64:
    """Return ((n_t − n_i)/(n_t + n_i))².

    The text writes pow(x, 2.0), undefined in GLSL for x < 0; x·x is the same number where it is defined.
    """
    n_t = np.asarray(transmitted_ior, dtype=np.float64)
    n_i = np.asarray(incident_ior, dtype=np.float64)
    with np.errstate(invalid="ignore"):  # ∞/∞ of the text's perfect mirror stays the NaN that it is
        x = (n_t - n_i) / (n_t + n_i)
    return np.asarray(x * x)
