"""An environment blurred by lobes that are round about their axis: integrals over all of the map's texels.

Between a row of directions and a row of texels such a lobe depends on the difference of their azimuths alone,
so that the integral along the row is a circular convolution: a product of Fourier series. No texel is left
out, where the few rays of a wide lobe would miss small bright light or take it for its surroundings.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gltf_iri.rendering.lobe_rays import Lobe

__all__ = ["blurred"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]


def blurred(radiance: Float32, lobe: Lobe) -> Float32:
    """Return what `lobe` about each direction sees of `radiance` (height, width, 3), as shares that sum to 1.

    The result is as large, its columns lie where those of `radiance` do, and its first and last row are the
    poles themselves (shaders/lighting/equirect.glsl). `width` must be even, `height` above 1, and the lobe
    must span several texels, also below the horizon, where it is to be 0.
    """
    height, width, _ = radiance.shape
    steradians = np.diff(-np.cos(np.pi * np.arange(height + 1) / height)) * (2.0 * np.pi / width)
    light = np.fft.rfft(radiance * steradians[:, None, None], axis=1)
    polar_in = (np.arange(height) + 0.5) * (np.pi / height)
    polar_out = np.arange(height) * (np.pi / (height - 1))
    waves = np.zeros((height, width // 2 + 1, 3), np.complex128)
    whole = np.ones(height)
    for row in range((height + 1) // 2):
        series = _series(lobe, polar_out[row], polar_in, width)
        # What lies as far from the other pole sees the rows in reverse.
        for at, seen in ((row, series), (height - 1 - row, series[::-1])):
            waves[at] = np.einsum("rk,rkc->kc", seen, light)
            whole[at] = seen[:, 0] @ steradians
    mean = np.fft.irfft(waves, n=width, axis=1) / whole[:, None, None]
    # Rounding of bright light may leave less than none where there is nothing.
    return np.maximum(mean, 0.0).astype(np.float32)


def _series(lobe: Lobe, polar: float, rows: Float64, width: int) -> Float64:
    """Return the Fourier series (rows, width/2 + 1) of the lobe about a direction over each row's azimuth."""
    half_azimuth = np.arange(width // 2 + 1) * (np.pi / width)
    # sin²(γ/2) = sin²((θ₁ − θ₂)/2) + sin θ₁ sin θ₂ sin²(φ/2), which keeps its digits where γ is small.
    apart = np.square(np.sin(0.5 * (polar - rows)))[:, None]
    around = (np.sin(polar) * np.sin(rows))[:, None] * np.square(np.sin(half_azimuth))
    values = lobe(np.minimum(apart + around, 1.0))  # by rounding it may be more
    turn = np.concatenate([values, values[:, -2:0:-1]], axis=1)
    return np.asarray(np.fft.rfft(turn, axis=1).real)
