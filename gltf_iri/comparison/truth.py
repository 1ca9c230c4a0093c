"""The truth beside a film with a way: averaged over the facets that send image light, and over a spread.

Means want hundreds of films a pixel, which the spectral truth has no time for. So the truth is taken at the
facets' mean cosine, and what averaging changes there is taken from `fourier` with all its terms. Both agree
to some 1e-6 where no base is nearly a perfect mirror, and what is left is the difference of their
differences.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.evaluation.prefiltered import prefiltered_fourier
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.facet_mean import facet_cosines, facet_mean
from gltf_iri.optics.microfacet import N_DOT_V_MIN, alpha_ggx
from gltf_iri.reference.film_on import FilmMethod, Sight

__all__ = ["averaged_truth"]

Float64 = NDArray[np.float64]

_TOLERANCE: Final = 1e-7

# Gauss points over slopes and half turns (`facet_cosines`), 2·slopes·turns cosines a pixel.
_POINTS: Final = (16, 6)
_POINTS_OF_A_SPREAD: Final = (8, 3)  # an averaged film takes a hundred times as long, and has fewer fringes

_FILMS_AT_ONCE: Final = 1 << 18


def averaged_truth(white: White) -> FilmMethod:
    """Return the truth under `white`: of image light the mean over facets, of a spread over thicknesses."""

    def method(film: Film, sight: Sight) -> Evaluation:
        if sight.facets is None:
            exact = evaluate("spectral", film, white=white)
            if not sight.thickness_std_nm.any():
                return exact
            more = _fourier(film, sight.thickness_std_nm, white) - _fourier(film, None, white)
            return replace(exact, rgb=exact.rgb + more)
        middle, change = _over_facets(film, sight, white)
        exact = evaluate("spectral", replace(film, cos_theta_1=middle), white=white)
        return replace(exact, rgb=exact.rgb + change)

    return method


def _over_facets(film: Film, sight: Sight, white: White) -> tuple[Float64, Float64]:
    """Return the facets' mean cosine (n,), and the film's mean over them less the plain film there (n, 3)."""
    facets = sight.facets
    count = film.shape[0]
    middle, change = np.zeros(count), np.zeros((count, 3))
    if facets is None:
        return middle, change
    has_spread = bool(sight.thickness_std_nm.any())
    slopes, turns = _POINTS_OF_A_SPREAD if has_spread else _POINTS
    points = 2 * slopes * turns
    cosine = np.broadcast_to(film.cos_theta_1, count)
    step = max(1, _FILMS_AT_ONCE // points)
    for start in range(0, count, step):
        rows = slice(start, min(start + step, count))
        seen, weights = facet_cosines(
            np.maximum(cosine[rows], N_DOT_V_MIN),
            alpha_ggx(facets.roughness[rows]),
            slopes=slopes,
            turns=turns,
        )
        middle[rows] = facet_mean(seen[..., None], weights)[:, 0]
        here = _rows(film, rows)
        each = Film(
            np.clip(seen, 0.0, 1.0),
            here.thickness_nm[:, None],
            here.film_ior,
            replace(here.base, f0=here.base.f0[:, None], index=here.base.index[:, None]),
            here.outside_ior,
        )
        std_nm = sight.thickness_std_nm[rows] if has_spread else None
        mean = facet_mean(_fourier(each, None if std_nm is None else std_nm[:, None], white), weights)
        change[rows] = mean - _fourier(replace(here, cos_theta_1=middle[rows]), None, white)
    return middle, change


def _rows(film: Film, rows: slice) -> Film:
    """Return some rows of a film of shape (n,) whose indices but the base's are the same everywhere."""
    thickness_nm = np.broadcast_to(film.thickness_nm, film.shape)[rows]
    colour = (*film.shape, 3)
    base = replace(
        film.base,
        f0=np.broadcast_to(film.base.f0, colour)[rows],
        index=np.broadcast_to(film.base.index, colour)[rows],
    )
    return replace(film, cos_theta_1=film.cos_theta_1[rows], thickness_nm=thickness_nm, base=base)


def _fourier(film: Film, thickness_std_nm: Float64 | None, white: White) -> Float64:
    if thickness_std_nm is not None:
        return prefiltered_fourier(film, thickness_std_nm, white, _TOLERANCE)
    return evaluate("fourier", film, white=white, parameters={"tolerance": _TOLERANCE}).rgb
