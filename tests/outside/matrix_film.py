"""One film by its characteristic matrix, for numpy as for Mitsuba's own numbers.

(B, C) = M·(1, η₃), r = (η₁B − C) / (η₁B + C), with M of the film's phase δ = 2π n₂ d cosθ₂ / λ and of the
admittances η = n cosθ for s, n / cosθ for p. Macleod 2010, "Thin-Film Optical Filters", 4th ed., chapter 2.
The package adds up Airy's series instead.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

__all__ = ["base_ior_of", "film_reflectance"]


def base_ior_of(f0: float) -> float:
    """Return the real index, above 1, of a base that reflects `f0` under air."""
    root = math.sqrt(f0)
    return (1.0 + root) / (1.0 - root)


def film_reflectance(
    film_ior: float,
    thickness_nm: float,
    base_ior: float,
    cosine: Any,
    wavelength_nm: Any,
    cos: Callable[..., Any],
) -> Any:
    """Return |r|² under air, averaged over both polarisations; `cosine` is the angle's outside, above 0.

    cos : the cosine for the type of `wavelength_nm`.
    """
    sine_squared = 1.0 - cosine * cosine
    cosines = [cosine, *(((1.0 - sine_squared / n**2) ** 0.5) for n in (film_ior, base_ior))]
    indices = (1.0, film_ior, base_ior)
    turn = cos(4.0 * math.pi * film_ior * thickness_nm * cosines[1] / wavelength_nm)
    cos_squared, sin_squared = 0.5 + 0.5 * turn, 0.5 - 0.5 * turn
    total = 0.0
    for power in (1, -1):
        e1, e2, e3 = (n * c**power for n, c in zip(indices, cosines, strict=True))
        lost = (e1 - e3) ** 2 * cos_squared + (e1 * e3 / e2 - e2) ** 2 * sin_squared
        whole = (e1 + e3) ** 2 * cos_squared + (e1 * e3 / e2 + e2) ** 2 * sin_squared
        total = total + 0.5 * lost / whole
    return total
