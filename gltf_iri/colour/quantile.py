"""How surely a share of all errors lies below a number, from errors at some points.

Of n independent errors those above the true p95 are binomially many, whatever their distribution: the k-th
smallest lies above it but with the probability P(Bin(n, 0.95) ≥ k) (David & Nagaraja, "Order Statistics",
§7.1). Points that fill a span evenly err by less than independent ones.
"""

from __future__ import annotations

import math
from functools import cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["CONFIDENCE", "LOOKS", "SHARE", "bounds", "ranks"]

Float64 = NDArray[np.float64]

# A budget is kept where this share of a material's colours keeps it,
SHARE: Final = 0.95
# which is known so surely, after all looks together.
CONFIDENCE: Final = 0.999

# How many points are looked at; more only while it is open whether the budget is kept.
LOOKS: Final = (256, 1024, 4096)

# That the budget is not kept may be less sure: it costs time, never accuracy.
_DOUBT: Final = 0.02


def bounds(errors: Float64) -> tuple[float, float]:
    """Return what the p95 of all errors lies above, and what it lies below, from errors (n,) at n points.

    NaN, a colour that a method leaves undefined, counts as infinite.
    """
    low, high = ranks(len(errors))
    ordered = np.sort(np.where(np.isnan(errors), np.inf, errors))
    return float(ordered[low]), float(ordered[high])


@cache
def ranks(count: int) -> tuple[int, int]:
    """Return the places, from 0 on, of both bounds among so many sorted errors; the last where too few."""
    at_least = np.cumsum(_binomial(count)[::-1])[::-1]  # P(Bin ≥ k)
    too_low = (1.0 - CONFIDENCE) / len(LOOKS)
    high = int(np.argmax(np.append(at_least, 0.0) <= too_low))
    low = int(np.argmax(np.append(1.0 - at_least[1:], 1.0) > _DOUBT))
    return max(low - 1, 0), min(high, count) - 1


def _binomial(count: int) -> Float64:
    """Return P(Bin(count, SHARE) = k) for k = 0 … count."""
    log_all = math.lgamma(count + 1)
    return np.array(
        [
            math.exp(
                log_all
                - math.lgamma(k + 1)
                - math.lgamma(count - k + 1)
                + k * math.log(SHARE)
                + (count - k) * math.log(1.0 - SHARE)
            )
            for k in range(count + 1)
        ]
    )
