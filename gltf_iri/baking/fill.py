"""Fills tables from the truth."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.lookup import axis_values
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.planning.film_table import FilmTable, Lobe
from gltf_iri.planning.material_plan import MaterialPlan

__all__ = ["bake", "bake_plans"]

Float64 = NDArray[np.float64]


def bake_plans(
    plans: Iterable[MaterialPlan], white: str = "D65", *, advance: Callable[[], None] = lambda: None
) -> Mapping[int, Mapping[Lobe, BakedTable]]:
    """Return the filled tables of every plan that has some, by the material's index and lobe.

    advance : called after each table.
    """
    filled: dict[int, dict[Lobe, BakedTable]] = {}
    for plan in plans:
        for table in () if plan.way is None else plan.way.tables:
            filled.setdefault(plan.index, {})[table.lobe] = bake(table, white)
            advance()
    return filled


def bake(table: FilmTable, white: str = "D65") -> BakedTable:
    """Return `table` filled from the truth under `white`."""
    start = time.perf_counter()
    texels: NDArray[np.floating[Any]] = _texels(table, white).astype(table.texel)
    return BakedTable(table, texels, white, time.perf_counter() - start, is_cached=False)


def _texels(table: FilmTable, white: str) -> Float64:
    columns = {axis.quantity: axis_values(axis) for axis in table.axes}
    cosine = columns["cos_theta"][:, None, None]
    thickness = columns.get("thickness_nm", np.array([table.thickness_nm]))[:, None]
    base = columns.get("base_f0")
    base_f0 = np.array([table.base_f0]) if base is None else np.repeat(base[:, None], 3, axis=1)
    film = Film.of(cosine, thickness, table.film_ior, base_from_f0(base_f0))
    return evaluate("spectral", film, white=white).rgb.reshape(*table.shape, 3)
