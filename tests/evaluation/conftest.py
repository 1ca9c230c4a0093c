"""A film's reflectance a second time: 2×2 transfer matrices of electric fields, 50 digits, one wavelength.

Shares neither formulas nor code with the package, which sums the inter-reflections in closed form.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from mpmath import mp, mpc, mpf

DIGITS = 50


@pytest.fixture(scope="session")
def film_reflectance() -> Callable[..., tuple[Any, Any]]:
    """The transfer matrix: (n1, n2, n3, thickness_nm, wavelength_nm, cos θ₁) → (R_s, R_p)."""
    return _film_reflectance


def _film_reflectance(
    outside_ior: float,
    film_ior: complex,
    base_index: complex,
    thickness_nm: float,
    wavelength_nm: Any,
    cos_1: float,
) -> tuple[Any, Any]:
    """Return (R_s, R_p); fields go as exp(i k z − iωt), so that k > 0 in n + ik absorbs."""
    with mp.workdps(DIGITS):
        n1, n2, n3 = (mpc(n) for n in (outside_ior, film_ior, base_index))
        sin_1 = mp.sqrt(1 - mpf(cos_1) ** 2)
        c1, c2, c3 = mpf(cos_1), _cosine(n1, n2, sin_1), _cosine(n1, n3, sin_1)
        delta = 2 * mp.pi * n2 * c2 * mpf(thickness_nm) / mpf(wavelength_nm)
        step = mp.matrix([[mp.exp(-1j * delta), 0], [0, mp.exp(1j * delta)]])
        reflectances = []
        for boundary in (_boundary_s, _boundary_p):
            first, second, third = boundary(n1, c1), boundary(n2, c2), boundary(n3, c3)
            m = mp.inverse(first) * second * step * mp.inverse(second) * third
            reflectances.append(abs(m[1, 0] / m[0, 0]) ** 2)
        return reflectances[0], reflectances[1]


def _cosine(n1: Any, n: Any, sin_1: Any) -> Any:
    cosine = mp.sqrt(1 - (n1 * sin_1 / n) ** 2)
    return cosine if mp.im(n * cosine) >= 0 and mp.re(n * cosine) >= 0 else -cosine


def _boundary_s(n: Any, c: Any) -> Any:
    return mp.matrix([[1, 1], [n * c, -n * c]])


def _boundary_p(n: Any, c: Any) -> Any:
    return mp.matrix([[c, c], [n, -n]])
