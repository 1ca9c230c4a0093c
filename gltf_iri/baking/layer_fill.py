"""Fills the tables of layers from the truth, or reads them from the cache."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.baking.cache import TableCache
from gltf_iri.baking.layer_cache import read_layers, sky_shapes, write_layers
from gltf_iri.baking.layer_factors import layer_factors
from gltf_iri.baking.layer_sky import sky_bands, sky_colours
from gltf_iri.baking.layer_spectra import weighing_of
from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.planning.material_plan import MaterialPlan

__all__ = ["bake_layer_plans", "bake_layers", "cosine_nodes", "filled_layers", "texel_nodes"]

Float64 = NDArray[np.float64]
Floats = NDArray[np.floating[Any]]


def bake_layer_plans(
    plans: Iterable[MaterialPlan],
    white: White = "D65",
    *,
    cache: TableCache | None = None,
    advance: Callable[[], None] = lambda: None,
) -> Mapping[int, BakedLayers]:
    """Return the filled tables of every plan whose layers have some, by the material's index.

    `advance` is called after each.
    """
    filled = {}
    for plan in plans:
        if plan.layers is not None and plan.layers.tables is not None:
            filled[plan.index] = bake_layers(plan.layers, white, cache=cache)
            advance()
    return filled


def bake_layers(plan: LayersPlan, white: White = "D65", *, cache: TableCache | None = None) -> BakedLayers:
    """Return the tables of `plan` filled under `white`, out of the cache where they lie there.

    Else they are put there.

    Raises UsageError where the plan has no tables.
    """
    found = None if cache is None else read_layers(cache, plan, white)
    if found is not None:
        return found
    baked = filled_layers(plan, white)
    if cache is not None:
        write_layers(cache, baked)
    return baked


def cosine_nodes(nodes: int) -> Float64:
    """Return the cosines (nodes,) that the texels of an axis stand for."""
    return np.linspace(0.0, 1.0, nodes)


def texel_nodes(plan: LayersPlan, nodes: int) -> Float64:
    """Return the values (nodes,) of the texture of periods that the texels of an axis stand for."""
    return np.linspace(plan.texel.low, plan.texel.high, nodes) if nodes > 1 else np.array([plan.texel.high])


def filled_layers(plan: LayersPlan, white: White, *, has_sky: bool = True) -> BakedLayers:
    """Return the tables of `plan` filled under `white`; raises as `bake_layers`.

    has_sky : without, what becomes of image light is left 0, for a half of the time.
    """
    start = time.perf_counter()
    tables = plan.tables
    if tables is None:
        raise UsageError("These layers are computed directly: their plan has no tables to fill.")
    weighing = weighing_of(plan, tables.bands, white, is_colour=tables.is_colour)
    cosines, texel = cosine_nodes(tables.cos_nodes), texel_nodes(plan, tables.period_nodes)
    shares = sky_bands(white).shares(weighing.rule)
    if not has_sky:
        shares = shares[:, :0]
    factors = [layer_factors(plan, layer, texel, cosines, weighing, shares) for layer in plan.layers]

    def kept(values: Float64) -> Floats:
        return _fours(values).astype(tables.texel)

    if has_sky:
        sky = sky_colours(plan, factors, cosines, white)
        sent, scattered, mirrored = (kept(each) for each in (sky.sent, sky.scattered, sky.mirrored))
    else:
        sent, scattered, mirrored = (np.zeros(shape) for shape in sky_shapes(plan, tables).values())
    return BakedLayers(
        plan=plan,
        first=kept(factors[0].colour),
        reflected=kept(np.stack([each.reflected for each in factors])),
        transmitted=kept(np.stack([each.transmitted for each in factors])),
        sent=sent,
        scattered=scattered,
        mirrored=mirrored,
        weights=_fours(weighing.weights.T).T,
        white=str(white),
        filled_in_s=time.perf_counter() - start,
    )


def _fours(values: Float64) -> Float64:
    """Return `values` with zeros at the end of the last axis, up to a multiple of four."""
    missing = -values.shape[-1] % 4
    return np.pad(values, [(0, 0)] * (values.ndim - 1) + [(0, missing)])
