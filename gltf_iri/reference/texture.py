"""Textures in float64: wrapped and filtered as OpenGL does, on the base level only.

There is no minification: a picture that is smaller than its texture aliases here, and OpenGL solves the same
problem only when it is asked for textures without mipmaps (`sharp_textures` of the renderer).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.transfer import srgb_decode

__all__ = ["Texels", "sample"]

Float64 = NDArray[np.float64]
Int64 = NDArray[np.int64]

_NEAREST: Final = 9728
_CLAMP_TO_EDGE: Final = 33071
_MIRRORED_REPEAT: Final = 33648

_LINEAR_VALUES: Final = np.arange(256) / 255.0
_SRGB_VALUES: Final = srgb_decode(_LINEAR_VALUES)

# Beyond this float64 no longer tells one texel from the next.
_FARTHEST_TEXEL: Final = 2.0**52


@dataclass(frozen=True, slots=True)
class Texels:
    """An image as the file stores it, uint8 (height, width, 4), row 0 on top, and how it is read."""

    pixels: NDArray[np.uint8]
    wrap_s: int
    wrap_t: int
    mag_filter: int


def sample(texels: Texels, uv: Float64, *, is_srgb: bool) -> Float64:
    """Return linear RGBA, (n, 4), at the coordinates `uv` (n, 2), (0, 0) the image's upper left corner.

    Texels are decoded before they are interpolated; alpha is linear in every colour space.
    OpenGL 3.3 §3.8.11: texel i of n covers [i/n, (i + 1)/n]; LINEAR weighs the four nearest centres.
    """
    height, width = texels.pixels.shape[:2]
    across = _texel_place(uv[:, 0], width)
    down = _texel_place(uv[:, 1], height)
    if texels.mag_filter == _NEAREST:
        column = _wrapped(np.floor(across).astype(np.int64), width, texels.wrap_s)
        row = _wrapped(np.floor(down).astype(np.int64), height, texels.wrap_t)
        return _decoded(texels.pixels[row, column], is_srgb)
    left, top = np.floor(across - 0.5), np.floor(down - 0.5)
    beta, gamma = (across - 0.5 - left)[:, None], (down - 0.5 - top)[:, None]
    rows = [_wrapped(top.astype(np.int64) + i, height, texels.wrap_t) for i in (0, 1)]
    columns = [_wrapped(left.astype(np.int64) + i, width, texels.wrap_s) for i in (0, 1)]
    lines = []
    for row in rows:
        first, second = (_decoded(texels.pixels[row, column], is_srgb) for column in columns)
        lines.append((1.0 - beta) * first + beta * second)
    return np.asarray((1.0 - gamma) * lines[0] + gamma * lines[1])


def _texel_place(coordinate: Float64, count: int) -> Float64:
    # A file may hold any finite number; what lies that far out has no texel that could be told from another.
    return np.clip(coordinate * count, -_FARTHEST_TEXEL, _FARTHEST_TEXEL)


def _wrapped(index: Int64, count: int, mode: int) -> Int64:
    """Return the texel that stands for `index` (OpenGL 3.3, table 3.17); glTF's other mode is REPEAT."""
    if mode == _CLAMP_TO_EDGE:
        return np.clip(index, 0, count - 1)
    if mode == _MIRRORED_REPEAT:
        there = np.mod(index, 2 * count)
        return np.where(there < count, there, 2 * count - 1 - there)
    return np.mod(index, count)


def _decoded(pixels: NDArray[np.uint8], is_srgb: bool) -> Float64:
    values = _LINEAR_VALUES[pixels]
    if is_srgb:
        values[:, :3] = _SRGB_VALUES[pixels[:, :3]]
    return values
