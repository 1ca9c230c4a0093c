"""The sRGB transfer function: from stored values to light and back (IEC 61966-2-1, 4.2 and 4.3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["srgb_decode", "srgb_encode"]

Float64 = NDArray[np.float64]


def srgb_decode(encoded: ArrayLike) -> Float64:
    """Return the linear light of stored values V: V/12.92 up to 0.04045, else ((V + 0.055)/1.055)^2.4."""
    v = np.asarray(encoded, np.float64)
    # Below the toe the power's base may be negative; its result is not used there.
    power = ((np.maximum(v, 0.0) + 0.055) / 1.055) ** 2.4
    return np.where(v <= 0.04045, v / 12.92, power)


def srgb_encode(linear: ArrayLike) -> Float64:
    """Return the stored values of linear light L: 12.92 L up to 0.0031308, else 1.055 L^(1/2.4) − 0.055."""
    light = np.asarray(linear, np.float64)
    power = 1.055 * np.maximum(light, 0.0) ** (1.0 / 2.4) - 0.055
    return np.where(light <= 0.0031308, 12.92 * light, power)
