"""A film described by its path difference at normal incidence, D_inc = 2 n₂ d, in place of its thickness.

Belcour & Barla 2017, section 5, Parametric Control. No method works in these terms by itself: they turn what
an artist sets into the film that every method takes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["film_ior_of_thin", "opd_at_normal_nm", "thickness_of_opd_nm"]

Float64 = NDArray[np.float64]


def opd_at_normal_nm(film_ior: ArrayLike, thickness_nm: ArrayLike) -> Float64:
    """Return D_inc = 2 n₂ d (...) in nm; D = D_inc cos θ₂ at any angle."""
    return np.asarray(2.0 * _array(film_ior) * _array(thickness_nm))


def thickness_of_opd_nm(film_ior: ArrayLike, opd_at_normal_nm: ArrayLike) -> Float64:
    """Return the thickness d = D_inc/(2 n₂) (...) in nm."""
    return np.asarray(_array(opd_at_normal_nm) / (2.0 * _array(film_ior)))


def film_ior_of_thin(
    outside_ior: ArrayLike, film_ior: ArrayLike, opd_at_normal_nm: ArrayLike, fade_nm: ArrayLike
) -> Float64:
    """Return the film index (...) that runs to the outside's as D_inc → 0, so that no film is no interface.

    The paper forces n₂ → n₁ and leaves open how. Here n₂ is untouched from D_inc = `fade_nm` > 0 on and below
    it n₁ + (n₂ − n₁) s²(3 − 2s), s = D_inc/fade_nm: smooth at both ends. Methods that are exact at zero
    thickness (`spectral`, `fourier`) do not need it; `bb17` does.
    """
    s = np.clip(_array(opd_at_normal_nm) / _array(fade_nm), 0.0, 1.0)
    outside = _array(outside_ior)
    return np.asarray(outside + (_array(film_ior) - outside) * (s * s * (3.0 - 2.0 * s)))


def _array(values: Any) -> Float64:
    return np.asarray(values, dtype=np.float64)
