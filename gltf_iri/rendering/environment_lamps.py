"""Small, bright lights of an environment, taken out of the map to be lit by formula.

A sun covers a texel or two and outshines everything else a thousandfold: sampled, it turns into speckles, and
layers of growing blur are too few to interpolate it. What is left of the map is smooth enough for both.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.rendering.environment_levels import environment_levels

__all__ = ["LAMPS_MAX", "split_lamps"]

Float32 = NDArray[np.float32]
Float64 = NDArray[np.float64]

# Every shaded pixel adds each of them, and beyond the first dozen they no longer tower over the rest.
LAMPS_MAX: Final = 32
_TRIES_MAX: Final = 96

# A texel that may belong to a lamp outshines the mean of the map and of its surroundings of some 6°.
_TIMES_MEAN: Final = 8.0
_TIMES_SURROUNDINGS: Final = 4.0
_SURROUNDINGS_HEIGHT: Final = 32

# What is looked at around it: the sun's radius is 0.27°; texels of small maps are larger than that.
_RADIUS_RAD: Final = np.radians(1.0)
_RADIUS_TEXELS: Final = 2.0
_OUTER_RADIUS: Final = 1.6  # of the ring whose light is what the map holds behind the lamp

# A lamp has most of the disc's light; else it is a window's corner or one bulb of many.
_LEAST_SHARE: Final = 0.6


def split_lamps(radiance: Float32) -> tuple[Float32, Float32]:
    """Return the lamps (n, 2, 4) of a map (height, width, 3), and the map without their light.

    A lamp's first row is its unit direction and mean squared angular radius in rad², the second the product
    of radiance and solid angle for red, green and blue. n may be 0, and the map is then returned itself.
    """
    height, width, _ = radiance.shape
    strength = radiance.max(axis=2)
    polar = (np.arange(height) + 0.5) * (np.pi / height)
    # The exact share of each row, so that lamps and the rest add up to the map.
    solid_angle = np.diff(-np.cos(np.pi * np.arange(height + 1) / height)) * (2.0 * np.pi / width)
    mean = float(strength.mean(axis=1) @ solid_angle) * width / (4.0 * np.pi)
    candidates = _candidates(strength, _TIMES_MEAN * mean)
    rest = radiance
    lamps: list[list[Float64]] = []
    radius = max(_RADIUS_RAD, _RADIUS_TEXELS * np.pi / height)
    for _ in range(_TRIES_MAX):
        if len(lamps) == LAMPS_MAX or not len(candidates):
            break
        row, column = _centred(strength, polar, int(candidates[0]), radius)
        rows, columns = _window(row, column, _OUTER_RADIUS * radius, height, width)
        direction = _directions(polar[rows], columns, width)
        distance_squared = np.sum(np.square(direction - _directions(polar[row], column, width)), axis=-1)
        disc = distance_squared <= radius**2
        place = np.ix_(rows, columns)
        texels = rest[place].astype(np.float64)
        ring = ~disc & (distance_squared <= (_OUTER_RADIUS * radius) ** 2)
        behind = np.median(texels[ring], axis=0) if ring.any() else np.zeros(3)
        excess = (
            np.where(disc[..., None], np.maximum(texels - behind, 0.0), 0.0)
            * solid_angle[rows][:, None, None]
        )
        inside = (texels * (disc * solid_angle[rows][:, None])[..., None]).sum()
        if excess.sum() >= _LEAST_SHARE * inside:
            lamps.append(_lamp(direction, excess, solid_angle[row]))
            rest = rest.copy() if rest is radiance else rest
            rest[place] = np.where(disc[..., None], np.minimum(texels, behind), texels)
        taken = (rows[:, None] * width + columns)[disc]
        candidates = candidates[~np.isin(candidates, taken)]
    return np.asarray(lamps, np.float32).reshape(-1, 2, 4), rest


def _candidates(strength: Float32, least: float) -> NDArray[np.int64]:
    """Return the flat places of texels that may belong to lamps, the brightest first."""
    height, width = strength.shape
    around = next(
        level[..., 0]
        for level in environment_levels(strength[..., None])
        if len(level) <= _SURROUNDINGS_HEIGHT
    )
    rows = np.arange(height) * around.shape[0] // height
    columns = np.arange(width) * around.shape[1] // width
    needed = np.maximum(_TIMES_SURROUNDINGS * around[rows][:, columns], least)
    found = np.flatnonzero(strength > needed)
    return np.asarray(found[np.argsort(-strength.ravel()[found], kind="stable")])


def _centred(strength: Float32, polar: Float64, place: int, radius: float) -> tuple[int, int]:
    """Return the texel in the middle of the light about a texel, for a sun's brightest may be at its edge."""
    height, width = strength.shape
    row, column = divmod(place, width)
    rows, columns = _window(row, column, radius, height, width)
    direction = _directions(polar[rows], columns, width)
    apart = np.sum(np.square(direction - _directions(polar[row], column, width)), axis=-1)
    weight = strength[np.ix_(rows, columns)].astype(np.float64) * np.sin(polar[rows])[:, None]
    middle = np.sum(direction * np.where(apart <= radius**2, weight, 0.0)[..., None], axis=(0, 1))
    down = np.arctan2(np.hypot(middle[0], middle[2]), middle[1]) / np.pi
    around = 0.5 + np.arctan2(middle[2], middle[0]) / (2.0 * np.pi)
    return min(int(down * height), height - 1), int(around * width) % width


def _window(
    row: int, column: int, radius: float, height: int, width: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return rows and columns (around the seam) of a box that holds the disc about a texel."""
    reach = int(np.ceil(radius / np.pi * height)) + 1
    rows = np.arange(max(row - reach, 0), min(row + reach, height - 1) + 1)
    polar = (row + 0.5) / height * np.pi
    sine = np.sin(polar)
    if np.sin(radius) >= sine:  # the disc holds a pole
        return rows, np.arange(width)
    wide = min(int(np.ceil(np.arcsin(np.sin(radius) / sine) / (2.0 * np.pi) * width)) + 1, (width - 1) // 2)
    return rows, np.arange(column - wide, column + wide + 1) % width


def _directions(polar: Float64, columns: NDArray[np.int64] | int, width: int) -> Float64:
    """Return unit directions of texel centres; rows first, then columns."""
    azimuth = (np.asarray(columns) + 0.5) * (2.0 * np.pi / width) - np.pi
    polar = np.asarray(polar)[..., None] if np.ndim(polar) else np.asarray(polar)
    sine, cosine = np.sin(polar), np.cos(polar) + 0.0 * azimuth
    return np.stack([sine * np.cos(azimuth), cosine, sine * np.sin(azimuth)], axis=-1)


def _lamp(direction: Float64, excess: Float64, texel: float) -> list[Float64]:
    weight = excess.sum(axis=2)
    centre = np.sum(direction * weight[..., None], axis=(0, 1)) / weight.sum()
    # Of unit vectors with mean m, the mean squared distance from their centre is 1 − |m|²; a filtered texel
    # adds its own, two sixths of its area.
    spread = max(1.0 - float(centre @ centre), 0.0) + texel / 3.0
    centre = centre / np.linalg.norm(centre)
    return [np.append(centre, spread), np.append(excess.sum(axis=(0, 1)), 0.0)]
