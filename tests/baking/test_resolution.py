"""Tables that are fitted to a budget keep it where they are read, and are no larger for nothing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.baking.fill import bake
from gltf_iri.baking.lookup import look_up
from gltf_iri.baking.resolution import BYTES_MAX, fit_table
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.prefiltered import prefiltered_fourier
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.facet_mean import facet_cosines, facet_mean, mean_cosine
from gltf_iri.planning.film_table import FilmTable
from gltf_iri.planning.reach import Lobe, Reach, Span

ONE = Span.at(1.0)
GREY = (Span.at(0.4), Span.at(0.4), Span.at(0.4))
GLASS = (Span.at(0.04), Span.at(0.04), Span.at(0.04))

SUZANNE = Reach(1.33, ONE, Span.at(400.0), ONE, Span.at(0.1), GREY, GLASS, True, True)
VARYING = replace(SUZANNE, film_ior=1.8, thickness_nm=Span(200.0, 600.0))
COPPER = (Span.at(0.95), Span.at(0.64), Span.at(0.54))


def fitted(
    reach: Reach, lobe: Lobe, budget: float, *, image: bool = False, spread: bool = False
) -> FilmTable:
    table = fit_table(reach, lobe, budget, has_image_light=image, has_spread=spread)
    assert table is not None
    assert 0.0 < table.delta_e <= budget
    assert table.bytes <= BYTES_MAX
    return table


def drawn(reach: Reach, lobe: Lobe, count: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Places that the fit has not seen."""
    g = np.random.default_rng(77)
    spans = reach.base_color if lobe == "metal" else reach.dielectric_f0
    low, high = (np.array([getattr(span, end) for span in spans]) for end in ("low", "high"))
    nm = reach.thickness_nm
    thickness_nm = nm.low + (nm.high - nm.low) * g.uniform(size=count)
    return g.uniform(size=count), thickness_nm, low + (high - low) * g.uniform(size=(count, 3))


