"""Films that differ from row to row of an array: their colours by a way, and what a budget must hold for."""

from __future__ import annotations

import threading
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from gltf_iri.arrays.film_rows import CHANNELS
from gltf_iri.backends import choose_backend
from gltf_iri.baking.baked import BakedTable
from gltf_iri.baking.lookup import look_up
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Base, Film, base_from_f0
from gltf_iri.evaluation.material_film import under_film
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.material.material import Material
from gltf_iri.optics.ior import fresnel0_to_ior
from gltf_iri.planning.decide import plan_material
from gltf_iri.planning.method import ParameterValue, find_method
from gltf_iri.planning.reach import Lobe, Reach, Span
from gltf_iri.planning.way import Way

__all__ = ["AIR", "ArrayFilms", "FilmColours", "films_of_material", "lobe_of", "reach_of_films"]

Float64 = NDArray[np.float64]

AIR: Final = 1.0

_NONE: Final = Span.at(0.0)
_SAME_INDEX: Final = 1e-9  # what the way to F0 and back rounds


@dataclass(frozen=True, slots=True)
class ArrayFilms:
    """What the rows (n, k) of an array are films of: `columns` name theirs, the rest is the same in all.

    bases : the share that each lobe has of the colour, and the base under its film; one lobe with share 1
        for films that are no material's. Where columns give the base, this one is not read.
    """

    columns: tuple[str, ...]
    thickness_nm: float
    film_ior: float
    outside_ior: float
    bases: Mapping[Lobe, tuple[float, Base]]

    @property
    def has_base_columns(self) -> bool:
        """True where the base differs from row to row."""
        return "base_f0" in self.columns or "base_r" in self.columns

    def film(self, block: Float64, lobe: Lobe) -> Film:
        """Return the films of some rows (m, k) over the base of `lobe`; raises UsageError as `Film.of`."""
        given = dict(zip(self.columns, block.T, strict=True))
        base = base_from_f0(self.base_f0(block, lobe)) if self.has_base_columns else self.bases[lobe][1]
        return Film.of(
            given["cos"],
            given.get("thickness", self.thickness_nm),
            given.get("film_ior", self.film_ior),
            base,
            given.get("outside_ior", self.outside_ior),
        )

    def base_f0(self, block: Float64, lobe: Lobe) -> Float64:
        """Return the base's F0, (m, 3) where columns give it, else (3,)."""
        if "base_f0" in self.columns:
            return np.repeat(block[:, self.columns.index("base_f0")][:, None], 3, axis=1)
        if "base_r" in self.columns:
            return block[:, [self.columns.index(name) for name in CHANNELS]]
        return np.broadcast_to(self.bases[lobe][1].f0, (3,))


class FilmColours:
    """Maps rows (m, k) to colours (m, 3) out of `tables`, or where there are none by `method`; for threads.

    count : of all rows, by which "auto" chooses what calculates, the same for every block.
    undefined : after the calls, how many rows met each case that the method leaves undefined.
    """

    def __init__(
        self,
        films: ArrayFilms,
        count: int,
        method: str,
        *,
        tables: Mapping[Lobe, BakedTable],
        parameters: Mapping[str, ParameterValue],
        white: str,
        backend: str,
    ) -> None:
        self.films = films
        # Texels in half precision would be widened for every block anew.
        self.tables = {lobe: replace(t, texels=t.texels.astype(np.float32)) for lobe, t in tables.items()}
        self.undefined: Counter[str] = Counter()
        available = ("numpy", "numba") if tables else find_method(method, "film").backends
        self.backend = choose_backend(backend, count, available, "table" if tables else method)
        self.method = method
        self.parameters = parameters
        self._white = white
        self._lock = threading.Lock()

    @property
    def label(self) -> str:
        """What the map of costs calls the method."""
        return Way(self.method, self.parameters).label

    def __call__(self, block: Float64) -> Float64:
        """Return the colours (m, 3) of some rows (m, k)."""
        one = self._looked_up if self.tables else self._evaluated
        parts = [share * one(block, lobe) for lobe, (share, _) in self.films.bases.items()]
        return np.asarray(sum(parts[1:], start=parts[0]))

    def _looked_up(self, block: Float64, lobe: Lobe) -> Float64:
        films = self.films
        given = dict(zip(films.columns, block.T, strict=True))
        thickness_nm = given.get("thickness", films.thickness_nm)
        base_f0 = films.base_f0(block, lobe)
        return look_up(self.tables[lobe], given["cos"], thickness_nm, base_f0, backend=self.backend)

    def _evaluated(self, block: Float64, lobe: Lobe) -> Float64:
        film = self.films.film(block, lobe)
        done = evaluate(
            self.method, film, white=self._white, backend=self.backend, parameters=self.parameters
        )
        with self._lock:
            for case, mask in done.undefined.items():
                self.undefined[case] += int(np.count_nonzero(np.broadcast_to(mask, film.shape)))
        return np.broadcast_to(done.rgb, (len(block), 3))


