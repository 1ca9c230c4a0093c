"""Sine and cosine by polynomials, in vector instructions; the C library's are called one by one."""

from __future__ import annotations

import numpy as np

from gltf_iri.compiled.loops import inline

__all__ = ["cosine_of_octant", "sincos_half_turns", "sincos_turns", "sine_of_half_turns", "sine_of_octant"]


@inline
def sincos_turns(turns: float) -> tuple[float, float]:
    """Return sin(2πt) and cos(2πt), to 2e-16, near their zeros to 4e-16 of themselves; NaN and ∞ give NaN.

    Whole, half and quarter turns come off without rounding.
    """
    t = turns - np.rint(turns)
    from_whole = abs(t)
    from_half = min(from_whole, 0.5 - from_whole)
    rest = min(from_half, 0.25 - from_half)
    sine, cosine = sine_of_octant(rest), cosine_of_octant(rest)
    is_steep = from_half > 0.125
    turned_sine = cosine if is_steep else sine
    turned_cosine = sine if is_steep else cosine
    return -turned_sine if t < 0.0 else turned_sine, -turned_cosine if from_whole > 0.25 else turned_cosine


@inline
def sincos_half_turns(t: float) -> tuple[float, float]:
    """Return sin(πt) and cos(πt), both of the other sign where t rounds to an odd number; else as above.

    For products of two of them, whose sign does not change with both.
    """
    part = t - np.rint(t)
    return sine_of_half_turns(part), sine_of_half_turns(0.5 - abs(part))


@inline
def sine_of_octant(turns: float) -> float:
    """Return sin(2πt) for |t| ≤ 1/8: sin(2πt)/t as a Chebyshev interpolation in t², truncated below 2e-17."""
    s = turns * turns
    p = 42.058685020160894 + s * (-15.093804209987114 + s * 3.7808689593022957)
    p = 81.60524927594804 + s * (-76.70585970427454 + s * p)
    return turns * (6.283185307179586 + s * (-41.341702240399634 + s * p))


@inline
def cosine_of_octant(turns: float) -> float:
    """Return cos(2πt) for |t| ≤ 1/8: (cos(2πt) − 1)/t² as a Chebyshev interpolation in t², below 2e-19."""
    s = turns * turns
    p = -26.426253275854723 + s * (7.903206911569678 + s * -1.6990343940660637)
    p = -85.4568172066438 + s * (60.24464135270201 + s * p)
    return 1.0 + s * (-19.739208802178716 + s * (64.93939402266824 + s * p))


@inline
def sine_of_half_turns(t: float) -> float:
    """Return sin(πt) for |t| ≤ ½: sin(πt)/t as a Chebyshev interpolation in t², truncated below 1e-18."""
    s = t * t
    p = 0.0004662998161898394 + s * (-2.1903497074626018e-05 + s * 7.697826768224191e-07)
    p = 0.0821458865731029 + s * (-0.007370430505916944 + s * p)
    p = 2.5501640398773007 + s * (-0.5992645293189447 + s * p)
    return t * (3.141592653589793 + s * (-5.167712780049969 + s * p))
