"""Balls in rows and columns, one material each: what a series of materials is shown on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import tan
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from gltf_iri.samples.builder import GLTFBuilder
from gltf_iri.samples.sphere import sphere

__all__ = ["RADIUS_M", "add_ball_grid"]

RADIUS_M: Final = 0.02
_PITCH_M: Final = 0.046
_MARGIN_M: Final = 0.008
_YFOV_RAD: Final = 0.2  # far away, so that balls at the side are seen as those in the middle
_TURNED: Final = (0.0, 1.0, 0.0, 0.0)  # half a turn about +Y: the seam of the textures is behind
_ASPECT: Final = 4.0 / 3.0


def add_ball_grid(
    builder: GLTFBuilder,
    rows: Sequence[Sequence[tuple[str, int]]],
    *,
    second_uvs_scale: ArrayLike | None = None,
    variants: Mapping[str, Mapping[str, int]] | None = None,
) -> None:
    """Add balls of `rows` of (name, material), from the top left, a camera that sees all, and a light.

    second_uvs_scale : (2,), how often the second texture coordinates run where the first run once.
    variants : of the ball of each name, as `GLTFBuilder.mesh` takes them.
    """
    ball = sphere(RADIUS_M, rings=32, segments=64)
    second_uvs = None if second_uvs_scale is None else ball.uvs * np.asarray(second_uvs_scale)
    columns = max(len(row) for row in rows)
    for line, row in enumerate(rows):
        for column, (name, material) in enumerate(row):
            x = (column - (columns - 1) / 2.0) * _PITCH_M
            y = ((len(rows) - 1) / 2.0 - line) * _PITCH_M
            builder.mesh(
                name,
                ball,
                material,
                rotation=_TURNED,
                translation_m=(x, y, 0.0),
                second_uvs=second_uvs,
                variants=(variants or {}).get(name),
            )
    width_m, height_m = (count * _PITCH_M + 2.0 * _MARGIN_M for count in (columns, len(rows)))
    distance_m = max(height_m, width_m / _ASPECT) / 2.0 / tan(_YFOV_RAD / 2.0)
    builder.perspective_camera((0.0, 0.0, distance_m), (0.0, 0.0, 0.0), _YFOV_RAD)
    builder.directional_light((-0.3, -0.8, -0.6), 1.0)
