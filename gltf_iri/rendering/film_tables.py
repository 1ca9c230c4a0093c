"""Baked tables of films as textures, and the numbers with which shaders find their way in them.

shaders/lighting/film_table.glsl says where axes lie. Textures filter: graphics cards do so with weights of
eight bits, so that a colour between two nodes is off by up to 1/512 of what they differ by.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from gltf_iri.baking.baked import BakedTable
from gltf_iri.errors import MissingCapabilityError, UsageError
from gltf_iri.planning.film_table import FilmTable, TableAxis
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.permutation import AXIS_WORDS, film_lobes
from gltf_iri.planning.reach import Lobe
from gltf_iri.rendering.uniforms import Sampled

if TYPE_CHECKING:
    import moderngl

__all__ = ["FilmTableStore", "checked_tables", "film_table_texture", "film_table_uniforms"]

# Keeps the place of any value finite in float32, however narrow an axis is.
_STEEPEST: Final = 1e20


def checked_tables(
    plan: MaterialPlan, tables: Mapping[int, Mapping[Lobe, BakedTable]], white: str
) -> dict[Lobe, BakedTable]:
    """Return the filled tables of the lobes of `plan`.

    tables : by the plans' index (`baking.fill.bake_plans`).
    white : what they must have been filled under.

    Raises UsageError where one that the plan's way names is not there.
    """
    found: dict[Lobe, BakedTable] = {}
    for lobe, table in film_lobes(plan).items():
        if table is None:
            continue
        baked = tables.get(plan.index, {}).get(lobe)
        if baked is None or baked.table != table or baked.white != white:
            raise UsageError(
                f"The plan of material {plan.index} wants a table of the film over its {lobe} under {white}, "
                f"and {'none' if baked is None else 'another'} was given; fill it with bake_plans."
            )
        found[lobe] = baked
    return found


class FilmTableStore:
    """The film tables of one picture's plans; what no plan asks for is never uploaded."""

    def __init__(
        self, context: moderngl.Context, tables: Mapping[int, Mapping[Lobe, BakedTable]], white: str
    ) -> None:
        self._context = context
        self._tables, self._white = tables, white
        self._textures: dict[tuple[int, Lobe], Sampled] = {}

    def uniforms(self, plan: MaterialPlan) -> dict[str, Any]:
        """Return the uniforms of the tables of `plan`; raises as `checked_tables`."""
        values: dict[str, Any] = {}
        for baked in checked_tables(plan, self._tables, self._white).values():
            values |= film_table_uniforms(baked.table)
        return values

    def textures(self, plan: MaterialPlan) -> dict[str, Sampled]:
        """Return the textures by the names of their samplers; raises as `checked_tables`."""
        found = {}
        for lobe, baked in checked_tables(plan, self._tables, self._white).items():
            key = plan.index, lobe
            if key not in self._textures:
                self._textures[key] = film_table_texture(self._context, baked)
            found[f"u_{lobe}_table"] = self._textures[key]
        return found

    def release(self) -> None:
        """Give everything back to OpenGL."""
        for texture in self._textures.values():
            texture.release()
        self._textures.clear()


def film_table_texture(context: moderngl.Context, baked: BakedTable) -> Sampled:
    """Return `baked` as a filtering texture, RGBA16F or RGBA32F, the caller's to release.

    Raises MissingCapabilityError where OpenGL takes none so large.
    """
    shape = (*baked.table.shape, *(1,) * (4 - len(baked.table.axes)))
    width, height, depth = shape[0], shape[1], shape[2] * shape[3]
    is_flat = len(baked.table.axes) <= 2
    limit = context.info["GL_MAX_TEXTURE_SIZE" if is_flat else "GL_MAX_3D_TEXTURE_SIZE"]
    if max(width, height, depth) > limit:
        raise MissingCapabilityError(
            f"A table of {' × '.join(map(str, baked.table.shape))} nodes wants a texture of "
            f"{width} × {height} × {depth}; this OpenGL takes {limit} a side."
        )
    # The first axis runs fastest in memory.
    texels = np.zeros((*shape[::-1], 4), dtype=np.float16 if baked.table.texel == "f2" else np.float32)
    texels[..., :3] = baked.texels.reshape(*shape, 3).transpose(3, 2, 1, 0, 4)
    kind, data = baked.table.texel, texels.tobytes()
    texture: Sampled
    if is_flat:
        texture = context.texture((width, height), 4, data, dtype=kind)
    else:
        texture = context.texture3d((width, height, depth), 4, data, dtype=kind)
        texture.repeat_z = False
    texture.repeat_x = texture.repeat_y = False
    texture.filter = (context.LINEAR, context.LINEAR)
    return texture


def film_table_uniforms(table: FilmTable) -> dict[str, tuple[float, ...]]:
    """Return each axis as (first value, scale, first node's place); nodes along the last two of four."""
    prefix = f"u_{table.lobe}_table"
    values: dict[str, tuple[float, ...]] = {}
    for place, axis in enumerate(table.axes):
        counts_nodes = len(table.axes) == 4 and place >= 2
        values[f"{prefix}_{AXIS_WORDS[axis.quantity]}"] = _axis_uniform(axis, counts_nodes=counts_nodes)
    if len(table.axes) == 4:
        values[f"{prefix}_nodes"] = tuple(float(nodes) for nodes in table.shape[2:])
    return values


def _axis_uniform(axis: TableAxis, *, counts_nodes: bool) -> tuple[float, float, float]:
    low, high = axis.span.low, axis.span.high
    if axis.quantity == "base_f0":
        low, high = math.sqrt(low), math.sqrt(high)
    # Texture coordinates have the first node's centre half a texel from the edge.
    unit, first = (1.0, 0.0) if counts_nodes else (1.0 / axis.nodes, 0.5 / axis.nodes)
    scale = (axis.nodes - 1) * unit / (high - low) if high > low else 0.0
    return low, min(scale, _STEEPEST), first
