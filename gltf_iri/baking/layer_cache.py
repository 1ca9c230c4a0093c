"""Filled tables of layers on disk, in the folder and the form of the films' tables."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked_layers import BakedLayers
from gltf_iri.baking.cache import TableCache, described
from gltf_iri.colour.bands import bands_of
from gltf_iri.colour.spaces import White
from gltf_iri.errors import UsageError
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables

__all__ = ["layer_shapes", "layer_weights", "read_layers", "sky_shapes", "write_layers"]

Float64 = NDArray[np.float64]

# Single precision holds every array: texels of half precision are exact in it.
_KEPT_AS: Final = "f4"


def layer_shapes(plan: LayersPlan, tables: LayerTables) -> dict[str, tuple[int, ...]]:
    """Return the shapes of the arrays of `BakedLayers`, but for its weights."""
    layers, fours = len(plan.layers), -4 * (-tables.bands // 4)
    nodes = (tables.period_nodes, tables.cos_nodes)
    every = (layers, *nodes, fours)
    return {
        "first": (*nodes, 4),
        "reflected": every,
        "transmitted": every,
        **sky_shapes(plan, tables),
    }


def sky_shapes(plan: LayersPlan, tables: LayerTables) -> dict[str, tuple[int, ...]]:
    """Return the shapes of the arrays of `BakedLayers` that image light alone reads."""
    nodes = (tables.period_nodes, tables.cos_nodes, 4)
    return {
        "sent": (len(plan.layers), *nodes),
        "scattered": nodes,
        "mirrored": (plan.metal_nodes, 2, *nodes),
    }


def layer_weights(tables: LayerTables, white: White) -> Float64:
    """Return the weights of `BakedLayers`."""
    weights = np.eye(3) if tables.is_colour else bands_of(tables.bands, white).weights
    return np.pad(weights, [(0, -tables.bands % 4), (0, 0)])


def read_layers(cache: TableCache, plan: LayersPlan, white: White) -> BakedLayers | None:
    """Return the filled tables of `plan`; None where they are not in `cache`.

    Raises UsageError where the plan has no tables.
    """
    tables = _tables(plan)
    shapes = layer_shapes(plan, tables)
    sizes = [math.prod(shape) for shape in shapes.values()]
    found = cache.read_values(_description(plan, tables, white), _KEPT_AS, sum(sizes))
    if found is None:
        return None
    values, filled_in_s = found
    parts = np.split(values, np.cumsum(sizes)[:-1])
    arrays: dict[str, Any] = {
        name: part.reshape(shape).astype(tables.texel)
        for (name, shape), part in zip(shapes.items(), parts, strict=True)
    }
    return BakedLayers(
        plan=plan,
        **arrays,
        weights=layer_weights(tables, white),
        white=str(white),
        filled_in_s=filled_in_s,
        is_cached=True,
    )


def write_layers(cache: TableCache, baked: BakedLayers) -> None:
    """Put filled tables into `cache`; where that fails the reason is noted there."""
    tables = _tables(baked.plan)
    values = [np.asarray(getattr(baked, name), np.float32) for name in layer_shapes(baked.plan, tables)]
    numbers = np.concatenate([each.reshape(-1) for each in values])
    white: Any = baked.white
    cache.write_values(_description(baked.plan, tables, white), _KEPT_AS, numbers, baked.filled_in_s)


def _tables(plan: LayersPlan) -> LayerTables:
    if plan.tables is None:
        raise UsageError("These layers are computed directly: their plan has no tables.")
    return plan.tables


def _description(plan: LayersPlan, tables: LayerTables, white: White) -> bytes:
    """Return all that the texels depend on."""
    metal = plan.metal_roughness
    return described(
        {
            "white": str(white),
            "host_ior": float(plan.host_ior).hex(),
            "layers": [
                [
                    *(float(value).hex() for value in (layer.n1, layer.n2, *layer.period_nm)),
                    float(layer.fill).hex(),
                    layer.cells,
                    float(layer.alpha).hex(),
                ]
                for layer in plan.layers
            ],
            "under": plan.under,
            "metal": None if metal is None else [float(metal.low).hex(), float(metal.high).hex()],
            "texel": [float(plan.texel.low).hex(), float(plan.texel.high).hex()],
            "tables": [tables.bands, tables.is_colour, tables.cos_nodes, tables.period_nodes, tables.texel],
        }
    )
