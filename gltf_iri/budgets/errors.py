"""How far ways to a film's colour are from the truth, over all that the film meets, as far as a budget asks.

An error is the CIEDE2000 between colours of the surface at the film's greatest factor, seen against white 1:
of light from one direction, where there is image light of its mean over the facets, and where the thickness
varies within a pixel of its mean over that. What is stated is a number that the p95 of it lies below
(`gltf_iri.colour.quantile`), the greatest of the sights'.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray

from gltf_iri.budgets.samples import Points, points_of
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.colour.quantile import LOOKS, bounds
from gltf_iri.colour.spaces import Light
from gltf_iri.evaluation.film import Film
from gltf_iri.evaluation.film_truth import film_truth, mean_film_truth
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.fresnel import f_schlick
from gltf_iri.planning.method import METHODS, ParameterValue
from gltf_iri.planning.reach import Lobe, Reach

__all__ = ["FilmErrors", "Measured"]

Float64 = NDArray[np.float64]

_Sight = Literal["one direction", "all around", "spread"]

# The film's colours (n, 3) at n points of a lobe.
Colours = Callable[[Lobe, Points], Float64]

# Where a budget is far above what it errs, a series stands for the truth, at a tenth of its time: it is held
# against the truth at a few points, and what it errs there at most is added to every error.
_SERIES_POINTS: Final = 32
_SEED: Final = 5
_SERIES_SHARE: Final = 0.02  # of a budget


@dataclass(frozen=True, slots=True)
class Measured:
    """What the p95 of a way's error lies below, and whether it was shown to keep the budget."""

    delta_e: float
    holds: bool


@dataclass(frozen=True, slots=True)
class _Places:
    """Points of one lobe under one light, what is there without a film, and the truth."""

    lobe: Lobe
    points: Points
    bare: Float64
    truth: Float64
    doubt: float  # ΔE that the truth itself may be off by


class FilmErrors:
    """Measures ways to the film's colour over one reach; what they are held against is computed once.

    bare_at_grazing : what the dielectric without its film reflects at grazing angles: its specular weight.
    has_spread : pixels hold more than one thickness, as far apart as `reach.spread_nm` says they usually are.
    """

    def __init__(
        self,
        reach: Reach,
        *,
        white: str | Light = "D65",
        has_image_light: bool,
        bare_at_grazing: float = 1.0,
        has_spread: bool = False,
    ) -> None:
        self.reach = reach
        self.white = white
        self.lobes = reach.lobes
        self._sights: tuple[_Sight, ...] = ("one direction",)
        if has_image_light:
            self._sights = (*self._sights, "all around")
        self._has_spread = has_spread and reach.spread_nm.low > 0.0
        self._bare_at_grazing = bare_at_grazing
        self._places: dict[tuple[Lobe, _Sight, int, bool], _Places] = {}
        self._series_errs: dict[Lobe, float] = {}

    def of_method(
        self, method: str, parameters: Mapping[str, ParameterValue], budget: float, *, floor: float = 0.0
    ) -> Measured:
        """Measure a method that computes each colour when it is wanted; `floor` is added to each error."""
        is_averaging = METHODS[method].glsl_spread_function is not None
        if METHODS[method].is_truth and self._sights == ("one direction",) and not self._has_spread:
            return Measured(floor, floor <= budget)

        def colours(lobe: Lobe, points: Points) -> Float64:
            film = points.film(self.reach.film_ior)
            return evaluate(method, film, white=self.white, parameters=parameters).rgb

        return self.of(colours, budget, floor=floor, is_averaging=is_averaging)

    def without_film(self, budget: float) -> Measured:
        """Measure what is left where the film is left out."""
        return self.of(None, budget)

    def of(
        self, colours: Colours | None, budget: float, *, floor: float = 0.0, is_averaging: bool = False
    ) -> Measured:
        """Measure any way to the film's colours; None is the surface without a film.

        is_averaging : it is of use for any spread of thickness; `colours` itself are those without one.
        """
        sights = self._sights
        if self._has_spread and not is_averaging:
            sights = (*sights, "spread")
        worst = Measured(0.0, True)
        for lobe in self.lobes:
            for sight in sights:
                found = self._measure(colours, lobe, sight, budget, floor)
                worst = Measured(max(worst.delta_e, found.delta_e), worst.holds and found.holds)
                if not worst.holds:
                    return worst
        return worst

    def _measure(
        self, colours: Colours | None, lobe: Lobe, sight: _Sight, budget: float, floor: float
    ) -> Measured:
        at_most = np.inf
        for count in LOOKS:
            places = self._at(lobe, sight, count, budget)
            found = places.bare if colours is None else self._on(places.bare, colours(lobe, places.points))
            above, below = bounds(delta_e_2000(found, places.truth))
            at_most = below + floor + places.doubt
            if at_most <= budget:
                return Measured(at_most, True)
            if above + floor > budget:
                break
        return Measured(at_most, False)

    def _at(self, lobe: Lobe, sight: _Sight, count: int, budget: float) -> _Places:
        is_series = self._series_err(lobe) <= _SERIES_SHARE * budget
        key = (lobe, sight, count, is_series)
        if key not in self._places:
            points = points_of(self.reach, lobe, count, from_all_around=sight == "all around")
            films = points.facet_films(self.reach.film_ior)
            bare = points.mean(self._bare(lobe, points, films.cos_theta_1))
            if sight == "spread":
                film = self._spread_truth(films)
            else:
                film = film_truth(films, self.white, is_exact=not is_series)
            truth = self._on(bare, points.mean(film))
            doubt = self._series_err(lobe) if is_series else 0.0
            self._places[key] = _Places(lobe, points, bare, truth, doubt)
        return self._places[key]

    def _spread_truth(self, films: Film) -> Float64:
        """Return the truth's mean over thicknesses, of deviations up to the usual one."""
        share = np.random.default_rng(_SEED).uniform(size=films.shape[0])
        spread_nm = share.reshape(-1, *[1] * (len(films.shape) - 1)) * self.reach.spread_nm.low
        return mean_film_truth(films, spread_nm, "E" if self.white == "E" else "D65")

    def _series_err(self, lobe: Lobe) -> float:
        if lobe not in self._series_errs:
            films = points_of(self.reach, lobe, _SERIES_POINTS).facet_films(self.reach.film_ior)
            by_series, truth = (film_truth(films, self.white, is_exact=each) for each in (False, True))
            self._series_errs[lobe] = float(delta_e_2000(by_series, truth).max())
        return self._series_errs[lobe]

    def _bare(self, lobe: Lobe, points: Points, cosine: Float64) -> Float64:
        """Return what the surface without a film reflects at the cosines (n, q): (n, q, 3)."""
        plain = f_schlick(points.base_f0[:, None], cosine[..., None])
        # base_f0 has the weight in it: weight · Schlick(F0) reaches the weight where Schlick(weight·F0) is 1.
        grazing = self._bare_at_grazing if lobe == "dielectric" else 1.0
        return np.asarray(plain - (1.0 - grazing) * f_schlick(0.0, cosine)[..., None])

    def _on(self, bare: Float64, film: Float64) -> Float64:
        strength = self.reach.factor.high
        return np.asarray((1.0 - strength) * bare + strength * film)
