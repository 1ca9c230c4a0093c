"""Fills tables from the truth, for half precision from the series that stands for it.

Means over facets and over thicknesses are linear in the film's colour. So the truth is computed once on a
grid of cosines and thicknesses, and matrices along both make of it the texels of every roughness and spread.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.cache import TableCache
from gltf_iri.baking.facet_matrix import chebyshev_cosines, facet_moments, terms_for, to_coefficients
from gltf_iri.baking.lookup import axis_values
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.film_truth import film_truth
from gltf_iri.planning.costs import shipped_costs
from gltf_iri.planning.film_table import FilmTable, Quantity
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.reach import Lobe

__all__ = ["bake", "bake_plans", "filling_ns", "spread_matrix", "spread_thicknesses"]

Float64 = NDArray[np.float64]

_FILMS_AT_ONCE: Final = 1 << 15  # an interrupt waits for so many truths at most

# What means over facets may err by, about: less than half precision rounds, and than single precision is for.
_FACET_MAX_ERROR: Final = {"f2": 1e-5, "f4": 1e-6}

# A Gaussian is cut 5.6 standard deviations off, where 2e-8 of it is left.
_REACH: Final = 5.6
# Steps of the trapezoidal rule: half a standard deviation, and a sixteenth of the shortest fringe, 360 nm/2n,
# so that no order below the sixteenth passes for a slow one.
_STEPS_A_STD: Final = 2.0
_SHORTEST_NM: Final = 360.0
_STEPS_A_FRINGE: Final = 16.0


def bake_plans(
    plans: Iterable[MaterialPlan],
    white: str = "D65",
    *,
    cache: TableCache | None = None,
    advance: Callable[[], None] = lambda: None,
) -> Mapping[int, Mapping[Lobe, BakedTable]]:
    """Return the filled tables of every plan that has some, by the material's index and lobe.

    Equal tables are filled once. `advance` is called after each table. Raises UsageError as the truth does.
    """
    known: dict[FilmTable, BakedTable] = {}
    filled: dict[int, dict[Lobe, BakedTable]] = {}
    for plan in plans:
        for table in () if plan.way is None else plan.way.tables:
            if table not in known:
                known[table] = bake(table, white, cache=cache)
            filled.setdefault(plan.index, {})[table.lobe] = known[table]
            advance()
    return filled


def bake(table: FilmTable, white: str = "D65", *, cache: TableCache | None = None) -> BakedTable:
    """Return `table` filled under `white`, out of the cache where it lies there; else it is put there."""
    found = None if cache is None else cache.read(table, white)
    if found is not None:
        return found
    start = time.perf_counter()
    texels: NDArray[np.floating[Any]] = _texels(table, white).astype(table.texel)
    baked = BakedTable(table, texels, white, time.perf_counter() - start, is_cached=False)
    if cache is not None:
        cache.write(baked)
    return baked


def filling_ns(table: FilmTable) -> float:
    """Return what filling `table` costs: the films that it takes, at the map's price of one."""
    rows, columns = table.axes[0].nodes, _nodes(table, "thickness_nm")
    rows += 96 if table.axis("roughness") else 0
    spread = table.axis("spread_nm")
    if spread is not None:
        columns += len(spread_thicknesses(table))
    films = rows * columns * _nodes(table, "base_f0")
    channels = 1 if table.axis("base_f0") else len(set(table.base_f0))
    # The map's metals have a base a channel, its other films one for all. It has no finer series.
    workload, alike = ("metals", 3) if table.lobe == "metal" else ("films", 1)
    label = "fourier, tolerance 1e-06" if table.texel == "f2" else "spectral"
    return films * channels / alike * shipped_costs().ns_of("numpy", workload, label)


def spread_thicknesses(table: FilmTable) -> Float64:
    """Return evenly spaced thicknesses at which averages over the table's spreads want the truth, in nm."""
    spread, thickness = table.axis("spread_nm"), table.axis("thickness_nm")
    if spread is None:
        return np.zeros(0)
    low = high = table.thickness_nm
    if thickness is not None:
        low, high = thickness.span.low, thickness.span.high
    step_nm = min(
        float(axis_values(spread)[1]) / _STEPS_A_STD, _SHORTEST_NM / (2.0 * table.film_ior * _STEPS_A_FRINGE)
    )
    reach_nm = _REACH * spread.span.high
    # Multiples of the step: mirrored at 0 they fall on each other.
    first, last = max(0, math.floor((low - reach_nm) / step_nm)), math.ceil((high + reach_nm) / step_nm)
    return np.asarray(np.arange(first, last + 1) * step_nm, np.float64)


