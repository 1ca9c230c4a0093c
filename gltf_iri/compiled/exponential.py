"""The exponential by a polynomial, in vector instructions; the C library's is called one by one."""

from __future__ import annotations

from typing import Final

import numpy as np

from gltf_iri.compiled.loops import inline

__all__ = ["LN2_HIGH", "LN2_LOW", "LOG2_E", "exp_negative", "expm1_reduced"]

LOG2_E: Final = 1.4426950408889634

# ln 2 in two parts, the first of 32 bits, so that whole multiples of it come off without rounding
LN2_HIGH: Final = 0.6931471803691238
LN2_LOW: Final = 1.9082149292705877e-10


@inline
def exp_negative(x: float) -> float:
    """Return e^x for x ≤ 0 to 4e-16 of itself, 2⁻¹⁰²² below that; NaN gives NaN.

    x = (n + f) ln 2 with a whole n and |f| ≤ ½: Taylor's series of e^(f ln 2) up to f¹² (rest below 2e-16),
    times 2ⁿ, which is written into the bits of the exponent.
    """
    turns = x * LOG2_E
    # Keeps the exponent's bits within their field.
    turns = -1022.0 if turns < -1022.0 else turns
    whole = np.rint(turns)
    f = (turns - whole) * 0.6931471805599453
    p = 2.505210838544172e-08 + f * 2.08767569878681e-09
    p = 2.48015873015873e-05 + f * (2.7557319223985893e-06 + f * (2.755731922398589e-07 + f * p))
    p = 0.008333333333333333 + f * (0.001388888888888889 + f * (0.0001984126984126984 + f * p))
    p = 0.5 + f * (0.16666666666666666 + f * (0.041666666666666664 + f * p))
    series = 1.0 + f * (1.0 + f * p)
    bits = (np.int64(whole) + np.int64(1023)) << np.int64(52)
    return float(series * np.int64(bits).view(np.float64))


@inline
def expm1_reduced(r: float) -> float:
    """Return e^r − 1 for |r| ≤ ½ ln 2, by Taylor's series up to r¹³/13!, to 2e-17 of itself."""
    p = r * (1 / 479001600 + r * (1 / 6227020800))
    p = r * (1 / 3628800 + r * (1 / 39916800 + p))
    p = r * (1 / 40320 + r * (1 / 362880 + p))
    p = r * (1 / 720 + r * (1 / 5040 + p))
    p = r * (1 / 24 + r * (1 / 120 + p))
    return r + r * r * (1 / 2 + r * (1 / 6 + p))
