"""Bragg layers on surfaces: the stack's BRDF at points, its share of the light, and image light on it."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import LayerBase, Pose, brdf, coating_reflectance
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.optics.layer_stack import coating_transmittance, sight_of
from gltf_iri.optics.microfacet import ALPHA_MIN
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.planning.effects import Effect
from gltf_iri.planning.layer_plan import LayersPlan, PlannedLayer
from gltf_iri.planning.material_plan import MaterialPlan
from gltf_iri.planning.reach import Span
from gltf_iri.reference.environment_map import EnvironmentMap
from gltf_iri.reference.film_on import FilmOn
from gltf_iri.reference.image_light import reflected
from gltf_iri.reference.layer_truth import TabulatedLayers
from gltf_iri.reference.layers_on import sight_between
from gltf_iri.reference.lobes import evaluate_lobes
from gltf_iri.reference.surface import Surface
from gltf_iri.reference.techniques import techniques
from gltf_iri.scene.environment import white

# Of low contrast, so that the truth settles at once.
UPPER = PlannedLayer(0, 1.3, 1.4, (200.0, 200.0), 0.4, 3, 0.09)
LOWER = PlannedLayer(1, 1.3, 1.45, (250.0, 250.0), 0.5, 2, 0.25)
BEETLE = PlannedLayer(0, 1.59, 1.67, (160.0, 160.0), 0.51, 8, 0.05)

VECTORS = {
    *("position", "normal", "view", "clearcoat_normal", "anisotropy_tangent"),
    *("base_color", "emission", "dielectric_f0", "sheen_color"),
}
LIT = (Effect.DIELECTRIC, Effect.METAL, Effect.BRAGG)

# What the tables of the truth err by, times the highest lobe that the tests meet.
TABLES = 2e-5


def plan_of(*layers, host=1.0, under="base", texel=None):
    return LayersPlan(layers, host, under, texel or Span.at(1.0), "layers-single")


def material(layers, *effects):
    return MaterialPlan(0, "", (*LIT, *effects), None, "", "core", layers=layers)


PLANS = {
    "beetle": plan_of(BEETLE, under="nothing"),
    "one over a diffuse base": plan_of(replace(UPPER, n1=1.0)),
    "two under a coating": plan_of(UPPER, LOWER, host=1.3),
}


@pytest.fixture(scope="module")
def truth():
    """Tables of `PLANS`, filled once."""
    return {name: TabulatedLayers(plan, "D65") for name, plan in PLANS.items()}


def points(count=64, seed=0, **changes):
    """Points of random normal, seen and lit from the front, and the light's direction."""
    rng = np.random.default_rng(seed)

    def unit(v):
        return v / np.linalg.norm(v, axis=1, keepdims=True)

    normal = unit(rng.normal(size=(count, 3)))
    view, light = (unit(normal + 0.8 * unit(rng.normal(size=(count, 3)))) for _ in range(2))
    values = {
        field.name: np.zeros((count, 3) if field.name in VECTORS else count) for field in fields(Surface)
    }
    values |= {
        "normal": normal,
        "clearcoat_normal": normal,
        "view": view,
        "n_dot_v": np.sum(normal * view, axis=1),
        "base_color": rng.uniform(size=(count, 3)),
        "perceptual_roughness": np.full(count, 0.5),
        "alpha_roughness": np.full(count, 0.25),
        "occlusion": np.ones(count),
        "dielectric_f0": np.full((count, 3), 0.04),
        "specular_weight": np.ones(count),
        "bragg_factor": np.ones(count),
        "bragg_period_texel": np.ones(count),
    }
    values |= {name: np.broadcast_to(value, np.shape(values[name])).copy() for name, value in changes.items()}
    return Surface(**values), light


def film_on(surface, layers):
    return FilmOn(surface, 1.3, lambda film, sight: pytest.fail("there is no film"), layers)


def by_hand(surface, light, plan):
    """f·cosθ of the stack without its coating's highlight, from angles alone."""
    n_dot_l = np.sum(surface.normal * light, axis=1)
    level = [
        v - np.sum(v * surface.normal, axis=1, keepdims=True) * surface.normal for v in (surface.view, light)
    ]
    turn = np.sum(level[0] * level[1], axis=1) / np.prod([np.linalg.norm(v, axis=1) for v in level], axis=0)
    m = surface.metallic
    base = LayerBase.of()
    if plan.under == "base":
        base = LayerBase.of(
            (1 - m)[:, None] * surface.base_color, surface.base_color, m, surface.alpha_roughness
        )
    stack = planned_stack(plan, surface.bragg_period_texel, base)
    pose = Pose.of(n_dot_l, surface.n_dot_v, np.clip(turn, -1, 1))
    return n_dot_l[:, None] * brdf(stack, pose, layer_colours("layers-single", stack))


