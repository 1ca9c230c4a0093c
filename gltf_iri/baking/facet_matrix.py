"""The mean over a rough mirror's facets as a matrix: from a reflectance at some cosines to its means.

A reflectance is smooth in the cosine. Interpolated in K Chebyshev points on [0, 1] it is Σ_j c_j T_j(2x − 1),
and its mean over facets Σ_j c_j m_j, where m_j are the means of T_j, which no reflectance changes.
Trefethen 2019, "Approximation Theory and Approximation Practice", chapters 3 and 4.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from numpy.typing import NDArray

from gltf_iri.optics.facet_mean import facet_cosines
from gltf_iri.optics.microfacet import N_DOT_V_MIN, alpha_ggx

__all__ = ["chebyshev_cosines", "chebyshev_moments", "facet_moments", "terms_for", "to_coefficients"]

Float64 = NDArray[np.float64]

_FEWEST_TERMS: Final = 24
_MOST_TERMS: Final = 384
# Materials of one roughness ask for the same moments: those of so many numbers are kept, some 60 MB in all.
_KEPT_NUMBERS: Final = 1 << 16
_VALUES_AT_ONCE: Final = 1 << 15  # keeps a block's temporaries in a core's cache

# Gauss points over slopes and turns, and what means of reflectances err by with them: of films of 1.5 µm, and
# less of thinner ones.
_QUADRATURES: Final = ((1e-4, 16, 8), (1e-5, 32, 12), (1e-6, 48, 16), (0.0, 96, 32))


def chebyshev_cosines(terms: int) -> Float64:
    """Return the points (terms,) in (0, 1) at which `to_coefficients` wants a reflectance."""
    return np.asarray(0.5 + 0.5 * np.cos(np.pi * (np.arange(terms) + 0.5) / terms))


def to_coefficients(terms: int) -> Float64:
    """Return the matrix (terms, terms) from values at `chebyshev_cosines` to coefficients: 2/K Σ f T_j."""
    matrix = chebvander(2.0 * chebyshev_cosines(terms) - 1.0, terms - 1).T * (2.0 / terms)
    matrix[0] /= 2.0
    return np.asarray(matrix)


def facet_moments(n_dot_v: Float64, roughness: Float64, terms: int, max_error: float) -> Float64:
    """Return m_j (..., terms) at N·V and perceptual roughness (...); at roughness 0 T_j(2 N·V − 1) itself.

    max_error : of means of reflectances, about; 1e-4 or less.
    """
    cosine, rough = np.broadcast_arrays(n_dot_v, roughness)
    if cosine.size * terms > _KEPT_NUMBERS:
        return _moments(cosine, rough, terms, max_error)
    return _kept_moments(cosine.tobytes(), rough.tobytes(), cosine.shape, terms, max_error)


@lru_cache(maxsize=128)
def _kept_moments(
    cosine: bytes, rough: bytes, shape: tuple[int, ...], terms: int, max_error: float
) -> Float64:
    n_dot_v, roughness = (np.frombuffer(a).reshape(shape) for a in (cosine, rough))
    moments = _moments(n_dot_v, roughness, terms, max_error)
    moments.setflags(write=False)
    return moments


def _moments(n_dot_v: Float64, roughness: Float64, terms: int, max_error: float) -> Float64:
    slopes, turns = next(points for error, *points in _QUADRATURES if error <= max_error or error == 0.0)
    cosine, rough = n_dot_v.reshape(-1), roughness.reshape(-1)
    moments = np.asarray(chebvander(2.0 * cosine - 1.0, terms - 1))
    rows = np.flatnonzero(rough > 0.0)
    step = max(1, _VALUES_AT_ONCE // (2 * slopes * turns))
    for start in range(0, len(rows), step):
        part = rows[start : start + step]
        seen, weights = facet_cosines(
            np.maximum(cosine[part], N_DOT_V_MIN), alpha_ggx(rough[part]), slopes=slopes, turns=turns
        )
        weights /= weights.sum(axis=-1, keepdims=True)
        moments[part] = chebyshev_moments(seen, weights, terms)
    return np.asarray(moments, np.float64).reshape(*n_dot_v.shape, terms)


def chebyshev_moments(cosines: Float64, weights: Float64, terms: int) -> Float64:
    """Return Σ weights T_j(2 cosine − 1), (r, terms), of points (r, q) in each row."""
    # T_{j+1} = 2x T_j − T_{j−1}, row by row: all T_j at once would leave the cache.
    x = 2.0 * cosines - 1.0
    before, now = np.ones_like(x), x
    moments = np.zeros((len(x), terms))
    for j in range(terms):
        moments[:, j] = np.einsum("rq,rq->r", weights, before)
        before, now = now, 2.0 * x * now - before
    return moments


def terms_for(reflectance: Callable[[Float64], Float64], max_error: float) -> int:
    """Return how many terms keep `reflectance`, (k,) cosines → (..., k, 3), to about `max_error`.

    Resonances of nearly perfect mirrors at grazing light want more than 384 terms, and get these.
    """
    terms = _FEWEST_TERMS
    while terms < _MOST_TERMS:
        values = reflectance(chebyshev_cosines(terms))
        tail = np.einsum("jk,...kc->...jc", to_coefficients(terms)[-terms // 4 :], values)
        if np.max(np.abs(tail)) <= max_error:
            break
        terms *= 2
    return terms
