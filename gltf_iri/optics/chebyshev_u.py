"""Chebyshev polynomials of a great degree by doubling: what N equal cells do, from what one does.

With cos θ = x, T_N(x) = cos Nθ and U_{N−1}(x) = sin Nθ / sin θ; the N-th power of a matrix of trace 2x and
determinant 1 is T_N + U_{N−1}(M − x) (Yeh 1988). Beyond |x| = 1 they are hyperbolic, and nothing here needs
to know. Doubling the pair with 1 − x² given apart is squaring e^{iθ}: an error of θ grows as N and no faster,
also where x nears ±1, whereas T_{2N} = 2T_N² − 1 alone loses θ there.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

__all__ = ["chebyshev_pair", "chebyshev_u"]


def chebyshev_pair(x: Any, one_minus_x2: Any, cells: int | NDArray[np.int64]) -> tuple[Any, Any]:
    """Return T_N(x) and U_{N−1}(x) for arrays x and 1 − x², N = `cells` ≥ 1 one number or an array.

    Deep in a gap both overflow to ±∞ together, as numpy's error state allows.
    """
    if not isinstance(cells, int):
        return _pair_of_each(x, one_minus_x2, cells)
    t, u = x, None  # N = 1, where U is 1
    for bit in bin(cells)[3:]:
        t, u = _doubled(x, one_minus_x2, t, u)
        if bit == "1":
            t, u = _advanced(x, one_minus_x2, t, u)
    return t, np.ones_like(x) if u is None else u


def chebyshev_u(x: Any, one_minus_x2: Any, cells: int | NDArray[np.int64]) -> Any:
    """Return U_{N−1}(x) alone, one step cheaper than `chebyshev_pair`."""
    if not isinstance(cells, int) or cells < 2:
        return chebyshev_pair(x, one_minus_x2, cells)[1]
    t, u = chebyshev_pair(x, one_minus_x2, cells // 2)
    if cells % 2:
        t, u = _doubled(x, one_minus_x2, t, u)
        return x * u + t
    u = u * t
    u *= 2.0
    return u


def _doubled(x: Any, one_minus_x2: Any, t: Any, u: Any) -> tuple[Any, Any]:
    if u is None:
        return x * x - one_minus_x2, 2.0 * x
    rest = u * u
    rest *= one_minus_x2
    doubled_u = u * t
    doubled_u *= 2.0
    return np.subtract(t * t, rest, out=rest), doubled_u


def _advanced(x: Any, one_minus_x2: Any, t: Any, u: Any) -> tuple[Any, Any]:
    rest = one_minus_x2 * u
    next_u = x * u
    next_u += t
    return np.subtract(x * t, rest, out=rest), next_u


def _pair_of_each(x: Any, one_minus_x2: Any, cells: NDArray[np.int64]) -> tuple[Any, Any]:
    t, u = np.ones_like(x), np.zeros_like(x)  # N = 0, which doubling leaves alone
    for bit in reversed(range(int(cells.max()).bit_length())):
        t, u = _doubled(x, one_minus_x2, t, u)
        is_odd = (cells >> bit) % 2 == 1
        next_t, next_u = _advanced(x, one_minus_x2, t, u)
        t, u = np.where(is_odd, next_t, t), np.where(is_odd, next_u, u)
    return t, u
