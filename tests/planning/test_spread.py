"""A spread of thickness is called for where the thickness varies and the film can be averaged over it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material
from gltf_iri.material.texture import TextureInfo
from gltf_iri.planning.decide import plan_material
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.film_table import FilmTable, TableAxis
from gltf_iri.planning.reach import Reach, Span
from gltf_iri.planning.way import Way

SPREAD = Effect.IRIDESCENCE_THICKNESS_SPREAD
GREY = (Span.at(0.5),) * 3
REACH = Reach(1.68, Span(0.0, 1.0), Span(100.0, 400.0), Span.at(0.0), Span.at(0.1), GREY, GREY)


def painted(**changes) -> Material:
    film = Iridescence(1.0, thickness_texture=TextureInfo(0), **({"film_ior": 1.68} | changes))
    return Material(iridescence=film)


def table(*quantities: str) -> Way:
    axes = tuple(TableAxis(quantity, Span(0.0, 1.0), 8) for quantity in quantities)
    return Way("spectral", tables=(FilmTable("dielectric", 1.68, 400.0, (0.04,) * 3, axes, "f2", 0.1),))


def test_a_varying_thickness_spreads_under_the_method_that_averages():
    assert plan_material(painted(), 0, method="fourier").calls_for(SPREAD)
    assert plan_material(painted(), 0, method="fourier", reach=REACH).calls_for(SPREAD)


@pytest.mark.parametrize("method", ["khr", "khr-guarded", "spectral"])
def test_other_methods_draw_the_mean_thickness_and_say_so(method):
    reason = plan_material(painted(), 0, method=method).skipped[SPREAD]
    assert reason == f"{method} cannot average over thickness: it draws the mean thickness' colour"


def test_a_texture_of_one_thickness_calls_for_nothing():
    one = replace(REACH, thickness_nm=Span.at(250.0))
    reason = plan_material(painted(), 0, method="fourier", reach=one).skipped[SPREAD]
    assert reason == "the texture holds 250 nm everywhere"
    same = painted(thickness_min_nm=400.0, thickness_max_nm=400.0)
    assert "both 400 nm" in plan_material(same, 0, method="fourier").skipped[SPREAD]


def test_without_a_thickness_texture_the_spread_is_not_even_mentioned():
    for material in (Material(), Material(iridescence=Iridescence(1.0))):
        assert SPREAD in plan_material(material, 0, method="fourier").absent


def test_a_texture_that_is_not_drawn_spreads_nothing():
    film = Iridescence(1.0, thickness_texture=TextureInfo(0, tex_coord=2))
    reason = plan_material(Material(iridescence=film), 0, method="fourier").skipped[SPREAD]
    assert reason.startswith("the thickness texture is not drawn: ")


def test_a_film_that_is_left_out_has_no_spread():
    bare = painted(film_ior=1.0)
    assert plan_material(bare, 0, method="fourier").skipped[SPREAD].startswith("there is no film: ")


def test_a_table_spreads_by_its_axis_whatever_method_filled_it():
    with_axis = table("cos_theta", "thickness_nm", "spread_nm")
    assert plan_material(painted(), 0, reach=REACH, way=with_axis, way_reason="cheap").calls_for(SPREAD)
    without = table("cos_theta", "thickness_nm")
    reason = plan_material(painted(), 0, reach=REACH, way=without, way_reason="cheap").skipped[SPREAD]
    assert reason == "the table has no axis for it: it draws the mean thickness' colour"
