"""Method `bb17`: exact interfaces, Gaussian fits of the observer, a fixed number of orders, as published.

    R_j = C₀ + 2 Σ_{m = 1}^{M} C_m Re(e^{imφ₂} Ŝ_j(mD))          (Belcour & Barla 2017, Eq. 10, M ≤ 3)

in X, Y and Z, each with the fits of `gltf_iri.colour.sensitivity`. Its white is E: by the fits X = Y = Z = 1
of what reflects everything, and the RGB space that these go into has E for its white, as the paper's CIE RGB.
Here it has Rec.709's primaries, with each row of the matrix scaled so that E is (1, 1, 1); D65 is unknown to
it, and the same numbers stand under either white. Light that the film's outer side reflects in total is all
reflected: no film is frustrated.
"""

from __future__ import annotations

from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gltf_iri.colour.sensitivity import gaussian_transform
from gltf_iri.colour.spaces import XYZ_TO_REC709, White
from gltf_iri.evaluation.dispersive import FilmBand, film_bands
from gltf_iri.evaluation.film import Evaluation, Film, Float64
from gltf_iri.optics.film_series import film_series

__all__ = ["BB17_ORDERS", "evaluate_bb17", "prefiltered_bb17"]

BB17_ORDERS: Final = 3

_E_XYZ_TO_RGB: Final[NDArray[np.float64]] = XYZ_TO_REC709 / XYZ_TO_REC709.sum(axis=1, keepdims=True)


def evaluate_bb17(film: Film, white: White, *, orders: int = BB17_ORDERS) -> Evaluation:
    """Evaluate `bb17` with fringes up to order `orders`; indices by wavelength as in `fourier`."""
    return Evaluation(prefiltered_bb17(film, 0.0, white, orders), "bb17", str(white))


def prefiltered_bb17(
    film: Film, thickness_std_nm: ArrayLike, white: White, orders: int = BB17_ORDERS
) -> Float64:
    """Return (..., 3): `bb17` averaged in closed form over a Gaussian spread of thickness.

    thickness_std_nm : (...), small against the film's thickness: what falls below 0 is counted as well.
    """
    spread = np.broadcast_to(np.asarray(thickness_std_nm, dtype=np.float64), film.shape).reshape(-1)
    rgb = np.zeros((spread.size, 3))
    for band in film_bands(film, white):
        rgb[:, band.channels] = _colour(band, spread, orders)[:, band.channels]
    return rgb.reshape(*film.shape, 3)


def _colour(band: FilmBand, thickness_std_nm: Float64, orders: int) -> Float64:
    series = film_series(band.outside_ior, band.film_ior, band.base_index, band.cos_theta_1)
    path = 2.0 * np.sqrt(np.maximum(series.q2_squared, 0.0))
    xyz = np.repeat((1.0 - (series.entering[0] + series.entering[1]))[:, None], 3, axis=-1)
    power: NDArray[Any] = 2.0 * series.entering
    for m in range(1, orders + 1):
        power = power * series.ratio
        sensitivity = gaussian_transform(m * path * band.thickness_nm, m * path * thickness_std_nm)
        xyz -= ((power[0] + power[1])[:, None] * sensitivity).real
    is_total = ~(series.q2_squared > 0.0)[:, None]
    return np.asarray(np.where(is_total, 1.0, xyz @ _E_XYZ_TO_RGB.T))
