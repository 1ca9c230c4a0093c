"""The cheapest way to the colour of a material's film whose measured error keeps a budget."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Final

from gltf_iri.backends import choose_backend
from gltf_iri.budgets.candidates import (
    Candidate,
    direct_candidates,
    reach_workload,
    resolves_in_glsl,
    table_ns,
    without_film,
)
from gltf_iri.budgets.errors import FilmErrors, Measured
from gltf_iri.budgets.search import Chosen, TableOffer, cheapest_way, check_budget, figure, the_truth
from gltf_iri.colour.spaces import WHITES, Light
from gltf_iri.planning.costs import Device
from gltf_iri.planning.film_table import FilmTable, TableAxis
from gltf_iri.planning.method import METHODS, truth_of
from gltf_iri.planning.reach import Lobe, Reach, Span
from gltf_iri.planning.way import Way
from gltf_iri.tolerances import GLSL_FILM_DELTA_E, MIXED_LOBES_DELTA_E

__all__ = ["Asked", "choose_way", "way_for_films"]

# Thinner than a fifth of the shortest wave that is seen, a film has no fringes yet.
_NO_FRINGES_OPD_NM: Final = 80.0
_WEAK_FACTOR: Final = 0.2


@dataclass(frozen=True, slots=True)
class Asked:
    """What the film of one material is wanted for.

    colours : how often the material's colour is wanted.
    bare_at_grazing : what its dielectric without the film reflects at grazing angles, its specular weight;
        None where that differs from place to place.
    is_film_needed : the film's own colour is wanted, so that it is never left out.
    has_tables : whether tables are an answer.
    has_spread : the thickness is averaged within a pixel, by tables and methods that can; others err by it.
    """

    budget: float
    colours: float
    device: Device
    white: str | Light = "D65"
    has_image_light: bool = False
    bare_at_grazing: float | None = 1.0
    is_film_needed: bool = False
    has_tables: bool = True
    has_spread: bool = False


def choose_way(reach: Reach, asked: Asked, subject: str, errors: FilmErrors | None = None) -> Chosen:
    """Return the cheapest way to the colour of a material's film, and why.

    errors : of the same reach, light and white, where it is asked several times.

    Raises UsageError for a budget below 0 or NaN, and where nothing keeps it for `subject`.
    """
    budget = check_budget(asked.budget)
    errors = errors or FilmErrors(
        reach,
        white=asked.white,
        has_image_light=asked.has_image_light,
        bare_at_grazing=1.0 if asked.bare_at_grazing is None else asked.bare_at_grazing,
        has_spread=asked.has_spread,
    )
    workloads = [reach_workload(reach, lobe) for lobe in errors.lobes]
    candidates = direct_candidates("film", asked.device, workloads, has_spread=asked.has_spread)
    if budget == 0.0:
        found = the_truth(candidates)
        if asked.device == "glsl" and asked.has_image_light and reach.roughness.high > 0.0:
            return replace(found, reason=f"{found.reason}; rough surfaces meet image light at a mean cosine")
        return found
    if asked.device == "glsl" and not resolves_in_glsl(reach):
        candidates = tuple(each for each in candidates if not METHODS[each.method or ""].is_truth)
    if asked.bare_at_grazing is not None and not asked.is_film_needed:
        candidates = (without_film(asked.device, workloads), *candidates)
    floor = GLSL_FILM_DELTA_E if asked.device == "glsl" else 0.0
    mixed = MIXED_LOBES_DELTA_E if len(errors.lobes) > 1 else 1.0

    def measure(candidate: Candidate, allowed: float) -> Measured:
        if candidate.method is None:
            found = errors.without_film(allowed / mixed)
        else:
            found = errors.of_method(candidate.method, candidate.parameters, allowed / mixed, floor=floor)
        return Measured(mixed * found.delta_e, found.holds)

    tables = _tables(errors, asked, floor) if asked.has_tables and asked.white in WHITES else None
    chosen = cheapest_way(candidates, measure, budget, asked.colours, subject=subject, tables=tables)
    if chosen.way.method is None:
        return Chosen(chosen.way, _without_film(reach, chosen.way))
    if chosen.way.method == "incoherent":
        return Chosen(chosen.way, f"beyond coherence, only the constant term stays; {chosen.reason}")
    return chosen


def way_for_films(reach: Reach, budget: float, *, count: int, white: str | Light = "D65") -> Way:
    """Return the cheapest way for the colours of `count` films within `reach`, in Python.

    Raises UsageError as `choose_way`.
    """
    device = choose_backend("auto", count, ("numpy", "numba"), "table")
    asked = Asked(budget, count, device, white, is_film_needed=True)
    return choose_way(reach, asked, "these films").way


def _tables(errors: FilmErrors, asked: Asked, floor: float) -> TableOffer:
    """Return the tables of all lobes as one way."""
    reach = errors.reach

    def fit(budget: float) -> Way | None:
        from gltf_iri.baking.fill import filling_ns
        from gltf_iri.baking.resolution import fit_table

        if budget <= floor:
            return None
        tables = []
        for lobe in errors.lobes:
            table = fit_table(
                reach,
                lobe,
                budget - floor,
                white="D65" if asked.white == "D65" else "E",
                has_image_light=asked.has_image_light,
                has_spread=asked.has_spread,
                bare_at_grazing=1.0 if asked.bare_at_grazing is None else asked.bare_at_grazing,
            )
            if table is None:
                return None
            tables.append(table)
        return Way(
            truth_of("film"),
            {},
            tuple(tables),
            sum(table_ns(asked.device, table) for table in tables),
            sum(filling_ns(table) for table in tables),
            max(table.delta_e for table in tables) + floor,
        )

    return TableOffer(sum(_least_table_ns(reach, lobe, asked) for lobe in errors.lobes), fit)


def _least_table_ns(reach: Reach, lobe: Lobe, asked: Asked) -> float:
    """Return what a colour costs out of a table with the axes that it cannot do without."""
    axes = [TableAxis("cos_theta", Span(0.0, 1.0), 2)]
    if not reach.thickness_nm.is_point:
        axes.append(TableAxis("thickness_nm", reach.thickness_nm, 2))
    if not all(span.is_point for span in reach.base(lobe)):
        axes.append(TableAxis("base_f0", Span(0.0, 1.0), 2))
    if asked.has_image_light:
        axes.append(TableAxis("roughness", reach.roughness, 2))
    return table_ns(asked.device, FilmTable(lobe, reach.film_ior, 0.0, (0.0,) * 3, tuple(axes), "f2", 0.0))


def _without_film(reach: Reach, way: Way) -> str:
    """Return why the film is left out."""
    if 2.0 * reach.film_ior * reach.thickness_nm.high < _NO_FRINGES_OPD_NM:
        why = "too thin to colour"
    elif reach.factor.high < _WEAK_FACTOR:
        why = "too weak to be seen"
    else:
        why = "of too little contrast to be seen"
    return f"{why}: without it ΔE ≤ {figure(way.delta_e)}"
