"""A budget chooses the cheapest way that keeps it, and tells by what figures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.bench.budgets import BUDGETS, measure_budgets, random_reaches
from gltf_iri.budgets.candidates import Candidate, direct_candidates
from gltf_iri.budgets.choose import Asked, choose_way
from gltf_iri.budgets.errors import FilmErrors, Measured
from gltf_iri.budgets.search import TableOffer, cheapest_way, figure
from gltf_iri.errors import UsageError
from gltf_iri.planning.costs import shipped_costs
from gltf_iri.planning.reach import Reach, Span
from gltf_iri.planning.way import Way
from gltf_iri.tolerances import MIXED_LOBES_DELTA_E

POINT = Span.at
PLAIN = Reach(
    film_ior=1.4,
    factor=POINT(1.0),
    thickness_nm=POINT(400.0),
    metallic=POINT(0.0),
    roughness=POINT(0.3),
    base_color=(POINT(0.9), POINT(0.6), POINT(0.3)),
    dielectric_f0=(POINT(0.06),) * 3,
    is_dielectric_grey=True,
)
DIRECT = Asked(0.3, 1e6, "glsl", has_tables=False)


def chosen(reach: Reach, budget: float, **asked: object) -> Way:
    return choose_way(reach, replace(DIRECT, budget=budget, **asked), "this one").way  # type: ignore[arg-type]


@pytest.mark.parametrize("device", ["glsl", "numpy", "numba"])
def test_a_budget_of_zero_is_the_truth(device: str) -> None:
    way = chosen(PLAIN, 0.0, device=device)
    assert (way.method, way.tables, way.delta_e) == ("spectral", (), 0.0)


@pytest.mark.parametrize("budget", [-1.0, -1e-300, np.nan, np.inf])
def test_what_is_no_color_difference_is_refused(budget: float) -> None:
    with pytest.raises(UsageError, match="0 asks for the truth"):
        chosen(PLAIN, budget)


@pytest.mark.parametrize("metallic", [0.0, 1.0])
def test_smaller_budgets_never_choose_a_larger_error(metallic: float) -> None:
    reach = replace(PLAIN, metallic=POINT(metallic))
    errors = [chosen(reach, budget).delta_e for budget in (30.0, 10.0, *BUDGETS)]
    assert errors == sorted(errors, reverse=True)
    assert all(error <= budget for error, budget in zip(errors, (30.0, 10.0, *BUDGETS), strict=True))


def test_a_budget_that_nothing_keeps_names_the_best_that_does() -> None:
    with pytest.raises(UsageError, match=r"ΔE 1e-05 for this one: the best is .* ΔE ≤ 0\.0001") as told:
        chosen(PLAIN, 1e-5)
    best = float(str(told.value).split("Ask for ")[1].split(" or more")[0])
    assert chosen(PLAIN, best).delta_e <= best


def test_the_best_is_a_table_where_no_method_comes_so_near() -> None:
    series = Candidate("fourier", {"tolerance": 1e-4}, 100.0)

    def fit(budget: float) -> Way | None:
        # A table errs less than what it is asked for, and none keeps less than 0.5.
        return Way("spectral", {}, (), 5.0, 1e6, 0.8 * budget) if budget >= 0.5 else None

    def way(budget: float) -> Way:
        tables = TableOffer(5.0, fit)
        return cheapest_way(
            [series], lambda *_: Measured(11.0, False), budget, 1e6, subject="it", tables=tables
        ).way

    with pytest.raises(UsageError, match="ΔE 1e-09 for it: the best is spectral") as told:
        way(1e-9)
    least = float(str(told.value).split("Ask for ")[1].split(" or more")[0])
    assert way(least).delta_e <= least < 0.7


def test_figures_are_those_of_the_map() -> None:
    way = chosen(PLAIN, 0.3)
    assert way.ns_per_colour == shipped_costs().ns_of("glsl", "films", way.label)
    metal = chosen(replace(PLAIN, metallic=POINT(1.0)), 0.3)
    assert metal.ns_per_colour == shipped_costs().ns_of("glsl", "metals", metal.label)
    both = chosen(replace(PLAIN, metallic=Span(0.0, 1.0)), 0.3)
    costs = [shipped_costs().ns_of("glsl", each, both.label) for each in ("films", "metals")]
    assert both.ns_per_colour == sum(costs)


def test_a_table_is_chosen_where_its_filling_pays() -> None:
    asked = replace(DIRECT, budget=0.3, has_tables=True)
    many = choose_way(PLAIN, asked, "it").way
    assert many.tables
    assert many.delta_e <= 0.3
    assert many.ns_per_colour == shipped_costs().ns_of("glsl", "films", "table of 1 axes")
    few = choose_way(PLAIN, replace(asked, colours=10.0), "it").way
    assert not few.tables
    assert few.ns_per_colour * 10.0 < many.ns_per_colour * 10.0 + many.filling_ns


def test_what_colours_nothing_is_left_out() -> None:
    thin = replace(PLAIN, thickness_nm=POINT(0.2))
    # What is left is Schlick's Fresnel, which errs by itself.
    found = choose_way(thin, replace(DIRECT, budget=4.0), "it")
    assert found.way.method is None
    assert found.reason.startswith("too thin to colour: without it ΔE ≤ ")
    weak = choose_way(replace(PLAIN, factor=POINT(0.01)), replace(DIRECT, budget=3.0), "it")
    assert weak.way.method is None
    assert "too weak" in weak.reason
    assert chosen(thin, 4.0, is_film_needed=True).method is not None
    assert chosen(thin, 4.0, bare_at_grazing=None).method is not None


def test_fringes_that_have_faded_leave_the_constant_term() -> None:
    found = choose_way(replace(PLAIN, thickness_nm=POINT(40_000.0)), replace(DIRECT, budget=0.5), "it")
    if "incoherent" in {each.method for each in direct_candidates("film", "glsl", ["thick"])}:
        assert found.way.method == "incoherent"
        assert "constant term" in found.reason


def test_the_film_counts_by_its_strength() -> None:
    errors = [
        FilmErrors(replace(PLAIN, factor=POINT(factor)), has_image_light=False).of_method("khr", {}, 1e9)
        for factor in (0.1, 0.5, 1.0)
    ]
    assert errors[0].delta_e < errors[1].delta_e < errors[2].delta_e


def test_image_light_asks_more_of_rough_surfaces() -> None:
    smooth, rough = (replace(PLAIN, roughness=POINT(r)) for r in (0.0, 0.6))
    series = ("fourier", {"tolerance": 1e-4}, 1e9)
    found = [FilmErrors(each, has_image_light=True).of_method(*series).delta_e for each in (smooth, rough)]
    assert found[0] < 0.1 < 1.0 < found[1]


def test_reasons_tell_the_figures() -> None:
    found = choose_way(PLAIN, DIRECT, "it")
    assert f" for {figure(found.way.ns_per_colour)} ns a colour" in found.reason
    assert "within ΔE 0.3: ΔE ≤ 0." in found.reason


def test_budgets_of_random_materials_hold_and_are_cheap() -> None:
    rows = list(measure_budgets(list(random_reaches(7)), (1.0, 0.1)))
    assert len(rows) == 14
    assert all(row.holds for row in rows)
    assert np.mean([row.is_cheapest for row in rows]) >= 0.9


def test_where_lobes_mix_the_larger_error_counts_more() -> None:
    alone = replace(PLAIN, metallic=POINT(1.0))
    both = replace(PLAIN, metallic=Span(0.0, 1.0))
    errors = FilmErrors(both, has_image_light=False).of_method("fourier", {"tolerance": 0.03}, np.inf)
    assert errors.delta_e > 0.0
    found = chosen(both, 3.0)
    measured = FilmErrors(both, has_image_light=False).of_method(str(found.method), found.parameters, np.inf)
    assert found.delta_e >= MIXED_LOBES_DELTA_E * measured.delta_e
    assert chosen(alone, 3.0).ns_per_colour < found.ns_per_colour
