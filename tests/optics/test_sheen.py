"""The fibres' distribution, masking and albedo: against mpmath, an independent quadrature, and their laws."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from gltf_iri.optics.microfacet import N_DOT_V_MIN
from gltf_iri.optics.sheen import (
    SHEEN_ALPHA_MIN,
    d_charlie,
    integrate_sheen,
    lambda_sheen,
    sheen_albedo,
    sheen_alpha,
    sheen_weight,
    v_sheen,
)

ALPHAS = (SHEEN_ALPHA_MIN, 0.04, 0.25, 1.0)

# The series at N·V = 1, where Λ has a root's slope; elsewhere quadrature and series keep 2e-6.
ALBEDO_MAX_ABS = 1e-5


@pytest.mark.parametrize("alpha", ALPHAS)
def test_projected_fibres_cover_the_surface_once(alpha: float) -> None:
    """∫ D (N·H) dω = 1: with sin² as variable the integrand is a power."""
    nodes, weights = leggauss(300)
    sine_squared = 0.5 + 0.5 * nodes
    facets = d_charlie(np.sqrt(1.0 - sine_squared), alpha)
    assert np.pi * np.sum(facets * 0.5 * weights) == pytest.approx(1.0, rel=1e-6)


@pytest.mark.parametrize("alpha", ALPHAS)
def test_masking_is_continuous_where_its_fit_is_folded(alpha: float) -> None:
    below, at, above = lambda_sheen([0.5 - 1e-9, 0.5, 0.5 + 1e-9], alpha)
    assert below == pytest.approx(at, rel=1e-7)
    assert above == pytest.approx(at, rel=1e-7)


def test_masking_grows_towards_the_horizon() -> None:
    cosine = np.linspace(1.0, 0.0, 200)
    for alpha in ALPHAS:
        assert np.all(np.diff(lambda_sheen(cosine, alpha)) > 0.0)


def test_fit_at_its_two_ends_is_the_printed_one() -> None:
    """L(½) of both columns, with mpmath."""
    for alpha, (a, b, c, d, e) in (
        (1.0, (21.5473, 3.82987, 0.19823, -1.97760, -4.32054)),
        (0.0, (25.3245, 3.32435, 0.16801, -1.27393, -4.85967)),
    ):
        x = mpmath.mpf("0.5")
        expected = mpmath.exp(a / (1 + b * x**c) + d * x + e)
        assert lambda_sheen(0.5, alpha) == pytest.approx(float(expected), rel=1e-13)


def test_visibility_is_reciprocal() -> None:
    light, view = np.random.default_rng(12).uniform(0.01, 1.0, (2, 200))
    np.testing.assert_allclose(v_sheen(light, view, 0.3), v_sheen(view, light, 0.3), rtol=1e-14)


@pytest.mark.parametrize("alpha", [0.1, 0.3, 1.0])
@pytest.mark.parametrize("n_dot_v", [0.05, 0.4, 1.0])
def test_albedo_is_the_integral_over_all_light(n_dot_v: float, alpha: float) -> None:
    """On other nodes: even azimuths, and panels that shrink towards the horizon."""
    edges = np.concatenate([[0.0], np.geomspace(1e-9, 0.5, 30), [1.0]])
    nodes, weights = leggauss(16)
    half = np.diff(edges)[:, None] / 2.0
    n_dot_l = (edges[:-1, None] + half * (1.0 + nodes)).ravel()[:, None]
    turn = 2.0 * np.pi * np.arange(400) / 400
    v_dot_l = np.sqrt((1.0 - n_dot_v**2) * (1.0 - n_dot_l**2)) * np.cos(turn) + n_dot_v * n_dot_l
    n_dot_h = np.minimum((n_dot_v + n_dot_l) / np.sqrt(2.0 + 2.0 * v_dot_l), 1.0)
    sent = np.mean(d_charlie(n_dot_h, alpha) * v_sheen(n_dot_l, n_dot_v, alpha) * n_dot_l, axis=1)
    expected = 2.0 * np.pi * np.sum(sent * (half * weights).ravel())
    assert sheen_albedo(n_dot_v, np.sqrt(alpha)) == pytest.approx(expected, abs=ALBEDO_MAX_ABS)


def test_the_series_keeps_the_quadrature_between_its_nodes() -> None:
    g = np.random.default_rng(13)
    for alpha in (*np.exp(g.uniform(np.log(SHEEN_ALPHA_MIN), 0.0, 6)), SHEEN_ALPHA_MIN, 1.0):
        spread = np.exp(g.uniform(np.log(N_DOT_V_MIN), 0.0, 40))
        n_dot_v = np.concatenate([[N_DOT_V_MIN, 0.5, 1.0], spread])
        expected = np.clip(integrate_sheen(n_dot_v, alpha)[0], 0.0, 1.0)
        found = sheen_albedo(n_dot_v, np.sqrt(alpha))
        np.testing.assert_allclose(found, expected, rtol=0, atol=ALBEDO_MAX_ABS)


def test_fibres_and_what_lies_below_never_send_more_than_arrives() -> None:
    n_dot_v, roughness = np.meshgrid(np.linspace(0.0, 1.0, 60), np.linspace(0.0, 1.0, 60))
    albedo = sheen_albedo(n_dot_v, roughness)
    assert albedo.min() >= 0.0
    assert albedo.max() <= 1.0
    colour = np.array([1.0, 0.5, 0.2])
    passed = sheen_weight(colour, albedo)
    assert np.all(colour * albedo[..., None] + passed[..., None] <= 1.0 + 1e-15)


def test_black_fibres_let_everything_pass() -> None:
    assert sheen_weight(np.zeros(3), 0.7) == 1.0


def test_smooth_fibres_are_drawn_with_the_guard_s_roughness() -> None:
    np.testing.assert_array_equal(sheen_alpha([0.0, 0.01, 0.5]), [SHEEN_ALPHA_MIN, SHEEN_ALPHA_MIN, 0.25])
