"""Chebyshev polynomials of a great degree by doubling: what N equal cells do, from what one does.

With cos θ = x, T_N(x) = cos Nθ and U_{N−1}(x) = sin Nθ / sin θ; the N-th power of a matrix of trace 2x and
determinant 1 is T_N + U_{N−1}(M − x) (Yeh 1988). Beyond |x| = 1 they are hyperbolic, and nothing here needs
to know. Doubling the pair with 1 − x² given apart is squaring e^{iθ}: an error of θ grows as N and no faster,
also where x nears ±1, whereas T_{2N} = 2T_N² − 1 alone loses θ there.

Results and steps lie in arrays that the caller lends, three of the shape of x: numpy spends a quarter of the
time on new ones.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

__all__ = ["chebyshev_pair", "chebyshev_u"]

Float64 = NDArray[np.float64]


def chebyshev_pair(
    x: Float64, one_minus_x2: Float64, cells: int | NDArray[np.int64], scratch: Sequence[Float64]
) -> tuple[Float64, Float64]:
    """Return T_N(x) and U_{N−1}(x) for N = `cells` ≥ 1, one number or an array that broadcasts with x.

    scratch : three arrays of the shape of x; the results are two of them. Deep in a gap both overflow to ±∞
    together, as numpy's error state allows.
    """
    t, u, rest = scratch
    if not isinstance(cells, int):
        t.fill(1.0)  # N = 0, which doubling leaves alone
        u.fill(0.0)
        for bit in reversed(range(int(cells.max()).bit_length())):
            _double(one_minus_x2, t, u, rest)
            is_odd = np.broadcast_to((cells >> bit) % 2 == 1, x.shape)
            _advance(x, one_minus_x2, t, u, rest, is_odd)
        return t, u
    digits = bin(cells)[3:]
    if digits == "":
        t[...] = x
        u.fill(1.0)
    for position, digit in enumerate(digits):
        if position == 0:
            np.multiply(one_minus_x2, -2.0, out=t)
            t += 1.0
            np.add(x, x, out=u)
        else:
            _double(one_minus_x2, t, u, rest)
        if digit == "1":
            _advance(x, one_minus_x2, t, u, rest, True)
    return t, u


def chebyshev_u(
    x: Float64, one_minus_x2: Float64, cells: int | NDArray[np.int64], scratch: Sequence[Float64]
) -> Float64:
    """Return U_{N−1}(x) alone, cheaper than `chebyshev_pair` where N is one even number."""
    if not isinstance(cells, int) or cells % 2:
        return chebyshev_pair(x, one_minus_x2, cells, scratch)[1]
    t, u = chebyshev_pair(x, one_minus_x2, cells // 2, scratch)
    u *= t
    u *= 2.0
    return u


def _double(one_minus_x2: Float64, t: Float64, u: Float64, rest: Float64) -> None:
    np.multiply(u, u, out=rest)
    rest *= one_minus_x2
    u *= t
    u *= 2.0
    t *= t
    t -= rest


def _advance(
    x: Float64, one_minus_x2: Float64, t: Float64, u: Float64, rest: Float64, where: bool | NDArray[np.bool_]
) -> None:
    np.multiply(one_minus_x2, u, out=rest)
    np.multiply(u, x, out=u, where=where)
    np.add(u, t, out=u, where=where)
    np.multiply(t, x, out=t, where=where)
    np.subtract(t, rest, out=t, where=where)
