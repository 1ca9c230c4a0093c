"""The tangent of a film's phase β = 2πd q₂/λ, of every film at every wavelength, with all its digits.

β/π is the product of a number for each film and angle, 2d q₂, and one for each wavelength, 1/λ. Where it
counts many half turns, or a sharp resonance magnifies what rounds it, both are taken as two floats
(`gltf_iri.optics.two_floats`), and whole half turns come off the exact product.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.optics.two_floats import exact_product, reciprocal, split

__all__ = ["phase_factors", "table", "write_tangent"]

Float64 = NDArray[np.float64]

_POLE: Final = 1e-17  # half turns from tan's pole, in place of none: as near as float64 comes to π/2


def phase_factors(q2: tuple[Any, ...], twice_nm: Float64, wavelength: Float64) -> tuple[Float64, Float64]:
    """Return what `write_tangent` multiplies, a row a number: of the angle, and of the wavelength.

    q2 : |q₂| (...), alone or as two floats. twice_nm : 2d (...), which goes with either.
    """
    is_exact = len(q2) > 1
    per_nm = reciprocal(wavelength) if is_exact else (1.0 / wavelength,)
    # The thickness goes with the angles, unless that would make a whole grid of them.
    together = np.broadcast(q2[0], twice_nm).shape
    if np.prod(together) <= max(np.size(q2[0]), wavelength.size):
        q2 = _times(q2, twice_nm)
    else:
        per_nm = _times(per_nm, twice_nm)
    if is_exact:
        return table(*_halves(*q2)), table(*_halves(*per_nm))
    return table(np.pi * q2[0]), table(per_nm[0])


def write_tangent(
    a: Float64, b: Float64, sign: Float64 | None, is_sharp: bool, t: Float64, *spare: Float64
) -> None:
    """Write tan β into t (...), tanh |β| where `sign` (...) is negative.

    a, b : what `phase_factors` returns, in pieces that broadcast to t. is_sharp : next to its poles the
    tangent is to have all its digits too. spare : two arrays (...), which are overwritten.
    """
    rest, whole = spare
    np.multiply(a[0], b[0], out=t)
    if len(a) == 1:
        fading = None if sign is None else np.tanh(t)
        np.tan(t, out=t)
    else:
        np.multiply(a[0], b[1], out=rest)
        rest += np.multiply(a[1], b[2], out=whole)
        fading = None if sign is None else np.tanh(np.pi * (t + rest))
        t -= np.rint(t, out=whole)
        if is_sharp:
            _write_tangent_to_its_pole(t, rest)
        else:
            t += rest
            np.tan(np.multiply(t, np.pi, out=t), out=t)
    if sign is not None and fading is not None:
        np.copyto(t, fading, where=sign < 0.0)


def _write_tangent_to_its_pole(t: Float64, rest: Float64) -> None:
    """Write tan π(t + rest) into t, |t| ≤ ½, with all digits next to the pole; overwrites its arguments.

    From a quarter on, the cotangent of what is left to a half, which as a difference is exact.
    """
    is_steep = np.abs(t) > 0.25
    np.copyto(t, np.copysign(0.5, t) - t, where=is_steep)
    np.negative(rest, out=rest, where=is_steep)
    t += rest
    np.copyto(t, _POLE, where=is_steep & (t == 0.0))
    np.tan(np.multiply(t, np.pi, out=t), out=t)
    np.divide(1.0, t, out=t, where=is_steep)


def _times(number: tuple[Any, ...], factor: Any) -> tuple[Any, ...]:
    if len(number) == 1:
        return (number[0] * factor,)
    product, low = exact_product(number[0], factor)
    return product, low + number[1] * factor


def _halves(value: Any, low: Any) -> tuple[Any, Any, Any]:
    """Return the first 26 bits of value + low, the rest, and both together."""
    first, second = split(value)
    return first, second + low, value


def table(*rows: Any) -> Float64:
    """Return (rows, ...): arrays that broadcast to (...), one after the other."""
    filled = np.zeros((len(rows), *np.broadcast(*rows).shape))
    for i, row in enumerate(rows):
        filled[i] = row
    return filled
