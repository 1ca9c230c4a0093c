"""The films that every published figure of this project is measured on."""

from __future__ import annotations

from typing import Final

import numpy as np

from gltf_iri.evaluation.film import Film, base_from_ior

__all__ = ["FILM_COUNT", "film_set"]

FILM_COUNT: Final = 1200
_SEED: Final = 0


def film_set(count: int = FILM_COUNT) -> Film:
    """Return `count` dielectric films under air, drawn one by one so that a shorter set begins a longer one.

    In this order: film index 1.1–2.2, thickness 100–800 nm, base index 1.2–2.5, cos θ 0.05–1, all uniform.
    """
    g = np.random.default_rng(_SEED)
    ranges = ((1.1, 2.2), (100.0, 800.0), (1.2, 2.5), (0.05, 1.0))
    drawn = np.array([[g.uniform(low, high) for low, high in ranges] for _ in range(count)])
    film_ior, thickness_nm, base_ior, cos_theta_1 = drawn.T
    return Film.of(cos_theta_1, thickness_nm, film_ior, base_from_ior(base_ior))
