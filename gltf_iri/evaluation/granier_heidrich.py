"""Method `granier-heidrich`: the layered BRDF of Granier & Heidrich 2003, read as a reflectance.

A BRDF has no one colour for an angle. Here it is asked at the mirror direction, with parallel boundaries and
lobes of value 1 (`gltf_iri.optics.granier_heidrich`). The base under the film plays no part in it.
"""

from __future__ import annotations

import numpy as np

from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation, Film, index_by_wavelength
from gltf_iri.optics.granier_heidrich import WAVELENGTHS_NM, layered_reflection

__all__ = ["evaluate_granier_heidrich"]


def evaluate_granier_heidrich(film: Film, white: White) -> Evaluation:
    """Evaluate `granier-heidrich`; one wavelength a channel knows no white, so `white` is only passed on.

    A dispersive film has its own index at each of the three wavelengths.
    """
    cosine = np.broadcast_to(film.cos_theta_1, film.shape)
    sine = np.sqrt(1.0 - cosine * cosine)
    nothing, up = np.zeros(film.shape), np.array([0.0, 0.0, 1.0])
    layer_ior = film.film_ior[..., None] * np.ones(3)
    if film.film_ior_at is not None:
        layer_ior = index_by_wavelength(film.film_ior_at, np.array(WAVELENGTHS_NM)).real
    rgb = layered_reflection(
        np.stack([sine, nothing, cosine], axis=-1),
        np.stack([-sine, nothing, cosine], axis=-1),
        up,
        up,
        film.outside_ior,
        layer_ior,
        film.thickness_nm,
        1.0,
        1.0,
    )
    return Evaluation(np.broadcast_to(rgb, (*film.shape, 3)), "granier-heidrich", str(white))
