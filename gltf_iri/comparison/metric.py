"""How two sets of pixels differ: in numbers for equations that should agree, in ΔE2000 for colours seen."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.difference import delta_e_2000

__all__ = ["Agreement", "ColourError", "agreement", "colour_error", "relative_deviation"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Agreement:
    """Largest differences over some pixels; None where there are none to compare."""

    pixels: int
    max_abs: float | None
    max_relative: float | None  # of |a − b| / max(1, |b|)
    non_finite: int  # pixels where either side is infinite or not a number; the maxima leave them out

    def within(self, tolerance: float) -> bool:
        """True where every pixel is finite and no relative difference exceeds `tolerance`."""
        return self.non_finite == 0 and (self.max_relative is None or self.max_relative <= tolerance)


@dataclass(frozen=True, slots=True)
class ColourError:
    """CIEDE2000 statistics and the largest difference of a linear channel; None where nothing is compared."""

    pixels: int
    max_abs: float | None
    delta_e_mean: float | None
    delta_e_p95: float | None
    delta_e_max: float | None


def relative_deviation(value: Float64, reference: Float64) -> Float64:
    """Return max over channels of |value − reference| / max(1, |reference|): (..., 3) → (...).

    The 1 makes it an absolute difference in the dark, where a relative one would measure only rounding.
    """
    return np.asarray(np.max(np.abs(value - reference) / np.maximum(1.0, np.abs(reference)), axis=-1))


def agreement(value: Float64, reference: Float64) -> Agreement:
    """Compare two arrays (n, 3) that should be equal up to rounding."""
    finite = np.all(np.isfinite(value) & np.isfinite(reference), axis=-1)
    value, reference, count = value[finite], reference[finite], len(finite)
    non_finite = count - len(value)
    if not len(value):
        return Agreement(count, None, None, non_finite)
    return Agreement(
        count,
        float(np.max(np.abs(value - reference))),
        float(np.max(relative_deviation(value, reference))),
        non_finite,
    )


def colour_error(value: Float64, truth: Float64, *, exposure: float = 1.0) -> ColourError:
    """Compare linear Rec.709 colours (n, 3); `exposure` multiplies both sides before ΔE, not before max_abs.

    Rows that are not finite on both sides are left out; `pixels` counts the rest.
    """
    finite = np.all(np.isfinite(value) & np.isfinite(truth), axis=-1)
    value, truth = value[finite], truth[finite]
    if not len(value):
        return ColourError(0, None, None, None, None)
    difference = delta_e_2000(exposure * value, exposure * truth)
    return ColourError(
        len(value),
        float(np.max(np.abs(value - truth))),
        float(np.mean(difference)),
        float(np.percentile(difference, 95)),
        float(np.max(difference)),
    )