def spread_matrix(thickness_nm: Float64, at_nm: Float64, std_nm: float) -> Float64:
    """Return (n, k): how films at `at_nm` (k,), evenly spaced, count in the Gaussian around each of (n,).

    What the Gaussian puts below 0 counts at the same thickness above, as the film's series has it
    (`gltf_iri.evaluation.prefiltered`): colours are even in the thickness.
    """
    density = np.exp(-0.5 * ((at_nm - thickness_nm[:, None]) / std_nm) ** 2)
    density += np.where(at_nm > 0.0, np.exp(-0.5 * ((at_nm + thickness_nm[:, None]) / std_nm) ** 2), 0.0)
    return np.asarray(density / density.sum(axis=1, keepdims=True))


def _nodes(table: FilmTable, quantity: Quantity) -> int:
    axis = table.axis(quantity)
    return 1 if axis is None else axis.nodes


def _texels(table: FilmTable, white: str) -> Float64:
    """Return the texels (*table.shape, 3), float64."""
    values = {axis.quantity: axis_values(axis) for axis in table.axes}
    cosine = values["cos_theta"]
    thickness_nm = values.get("thickness_nm", np.array([table.thickness_nm]))
    base = values.get("base_f0")
    base_f0 = np.array([table.base_f0]) if base is None else np.repeat(base[:, None], 3, axis=1)
    roughness, spread_nm = values.get("roughness", np.zeros(1)), values.get("spread_nm", np.zeros(1))

    def truth(cosines: Float64, at_nm: Float64, f0: Float64) -> Float64:
        """Return (cosines, thicknesses, bases, 3)."""
        film = Film.of(cosines[:, None, None], at_nm[:, None], table.film_ior, base_from_f0(f0))
        # Half precision rounds by 2⁻¹² of the value, the series errs by 6e-7.
        return film_truth(film, white, is_exact=table.texel == "f4")

    more_cosines = np.zeros(0)
    if roughness.any():
        hardest = np.unique(thickness_nm[[0, -1, len(thickness_nm) // 2]])
        ends = base_f0[[0, -1]]
        terms = terms_for(
            lambda at: np.moveaxis(truth(at, hardest, ends), 0, -2), _FACET_MAX_ERROR[table.texel]
        )
        more_cosines = chebyshev_cosines(terms)
        over_facets = [
            facet_moments(cosine, np.full(1, r), terms, _FACET_MAX_ERROR[table.texel])
            @ to_coefficients(terms)
            for r in roughness[1:]
        ]
    more_nm = spread_thicknesses(table)
    over_nm = [spread_matrix(thickness_nm, more_nm, float(s)) for s in spread_nm[1:]]

    all_cosines = np.concatenate([cosine, more_cosines])
    all_nm = np.concatenate([thickness_nm, more_nm])
    texels = np.zeros((len(cosine), len(thickness_nm), len(base_f0), len(roughness), len(spread_nm), 3))
    step = max(1, _FILMS_AT_ONCE // len(all_cosines))
    for b in range(len(base_f0)):
        colour = np.concatenate(
            [
                truth(all_cosines, all_nm[i : i + step], base_f0[b : b + 1])
                for i in range(0, len(all_nm), step)
            ],
            axis=1,
        )[:, :, 0]
        by_roughness = [colour[: len(cosine)]]
        if roughness.any():
            by_roughness += [np.tensordot(m, colour[len(cosine) :], 1) for m in over_facets]
        for r, of_r in enumerate(by_roughness):
            texels[:, :, b, r, 0] = of_r[:, : len(thickness_nm)]
            for s, m in enumerate(over_nm, start=1):
                texels[:, :, b, r, s] = np.einsum("dk,ckx->cdx", m, of_r[:, len(thickness_nm) :])
    return texels.reshape(*table.shape, 3)
