"""Method `incoherent`: the film without its fringes, as it looks where they are finer than anyone can see.

R̄ is the mean of the exact reflectance over the film's phase (`gltf_iri.optics.incoherent`), which depends
neither on the thickness nor on the wavelength. Beyond some 50 µm it is the truth; nearer it is the grey, or
the tint of a coloured base, that fringes are seen around.
"""

from __future__ import annotations

import numpy as np

from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.dispersive import film_bands
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.optics.incoherent import film_reflectance_incoherent

__all__ = ["evaluate_incoherent"]


def evaluate_incoherent(film: Film, white: White) -> Evaluation:
    """Evaluate `incoherent`; where indices depend on the wavelength each channel takes its own."""
    rgb = np.zeros((int(np.prod(film.shape, dtype=np.intp)), 3))
    for band in film_bands(film, white):
        colour = film_reflectance_incoherent(
            band.outside_ior, band.film_ior, band.base_index, band.cos_theta_1
        )
        rgb[:, band.channels] = colour[:, None]
    return Evaluation(rgb.reshape(*film.shape, 3), "incoherent", str(white))
