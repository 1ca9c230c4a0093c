"""Published indices of a few media, 360–830 nm, to measure what one index per channel costs.

Copper and gold: Johnson & Christy, Phys. Rev. B 6, 4370 (1972); aluminium: Rakić, Appl. Opt. 34, 4755 (1995).
N-BK7: Schott's Sellmeier coefficients; SiO2: Malitson, J. Opt. Soc. Am. 55, 1205 (1965); TiO2 (rutile,
ordinary ray): DeVore, J. Opt. Soc. Am. 41, 416 (1951).
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Dispersion

__all__ = ["FILM_MEDIA", "METALS", "N_BK7"]

Float64 = NDArray[np.float64]

# wavelength in nm, n, k
_COPPER: Final = """354.2 1.37 1.916, 367.9 1.36 1.975, 381.5 1.33 2.045, 397.4 1.32 2.116, 413.3 1.28 2.207,
430.5 1.25 2.305, 450.9 1.24 2.397, 471.4 1.25 2.483, 495.9 1.22 2.564, 520.9 1.18 2.608, 548.6 1.02 2.577,
582.1 0.70 2.704, 616.8 0.30 3.205, 659.5 0.22 3.747, 704.5 0.21 4.205, 756.0 0.24 4.665, 821.1 0.26 5.180,
892.0 0.30 5.768"""
_GOLD: Final = """354.2 1.50 1.866, 367.9 1.48 1.895, 381.5 1.46 1.933, 397.4 1.47 1.952, 413.3 1.46 1.958,
430.5 1.45 1.948, 450.9 1.38 1.914, 471.4 1.31 1.849, 495.9 1.04 1.833, 520.9 0.62 2.081, 548.6 0.43 2.455,
582.1 0.29 2.863, 616.8 0.21 3.272, 659.5 0.14 3.697, 704.5 0.13 4.103, 756.0 0.14 4.542, 821.1 0.16 5.083,
892.0 0.17 5.663"""
_ALUMINIUM: Final = """326.28 0.31474 3.9165, 364.66 0.39877 4.3957, 413.28 0.52135 5.0008,
442.8 0.6079 5.3676, 476.87 0.7278 5.7781, 516.6 0.8734 6.2418, 563.57 1.0728 6.7839,
619.93 1.366 7.4052, 652.25 1.5724 7.7354,
688.81 1.8301 8.0601, 729.32 2.1606 8.3565, 774.91 2.6154 8.4914, 794.78 2.7675 8.3866, 815.69 2.7668 8.2573,
837.74 2.6945 8.1878"""


def _tabulated(text: str) -> Dispersion:
    nm, n, k = np.array([[float(number) for number in row.split()] for row in text.split(",")]).T

    def index_at(wavelength_nm: Float64) -> NDArray[np.complex128]:
        return np.asarray(np.interp(wavelength_nm, nm, n) + 1j * np.interp(wavelength_nm, nm, k))

    return index_at


def _sellmeier(*terms: tuple[float, float]) -> Dispersion:
    """Return n² = 1 + Σ B λ²/(λ² − C), λ in µm."""

    def index_at(wavelength_nm: Float64) -> Float64:
        squared = (1e-3 * wavelength_nm) ** 2
        return np.asarray(np.sqrt(1.0 + sum(b * squared / (squared - c) for b, c in terms)))

    return index_at


def _rutile(wavelength_nm: Float64) -> Float64:
    return np.asarray(np.sqrt(5.913 + 0.2441 / ((1e-3 * wavelength_nm) ** 2 - 0.0803)))


def _constant(wavelength_nm: Float64) -> Float64:
    return np.full_like(wavelength_nm, 1.4)


N_BK7: Final = _sellmeier((1.03961212, 0.00600069867), (0.231792344, 0.0200179144), (1.01046945, 103.560653))
METALS: Final = {
    "copper": _tabulated(_COPPER),
    "gold": _tabulated(_GOLD),
    "aluminium": _tabulated(_ALUMINIUM),
}
FILM_MEDIA: Final = {
    "n = 1.4": _constant,
    "SiO2": _sellmeier((0.6961663, 0.0684043**2), (0.4079426, 0.1162414**2), (0.8974794, 9.896161**2)),
    "TiO2": _rutile,
}
