"""Sine and cosine by polynomials, in vector instructions; the C library's are called one by one."""

from __future__ import annotations

import numpy as np

from gltf_iri.compiled.loops import inline

__all__ = ["sincos_turns"]


@inline
def sincos_turns(turns: float) -> tuple[float, float]:
    """Return sin(2πt) and cos(2πt), to 2e-16; NaN and ∞ give NaN.

    Whole and quarter turns come off without rounding; on the eighth of a turn that is left, Chebyshev
    approximations in t² of sin(2πt)/t and cos(2πt), of degree 7 (truncated below 1e-19).
    """
    quarters = np.floor(4.0 * turns + 0.5)
    t = turns - 0.25 * quarters
    s = t * t
    sine = t * (
        6.283185307179586
        + s
        * (
            -41.34170224039976
            + s
            * (
                81.60524927607493
                + s
                * (
                    -76.70585975299812
                    + s
                    * (
                        42.05869392898878
                        + s * (-15.094640403891546 + s * (3.8197881201632113 + s * -0.7116358090781666))
                    )
                )
            )
        )
    )
    cosine = 1.0 + s * (
        -19.739208802178716
        + s
        * (
            64.93939402266795
            + s
            * (
                -85.45681720652271
                + s
                * (
                    60.244641328867296
                    + s * (-26.426250908622137 + s * (7.903091687751697 + s * -1.6968494702918826))
                )
            )
        )
    )
    quadrant = quarters - 4.0 * np.floor(0.25 * quarters)
    is_odd = (quadrant == 1.0) | (quadrant == 3.0)
    turned_sine = cosine if is_odd else sine
    turned_cosine = sine if is_odd else cosine
    if quadrant >= 2.0:
        turned_sine = -turned_sine
    if (quadrant == 1.0) | (quadrant == 2.0):
        turned_cosine = -turned_cosine
    return turned_sine, turned_cosine
