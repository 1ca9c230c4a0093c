"""Reflectance spectra to colour, refined until the colour no longer changes.

RGB = M ∫ R(λ) P(λ) (x̄, ȳ, z̄) dλ,  each row scaled so that R ≡ 1 is (1, 1, 1) under the white P.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.adaptive import integrate_adaptive
from gltf_iri.colour.quadrature import HALF_BANDWIDTH_PER_NM, colour_rule
from gltf_iri.colour.spaces import White
from gltf_iri.tolerances import COLOUR_CONVERGENCE

__all__ = ["MAX_DEGREE", "Reflectance", "integrate_colour"]

Float64 = NDArray[np.float64]

# reflectance(rows, wavelength_nm): rows (r,) integers, wavelength_nm (k,) or (r, k) → (r, k), or (r, k, 3)
# where each channel has a base of its own.
Reflectance = Callable[[NDArray[np.intp], Float64], Float64]

FIRST_DEGREE: Final = 32
MAX_DEGREE: Final = 1024  # what is still open then has narrow features: `integrate_adaptive` finds them

_ROWS_AT_ONCE: Final = 1024  # bounds memory: at the highest degree a block holds 1024 × 1025 × 3 numbers
_VALUES_AT_ONCE: Final = 1 << 16  # keeps temporaries inside a core's cache


def integrate_colour(
    reflectance: Reflectance,
    count: int,
    *,
    white: White,
    opd_nm: Float64 | None = None,
    max_degree: int | None = None,
) -> Float64:
    """Return linear Rec.709 (count, 3) of `count` reflectance spectra.

    A row is finished when doubling the wavelengths moves none of its channels by COLOUR_CONVERGENCE.

    opd_nm : (count,) path difference of each row's fringes; no row finishes on fewer nodes than resolve it.
    max_degree : leave rows at the colour of this degree, a power of two, that it does not settle; without it
    those that the rule of MAX_DEGREE leaves open go on in panels.
    Raises UsageError where no number of wavelengths settles a colour.
    """
    opd_nm = np.zeros(count) if opd_nm is None else opd_nm
    rgb = np.zeros((count, 3))
    still_open = []
    for start in range(0, count, _ROWS_AT_ONCE):
        rows = np.arange(start, min(start + _ROWS_AT_ONCE, count))
        rgb[rows], open_rows = _integrate_block(
            reflectance, rows, opd_nm[rows], white, max_degree or MAX_DEGREE
        )
        still_open.append(open_rows)
    rest = np.concatenate([np.zeros(0, dtype=np.intp), *still_open])
    if max_degree is not None:
        return rgb
    rgb[rest] = integrate_adaptive(reflectance, rest, white=white, opd_nm=opd_nm[rest])
    return rgb


def _integrate_block(
    reflectance: Reflectance, rows: NDArray[np.intp], opd_nm: Float64, white: White, max_degree: int
) -> tuple[Float64, NDArray[np.intp]]:
    """Return the colours (r, 3) of `rows`, and those of the rows that the highest degree leaves open."""
    # The degree at which fringes of this path difference are resolved at all (Nyquist's, in Chebyshev terms).
    needed = 2.0 * np.pi * HALF_BANDWIDTH_PER_NM * opd_nm
    result = np.zeros((len(rows), 3))
    degree = FIRST_DEGREE
    rule = colour_rule(degree, white)
    open_rows = np.arange(len(rows))
    values = _sample(reflectance, rows, rule.wavelength_nm)
    result[:] = _weigh(values, rule.weights)
    while len(open_rows) > 0 and degree < max_degree:
        degree *= 2
        rule = colour_rule(degree, white)
        new = _sample(reflectance, rows[open_rows], rule.wavelength_nm[1::2])
        merged = np.zeros((values.shape[0], degree + 1, *values.shape[2:]))
        merged[:, 0::2] = values
        merged[:, 1::2] = new
        refined = _weigh(merged, rule.weights)
        moved = np.abs(refined - result[open_rows]).max(axis=-1)
        result[open_rows] = refined
        # Not "moved ≥ tolerance": a NaN must not count as settled.
        is_open = ~(moved < COLOUR_CONVERGENCE) | (degree < needed[open_rows])
        open_rows, values = open_rows[is_open], merged[is_open]
    return result, rows[open_rows]


def _sample(reflectance: Reflectance, rows: NDArray[np.intp], wavelength_nm: Float64) -> Float64:
    step = max(1, _VALUES_AT_ONCE // len(wavelength_nm))
    return np.concatenate([reflectance(rows[i : i + step], wavelength_nm) for i in range(0, len(rows), step)])


def _weigh(values: Float64, weights: Float64) -> Float64:
    if values.ndim == 2:
        return values @ weights
    return np.stack([values[:, :, c] @ weights[:, c] for c in range(3)], axis=-1)