@pytest.mark.parametrize("name", PLANS)
def test_a_stack_of_factor_1_is_its_brdf(truth, name):
    surface, light = points(5, metallic=0.0 if name == "beetle" else 0.4)
    plan = PLANS[name]
    sent = evaluate_lobes(surface, light, film_on(surface, truth[name]), material(plan))
    expected = by_hand(surface, light, plan)
    # Where the smooth coating's highlight does not reach.
    half = (surface.view + light) / np.linalg.norm(surface.view + light, axis=1, keepdims=True)
    off = np.linalg.norm(np.cross(surface.normal, half), axis=1) > (0.2 if plan.host_ior != 1.0 else 0.0)
    assert off.sum() >= 3
    assert_allclose(sent[off], expected[off], atol=2e-4 if plan.host_ior != 1.0 else TABLES)
    assert expected[off].max() > 1e-3


def test_tables_stand_for_the_truth_of_the_papers_two_layers():
    """Fourneau et al. 2024, Figure 7: A on B in air; what tables of band means and 4097 cosines leave."""
    upper = PlannedLayer(0, 1.0, 1.5, (500.0, 500.0), 0.5, 10, 0.1)
    plan = plan_of(upper, PlannedLayer(1, 1.0, 1.5, (988.0, 988.0), 0.5, 10, 0.05), under="nothing")
    h, i, o = np.random.default_rng(0).uniform(0.1, 1.0, (3, 3))
    exact, tables = layer_colours("layers-single", planned_stack(plan)), TabulatedLayers(plan, "D65")
    found = tables(np.ones(()))
    for layer in (0, 1):
        assert_allclose(found.reflected(layer, h, i, o), exact.reflected(layer, h, i, o), atol=1e-3)


def test_sight_by_vectors_is_sight_by_angles():
    surface, light = points(2000)
    n_dot_l = np.sum(surface.normal * light, axis=1)
    level = [
        v - np.sum(v * surface.normal, axis=1, keepdims=True) * surface.normal for v in (surface.view, light)
    ]
    turn = np.sum(level[0] * level[1], axis=1) / np.prod([np.linalg.norm(v, axis=1) for v in level], axis=0)
    for host in (1.0, 1.35):
        there = sight_between(surface, light, n_dot_l, host)
        angles = sight_of(host, n_dot_l, surface.n_dot_v, np.clip(turn, -1, 1))
        for field in fields(there):
            assert_allclose(getattr(there, field.name), getattr(angles, field.name), atol=1e-12)


def test_factor_0_is_the_plain_material_bit_for_bit(truth):
    surface, light = points(metallic=0.5, bragg_factor=0.0)
    plain = material(None)
    expected = evaluate_lobes(surface, light, film_on(surface, None), plain)
    layers = PLANS["one over a diffuse base"]
    sent = evaluate_lobes(
        surface, light, film_on(surface, truth["one over a diffuse base"]), material(layers)
    )
    assert np.array_equal(sent, expected)


def test_the_factor_mixes_stack_and_plain_material(truth):
    name = "one over a diffuse base"
    rng = np.random.default_rng(5)
    share = rng.uniform(size=64)
    ends = [points(metallic=0.5, bragg_factor=factor) for factor in (0.0, 1.0)]
    plain, stack = (
        evaluate_lobes(surface, light, film_on(surface, truth[name]), material(PLANS[name]))
        for surface, light in ends
    )
    surface, light = points(metallic=0.5, bragg_factor=share)
    sent = evaluate_lobes(surface, light, film_on(surface, truth[name]), material(PLANS[name]))
    assert_allclose(sent, (1 - share)[:, None] * plain + share[:, None] * stack, atol=1e-12)


def test_sheen_and_clearcoat_lie_over_the_stack(truth):
    """Over a black stack that mirrors nothing they send what they send over a black base."""
    name = "one over a diffuse base"
    surface, light = points(sheen_color=0.4, sheen_roughness=0.5, clearcoat=0.7, clearcoat_roughness=0.3)
    over = Effect.SHEEN, Effect.CLEARCOAT

    def sent(factor, colour):
        here = replace(surface, bragg_factor=np.full(64, factor), base_color=np.full((64, 3), colour))
        return evaluate_lobes(here, light, film_on(here, truth[name]), material(PLANS[name], *over))

    def below(factor, colour):
        here = replace(surface, bragg_factor=np.full(64, factor), base_color=np.full((64, 3), colour))
        return evaluate_lobes(here, light, film_on(here, truth[name]), material(PLANS[name]))

    # Both pass the same share of whatever lies below them.
    by_stack = (sent(1.0, 0.9) - sent(1.0, 0.2)) / (below(1.0, 0.9) - below(1.0, 0.2))
    by_plain = (sent(0.0, 0.9) - sent(0.0, 0.2)) / (below(0.0, 0.9) - below(0.0, 0.2))
    assert_allclose(by_stack, by_plain, rtol=1e-9)


