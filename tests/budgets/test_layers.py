"""Budgets of Bragg layers: kept at other poses than those that chose the tables, by the fewest bands."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from gltf_iri.baking.layer_fill import filled_layers
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.baking.layer_resolution import fit_layer_tables, lookup_terms
from gltf_iri.baking.layer_samples import COLOURS, doubt_of, p95_guess, sampled_layers
from gltf_iri.budgets.candidates import Candidate
from gltf_iri.budgets.choose import Asked
from gltf_iri.budgets.layers import AskedOfLayers, choose_layers, layer_table_ns, look_ups
from gltf_iri.budgets.plans import plan_within
from gltf_iri.budgets.stacks import way_for_stack
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables, PlannedLayer
from gltf_iri.planning.layers import plan_layers
from gltf_iri.planning.reach import Span
from gltf_iri.tolerances import GLSL_FILM_DELTA_E

SHARP = PlannedLayer(0, 1.0, 1.5, (200.0, 200.0), 0.4, 8, 0.09)
SOFT = PlannedLayer(1, 1.0, 1.7, (250.0, 250.0), 0.5, 4, 0.2)
TWO = LayersPlan((SHARP, SOFT), 1.0, "base", Span.at(1.0), "layers-bands")


@cache
def chosen(budget: float) -> LayersPlan:
    return choose_layers(TWO, AskedOfLayers(budget), "these layers")


def random_plan(g: np.random.Generator) -> LayersPlan:
    """Return up to three layers in a host, on black or on a base."""
    host = 1.0 if g.uniform() < 0.5 else g.uniform(1.1, 1.6)
    layers = []
    for source in range(g.integers(1, 4)):
        nm, contrast = g.uniform(150.0, 400.0), g.uniform(0.05, 0.8)
        alpha = max(g.uniform(0.0, 0.7) ** 2, 1e-3)
        layers.append(
            PlannedLayer(
                source, host, host + contrast, (nm, nm), g.uniform(0.2, 0.8), int(g.integers(1, 12)), alpha
            )
        )
    under = "base" if g.uniform() < 0.5 else "nothing"
    return LayersPlan(tuple(layers), host, under, Span.at(1.0), "layers-bands")


@pytest.mark.parametrize("budget", [1.0, 0.3])
def test_budgets_are_kept_at_other_poses_by_the_truth_itself(budget: float) -> None:
    plan = chosen(budget)
    assert plan.tables is not None and plan.delta_e is not None and plan.delta_e <= budget
    samples = sampled_layers(plan, "D65", texels=1, poses=100, seed=77, bands=())
    truth = layer_colours("layers-single", planned_stack(plan))
    cosines = samples.cos_h, samples.cos_i, samples.cos_o
    exact = [truth.reflected(number, *cosines) for number in range(2)] + [truth.passed(*cosines[1:])]
    found = lookup_terms(filled_layers(plan, "D65", has_sky=False), samples)
    for a, b in zip(found, exact, strict=True):
        assert np.quantile(delta_e_2000(a, b), 0.95) <= plan.delta_e


def test_what_single_precision_adds_is_stated() -> None:
    plan = chosen(1.0)
    assert plan.tables is not None and plan.delta_e is not None
    assert plan.delta_e - plan.tables.delta_e == pytest.approx(GLSL_FILM_DELTA_E)


def test_what_the_samples_own_truth_errs_by_is_stated(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gltf_iri.baking.layer_resolution.doubt_of", lambda *_: 2.0)
    fit = fit_layer_tables(TWO, 3.0)
    assert fit.tables is not None and 2.0 < fit.tables.delta_e <= 3.0


def test_less_is_asked_for_with_more_bands_and_nodes() -> None:
    sizes = [chosen(budget).tables for budget in (3.0, 1.0, 0.3)]
    bands = [tables.bands for tables in sizes if tables is not None]
    prices = [chosen(budget).ns_per_colour for budget in (3.0, 1.0, 0.3)]
    assert bands == sorted(bands) and prices == sorted(prices) and prices[0] < prices[-1]


@pytest.mark.parametrize("seed", range(2))
def test_random_stacks_keep_what_is_stated(seed: int) -> None:
    plan = choose_layers(random_plan(np.random.default_rng(seed)), AskedOfLayers(1.0), "these layers")
    assert plan.delta_e is not None and plan.delta_e <= 1.0
    samples = sampled_layers(plan, "D65", texels=1, poses=1024, seed=91, bands=())
    found = lookup_terms(filled_layers(plan, "D65", has_sky=False), samples)
    errors = [delta_e_2000(a, b) for a, b in zip(found, samples.truth, strict=True)]
    assert max(np.quantile(each, 0.95) for each in errors) <= plan.delta_e


def test_periods_that_vary_keep_the_budget_too() -> None:
    layer = replace(SOFT, period_nm=(200.0, 260.0))
    varied = LayersPlan((layer,), 1.0, "nothing", Span(0.2, 0.8), "layers-bands")
    plan = choose_layers(varied, AskedOfLayers(1.0), "these layers")
    assert plan.tables is not None and plan.tables.period_nodes > 1
    g = np.random.default_rng(3)
    texel, cosine = g.uniform(0.2, 0.8, size=200), g.uniform(size=200)
    exact = layer_colours("layers-single", planned_stack(plan, texel)).reflected(0, cosine, cosine, cosine)
    found = LayerLookup(filled_layers(plan, "D65", has_sky=False), texel).reflected(0, cosine, cosine, cosine)
    assert np.quantile(delta_e_2000(found, exact), 0.95) <= 1.0


def test_the_samples_are_those_of_the_truth() -> None:
    plan = replace(TWO, host_ior=1.3, layers=(replace(SHARP, n1=1.3), replace(SOFT, n1=1.3)))
    samples = sampled_layers(plan, "D65", texels=1, poses=64, seed=5, bands=(COLOURS, 8), is_crossed=True)
    assert {len(terms) for terms in (samples.truth, *samples.by_bands.values())} == {4}
    assert doubt_of(plan, samples, "D65") < 0.02


def test_what_crosses_all_layers_once_keeps_the_budget_too(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("gltf_iri.baking.layer_resolution._MEASURED", (8, 16))
    monkeypatch.setattr("gltf_iri.baking.layer_resolution._CHECKED", (16, 16))
    plan = choose_layers(TWO, AskedOfLayers(3.0, is_crossed=True), "these layers")
    assert plan.delta_e is not None and plan.delta_e <= 3.0
    cosine = np.random.default_rng(7).uniform(size=60)
    exact = layer_colours("layers-single", planned_stack(plan)).entering(cosine)
    found = LayerLookup(filled_layers(plan, "D65", has_sky=False)).entering(cosine)
    assert np.quantile(delta_e_2000(found, exact), 0.95) <= plan.delta_e


def test_tables_that_only_a_crossing_breaks_are_not_chosen(monkeypatch: pytest.MonkeyPatch) -> None:
    def grey(_: LayerLookup, cosine: np.ndarray) -> np.ndarray:
        return np.full((*np.shape(cosine), 3), 0.5)

    monkeypatch.setattr(LayerLookup, "entering", grey)
    for name, value in {
        "LAYER_BANDS": (8,),
        "_MEASURED": (4, 16),
        "_CHECKED": (8, 16),
        "_CELLS_MAX": 128,
    }.items():
        monkeypatch.setattr(f"gltf_iri.baking.layer_resolution.{name}", value)
    one = replace(TWO, layers=(SOFT,))
    assert choose_layers(one, AskedOfLayers(3.0), "them").tables is not None
    with pytest.raises(UsageError, match="No tables of layers keep ΔE 3 for them"):
        choose_layers(one, AskedOfLayers(3.0, is_crossed=True), "them")


def test_bands_beat_colours() -> None:
    samples = sampled_layers(TWO, "D65", texels=1, poses=256, seed=1, bands=(COLOURS, 8, 16))
    errors = [p95_guess(samples.by_bands[bands], samples.truth) for bands in (COLOURS, 8, 16)]
    assert errors == sorted(errors, reverse=True)


def test_a_budget_of_0_is_the_truth_directly() -> None:
    plan = chosen(0.0)
    assert plan.method == "layers-single" and plan.tables is None and plan.delta_e == 0.0


@pytest.mark.parametrize("budget", [-1.0, float("nan"), float("inf")])
def test_budgets_that_are_none_are_refused(budget: float) -> None:
    with pytest.raises(UsageError, match="A budget is"):
        choose_layers(TWO, AskedOfLayers(budget), "these layers")


def test_what_is_out_of_reach_is_told_with_the_best() -> None:
    with pytest.raises(
        UsageError, match=r"No tables of layers keep ΔE 0\.001 for them: the best err by about 0"
    ):
        choose_layers(TWO, AskedOfLayers(0.001), "them")


def test_fringes_beyond_judgement_are_told() -> None:
    thick = replace(TWO, layers=(replace(SHARP, period_nm=(1e5, 1e5), cells=1000),))
    with pytest.raises(UsageError, match="fringes so fine"):
        choose_layers(thick, AskedOfLayers(1.0), "them")


def test_look_ups_are_counted_by_fours() -> None:
    tables = LayerTables(16, False, 33, 1, "f2", 0.0)
    assert look_ups(TWO, tables) == 1 + 4 + 16
    assert look_ups(replace(TWO, under="nothing"), tables) == 1 + 4 + 8
    assert look_ups(replace(TWO, under="nothing", layers=(SHARP,)), tables) == 1
    assert layer_table_ns(TWO, tables, "glsl") > layer_table_ns(TWO, replace(tables, bands=8), "glsl")


def test_materials_with_layers_are_planned_within_a_budget() -> None:
    layer = MirrorLayer(ior_2=1.6, period_min_nm=220.0, period_max_nm=220.0, cells=3, roughness=0.4)
    black = MetallicRoughness(base_color_factor=(0.0, 0.0, 0.0, 1.0), metallic_factor=0.0)
    material = Material(pbr=black, bragg=Bragg(1.0, layers=(layer,)))
    known: list[tuple[LayersPlan, LayersPlan]] = []
    plan = plan_within(material, 0, Asked(1.0, 1e6, "glsl"), chosen_layers=known)
    assert plan.layers is not None and plan.layers.delta_e is not None and plan.layers.delta_e <= 1.0
    again = plan_within(material, 1, Asked(1.0, 1e6, "glsl"), chosen_layers=known)
    assert again.layers is plan.layers


def test_what_resolves_nothing_ends_in_a_number_or_a_sentence() -> None:
    plan = LayersPlan((replace(SHARP, n2=10.0, alpha=1.0),), 1.0, "nothing", Span.at(1.0), "layers-bands")
    try:
        found = choose_layers(plan, AskedOfLayers(2.0), "them")
    except UsageError as error:
        assert "best err" in str(error)
    else:
        assert found.delta_e is not None and found.delta_e <= 2.0


HOSTILE = {
    "a thousand cells": Bragg(1.0, layers=(MirrorLayer(ior_2=1.5, cells=1000, roughness=0.5),)),
    "no thickness": Bragg(
        1.0, layers=(MirrorLayer(ior_1=1.5, ior_2=10.0, period_min_nm=0.0, period_max_nm=0.0),)
    ),
    "a dense host": Bragg(1.0, host_ior=10.0, layers=(MirrorLayer(ior_1=10.0, ior_2=1.0, cells=9),)),
    "dense cells": Bragg(1.0, layers=(MirrorLayer(ior_2=10.0, cells=50, roughness=1.0),)),
    "no first film": Bragg(1.0, layers=(MirrorLayer(ior_2=1.5, fill=0.0, cells=20),)),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_layers_fill_tables_of_numbers(name: str) -> None:
    plan = plan_layers(Material(pbr=MetallicRoughness(metallic_factor=0.0), bragg=HOSTILE[name]))
    assert plan is not None
    small = replace(plan, tables=LayerTables(8, False, 17, 1, "f4", 0.0))
    baked = filled_layers(small, "D65", has_sky=False)
    for array in (baked.first, baked.reflected, baked.transmitted):
        assert np.all(np.isfinite(array))


def test_stacks_are_given_the_cheapest_method_that_keeps_the_budget(monkeypatch: pytest.MonkeyPatch) -> None:
    offered = (
        Candidate("layers-rgb", {"reflectance": "bloch"}, 10.0),
        Candidate("layers-bands", {"bands": 64}, 100.0),
        Candidate("layers-single", {}, 1000.0),
    )
    monkeypatch.setattr("gltf_iri.budgets.stacks.direct_candidates", lambda *_: offered)
    monkeypatch.setattr("gltf_iri.budgets.stacks._LOOKS", (16, 24))
    layers = (BraggLayer.of(1.0, 1.5, 100.0, 120.0, 5), BraggLayer.of(1.0, 1.7, 100.0, 120.0, 3))
    stack = LayerStack.of(layers, 1.0, LayerBase.of(0.5))
    assert way_for_stack(stack, 30.0).way.method == "layers-rgb"
    found = way_for_stack(stack, 1.0)
    assert found.way.method == "layers-bands" and found.way.delta_e <= 1.0
    assert way_for_stack(stack, 0.0).way.method == "layers-single"
    assert way_for_stack(stack, 1e-6).way.method == "layers-single"
