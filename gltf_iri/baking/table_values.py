"""Colours that a table would hold, at any place, without filling it: what its resolution is measured with."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.facet_matrix import chebyshev_cosines, facet_moments, terms_for, to_coefficients
from gltf_iri.colour.spaces import White
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.film_truth import film_truth, mean_film_truth
from gltf_iri.planning.film_table import Quantity

__all__ = ["Places", "TableValues"]

Float64 = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Places:
    """n films, each seen from m sides.

    cos_theta, roughness : (n, m); thickness_nm, spread_nm : (n, 1); base_f0 : (n, 3).
    """

    cos_theta: Float64
    thickness_nm: Float64
    base_f0: Float64
    roughness: Float64
    spread_nm: Float64

    def value(self, quantity: Quantity) -> Float64:
        """Return one of them."""
        return np.asarray(getattr(self, quantity))

    def moved(self, values: Mapping[Quantity, Float64]) -> Places:
        """Return the places with some of their values replaced."""
        return replace(self, **{str(quantity): each for quantity, each in values.items()})


class TableValues:
    """Maps places to the truth there (n, m, 3): of one direction, and of the mean over facets.

    What several calls have in common is computed once.

    is_exact : whether the truth itself is asked, or the series that stands for it.
    facet_max_error : what means over facets may err by, about.
    """

    def __init__(self, film_ior: float, white: White, *, is_exact: bool, facet_max_error: float) -> None:
        self._is_exact = is_exact
        self._film_ior, self._white, self._max_error = film_ior, white, facet_max_error
        self._terms = 0
        self._known: dict[tuple[bytes, ...], Float64] = {}

    def __call__(self, places: Places) -> Float64:
        """Return the colours (n, m, 3)."""
        if not places.roughness.any():
            key = (places.cos_theta.tobytes(), *_key(places))
            return self._once(key, lambda: self._in_one_direction(places.cos_theta, places))
        terms = self._terms = self._terms or self._terms_for(places)
        moments = self._once(
            (places.cos_theta.tobytes(), places.roughness.tobytes()),
            lambda: facet_moments(places.cos_theta, places.roughness, terms, self._max_error),
        )
        coefficients = self._once(_key(places), lambda: self._coefficients(places, terms))
        return np.asarray(np.einsum("nmj,njc->nmc", moments, coefficients))

    def _once(self, key: tuple[bytes, ...], compute: Callable[[], Float64]) -> Float64:
        if key not in self._known:
            self._known[key] = compute()
        return self._known[key]

    def _terms_for(self, places: Places) -> int:
        """Return the terms that a thin, a middling and the thickest film want."""
        rows = np.argsort(places.thickness_nm[:, 0])[[0, len(places.thickness_nm) // 2, -1]]
        few = _rows(places, rows)
        return terms_for(
            lambda at: self._in_one_direction(np.broadcast_to(at, (3, len(at))), few), self._max_error
        )

    def _coefficients(self, places: Places, terms: int) -> Float64:
        """Return (n, terms, 3) of the series in the cosine; equal films are asked once."""
        columns = np.column_stack([places.thickness_nm, places.base_f0, places.spread_nm])
        _, rows, which = np.unique(columns, axis=0, return_index=True, return_inverse=True)
        at = np.broadcast_to(chebyshev_cosines(terms), (len(rows), terms))
        colours = self._in_one_direction(at, _rows(places, rows))
        return np.asarray(np.einsum("jk,nkc->njc", to_coefficients(terms), colours)[which.reshape(-1)])

    def _in_one_direction(self, cos_theta: Float64, places: Places) -> Float64:
        """Return (n, k, 3) at the cosines (n, k)."""
        base = base_from_f0(places.base_f0[:, None])
        film = Film.of(cos_theta, places.thickness_nm, self._film_ior, base)
        if not places.spread_nm.any():
            return film_truth(film, self._white, is_exact=self._is_exact)
        return mean_film_truth(film, places.spread_nm, self._white)


def _rows(places: Places, rows: NDArray[np.intp]) -> Places:
    return Places(*(places.value(each.name)[rows] for each in fields(places)))  # type: ignore[arg-type]


def _key(places: Places) -> tuple[bytes, ...]:
    return tuple(a.tobytes() for a in (places.thickness_nm, places.base_f0, places.spread_nm))
