"""The DFG terms against a quadrature over directions of light, which shares no variable with theirs."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from gltf_iri.optics.dfg import dfg_terms, integrate_dfg
from gltf_iri.optics.microfacet import ALPHA_MIN, N_DOT_V_MIN, d_ggx, v_smith_ggx_correlated

# The series' own error and the quadrature's it was made from, both measured against twice the nodes.
SERIES_MAX_ABS = 1e-7


def over_lights(n_dot_v: float, alpha: float) -> np.ndarray:
    """A and B as ∫ D·V·(N·L) {1 − Fc, Fc} dω_l on evenly spaced azimuths; for lobes wider than the nodes."""
    nodes, weights = leggauss(200)
    n_dot_l, share = (0.5 + 0.5 * nodes)[:, None], (0.5 * weights)[:, None] * (2.0 * np.pi / 1600)
    turn = 2.0 * np.pi * np.arange(1600) / 1600
    v_dot_l = np.sqrt((1.0 - n_dot_v**2) * (1.0 - n_dot_l**2)) * np.cos(turn) + n_dot_v * n_dot_l
    v_dot_h = np.sqrt(0.5 + 0.5 * v_dot_l)
    n_dot_h = (n_dot_v + n_dot_l) / (2.0 * v_dot_h)
    sent = d_ggx(1.0 - n_dot_h**2, alpha) * v_smith_ggx_correlated(n_dot_l, n_dot_v, alpha) * n_dot_l * share
    grazing = (1.0 - v_dot_h) ** 5
    return np.array([np.sum(sent * (1.0 - grazing)), np.sum(sent * grazing)])


@pytest.mark.parametrize("roughness", [0.5, 0.75, 1.0])
@pytest.mark.parametrize("n_dot_v", [0.1, 0.4, 0.8, 1.0])
def test_terms_are_the_integral_over_all_light(n_dot_v: float, roughness: float) -> None:
    found = np.array(dfg_terms(n_dot_v, roughness))
    np.testing.assert_allclose(found, over_lights(n_dot_v, roughness**2), rtol=0, atol=SERIES_MAX_ABS)


def test_the_series_keeps_the_quadrature_between_its_nodes() -> None:
    g = np.random.default_rng(11)
    alphas = np.exp(g.uniform(np.log(ALPHA_MIN), 0.0, 12))
    for alpha in (*alphas, ALPHA_MIN, 1.0):
        n_dot_v = np.concatenate([[N_DOT_V_MIN, 1.0], np.exp(g.uniform(np.log(N_DOT_V_MIN), 0.0, 40))])
        found = np.array(dfg_terms(n_dot_v, np.sqrt(alpha)))
        np.testing.assert_allclose(found, integrate_dfg(n_dot_v, alpha), rtol=0, atol=SERIES_MAX_ABS)


def test_a_mirror_has_schlick_s_terms() -> None:
    n_dot_v = np.linspace(0.2, 1.0, 20)
    a, b = dfg_terms(n_dot_v, 0.0)
    # α = ALPHA_MIN blurs Fc by the order of α over the cosine.
    np.testing.assert_allclose(b, (1.0 - n_dot_v) ** 5, rtol=0, atol=1e-4)
    np.testing.assert_allclose(a + b, 1.0, rtol=0, atol=1e-4)


def test_no_mirror_sends_more_than_arrives() -> None:
    n_dot_v, roughness = np.meshgrid(np.linspace(0.0, 1.0, 60), np.linspace(0.0, 1.0, 60))
    a, b = dfg_terms(n_dot_v, roughness)
    assert a.shape == (60, 60)
    assert a.min() >= 0.0
    assert b.min() >= -SERIES_MAX_ABS
    assert (a + b).max() <= 1.0 + SERIES_MAX_ABS


def test_cosines_below_the_guard_read_as_the_guard() -> None:
    np.testing.assert_array_equal(dfg_terms(0.0, 0.5), dfg_terms(N_DOT_V_MIN, 0.5))


def test_points_that_repeat_have_the_terms_that_they_have_alone() -> None:
    g = np.random.default_rng(12)
    n_dot_v, roughness = g.uniform(size=(2, 50))
    n_dot_v[1::2] = n_dot_v[::2]  # neighbours that differ in roughness alone
    times = g.integers(1, 9, 50)
    alone = np.stack([dfg_terms(*point) for point in zip(n_dot_v, roughness, strict=True)], axis=1)
    repeated = np.array(dfg_terms(np.repeat(n_dot_v, times), np.repeat(roughness, times)))
    np.testing.assert_allclose(repeated, np.repeat(alone, times, axis=1), rtol=0, atol=1e-13)
    assert np.shape(dfg_terms(np.zeros(0), 0.5)) == (2, 0)
