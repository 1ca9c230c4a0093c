"""Cumulative integrals of observer times illuminant over ω = 2π/λ (Fourneau et al. 2024, Eq. 16), tabulated.

A spectrum that is constant between a few ω needs only their differences: rgb = Σ_j w_j (C̄(ω_j+1) − C̄(ω_j)).
Stated over ν = 1/λ = ω/2π, in linear Rec.709 of which each channel ends at exactly 1.
"""

from __future__ import annotations

from functools import cache
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.observer import WAVELENGTH_RANGE_NM, observer_table
from gltf_iri.colour.quadrature import colour_density
from gltf_iri.colour.spaces import White

__all__ = ["CUMULATIVE_STEPS", "FIRST_PER_NM", "STEPS_NM", "cumulative_colour", "cumulative_steps"]

Float64 = NDArray[np.float64]

# Linear between so many equal steps of ν: within 3e-5 of the integral, far below what landmarks can promise.
CUMULATIVE_STEPS: Final = 1024

_SHORTEST_NM, _LONGEST_NM = WAVELENGTH_RANGE_NM

# ν in 1/nm goes to (ν − FIRST_PER_NM) · STEPS_NM steps of the table.
FIRST_PER_NM: Final = 1.0 / _LONGEST_NM
STEPS_NM: Final = CUMULATIVE_STEPS / (1.0 / _SHORTEST_NM - 1.0 / _LONGEST_NM)


@cache
def cumulative_steps(white: White) -> Float64:
    """Return (CUMULATIVE_STEPS + 1, 3): C̄ from ν = 1/830 nm⁻¹, where it is 0, to 1/360, where it is 1."""
    wanted_nm = 1.0 / np.linspace(1.0 / _SHORTEST_NM, 1.0 / _LONGEST_NM, CUMULATIVE_STEPS + 1)
    wanted_nm[0], wanted_nm[-1] = _SHORTEST_NM, _LONGEST_NM
    edges_nm = np.union1d(observer_table()[:, 0], wanted_nm)
    middle_nm = 0.5 * (edges_nm[1:] + edges_nm[:-1])
    at_edges, at_middles = colour_density(edges_nm, white), colour_density(middle_nm, white)
    # Observer and illuminant are linear between the edges: Simpson's rule is exact.
    panels = np.diff(edges_nm)[:, None] * (at_edges[:-1] + 4.0 * at_middles + at_edges[1:]) / 6.0
    from_blue = np.concatenate([np.zeros((1, 3)), np.cumsum(panels, axis=0)])
    from_blue /= from_blue[-1]
    steps = 1.0 - from_blue[np.searchsorted(edges_nm, wanted_nm)][::-1]
    steps.setflags(write=False)
    return steps


def cumulative_colour(per_nm: ArrayLike, white: White) -> Float64:
    """Return C̄ (..., 3) at ν = `per_nm` (...) in 1/nm: 0 below 1/830, 1 above 1/360."""
    steps = cumulative_steps(white)
    position = (np.asarray(per_nm, dtype=np.float64) - FIRST_PER_NM) * STEPS_NM
    position = np.minimum(np.maximum(position, 0.0), float(CUMULATIVE_STEPS))
    index = np.minimum(position, CUMULATIVE_STEPS - 1.0).astype(np.intp)
    low = steps[index]
    return np.asarray(low + (position - index)[..., None] * (steps[index + 1] - low))
