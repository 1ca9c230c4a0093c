"""The film or the layers of one material at many points, by any method, and what it left undefined."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gltf_iri.evaluation.film import Evaluation, Film, base_from_f0
from gltf_iri.planning.reach import Lobe
from gltf_iri.reference.layers_on import LayersMethod
from gltf_iri.reference.surface import Surface

__all__ = ["Facets", "FilmMethod", "FilmOn", "Sight", "in_one_direction"]

Float64 = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True)
class Facets:
    """What of a rough surface sends image light to the viewer, at n points.

    roughness : (n,) perceptual.
    mean_cosine : (n,) the mean of V·H over the facets, as the renderer has it.
    """

    roughness: Float64
    mean_cosine: Float64

    def take(self, rows: Mask) -> Facets:
        """Return those at `rows`."""
        return Facets(self.roughness[rows], self.mean_cosine[rows])


@dataclass(frozen=True, slots=True)
class Sight:
    """How n points of a film are seen, beside what `Film` says.

    lobe : which base lies under the film.
    thickness_std_nm : (n,) how far the thickness spreads within what a point stands for.
    facets : those that send image light, the film's cosine being N·V; None for light from one direction.
    """

    lobe: Lobe
    thickness_std_nm: Float64
    facets: Facets | None = None


FilmMethod = Callable[[Film, Sight], Evaluation]


def in_one_direction(method: Callable[[Film], Evaluation]) -> FilmMethod:
    """Return `method` of films in one direction, whose thickness does not spread, as a `FilmMethod`."""
    return lambda film, sight: method(film)


@dataclass(slots=True)
class FilmOn:
    """The film on the n points of `surface`; its outside is air, also under a clearcoat.

    film_ior : not read where the surface has no film (iridescence factor 0).
    method : maps a `Film` and how it is seen to its reflectance colours.
    layers : the colours of the Bragg layers; None where the plan has none.
    white : the method's own; "" until a film was evaluated.
    undefined : for each undefined case of the method's text that occurred, the points (n,) it touched.
    """

    surface: Surface
    film_ior: float
    method: FilmMethod
    layers: LayersMethod | None = None
    white: str = ""
    undefined: dict[str, Mask] = field(default_factory=dict)

    def at(self, surface: Surface) -> FilmOn:
        """Return the same on other points."""
        return FilmOn(surface, self.film_ior, self.method, self.layers)

    @property
    def has_film(self) -> Mask:
        """Where (n,) there is a film."""
        return np.asarray(self.surface.iridescence_factor > 0.0)

    def __call__(
        self, lobe: Lobe, base_f0: Float64, cos_theta: Float64, needed: Mask, facets: Facets | None = None
    ) -> Float64:
        """Return the film's reflectance (n, 3) over `base_f0`; 0 where there is no film or none is needed.

        facets : those that send image light; `cos_theta` is then N·V.
        """
        rgb = np.zeros_like(base_f0)
        rows = self.has_film & needed
        if not rows.any():
            return rgb
        thickness_nm = self.surface.iridescence_thickness_nm[rows]
        film = Film.of(cos_theta[rows], thickness_nm, self.film_ior, base_from_f0(base_f0[rows]))
        sight = Sight(
            lobe,
            self.surface.iridescence_thickness_std_nm[rows],
            None if facets is None else facets.take(rows),
        )
        evaluation = self.method(film, sight)
        rgb[rows] = evaluation.rgb
        self.white = evaluation.white
        for case, touched in evaluation.undefined.items():
            mask = self.undefined.setdefault(case, np.zeros(rows.shape, dtype=np.bool_))
            mask[rows] |= np.broadcast_to(touched, film.shape)
        return rgb
