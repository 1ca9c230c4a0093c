"""Texels are the truth at the values that they stand for, and its means over facets and thicknesses."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.baking.fill import bake, bake_plans, filling_ns
from gltf_iri.baking.lookup import axis_values
from gltf_iri.evaluation.film import Film, base_from_f0
from gltf_iri.evaluation.prefiltered import prefiltered_fourier
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.facet_mean import facet_cosines, facet_mean
from gltf_iri.planning.film_table import FilmTable, TableAxis
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.reach import Span
from gltf_iri.planning.way import Way

COS = TableAxis("cos_theta", Span(0.0, 1.0), 5)
NM = TableAxis("thickness_nm", Span(150.0, 700.0), 4)
BASE = TableAxis("base_f0", Span(0.04, 0.9), 3)
ROUGH = TableAxis("roughness", Span(0.0, 0.8), 3)
SPREAD = TableAxis("spread_nm", Span(0.0, 60.0), 3)
COLOUR = (0.9, 0.5, 0.1)

# The series' own table errs so much.
SERIES_MAX_ABS = 2e-6


def table_of(*axes: TableAxis, texel: str = "f4", film_ior: float = 1.4) -> FilmTable:
    return FilmTable("metal", film_ior, 400.0, COLOUR, axes, texel, 0.0)


def test_texels_are_the_truth_where_they_stand() -> None:
    texels = bake(table_of(COS, NM, BASE)).texels
    film = Film.of(
        axis_values(COS)[:, None, None],
        axis_values(NM)[:, None],
        1.4,
        base_from_f0(np.repeat(axis_values(BASE)[:, None], 3, axis=1)),
    )
    np.testing.assert_allclose(texels, evaluate("spectral", film).rgb, rtol=1e-7)


def test_half_precision_rounds_the_same_truth() -> None:
    half, single = bake(table_of(COS, NM, texel="f2")), bake(table_of(COS, NM))
    assert half.texels.dtype == np.float16
    np.testing.assert_allclose(half.texels, single.texels, rtol=2.0**-11)


def test_other_whites_make_other_tables() -> None:
    d65, e = bake(table_of(COS), "D65"), bake(table_of(COS), "E")
    assert (d65.white, e.white) == ("D65", "E")
    assert np.abs(d65.texels - e.texels).max() > 1e-3


def test_rough_texels_are_means_over_facets() -> None:
    texels = bake(table_of(COS, NM, ROUGH)).texels
    for r, roughness in enumerate(axis_values(ROUGH)[1:], start=1):
        cosines, weights = facet_cosines(
            np.maximum(axis_values(COS), 1e-4), roughness**2, slopes=96, turns=24
        )
        for d, thickness_nm in enumerate(axis_values(NM)):
            film = Film.of(cosines, thickness_nm, 1.4, base_from_f0(COLOUR))
            expected = facet_mean(evaluate("fourier", film, parameters={"tolerance": 1e-8}).rgb, weights)
            np.testing.assert_allclose(texels[:, d, r], expected, rtol=0, atol=1e-5)
    np.testing.assert_array_equal(texels[:, :, 0], bake(table_of(COS, NM)).texels)


# Around thickness 0 the closed form sums 33 films, 0.35 standard deviations apart: too few for sharp fringes.
@pytest.mark.parametrize(("low_nm", "atol"), [(0.0, 1e-5), (150.0, SERIES_MAX_ABS)])
def test_spread_texels_are_the_closed_form_s(low_nm: float, atol: float) -> None:
    nm = TableAxis("thickness_nm", Span(low_nm, 700.0), 4)
    texels = bake(table_of(COS, nm, SPREAD)).texels
    film = Film.of(axis_values(COS)[:, None], axis_values(nm), 1.4, base_from_f0(COLOUR))
    for s, spread_nm in enumerate(axis_values(SPREAD)[1:], start=1):
        expected = prefiltered_fourier(film, spread_nm, "D65", 1e-8)
        np.testing.assert_allclose(texels[:, :, s], expected, rtol=0, atol=atol)
    np.testing.assert_array_equal(texels[:, :, 0], bake(table_of(COS, nm)).texels)


def test_means_over_facets_and_thicknesses_commute() -> None:
    both = bake(table_of(COS, NM, ROUGH, SPREAD)).texels
    np.testing.assert_array_equal(both[:, :, :, 0], bake(table_of(COS, NM, ROUGH)).texels)
    np.testing.assert_array_equal(both[:, :, 0], bake(table_of(COS, NM, SPREAD)).texels)
    cosines, weights = facet_cosines(np.array([0.5]), 0.16, slopes=48, turns=16)
    film = Film.of(cosines, axis_values(NM)[1], 1.4, base_from_f0(COLOUR))
    expected = facet_mean(prefiltered_fourier(film, 60.0, "D65", 1e-8), weights)
    np.testing.assert_allclose(both[2, 1, 1, 2], expected[0], rtol=0, atol=1e-5)


def test_white_mirrors_stay_white() -> None:
    white = FilmTable("metal", 1.4, 400.0, (1.0, 1.0, 1.0), (COS, NM, ROUGH), "f4", 0.0)
    np.testing.assert_allclose(bake(white).texels, 1.0, rtol=1e-6)


def test_plans_share_equal_tables_and_those_without_have_none() -> None:
    table = table_of(COS)
    way = Way("spectral", tables=(table,))
    plans = [
        MaterialPlan(i, "", (), "spectral", "", "core", way=w) for i, w in ((3, way), (4, None), (-1, way))
    ]
    steps: list[int] = []
    baked = bake_plans(plans, advance=lambda: steps.append(1))
    assert list(baked) == [3, -1]
    assert baked[3]["metal"] is baked[-1]["metal"]
    assert len(steps) == 2


def test_filling_costs_by_the_truths_it_takes() -> None:
    grey = FilmTable("metal", 1.4, 400.0, (0.5, 0.5, 0.5), (COS, NM), "f4", 0.0)
    more = FilmTable(
        "metal", 1.4, 400.0, (0.5, 0.5, 0.5), (COS, TableAxis("thickness_nm", NM.span, 8)), "f4", 0.0
    )
    assert filling_ns(more) == pytest.approx(2.0 * filling_ns(grey))
    assert filling_ns(table_of(COS, NM)) == pytest.approx(3.0 * filling_ns(grey))
    assert filling_ns(table_of(COS, NM, ROUGH)) > filling_ns(table_of(COS, NM))