CASES = {
    "constant film on a dielectric": (SUZANNE, "dielectric", ["cos_theta"]),
    "constant film on a coloured metal": (replace(SUZANNE, base_color=COPPER), "metal", ["cos_theta"]),
    "varying film": (VARYING, "dielectric", ["cos_theta", "thickness_nm"]),
    "constant film on a painted metal": (
        replace(SUZANNE, base_color=(Span(0.2, 0.9), Span(0.1, 0.5), Span.at(0.3)), is_metal_grey=False),
        "metal",
        ["cos_theta", "base_f0"],
    ),
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("budget", [2.0, 0.1])
def test_a_fitted_table_keeps_its_budget_where_it_is_read(case: str, budget: float) -> None:
    reach, lobe, quantities = CASES[case]
    table = fitted(reach, lobe, budget)
    assert [axis.quantity for axis in table.axes] == quantities
    cosine, thickness_nm, base_f0 = drawn(reach, lobe, 500)
    found = look_up(bake(table), cosine, thickness_nm, base_f0)
    truth = evaluate("spectral", Film.of(cosine, thickness_nm, reach.film_ior, base_from_f0(base_f0))).rgb
    assert np.quantile(delta_e_2000(found, truth), 0.95) <= budget


def test_smaller_budgets_want_larger_tables_and_finer_texels() -> None:
    tables = [fitted(SUZANNE, "dielectric", budget) for budget in (3.0, 0.5, 0.05, 0.005)]
    sizes = [table.bytes for table in tables]
    assert sizes == sorted(set(sizes))
    assert tables[0].texel == "f2"
    assert tables[-1].texel == "f4"


def test_half_of_the_nodes_would_not_do() -> None:
    table = fitted(SUZANNE, "dielectric", 0.5)
    axis = table.axes[0]
    half = replace(table, axes=(replace(axis, nodes=1 + axis.nodes // 2),))
    cosine, thickness_nm, base_f0 = drawn(SUZANNE, "dielectric", 500)
    truth = evaluate("spectral", Film.of(cosine, thickness_nm, 1.33, base_from_f0(base_f0))).rgb
    found = look_up(bake(half), cosine, thickness_nm, base_f0)
    assert np.quantile(delta_e_2000(found, truth), 0.95) > 0.5


def test_a_film_that_shows_less_wants_less() -> None:
    faint = replace(SUZANNE, factor=Span(0.0, 0.1))
    assert fitted(faint, "dielectric", 0.1).bytes < fitted(SUZANNE, "dielectric", 0.1).bytes


def test_roughness_has_an_axis_where_image_light_shows_it() -> None:
    rough = replace(SUZANNE, roughness=Span(0.2, 0.6))
    assert fitted(rough, "dielectric", 0.3).axis("roughness") is None
    table = fitted(rough, "dielectric", 0.3, image=True)
    axis = table.axis("roughness")
    assert axis is not None
    assert (axis.span.low, axis.span.high) == (0.0, 0.6)
    cosine, _, base_f0 = drawn(rough, "dielectric", 100)
    roughness = np.random.default_rng(8).uniform(0.2, 0.6, 100)
    cosines, weights = facet_cosines(np.maximum(cosine, 1e-4), roughness**2, slopes=24, turns=8)
    films = Film.of(cosines, 400.0, 1.33, base_from_f0(base_f0[:, None]))
    truth = facet_mean(evaluate("fourier", films, parameters={"tolerance": 1e-6}).rgb, weights)
    found = look_up(bake(table), cosine, 400.0, base_f0, roughness=roughness)
    assert np.quantile(delta_e_2000(found, truth), 0.95) <= 0.3


def test_nearly_smooth_facets_want_no_axis_and_keep_the_budget_at_their_mean_cosine() -> None:
    smooth = replace(SUZANNE, roughness=Span.at(0.05))
    table = fitted(smooth, "dielectric", 3.0, image=True)
    assert [axis.quantity for axis in table.axes] == ["cos_theta"]
    cosine, _, base_f0 = drawn(smooth, "dielectric", 200)
    cosines, weights = facet_cosines(np.maximum(cosine, 1e-4), 0.05**2)
    films = Film.of(cosines, 400.0, 1.33, base_from_f0(base_f0[:, None]))
    truth = facet_mean(evaluate("fourier", films, parameters={"tolerance": 1e-6}).rgb, weights)
    found = look_up(bake(table), mean_cosine(cosine, 0.05), 400.0, base_f0)
    assert np.quantile(delta_e_2000(found, truth), 0.95) <= 3.0


def test_a_spread_has_an_axis_where_it_shows() -> None:
    table = fitted(replace(VARYING, spread_nm=Span(100.0, 200.0)), "dielectric", 2.0, spread=True)
    axis = table.axis("spread_nm")
    assert axis is not None
    assert axis.span == Span(0.0, 200.0)
    cosine, thickness_nm, base_f0 = drawn(VARYING, "dielectric", 200)
    spread_nm = np.random.default_rng(9).uniform(0.0, 200.0, 200)
    film = Film.of(cosine, thickness_nm, 1.8, base_from_f0(base_f0))
    truth = prefiltered_fourier(film, spread_nm, "D65", 1e-6)
    found = look_up(bake(table), cosine, thickness_nm, base_f0, spread_nm=spread_nm)
    assert np.quantile(delta_e_2000(found, truth), 0.95) <= 2.0
    narrow = replace(VARYING, thickness_nm=Span(400.0, 402.0), spread_nm=Span(0.5, 1.0))
    assert fitted(narrow, "dielectric", 2.0, spread=True).axis("spread_nm") is None


def test_what_no_table_holds_has_none() -> None:
    painted = (Span(0.0, 1.0), Span(0.0, 1.0), Span(0.0, 1.0))
    wild = replace(SUZANNE, thickness_nm=Span(0.0, 3000.0), base_color=painted, is_metal_grey=False)
    assert fit_table(wild, "metal", 1e-3, has_image_light=False, has_spread=False) is None


@pytest.mark.parametrize("budget", [0.0, -1.0, np.nan])
def test_a_table_has_a_budget(budget: float) -> None:
    with pytest.raises(UsageError, match="greater than 0"):
        fit_table(SUZANNE, "dielectric", budget, has_image_light=False, has_spread=False)


@pytest.mark.parametrize("weight", [1.0, 0.2])
def test_a_weak_film_is_judged_with_what_the_bare_surface_sends(weight: float) -> None:
    # Nearly black: without the facets' own grazing share, or the weight, the film would be seen less well.
    black = (Span.at(0.002), Span.at(0.002), Span.at(0.002))
    reach = replace(SUZANNE, film_ior=1.5, factor=Span.at(0.3), roughness=Span(0.3, 0.9), dielectric_f0=black)
    table = fit_table(
        reach, "dielectric", 0.3, has_image_light=True, has_spread=False, bare_at_grazing=weight
    )
    assert table is not None
    g = np.random.default_rng(21)
    n_dot_v, roughness = g.uniform(size=300), g.uniform(0.3, 0.9, 300)
    cosines, weights = facet_cosines(np.maximum(n_dot_v, 1e-4), roughness**2, slopes=24, turns=8)
    films = Film.of(cosines, 400.0, 1.5, base_from_f0(np.full(3, 0.002)))
    truth = facet_mean(evaluate("fourier", films, parameters={"tolerance": 1e-6}).rgb, weights)
    plain = 0.002 + (weight - 0.002) * (1.0 - cosines[..., None]) ** 5
    bare = 0.7 * facet_mean(np.repeat(plain, 3, axis=-1), weights)
    found = look_up(bake(table), n_dot_v, 400.0, np.full(3, 0.002), roughness=roughness)
    error = np.quantile(delta_e_2000(bare + 0.3 * found, bare + 0.3 * truth), 0.95)
    assert error <= table.delta_e <= 0.3
