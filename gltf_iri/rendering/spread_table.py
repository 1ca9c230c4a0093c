"""The table of sensitivities under a spread of path differences, as shaders/optics read it.

Texels are lines as those of `film_sensitivity`, farther apart: a line over a nanometre errs by 1.2e-5 at
most, where `gltf_iri.colour.damped_sensitivity` errs between two spreads by eight times as much.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.damped_sensitivity import SPREADS, damped_sensitivity, spread_bounds
from gltf_iri.colour.sensitivity_table import END_NM, sensitivity_table
from gltf_iri.colour.spaces import White
from gltf_iri.planning.method import ParameterValue
from gltf_iri.rendering.line_words import line_words

__all__ = ["SPREAD_FAR_PER_NM", "SPREAD_FINE_END_NM", "SPREAD_LAST", "SPREAD_ROW", "SPREAD_ROWS"]
__all__ += ["SPREAD_ROW_BITS", "SPREAD_SLOPE_BITS", "SPREAD_SLOPE_MAX", "SPREAD_VALUE_MAX"]
__all__ += ["film_sensitivity_spread"]

# Texels are a nanometre apart, and beyond the fine part, which ends half way between two of them, four.
SPREAD_FINE_END_NM: Final = 4096.5
SPREAD_FAR_PER_NM: Final = 0.25

# What |Re Ŝ| and its slope from texel to texel stay below, under either white; rounding costs 4e-6.
SPREAD_VALUE_MAX: Final = 1.6
SPREAD_SLOPE_MAX: Final = 0.018
SPREAD_SLOPE_BITS: Final = 12

SPREAD_ROW_BITS: Final = 10
SPREAD_ROW: Final = 1 << SPREAD_ROW_BITS
SPREAD_LAST: Final = math.ceil(SPREAD_FINE_END_NM + SPREAD_FAR_PER_NM * (END_NM - SPREAD_FINE_END_NM))
SPREAD_ROWS: Final = SPREAD_LAST // SPREAD_ROW + 1  # of texels, for each spread


def film_sensitivity_spread(
    white: White, tolerance: float = 1.0, **parameters: ParameterValue
) -> NDArray[np.uint32]:
    """Return (SPREADS · SPREAD_ROWS, SPREAD_ROW, 4): Re Ŝ of each of `spreads_nm`, one after the other.

    The fourth channel is the float32 of a bound of all that follow over half of `tolerance`; of spread 0 it
    is the bound that `film_sensitivity` has.
    """
    grid_nm, damped = damped_sensitivity(white)
    place = np.arange(SPREAD_LAST) + np.array([-0.5, 0.0, 0.5])[:, None]
    far_nm = SPREAD_FINE_END_NM + (place - SPREAD_FINE_END_NM) / SPREAD_FAR_PER_NM
    # All lie on the grid; Ŝ is even in D, and 0 beyond the table.
    opd_nm = np.minimum(np.abs(np.maximum(place, far_nm)), END_NM)
    begin, middle, end = np.rint(opd_nm / grid_nm[1]).astype(np.intp)
    texels = np.zeros((SPREADS, SPREAD_ROWS * SPREAD_ROW, 4), dtype=np.uint32)
    for row, values in zip(texels, damped, strict=True):
        row[:SPREAD_LAST, :3] = line_words(
            values[begin],
            values[middle],
            values[end],
            value_max=SPREAD_VALUE_MAX,
            slope_max=SPREAD_SLOPE_MAX,
            slope_bits=SPREAD_SLOPE_BITS,
        )
    bounds = spread_bounds(damped)[:, begin]
    bounds[0] = np.maximum(sensitivity_table(white).bound(opd_nm[1]), bounds[0])
    texels[:, :SPREAD_LAST, 3] = (bounds * (2.0 / tolerance)).astype(np.float32).view(np.uint32)
    return texels.reshape(-1, SPREAD_ROW, 4)
