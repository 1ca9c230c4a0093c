"""Mip levels of a channel's first and second moments: its mean and variance over any texel of a level.

Moments are averaged, not variances: E[t²] and E[t] over an area give its variance E[t²] − E[t]², by which a
thickness that varies within a pixel is prefiltered (Belcour & Barla 2017, section 5, Multi-scale Rendering).
OpenGL leaves open how it halves odd sizes, so the levels are made here.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["MEAN", "ROUNDING", "SQUARE", "moment_levels"]

# Where a level's texels keep E[t²] and E[t]: the mean in G, where glTF's thickness is.
SQUARE: Final = 0
MEAN: Final = 1

# Of E[t²] − E[t]² in float32, t up to 1; 8-bit texels that differ do so by more.
ROUNDING: Final = 2.5e-7


def moment_levels(channel: NDArray[np.uint8]) -> Iterator[NDArray[np.float32]]:
    """Yield (E[t²], E[t]) of every mip level, (height, width, 2), for 8-bit texels, t in [0, 1].

    channel : (height, width). A level has half the height and width of the one before, rounded down, at
    least 1; each of its texels is the mean over its own area, which cuts texels of the level before where a
    size is odd.
    """
    values = np.arange(256) / 255.0
    level = np.stack([values * values, values], axis=-1)[channel]
    yield level.astype(np.float32)
    while max(level.shape[:2]) > 1:
        level = _halved(_halved(level, 0), 1)
        yield level.astype(np.float32)


def _halved(texels: NDArray[np.float64], axis: int) -> NDArray[np.float64]:
    """Return the means over half as many texels along `axis`, rounded down; of one texel, itself."""
    count = texels.shape[axis]
    half = max(count // 2, 1)
    texels = np.moveaxis(texels, axis, 0)
    first = texels[0 : 2 * half : 2]
    if count == 1:
        mean = texels
    elif count % 2 == 0:
        mean = 0.5 * (first + texels[1::2])
    else:
        # 2h + 1 texels in h: each new one has (2h + 1)/h of the old, the i-th from 2i + i/h on.
        i = np.arange(half).reshape(-1, *[1] * (texels.ndim - 1))
        inner, last = texels[1 : 2 * half : 2], texels[2 : 2 * half + 1 : 2]
        mean = ((half - i) * first + half * inner + (i + 1) * last) / count
    return np.ascontiguousarray(np.moveaxis(mean, 0, axis))
