"""How many bands and nodes a stack's tables need, so that they keep a budget.

Measured, not guessed: what bands err without any table at random poses says which are enough; tables of them
are filled and halved or doubled along either axis until the smallest that keeps nine tenths of the budget is
found, and that is held against the truth at other poses.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.baking.layer_fill import filled_layers
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.baking.layer_samples import (
    COLOURS,
    LayerSamples,
    Terms,
    doubt_of,
    p95_below,
    p95_guess,
    sampled_layers,
)
from gltf_iri.baking.layer_spectra import path_nm
from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError
from gltf_iri.planning.film_table import Texel
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables

__all__ = ["LAYER_BANDS", "LayerFit", "fit_layer_tables", "lookup_terms", "needs_products"]

# By the texels that one look-up reads; colours read as many as the fewest bands.
LAYER_BANDS: Final = (COLOURS, 4, 8, 12, 16, 20, 24, 32, 48, 64)

_BYTES_MAX: Final = 16 << 20

# Light that travels further in a layer has fringes that take the truth minutes.
_PATH_MAX_NM: Final = 5e6

_AIMED_AT: Final = 0.9  # of the budget
_BANDS_SHARE: Final = 0.95  # of what is aimed at, that bands may take without tables

# Random values of the texture, and poses at each; for one period all at it.
_MEASURED: Final = (24, 16)
_CHECKED: Final = (64, 16)
_CHECKS: Final = 5

# Cells of a first guess, of which halves and doubles are tried.
_COS_CELLS: Final = 64
_PERIOD_CELLS: Final = 16
_CELLS_MAX: Final = 4096


@dataclass(frozen=True, slots=True)
class LayerFit:
    """The tables that keep a budget, None where none do; `best` is the least p95 that was met."""

    tables: LayerTables | None
    best: float


def needs_products(plan: LayersPlan) -> bool:
    """True where factors are multiplied: more layers than one, or a base below."""
    return len(plan.layers) > 1 or plan.under == "base"


def fit_layer_tables(
    plan: LayersPlan, budget: float, *, white: White = "D65", is_crossed: bool = False
) -> LayerFit:
    """Return the smallest tables found, of as few bands as do, whose p95 of CIEDE2000 keeps `budget`.

    `delta_e` of the tables is a number that the p95 against single reflections lies below at other poses:
    of each layer's reflection through those above, and of what passes all. What the samples' own spectra are
    off by `layers-single`, at a few of them, is in it.

    is_crossed : light from behind passes all layers once, and that colour is judged too.

    Raises UsageError for a budget of 0 or less, and for layers whose fringes are too fine to be judged.
    """
    if not budget > 0.0:
        raise UsageError("Tables err: their budget must be greater than 0.")
    choices = LAYER_BANDS if needs_products(plan) else (COLOURS,)
    if path_nm(plan) > _PATH_MAX_NM:
        raise UsageError(
            f"Layers in which light travels {1e-6 * path_nm(plan):.3g} mm are not held to budgets: fringes"
            " so fine cannot be judged. Leave the budget out, or ask for 0, the truth itself."
        )
    texels, poses = _CHECKED
    checked = sampled_layers(plan, white, texels=texels, poses=poses, seed=2, bands=(), is_crossed=is_crossed)
    doubt = doubt_of(plan, checked, white)
    texels, poses = _MEASURED
    seen = sampled_layers(
        plan, white, texels=texels, poses=poses, seed=1, bands=choices, is_crossed=is_crossed
    )
    best, target = np.inf, _AIMED_AT * budget - doubt
    for bands in choices:
        alone = p95_guess(seen.by_bands[bands], seen.truth)
        best = min(best, alone)
        if alone > _BANDS_SHARE * target and needs_products(plan):
            continue
        aim = target
        for _ in range(_CHECKS):
            baked, least = _smallest(plan, bands, aim, seen, white)
            best = min(best, least)
            if baked is None:
                break
            delta_e = p95_below(lookup_terms(baked, checked), checked.truth) + doubt
            if delta_e <= budget:
                return LayerFit(replace(_tables(baked), delta_e=delta_e), delta_e)
            aim *= _AIMED_AT * budget / delta_e
    return LayerFit(None, float(best) + doubt)


def lookup_terms(baked: BakedLayers, samples: LayerSamples) -> Terms:
    """Return the colours of `samples` out of filled tables."""
    found = LayerLookup(baked, samples.texel)
    cosines = samples.cos_h, samples.cos_i, samples.cos_o
    terms = [found.reflected(number, *cosines) for number in range(len(baked.plan.layers))]
    if baked.plan.under == "base":
        terms.append(found.passed(samples.cos_i, samples.cos_o))
    if samples.is_crossed:
        terms.append(found.entering(samples.cos_o))
    return tuple(terms)


def _smallest(
    plan: LayersPlan, bands: int, target: float, seen: LayerSamples, white: White
) -> tuple[BakedLayers | None, float]:
    """Return the smallest tables whose p95 at `seen` is `target`, and the least p95 that was met."""

    def filled(cos_cells: int, period_cells: int) -> BakedLayers:
        tables = LayerTables(max(bands, 3), bands == COLOURS, cos_cells + 1, period_cells + 1, "f4", 0.0)
        return filled_layers(replace(plan, tables=tables), white, has_sky=False)

    def error(baked: BakedLayers) -> float:
        return p95_guess(lookup_terms(baked, seen), seen.truth)

    cells = [_COS_CELLS, _PERIOD_CELLS if plan.varies else 0]
    baked, best = filled(*cells), np.inf
    while (now := error(baked)) > target:
        best = min(best, now)
        # The axis that matters is the one whose halving hurts more.
        hurts = [error(halved) if (halved := _halved(baked, axis)) is not None else 0.0 for axis in (0, 1)]
        cells[int(np.argmax(hurts))] *= 2
        tables = LayerTables(max(bands, 3), bands == COLOURS, cells[0] + 1, cells[1] + 1, "f2", 0.0)
        if tables.bytes(plan) > _BYTES_MAX or max(cells) > _CELLS_MAX:
            return None, best
        baked = filled(*cells)
    best = min(best, now)
    is_shrinking = True
    while is_shrinking:
        is_shrinking = False
        for axis in (1, 0):
            halved = _halved(baked, axis)
            if halved is not None and error(halved) <= target:
                baked, is_shrinking = halved, True
    half = _rounded(baked, "f2")
    baked = half if error(half) <= target else baked
    return (baked if _tables(baked).bytes(plan) <= _BYTES_MAX else None), best


def _tables(baked: BakedLayers) -> LayerTables:
    tables = baked.plan.tables
    if tables is None:
        raise UsageError("These layers have no tables.")
    return tables


def _halved(baked: BakedLayers, axis: int) -> BakedLayers | None:
    """Return every other node along the cosine (0) or the period (1); None where there are no more."""
    tables = _tables(baked)
    nodes = (tables.cos_nodes, tables.period_nodes)[axis]
    if nodes < 3:
        return None
    fewer = (nodes + 1) // 2
    slices = (slice(None), slice(None, None, 2)) if axis == 0 else (slice(None, None, 2), slice(None))
    tables = replace(tables, cos_nodes=fewer) if axis == 0 else replace(tables, period_nodes=fewer)
    return _with(baked, tables, [array[(..., *slices, slice(None))] for array in _texels(baked)])


def _rounded(baked: BakedLayers, texel: Texel) -> BakedLayers:
    tables = replace(_tables(baked), texel=texel)
    return _with(baked, tables, [array.astype(texel) for array in _texels(baked)])


def _texels(baked: BakedLayers) -> Sequence[NDArray[np.floating[Any]]]:
    return baked.first, baked.reflected, baked.transmitted


def _with(
    baked: BakedLayers, tables: LayerTables, arrays: Sequence[NDArray[np.floating[Any]]]
) -> BakedLayers:
    first, reflected, transmitted = arrays
    plan = replace(baked.plan, tables=tables)
    return replace(baked, plan=plan, first=first, reflected=reflected, transmitted=transmitted)
