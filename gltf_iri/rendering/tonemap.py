"""From unbounded linear light to what a display can show; colours are linear Rec.709, (..., 3), any range."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.errors import UsageError

__all__ = ["TONE_MAPS", "tone_map"]

Float64 = NDArray[np.float64]

# Khronos PBR Neutral: where compression starts and how fast what is compressed turns white.
_NEUTRAL_START: Final = 0.8 - 0.04
_NEUTRAL_DESATURATION: Final = 0.15

# From Rec.709 to the space in which the fit works, and back: Hill's products of sRGB, D60 and RRT matrices.
_ACES_IN: Final = np.array(
    [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]]
)
_ACES_OUT: Final = np.array(
    [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]]
)


def _none(rgb: Float64) -> Float64:
    return rgb


def _neutral(rgb: Float64) -> Float64:
    """Khronos PBR Neutral: base colours keep hue and lightness, only highlights are compressed.

    Source: Khronos Group 2024, "Khronos PBR Neutral Tone Mapper", specification and GLSL.
    """
    darkest = rgb.min(axis=-1, keepdims=True)
    # What a dielectric's F0 = 0.04 adds to its colour is taken off, less of it near black.
    offset = np.where(darkest < 0.08, darkest - 6.25 * darkest * darkest, 0.04)
    rgb = rgb - offset
    peak = rgb.max(axis=-1, keepdims=True)
    room = 1.0 - _NEUTRAL_START
    # Below the start nothing is compressed; the floor keeps the unused branch's denominators positive.
    high = np.maximum(peak, _NEUTRAL_START)
    compressed = 1.0 - room * room / (high + room - _NEUTRAL_START)
    towards_white = 1.0 - 1.0 / (_NEUTRAL_DESATURATION * (high - compressed) + 1.0)
    bright = rgb * (compressed / high) * (1.0 - towards_white) + compressed * towards_white
    return np.where(peak < _NEUTRAL_START, rgb, bright)


def _aces(rgb: Float64) -> Float64:
    """ACES film look, reference rendering and sRGB output transforms in one fit.

    Source: Stephen Hill 2016, in "Baking Lab" by Pettineo (MIT licence), ACES.hlsl.
    """
    v = np.maximum(rgb, 0.0) @ _ACES_IN.T  # the fit is not monotone below 0
    fitted = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081)
    return np.asarray(fitted @ _ACES_OUT.T)


TONE_MAPS: Final[Mapping[str, Callable[[Float64], Float64]]] = MappingProxyType(
    {"none": _none, "neutral": _neutral, "aces": _aces}
)


def tone_map(name: str, rgb: ArrayLike) -> Float64:
    """Return display-linear colours in [0, 1]; an unknown name raises UsageError."""
    try:
        curve = TONE_MAPS[name]
    except KeyError:
        raise UsageError(f"There is no tone map '{name}'; choose one of: {', '.join(TONE_MAPS)}.") from None
    return np.clip(curve(np.asarray(rgb, np.float64)), 0.0, 1.0)
