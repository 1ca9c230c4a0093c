"""Films whose tables are measured: what of each is constant, what varies, and the points it is asked at."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.planning.film_table import FilmTable, Quantity, TableAxis, Texel
from gltf_iri.planning.reach import Lobe, Span

__all__ = ["FilmPart", "film_of", "point_parts", "points_of", "table_of", "varied"]

Float64 = NDArray[np.float64]

_COSINES: Final = Span(0.0, 1.0)


@dataclass(frozen=True, slots=True)
class FilmPart:
    """The film over one lobe of a material; `base_f0` one span a channel."""

    lobe: Lobe
    film_ior: float
    thickness_nm: Span
    base_f0: tuple[Span, Span, Span]

    @property
    def is_one_base(self) -> bool:
        """True where the base is one colour."""
        return all(span.is_point for span in self.base_f0)

    @property
    def varying(self) -> tuple[Quantity, ...]:
        """What its table has an axis for."""
        found: list[Quantity] = ["cos_theta"]
        if not self.thickness_nm.is_point:
            found.append("thickness_nm")
        if not self.is_one_base:
            found.append("base_f0")
        return tuple(found)


def point_parts(film: Film, lobe: Lobe, count: int) -> list[FilmPart]:
    """Return the first `count` films of a set, at any angle."""
    thickness_nm, film_ior = film.thickness_nm.tolist(), film.film_ior.tolist()
    bases = film.base.f0.tolist()
    return [FilmPart(lobe, film_ior[k], Span.at(thickness_nm[k]), _points(bases[k])) for k in range(count)]


def varied(part: FilmPart, thickness_nm: Span | None = None, base_f0: Span | None = None) -> FilmPart:
    """Return `part` with spans in place of its thickness or of its base."""
    base = part.base_f0 if base_f0 is None else (base_f0, base_f0, base_f0)
    return FilmPart(part.lobe, part.film_ior, thickness_nm or part.thickness_nm, base)


def points_of(part: FilmPart, count: int, g: np.random.Generator, cosines: Span = _COSINES) -> Film:
    """Return `part` at `count` points, each value drawn uniformly from its span."""
    base_f0 = np.stack([_drawn(span, count, g) for span in part.base_f0], axis=-1)
    thickness_nm = _drawn(part.thickness_nm, count, g)
    ior = np.full(count, part.film_ior)
    return Film.of(_drawn(cosines, count, g), thickness_nm, ior, base_from_f0(base_f0))


def film_of(films: Sequence[Film]) -> Film:
    """Return films with one axis of points each, one behind the other."""
    return Film.of(
        np.concatenate([film.cos_theta_1 for film in films]),
        np.concatenate([film.thickness_nm for film in films]),
        np.concatenate([film.film_ior for film in films]),
        base_from_f0(np.concatenate([film.base.f0 for film in films])),
    )


def table_of(part: FilmPart, nodes: Mapping[Quantity, int], texel: Texel) -> FilmTable:
    """Return the empty table of `part` with so many nodes along what varies; its own error is unknown."""
    spans: dict[Quantity, Span] = {
        "cos_theta": _COSINES,
        "thickness_nm": part.thickness_nm,
        "base_f0": Span(min(s.low for s in part.base_f0), max(s.high for s in part.base_f0)),
    }
    red, green, blue = (span.low for span in part.base_f0)
    return FilmTable(
        lobe=part.lobe,
        film_ior=part.film_ior,
        thickness_nm=part.thickness_nm.low,
        base_f0=(red, green, blue),
        axes=tuple(TableAxis(name, spans[name], nodes[name]) for name in part.varying),
        texel=texel,
        delta_e=0.0,
    )


def _points(colour: Sequence[float]) -> tuple[Span, Span, Span]:
    red, green, blue = (Span.at(value) for value in colour)
    return red, green, blue


def _drawn(span: Span, count: int, g: np.random.Generator) -> Float64:
    return g.uniform(span.low, span.high, count)
