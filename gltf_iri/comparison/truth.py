"""The truth beside a film with a way: averaged over the facets that send image light, and over a spread.

Means want dozens of films a pixel, for which the spectral truth has no time. So the truth is taken at the
facets' mean cosine, and what averaging changes there from `fourier` with nearly all its terms: what the two
methods differ by stands in both of what is subtracted.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.facet_matrix import chebyshev_cosines, facet_moments, terms_for, to_coefficients
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Evaluation, Film
from gltf_iri.evaluation.prefiltered import prefiltered_fourier
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.reference.film_on import FilmMethod, Sight

__all__ = ["averaged_truth"]

Float64 = NDArray[np.float64]

_TOLERANCE: Final = 1e-5  # of what `fourier` leaves out, most of it in both of two that are subtracted
_MAX_ERROR: Final = 1e-5  # of the series in the cosine that is averaged over facets

_FILMS_AT_ONCE: Final = 1 << 18
_PROBES: Final = 64  # films that say how many terms all of them want


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
    facets, count = sight.facets, film.shape[0]
    middle, change = np.zeros(count), np.zeros((count, 3))
    if facets is None:
        return middle, change
    terms = _terms(film, white)
    at, coefficients = chebyshev_cosines(terms), to_coefficients(terms)
    n_dot_v = np.broadcast_to(film.cos_theta_1, count)
    step = max(1, _FILMS_AT_ONCE // terms)
    for start in range(0, count, step):
        rows = np.arange(start, min(start + step, count))
        moments = facet_moments(n_dot_v[rows], facets.roughness[rows], terms, _MAX_ERROR)
        middle[rows] = np.clip(0.5 + 0.5 * moments[:, 1], 0.0, 1.0)  # T₁(2x − 1) = 2x − 1
        here = _rows(film, rows)
        colours = _fourier(_at_each(here, at), sight.thickness_std_nm[rows, None], white)
        mean = np.einsum("rk,rkc->rc", moments @ coefficients, colours)
        change[rows] = mean - _fourier(replace(here, cos_theta_1=middle[rows]), None, white)
    return middle, change


def _terms(film: Film, white: White) -> int:
    """Return how many terms the films' series in the cosine want, by some of them and the thickest."""
    thickness_nm = np.broadcast_to(film.thickness_nm, film.shape)
    rows = np.append(np.linspace(0, film.shape[0] - 1, _PROBES).astype(np.intp), np.argmax(thickness_nm))
    some = _rows(film, rows)
    return terms_for(lambda at: _fourier(_at_each(some, at), None, white), _MAX_ERROR)


def _rows(film: Film, rows: NDArray[np.intp]) -> Film:
    """Return some rows of a film of shape (n,) whose film and outside index are the same everywhere."""
    colour = (*film.shape, 3)
    base = replace(
        film.base,
        f0=np.broadcast_to(film.base.f0, colour)[rows],
        index=np.broadcast_to(film.base.index, colour)[rows],
    )
    cosine, thickness_nm = (
        np.broadcast_to(a, film.shape)[rows] for a in (film.cos_theta_1, film.thickness_nm)
    )
    return replace(film, cos_theta_1=cosine, thickness_nm=thickness_nm, base=base)


def _at_each(film: Film, cosines: Float64) -> Film:
    """Return a film of shape (n,) at every one of `cosines` (k,): (n, k)."""
    base = replace(film.base, f0=film.base.f0[:, None], index=film.base.index[:, None])
    return replace(film, cos_theta_1=cosines, thickness_nm=film.thickness_nm[:, None], base=base)


def _fourier(film: Film, thickness_std_nm: Float64 | None, white: White) -> Float64:
    """Return the series' colours (..., 3), averaged where the thickness spreads."""
    if thickness_std_nm is not None and thickness_std_nm.any():
        return prefiltered_fourier(film, thickness_std_nm, white, _TOLERANCE)
    return evaluate("fourier", film, white=white, parameters={"tolerance": _TOLERANCE}).rgb
