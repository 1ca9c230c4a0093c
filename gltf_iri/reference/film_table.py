"""A film of one thickness over one base as a polynomial of the cosine, for a million directions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Final

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Base, Evaluation, Film

__all__ = ["TabulatedFilm"]

Float64 = NDArray[np.float64]

# Far below what a Monte-Carlo mean over directions resolves.
_MAX_ERROR: Final = 1e-6

_FEWEST_TERMS: Final = 32
_MOST_TERMS: Final = 512

# More different films than this on one surface come from a texture, and are evaluated one by one.
_MOST_FILMS: Final = 4


@dataclass(frozen=True, slots=True)
class _Series:
    coefficients: Float64  # (terms, 3)
    like: Evaluation  # what it was made from


@dataclass(slots=True)
class TabulatedFilm:
    """Maps films to their colours as `method` does, to 1e-6, with few calls of it.

    A reflectance is analytic in cos θ₁; its Chebyshev series is doubled until it is met at the nodes of the
    next one. Where that fails (metals close to a perfect mirror, methods with kinks), and for films that
    differ from point to point, `method` is called itself.
    """

    method: Callable[[Film], Evaluation]
    _known: dict[bytes, _Series | None] = field(default_factory=dict)

    def __call__(self, film: Film) -> Evaluation:
        """Return the colours of `film`, a row of points (n,)."""
        keys = _keys(film)
        if keys is None or len(keys) < _FEWEST_TERMS:
            return self.method(film)
        groups: list[NDArray[np.int64]] = []
        left = np.arange(len(keys))
        while len(left) and len(groups) < _MOST_FILMS:
            is_same = np.all(keys[left] == keys[left[0]], axis=1)
            groups.append(left[is_same])
            left = left[~is_same]
        found = [] if len(left) else [self._series(keys[rows[0]]) for rows in groups]
        known = [series for series in found if series is not None]
        if not known or len(known) < len(found):
            return self.method(film)
        cosine = np.broadcast_to(film.cos_theta_1, film.shape)
        rgb = np.zeros((*film.shape, 3))
        for rows, series in zip(groups, known, strict=True):
            rgb[rows] = _sum(series.coefficients, cosine[rows])
        return replace(known[0].like, rgb=rgb)

    def _series(self, key: Float64) -> _Series | None:
        name = key.tobytes()
        if name not in self._known:
            self._known[name] = self._fitted(key)
        return self._known[name]

    def _fitted(self, key: Float64) -> _Series | None:
        terms = _FEWEST_TERMS
        fine = self._at_nodes(key, terms)
        while terms < _MOST_TERMS:
            coefficients: Float64 = np.asarray(
                chebyshev.chebfit(2.0 * _nodes(terms) - 1.0, fine.rgb, terms - 1), np.float64
            )
            terms *= 2
            fine = self._at_nodes(key, terms)
            if fine.undefined:
                return None
            if np.max(np.abs(_sum(coefficients, _nodes(terms)) - fine.rgb)) <= 0.5 * _MAX_ERROR:
                return _Series(coefficients, fine)
        return None

    def _at_nodes(self, key: Float64, terms: int) -> Evaluation:
        thickness, film_ior, outside = key[:3]
        base = Base(np.tile(key[3:6], (terms, 1)), np.tile(key[6:9] + 1j * key[9:], (terms, 1)))
        return self.method(Film.of(_nodes(terms), thickness, film_ior, base, outside))


def _keys(film: Film) -> Float64 | None:
    """Return what colours depend on beside the cosine, (n, 12); None for dispersive media."""
    if film.film_ior_at is not None or film.base.index_at is not None or len(film.shape) != 1:
        return None
    scalars = [
        np.broadcast_to(a, film.shape)[:, None] for a in (film.thickness_nm, film.film_ior, film.outside_ior)
    ]
    index = film.base.index
    colours = [np.broadcast_to(a, (*film.shape, 3)) for a in (film.base.f0, index.real, index.imag)]
    return np.concatenate([*scalars, *colours], axis=1)


def _nodes(terms: int) -> Float64:
    """Return Chebyshev's points of the first kind in [0, 1]."""
    return np.asarray(0.5 + 0.5 * np.cos(np.pi * (np.arange(terms) + 0.5) / terms))


def _sum(coefficients: Float64, cosine: Float64) -> Float64:
    return np.asarray(np.moveaxis(chebyshev.chebval(2.0 * cosine - 1.0, coefficients), 0, -1))
