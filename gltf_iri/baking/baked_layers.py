"""Filled tables of a stack of Bragg layers, as lookup, renderer and reference receive them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.errors import UsageError
from gltf_iri.planning.layer_plan import LayersPlan
from gltf_iri.planning.material_plan import MaterialPlan

__all__ = ["BakedLayers", "given_tables"]

Float64 = NDArray[np.float64]
Floats = NDArray[np.floating[Any]]


@dataclass(frozen=True, slots=True)
class BakedLayers:
    """Tables of the L layers of `plan`, whose `tables` gives P periods, C cosines and B bands.

    first : (P, C, 4) the first layer's reflection as a colour, the fourth number 0.
    reflected, transmitted : (L, P, C, B') mean reflectance and transmissivity of each band in one direction,
        B' = B rounded up to fours, what is beyond B is 0.
    What becomes of a white sky, seen at the cosine in the host, are colours of whole spectra: with what
    passes the layers above on either way, and what the host's surface lets in, but not what it lets out. The
    fourth number is 0.

    sent : (L, P, C, 4) by each layer's facets. scattered : (P, C, 4) by a white Lambertian base, as if it lay
        in the host. mirrored : (R, 2, P, C, 4) by a metal, F0·[r, 0] + [r, 1] at the R roughnesses that
        divide the plan's `metal_roughness`.
    weights : (B', 3) the bands' weights, linear Rec.709, columns sum to 1; 3 × 3 unity and 0 for colours.
    filled_in_s : seconds that filling took, now or when it was put into the cache.
    is_cached : True where it was read from the cache.
    """

    plan: LayersPlan
    first: Floats
    reflected: Floats
    transmitted: Floats
    sent: Floats
    scattered: Floats
    mirrored: Floats
    weights: Float64
    white: str
    filled_in_s: float = 0.0
    is_cached: bool = False


def given_tables(plan: MaterialPlan, layer_tables: Mapping[int, BakedLayers], white: str) -> BakedLayers:
    """Return the tables given for `plan`, by its index; UsageError where they are missing or others'."""
    baked = layer_tables.get(plan.index)
    if baked is None or baked.plan != plan.layers or baked.white != white:
        raise UsageError(
            f"The plan of material {plan.index} wants tables of its layers under {white}, and "
            f"{'none' if baked is None else 'others'} were given; fill them with bake_layer_plans."
        )
    return baked
