"""Filled tables of a stack of Bragg layers, as lookup, renderer and reference receive them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gltf_iri.planning.layer_plan import LayersPlan

__all__ = ["BakedLayers"]

Float64 = NDArray[np.float64]
Floats = NDArray[np.floating[Any]]


@dataclass(frozen=True, slots=True)
class BakedLayers:
    """Tables of the L layers of `plan`, whose `tables` gives P periods, C cosines and B bands.

    first : (P, C, 4) the first layer's reflection as a colour, the fourth number 0.
    reflected, transmitted : (L, P, C, B') mean reflectance and transmissivity of each band in one direction,
        B' = B rounded up to fours, what is beyond B is 0.
    first_albedo : (P, C, 4), albedo : (L, P, C, B') ∫ R w dω over the lobe at N·V: what the layer alone sends
        of a white sky, as `first` and `reflected` do of one direction.
    irradiance : (L, P, B') what of a white sky that has passed those above passes the layer, too: the product
        over all layers is the mean of ∏ T_k over the sky, as the coating lets it in.
    weights : (B', 3) the bands' weights, linear Rec.709, columns sum to 1; 3 × 3 unity and 0 for colours.
    filled_in_s : seconds that filling took, now or when it was put into the cache.
    is_cached : True where it was read from the cache.
    """

    plan: LayersPlan
    first: Floats
    reflected: Floats
    transmitted: Floats
    first_albedo: Floats
    albedo: Floats
    irradiance: Float64
    weights: Float64
    white: str
    filled_in_s: float = 0.0
    is_cached: bool = False
