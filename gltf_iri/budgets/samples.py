"""Points that fill what a film meets evenly: where its errors are measured.

The k-th point of the additive recurrence x = ½ + kα mod 1, α_j = φ⁻ʲ with φ the positive root of
φ^(d+1) = φ + 1: Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences". In one dimension
this is the golden ratio's sequence. Only what varies takes a dimension. The same reach always gives the same
points, and fewer points begin more of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.optics.facet_mean import facet_cosines, facet_mean
from gltf_iri.optics.microfacet import N_DOT_V_MIN, alpha_ggx
from gltf_iri.planning.reach import Lobe, Reach, Span

__all__ = ["Facets", "Points", "points_of"]

Float64 = NDArray[np.float64]

# Gauss points over the facets' slope (of two panels) and over half a turn: means of films up to some fringes
# keep three digits, of an error of which two are told.
_SLOPES: Final = 12
_TURNS: Final = 4


@dataclass(frozen=True, slots=True)
class Facets:
    """What each of n points sees of light from all around: facets at q cosines V·H, and what each sends.

    cosines, weights : (n, q), of `gltf_iri.optics.facet_mean`.
    """

    cosines: Float64
    weights: Float64


@dataclass(frozen=True, slots=True)
class Points:
    """n places within a reach, under one lobe.

    cos_theta : (n,) outside; where light comes from all around (`facets` given) N·V.
    thickness_nm : (n,).
    base_f0 : (n, 3).
    roughness : (n,) perceptual; 0 for light from one direction.
    """

    cos_theta: Float64
    thickness_nm: Float64
    base_f0: Float64
    roughness: Float64
    facets: Facets | None = None

    def film(self, film_ior: float) -> Film:
        """Return the films (n,) under air, seen by facets from all around at their mean cosine."""
        cosine = self.cos_theta
        if self.facets is not None:
            cosine = facet_mean(self.facets.cosines[..., None], self.facets.weights)[:, 0]
        return Film.of(cosine, self.thickness_nm, film_ior, base_from_f0(self.base_f0))

    def facet_films(self, film_ior: float) -> Film:
        """Return the films (n, q) that the facets see; (n, 1) for light from one direction."""
        cosine = self.cos_theta[:, None] if self.facets is None else self.facets.cosines
        return Film.of(cosine, self.thickness_nm[:, None], film_ior, base_from_f0(self.base_f0[:, None]))

    def mean(self, colours: Float64) -> Float64:
        """Return what facets of the colours (n, q, 3) send together, (n, 3)."""
        return colours[:, 0] if self.facets is None else facet_mean(colours, self.facets.weights)


def points_of(
    reach: Reach, lobe: Lobe, count: int, *, from_all_around: bool = False, first: int = 0
) -> Points:
    """Return `count` points of the sequence from number `first` on.

    from_all_around : light, whose facets depend on the roughness; else light comes from one direction.
    """
    base, is_grey = reach.base(lobe), reach.is_grey(lobe)
    spans = [Span(0.0, 1.0), reach.thickness_nm, *(base[:1] if is_grey else base)]
    if from_all_around:
        spans.append(reach.roughness)
    varying = [span for span in spans if not span.is_point]
    filled = iter(_recurrence(count, len(varying), first).T)
    columns = [
        np.full(count, span.low) if span.is_point else span.low + (span.high - span.low) * next(filled)
        for span in spans
    ]
    roughness = columns.pop() if from_all_around else np.zeros(count)
    cos_theta, thickness_nm, *channels = columns
    base_f0 = np.stack(channels * (3 if is_grey else 1), axis=-1)
    facets = None
    if from_all_around:
        seen = np.maximum(cos_theta, N_DOT_V_MIN)
        facets = Facets(*facet_cosines(seen, alpha_ggx(roughness), slopes=_SLOPES, turns=_TURNS))
    return Points(cos_theta, thickness_nm, base_f0, roughness, facets)


def _recurrence(count: int, dimensions: int, first: int) -> Float64:
    """Return (count, dimensions) in [0, 1)."""
    phi = 2.0
    for _ in range(64):  # a contraction: it stands still long before
        phi = (1.0 + phi) ** (1.0 / (dimensions + 1))
    alpha = phi ** -np.arange(1.0, dimensions + 1)
    number = np.arange(first + 1, first + count + 1, dtype=np.float64)
    return np.asarray((0.5 + number[:, None] * alpha) % 1.0)
