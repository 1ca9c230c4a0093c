"""Workload `image-light`: what rough films make of a white sky, as renderers have it and by tables.

The truth is the film's mean over the facets that the viewer sees, ∫F(V·H)·w. Facets are taken from Heitz
2018, "Sampling the GGX Distribution of Visible Normals" (JCGT 7.4), which `gltf_iri.optics` does not use; a
facet that the viewer sees then counts G₂/G₁ = (1 + Λ_V)/(1 + Λ_V + Λ_L), Heitz 2014, Eq. 43 and 99.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from functools import cache, partial
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.fill import bake
from gltf_iri.baking.lookup import look_up
from gltf_iri.baking.resolution import fit_table
from gltf_iri.bench.colour_rows import WHITE
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.microfacet import alpha_ggx
from gltf_iri.planning.reach import Lobe, Reach, Span

__all__ = ["FILMS", "ROUGHNESSES", "ImageLightRow", "SkyFilm", "facets_seen", "measure_image_light"]

Float64 = NDArray[np.float64]

ROUGHNESSES: Final = tuple(round(0.1 * k, 1) for k in range(1, 10))
BUDGET: Final = 0.5  # of the tables
ANGLES: Final = 32
_SIDE: Final = 192  # lines of facets, and facets along each
_HALVINGS: Final = 50
_NODES: Final = 2049  # of F along V·H, between which it is interpolated: 1e-5 for 1200 nm


@dataclass(frozen=True, slots=True)
class SkyFilm:
    """A film over a base of F0 `base_f0`, (R, G, B)."""

    name: str
    lobe: Lobe
    film_ior: float
    thickness_nm: float
    base_f0: tuple[float, float, float]

    def colours(self, cosine: Float64) -> Float64:
        """Return its true colours (m, 3) at the cosines (m,)."""
        film = Film.of(cosine, self.thickness_nm, self.film_ior, base_from_f0(self.base_f0))
        return evaluate("spectral", film, white=WHITE).rgb


_GLASS: Final = (0.04, 0.04, 0.04)
_GOLD: Final = (1.0, 0.766, 0.336)  # as glTF's own examples have it
FILMS: Final = (
    SkyFilm("on glass, 300 nm", "dielectric", 1.33, 300.0, _GLASS),
    SkyFilm("on glass, 1200 nm", "dielectric", 1.8, 1200.0, _GLASS),
    SkyFilm("on gold, 300 nm", "metal", 1.7, 300.0, _GOLD),
    SkyFilm("on gold, 1200 nm", "metal", 1.7, 1200.0, _GOLD),
)


@dataclass(frozen=True, slots=True)
class ImageLightRow:
    """One way on one film at one roughness; ΔE is CIEDE2000 of what a white sky becomes, over N·V uniform.

    convergence : by how much the truth moves with two thirds of the lines, the most of any channel.
    """

    workload: str
    film: str
    roughness: float
    way: str
    max_abs: float
    delta_e_mean: float
    delta_e_p95: float
    convergence: float

    def to_json(self) -> dict[str, Any]:
        """Return the row of `bench --json`."""
        return {**asdict(self), "method": self.way, "backend": "numpy", "ns_per_eval": None}


def measure_image_light(
    films: Sequence[SkyFilm] = FILMS,
    roughnesses: Sequence[float] = ROUGHNESSES,
    angles: int = ANGLES,
    side: int = _SIDE,
    advance: Callable[[], None] = lambda: None,
) -> list[ImageLightRow]:
    """Return for each film and roughness a row of each way; advances once a roughness."""
    n_dot_v = (np.arange(angles) + 0.5) / angles
    nodes = np.linspace(0.0, 1.0, _NODES)
    colours = {film.name: film.colours(nodes) for film in films}
    rows: list[ImageLightRow] = []
    tabled = {film.name: _by_table(film, roughnesses) for film in films}
    for roughness in roughnesses:
        weights = np.stack([_along_nodes(each, roughness, side) for each in n_dot_v])
        coarse = np.stack([_along_nodes(each, roughness, 2 * side // 3) for each in n_dot_v])
        mean_cosine = (weights @ nodes) / weights.sum(axis=1)
        for film in films:
            truth = weights @ colours[film.name]
            moved = float(np.abs(coarse @ colours[film.name] - truth).max())
            for way, rgb in _ways(film, n_dot_v, roughness, mean_cosine, tabled[film.name]):
                delta_e = delta_e_2000(rgb, truth)
                rows.append(
                    ImageLightRow(
                        "image-light",
                        film.name,
                        roughness,
                        way,
                        float(np.abs(rgb - truth).max()),
                        float(delta_e.mean()),
                        float(np.percentile(delta_e, 95)),
                        moved,
                    )
                )
        advance()
    return rows


def facets_seen(n_dot_v: float, alpha: float, side: int) -> tuple[Float64, Float64]:
    """Return V·H and the weight, (side²,) each, of facets seen at N·V; the weights add up to A + B.

    Heitz's disc is crossed by lines of constant a, across = sin a, and along = cos a sin b runs on each: no
    edge remains but that of facets whose mirror direction lies below the surface; there each line begins.
    """
    view = _View(n_dot_v, alpha)
    nodes, weights = _gauss(side)
    # One half mirrors the other in the plane of N and V.
    a = 0.25 * np.pi * (nodes[:, None] + 1.0)
    low, high = np.full_like(a, -0.5 * np.pi), np.full_like(a, 0.5 * np.pi)
    is_cut = view.cosines(a, low)[1] <= 0.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        is_below = view.cosines(a, middle)[1] <= 0.0
        low, high = np.where(is_below, middle, low), np.where(is_below, high, middle)
    first = np.where(is_cut, high, -0.5 * np.pi)
    width = 0.5 * np.pi - first
    b = first + 0.5 * width * (nodes + 1.0)
    area = 0.25 * width * weights * weights[:, None] * np.cos(a) ** 2 * np.cos(b)
    v_dot_h, n_dot_l = view.cosines(a, b)
    masked = _lambda(np.array(n_dot_v), alpha)
    sent = (1.0 + masked) / (1.0 + masked + _lambda(np.maximum(n_dot_l, 1e-12), alpha))
    return v_dot_h.ravel(), (sent * area).ravel()


class _View:
    """V, and what it is in the space where facets lie on a hemisphere."""

    def __init__(self, n_dot_v: float, alpha: float) -> None:
        self._cosine, self._sine, self._alpha = n_dot_v, np.sqrt(1.0 - n_dot_v * n_dot_v), alpha
        length = np.hypot(alpha * self._sine, n_dot_v)
        self._x, self._z = alpha * self._sine / length, n_dot_v / length

    def cosines(self, a: Float64, b: Float64) -> tuple[Float64, Float64]:
        """Return V·H and N·L of the facets at a and b."""
        share = 0.5 * (1.0 + self._z)
        squeezed = (1.0 - share) + share * np.sin(b)
        along = np.cos(a) * squeezed
        up = np.cos(a) * np.sqrt(np.maximum(share * (1.0 - np.sin(b)) * (1.0 + squeezed), 0.0))
        # The disc's second axis is V × y = (−z, 0, x).
        x, y = up * self._x - along * self._z, np.sin(a) + 0.0 * b
        h = np.stack([self._alpha * x, self._alpha * y, np.maximum(up * self._z + along * self._x, 0.0)])
        h /= np.linalg.norm(h, axis=0)
        v_dot_h = h[0] * self._sine + h[2] * self._cosine
        return v_dot_h, 2.0 * v_dot_h * h[2] - self._cosine


@cache
def _gauss(count: int) -> tuple[Float64, Float64]:
    return np.polynomial.legendre.leggauss(count)


def _lambda(cosine: Float64, alpha: float) -> Float64:
    """Λ = (√(1 + α² tan²θ) − 1)/2, Heitz 2014, Eq. 72."""
    tangent_squared = np.maximum(1.0 - cosine * cosine, 0.0) / (cosine * cosine)
    return np.asarray(0.5 * (np.sqrt(1.0 + alpha * alpha * tangent_squared) - 1.0))


def _along_nodes(n_dot_v: float, roughness: float, side: int) -> Float64:
    """Return the facets' weights (_NODES,) laid on the nodes of V·H, each between its two neighbours."""
    cosine, weight = facets_seen(n_dot_v, float(alpha_ggx(roughness)), side)
    place = np.clip(cosine, 0.0, 1.0) * (_NODES - 1)
    cell = np.minimum(place.astype(np.intp), _NODES - 2)
    t = place - cell
    laid = np.bincount(cell, weight * (1.0 - t), _NODES)
    return np.asarray(laid + np.bincount(cell + 1, weight * t, _NODES))


