"""Method `naive-rgb`: the exact film at one wavelength a channel.

The simplest film shader, which Belcour & Barla 2017 compare with (§4.1, Fig. 7a): each of red, green and blue
is the Airy reflectance at a wavelength of its own. Papers differ in the wavelengths; here each is where its
channel of linear Rec.709 under D65 has its greatest weight (the product of illuminant, colour matching
functions and matrix row), which is nearer to the truth than the peaks of x̄, ȳ and z̄. Whatever they are,
fringes never fade with thickness, and R = 1 at all three is white.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation, Film, index_by_wavelength
from gltf_iri.optics.film import film_reflectance

__all__ = ["CHANNEL_NM", "evaluate_naive_rgb"]

# Peaks of the colour density of R, G and B (`colour/quadrature.py`, D65), in nm; a test finds them again.
CHANNEL_NM: Final = (605.0, 535.0, 450.0)


def evaluate_naive_rgb(
    film: Film,
    white: White,
    *,
    red_nm: float = CHANNEL_NM[0],
    green_nm: float = CHANNEL_NM[1],
    blue_nm: float = CHANNEL_NM[2],
) -> Evaluation:
    """Evaluate `naive-rgb` at the three wavelengths; a white does not move them.

    Dispersive indices are taken at each channel's wavelength.
    """
    wavelength_nm = np.array([red_nm, green_nm, blue_nm])
    outside_ior, film_ior, thickness_nm, cos_theta_1 = (
        a[..., None] for a in (film.outside_ior, film.film_ior, film.thickness_nm, film.cos_theta_1)
    )
    base_index = film.base.index
    if film.film_ior_at is not None:
        film_ior = index_by_wavelength(film.film_ior_at, wavelength_nm).real
    if film.base.index_at is not None:
        base_index = index_by_wavelength(film.base.index_at, wavelength_nm)
    rgb = film_reflectance(outside_ior, film_ior, base_index, thickness_nm, wavelength_nm, cos_theta_1)
    return Evaluation(np.array(np.broadcast_to(rgb, (*film.shape, 3))), "naive-rgb", str(white))