def test_periods_follow_the_texture():
    texel = Span(0.25, 0.75)
    varying = plan_of(replace(BEETLE, period_nm=(150.0, 210.0)), under="nothing", texel=texel)
    at = np.linspace(0.25, 0.75, 9)
    surface, light = points(9, bragg_period_texel=at)
    sent = evaluate_lobes(
        surface, light, film_on(surface, TabulatedLayers(varying, "D65")), material(varying)
    )
    assert_allclose(sent, by_hand(surface, light, varying), atol=TABLES)
    for row in (0, 3, 8):
        period = 150.0 + 60.0 * row / 8
        fixed = plan_of(replace(BEETLE, period_nm=(period, period)), under="nothing")
        assert_allclose(sent[row], by_hand(surface, light, fixed)[row], atol=TABLES)


def overhead(count, cosine, **changes):
    surface, _ = points(count, **changes)
    sine = np.sqrt(1 - cosine**2)
    view = np.column_stack([sine, np.zeros(count), cosine])
    up = np.tile([0.0, 0.0, 1.0], (count, 1))
    return replace(surface, normal=up, clearcoat_normal=up, view=view, n_dot_v=cosine)


@pytest.mark.parametrize("name", PLANS)
def test_a_white_room_shows_the_directional_reflectance(truth, name):
    cosine = np.array([1.0, 0.6, 0.2])
    plan = PLANS[name]
    surface = overhead(3, cosine, base_color=(0.8, 0.5, 0.2))
    colour, error = reflected(
        surface,
        material(plan),
        EnvironmentMap(white()),
        film_on(surface, truth[name]),
        samples=2048,
        rng=np.random.default_rng(0),
    )
    # ∫ f cosθ over the hemisphere by Gauss's rule, in θ and φ.
    nodes, weights = gauss_unit(48)
    theta, theta_weights = 0.5 * np.pi * nodes, 0.5 * np.pi * weights
    phi, phi_weights = np.pi * nodes, 2.0 * np.pi * weights
    base = LayerBase.of((0.8, 0.5, 0.2)) if plan.under == "base" else LayerBase.of()
    stack = planned_stack(plan, 1.0, base)
    expected = []
    for each in cosine:
        pose = Pose.of(np.cos(theta)[:, None], each, np.cos(phi))
        f = brdf(stack, pose, truth[name](np.ones(())))
        around = np.einsum("tpc,t,p->c", f, np.cos(theta) * np.sin(theta) * theta_weights, phi_weights)
        expected.append(around + coating_reflectance(plan.host_ior, each))
    # Seven degrees of freedom: 7 standard errors hold 99.98 %. The coating is drawn as narrow facets.
    drawn = 3e-3 if plan.host_ior != 1.0 else 2e-4
    assert np.all(np.abs(colour - expected) < 7 * error + drawn)
    assert error.max() < 5e-3


def test_facets_in_a_host_are_drawn_as_densely_as_is_told():
    """Each way of drawing integrates to what of its samples are not lost below the horizon."""
    cosine = np.full(20000, 0.5)
    surface = overhead(20000, cosine, base_color=0.5)
    ways = list(techniques(surface, material(PLANS["two under a coating"]), EnvironmentMap(white())))
    rng = np.random.default_rng(1)
    drawn = rng.uniform(size=(20000, 2))
    even = np.column_stack([np.cos(a := 2 * np.pi * drawn[:, 1]), np.sin(a)])
    height = drawn[:, 0]
    everywhere = np.column_stack([np.sqrt(1 - height**2)[:, None] * even, height])
    for way in (ways[3], ways[4]):
        is_kept = way.sample(drawn)[:, 2] > 0.0
        total = 2 * np.pi * way.density(everywhere)
        assert abs(total.mean() - is_kept.mean()) < 5 * total.std() / np.sqrt(20000)
        assert is_kept.mean() < 1.0


def test_what_the_coating_passes_and_mirrors_is_all():
    cosine = np.linspace(0.0, 1.0, 11)
    assert_allclose(coating_reflectance(1.35, cosine) + coating_transmittance(1.35, cosine), 1.0, atol=1e-15)
    assert ALPHA_MIN == 1e-3
