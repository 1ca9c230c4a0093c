"""The order of surfaces that let light through, and when each needs to see what was drawn before it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.planning.effects import Effect
from gltf_iri.rendering.draw import Draw
from gltf_iri.scene.camera import projection_matrix
from gltf_iri.scene.model import Camera

__all__ = ["MAX_CAPTURES", "Group", "Sheet", "group_sheets", "sheets_in_order"]

Float64 = NDArray[np.float64]

# Each costs as much as some passes over the whole picture: a thousand panes in a row would take minutes.
MAX_CAPTURES: Final = 32

# The picture is divided into so many parts a side to find out whether two sheets lie over each other.
_PARTS: Final = 64


@dataclass(frozen=True, slots=True)
class Sheet:
    """The faces of one draw that are drawn together: all, the far ones or the near ones."""

    draw: Draw
    culled: str | None  # the face that is left out
    depths_m: tuple[float, float]  # along the view's axis: of the sheet, and where that is equal of the shape
    columns: slice  # of the picture's parts, which it may cover
    rows: slice


@dataclass(frozen=True, slots=True)
class Group:
    """Sheets that are drawn one after another; those that transmit see what was drawn before the group."""

    sheets: tuple[Sheet, ...]
    is_capturing: bool


def sheets_in_order(draws: Iterable[Draw], camera: Camera, size: tuple[int, int]) -> list[Sheet]:
    """Return the sheets of all see-through draws from the farthest to the nearest.

    Near faces lie where their shape is nearest, far ones where it is farthest, so that of nested shapes the
    inner ones lie between both sheets of the outer.
    """
    view_projection = projection_matrix(camera, size[0] / size[1]) @ camera.view
    sheets = [
        sheet for draw in draws if draw.is_see_through for sheet in _sheets(draw, camera, view_projection)
    ]
    return sorted(sheets, key=lambda sheet: sheet.depths_m, reverse=True)


def group_sheets(sheets: Iterable[Sheet]) -> Iterator[Group]:
    """Yield groups in order: a transmissive sheet begins one where it lies over something new.

    After `MAX_CAPTURES` captures the rest sees the last of them.
    """
    captures = 0
    changed = np.ones((_PARTS, _PARTS), dtype=bool)  # by the opaque surfaces
    sheets_of_group: list[Sheet] = []
    is_capturing = False
    for sheet in sheets:
        place = (sheet.rows, sheet.columns)
        if sheet.draw.is_transmissive and captures < MAX_CAPTURES and (captures == 0 or changed[place].any()):
            if sheets_of_group:
                yield Group(tuple(sheets_of_group), is_capturing)
            sheets_of_group, is_capturing = [], True
            captures += 1
            changed[:] = False
        sheets_of_group.append(sheet)
        changed[place] = True
    if sheets_of_group:
        yield Group(tuple(sheets_of_group), is_capturing)


def _sheets(draw: Draw, camera: Camera, view_projection: Float64) -> Iterator[Sheet]:
    primitive = draw.primitive
    used = np.zeros(len(primitive.positions), dtype=bool)
    used[primitive.triangles] = True
    points = np.ones((int(used.sum()), 4))
    points[:, :3] = primitive.positions[used]
    points = points @ primitive.world.T
    depths = -(points @ camera.view[2])
    columns, rows = _parts(points @ view_projection.T)
    near, mean, far = float(depths.min()), float(depths.mean()), float(depths.max())
    is_double_sided = draw.plan.calls_for(Effect.DOUBLE_SIDED)
    if is_double_sided and not draw.plan.calls_for(Effect.VOLUME):
        yield Sheet(draw, "front", (far, mean), columns, rows)
        yield Sheet(draw, "back", (near, mean), columns, rows)
    else:
        # A thick body's near faces account for the whole way through it; its far faces are seen from inside
        # only, or where the body is open.
        yield Sheet(draw, None if is_double_sided else "back", (near, mean), columns, rows)


def _parts(clip: Float64) -> tuple[slice, slice]:
    """Return the columns and rows of the picture's parts that points (n, 4) and what is between may cover."""
    w = clip[:, 3:]
    if not (w > 0.0).all():  # reaches behind the eye: anywhere
        return slice(0, _PARTS), slice(0, _PARTS)
    place = (0.5 + 0.5 * clip[:, :2] / w) * _PARTS
    low = np.clip(np.floor(place.min(axis=0, initial=_PARTS)) - 1, 0, _PARTS).astype(int)
    high = np.clip(np.ceil(place.max(axis=0, initial=0.0)) + 1, 0, _PARTS).astype(int)
    return slice(low[0], high[0]), slice(low[1], high[1])