def _ways(
    film: SkyFilm,
    n_dot_v: Float64,
    roughness: float,
    mean_cosine: Float64,
    tabled: Callable[[Float64, float], Float64],
) -> Iterator[tuple[str, Float64]]:
    """Yield what each way makes of the white sky, (m, 3)."""
    a, b = (each[:, None] for each in dfg_terms(n_dot_v, roughness))
    straight = film.colours(n_dot_v)
    yield "F(N·V) as F0: F·A + B", straight * a + b
    yield "F(N·V)·(A + B)", straight * (a + b)
    yield "F(mean V·H)·(A + B)", film.colours(mean_cosine) * (a + b)
    yield f"table for ΔE {BUDGET:g}", tabled(n_dot_v, roughness) * (a + b)


def _by_table(film: SkyFilm, roughnesses: Sequence[float]) -> Callable[[Float64, float], Float64]:
    """Return the mean of the film over facets out of its table, at N·V (m,) and a roughness."""
    spans = tuple(Span.at(f0) for f0 in film.base_f0)
    none = Span.at(0.0)
    reach = Reach(
        film_ior=film.film_ior,
        factor=Span.at(1.0),
        thickness_nm=Span.at(film.thickness_nm),
        metallic=Span.at(1.0 if film.lobe == "metal" else 0.0),
        roughness=Span(min(roughnesses), max(roughnesses)),
        base_color=(spans[0], spans[1], spans[2]) if film.lobe == "metal" else (none, none, none),
        dielectric_f0=(spans[0], spans[1], spans[2]) if film.lobe == "dielectric" else (none, none, none),
    )
    table = fit_table(reach, film.lobe, BUDGET, white=WHITE, has_image_light=True, has_spread=False)
    if table is None:
        raise UsageError(f"No table of the film {film.name} keeps ΔE {BUDGET:g}.")
    return partial(_looked_up, bake(table, WHITE), film)


def _looked_up(baked: BakedTable, film: SkyFilm, n_dot_v: Float64, roughness: float) -> Float64:
    return look_up(baked, n_dot_v, film.thickness_nm, film.base_f0, roughness=roughness, backend="numpy")