def reach_of_films(films: ArrayFilms, spans: Mapping[str, Span]) -> Reach | None:
    """Return what a budget must hold for; `spans` are those of the columns (`column_spans`).

    None for films that tables do not know: of several indices, not under air, or over a base that is not
    given by its F0 or a real index of 1 or more.
    """
    if "film_ior" in films.columns or "outside_ior" in films.columns or films.outside_ior != AIR:
        return None
    if not films.has_base_columns and not all(_is_real(base) for _, base in films.bases.values()):
        return None
    is_grey = "base_f0" in films.columns
    colours = {lobe: _base_spans(films, spans, lobe) for lobe in films.bases}
    share = films.bases["metal"][0] if "metal" in films.bases else 0.0
    return Reach(
        film_ior=films.film_ior,
        factor=Span.at(1.0),
        thickness_nm=spans.get("thickness", Span.at(films.thickness_nm)),
        metallic=Span.at(share),
        roughness=_NONE,
        base_color=colours.get("metal", (_NONE, _NONE, _NONE)),
        dielectric_f0=colours.get("dielectric", (_NONE, _NONE, _NONE)),
        is_dielectric_grey=is_grey,
        is_metal_grey=is_grey,
    )


def _base_spans(films: ArrayFilms, spans: Mapping[str, Span], lobe: Lobe) -> tuple[Span, Span, Span]:
    if "base_f0" in films.columns:
        return (spans["base_f0"], spans["base_f0"], spans["base_f0"])
    if "base_r" in films.columns:
        return (spans["base_r"], spans["base_g"], spans["base_b"])
    r, g, b = (Span.at(float(f0)) for f0 in np.broadcast_to(films.bases[lobe][1].f0, (3,)))
    return (r, g, b)


def _is_real(base: Base) -> bool:
    """Return whether the F0 of `base` says all of its index."""
    return bool(np.allclose(base.index, fresnel0_to_ior(base.f0), rtol=_SAME_INDEX, atol=0.0))


def films_of_material(
    material: Material, index: int, columns: tuple[str, ...], thickness_nm: float | None = None
) -> ArrayFilms:
    """Return the films of a material without its textures, as `evaluate_material` has them.

    thickness_nm : where no column gives it; None for the maximum. Raises UsageError where there is no film.
    """
    plan = plan_material(material, index)
    if material.iridescence is None or plan.method is None:
        raise UsageError(f"Material '{plan.name or index}' has nothing to evaluate: {plan.method_reason}.")
    under = under_film(material, plan)
    metalness = material.pbr.metallic_factor
    bases: dict[Lobe, tuple[float, Base]] = {
        "dielectric": (1.0 - metalness, base_from_f0(under.weight * under.dielectric_f0)),
        "metal": (metalness, base_from_f0(under.metal_f0)),
    }
    return ArrayFilms(
        columns,
        material.iridescence.thickness_max_nm if thickness_nm is None else thickness_nm,
        material.iridescence.film_ior,
        AIR,
        {lobe: each for lobe, each in bases.items() if each[0] > 0.0},
    )


def lobe_of(columns: Sequence[str], base: Base) -> Lobe:
    """Return the lobe that films over `base` count as: a metal's where the channels differ."""
    is_grey = "base_r" not in columns and bool(np.all(base.f0 == base.f0[..., :1]))
    return "dielectric" if is_grey else "metal"
