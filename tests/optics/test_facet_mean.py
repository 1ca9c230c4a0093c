"""The mean over facets against integrals over directions of light, and its laws."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from gltf_iri.optics.dfg import dfg_terms
from gltf_iri.optics.facet_mean import facet_cosines, facet_mean, mean_cosine
from gltf_iri.optics.microfacet import N_DOT_V_MIN, d_ggx, v_smith_ggx_correlated


def ripple(cosine: np.ndarray) -> np.ndarray:
    """A reflectance with two fringes, as a film's."""
    return np.stack([0.3 + 0.2 * np.cos(k * cosine) for k in (0.0, 6.0, 12.0)], axis=-1)


def over_lights(n_dot_v: float, alpha: float) -> np.ndarray:
    """∫F·D·V·(N·L) dω_l over ∫D·V·(N·L) dω_l on even azimuths: it shares no variable with the facets."""
    nodes, weights = leggauss(200)
    n_dot_l, share = (0.5 + 0.5 * nodes)[:, None], (0.5 * weights)[:, None] * (2.0 * np.pi / 1600)
    turn = 2.0 * np.pi * np.arange(1600) / 1600
    v_dot_l = np.sqrt((1.0 - n_dot_v**2) * (1.0 - n_dot_l**2)) * np.cos(turn) + n_dot_v * n_dot_l
    v_dot_h = np.sqrt(0.5 + 0.5 * v_dot_l)
    n_dot_h = (n_dot_v + n_dot_l) / (2.0 * v_dot_h)
    sent = d_ggx(1.0 - n_dot_h**2, alpha) * v_smith_ggx_correlated(n_dot_l, n_dot_v, alpha) * n_dot_l * share
    values = np.concatenate([ripple(v_dot_h), v_dot_h[..., None]], axis=-1)
    return np.sum(sent[..., None] * values, axis=(0, 1)) / sent.sum()


@pytest.mark.parametrize("roughness", [0.5, 0.75, 1.0])
@pytest.mark.parametrize("n_dot_v", [0.1, 0.4, 0.8, 1.0])
def test_the_mean_is_the_integral_over_all_light(n_dot_v: float, roughness: float) -> None:
    expected = over_lights(n_dot_v, roughness**2)
    cosines, weights = facet_cosines(n_dot_v, roughness**2)
    np.testing.assert_allclose(facet_mean(ripple(cosines), weights), expected[:3], rtol=0, atol=1e-5)
    assert mean_cosine(n_dot_v, roughness) == pytest.approx(expected[3], rel=0, abs=1e-6)


@pytest.mark.parametrize("alpha", [0.02, 0.6])
def test_the_mean_is_that_of_lights_drawn_at_random(alpha: float) -> None:
    # Heitz 2018, "Sampling the GGX Distribution of Visible Normals", appendix A.
    g = np.random.default_rng(4)
    n_dot_v, count = 0.2, 400_000
    view = np.array([np.sqrt(1.0 - n_dot_v**2), 0.0, n_dot_v])
    stretched = view * [alpha, alpha, 1.0]
    stretched /= np.linalg.norm(stretched)
    across = np.array([0.0, 1.0, 0.0])
    along = np.cross(stretched, across)
    radius, turn = np.sqrt(g.uniform(size=count)), g.uniform(0.0, 2.0 * np.pi, count)
    x, y = radius * np.cos(turn), radius * np.sin(turn)
    share = 0.5 * (1.0 + stretched[2])
    # The disk's far half shrinks to what is seen of the hemisphere.
    y = (1.0 - share) * np.sqrt(1.0 - x * x) + share * y
    normal = x[:, None] * across + y[:, None] * along
    normal += np.sqrt(np.maximum(0.0, 1.0 - x * x - y * y))[:, None] * stretched
    facet = normal * [alpha, alpha, 1.0]
    facet /= np.linalg.norm(facet, axis=1, keepdims=True)
    v_dot_h = facet @ view
    n_dot_l = 2.0 * v_dot_h * facet[:, 2] - n_dot_v
    slant_l = np.sqrt(alpha**2 + (1.0 - alpha**2) * n_dot_l**2)
    slant_v = np.sqrt(alpha**2 + (1.0 - alpha**2) * n_dot_v**2)
    passes = np.where(
        n_dot_l > 0.0, n_dot_l * (n_dot_v + slant_v) / (n_dot_l * slant_v + n_dot_v * slant_l), 0.0
    )
    cosines, weights = facet_cosines(n_dot_v, alpha)
    assert weights.sum() == pytest.approx(passes.mean(), rel=0, abs=2e-3)
    drawn = passes @ ripple(v_dot_h) / passes.sum()
    np.testing.assert_allclose(facet_mean(ripple(cosines), weights), drawn, rtol=0, atol=2e-3)


def test_weights_sum_to_what_a_white_mirror_sends() -> None:
    n_dot_v, roughness = np.meshgrid([N_DOT_V_MIN, 0.01, 0.2, 0.7, 1.0], [0.04, 0.2, 0.5, 1.0])
    _, weights = facet_cosines(n_dot_v, roughness**2)
    np.testing.assert_allclose(weights.sum(axis=-1), sum(dfg_terms(n_dot_v, roughness)), rtol=0, atol=1e-5)


def test_facets_of_a_white_reflectance_are_white() -> None:
    cosines, weights = facet_cosines(np.array([0.01, 0.5, 1.0]), 0.3)
    np.testing.assert_allclose(facet_mean(np.ones((*cosines.shape, 3)), weights), 1.0, rtol=1e-14)
    assert cosines.min() >= 0.0
    assert cosines.max() <= 1.0 + 1e-15
    assert weights.min() >= 0.0


def test_a_mirror_s_facets_are_seen_as_its_surface() -> None:
    n_dot_v = np.linspace(0.1, 1.0, 10)
    np.testing.assert_allclose(mean_cosine(n_dot_v, 0.0), n_dot_v, rtol=0, atol=1e-4)


def test_the_series_of_the_mean_cosine_keeps_the_quadrature_between_its_nodes() -> None:
    g = np.random.default_rng(5)
    for alpha in np.exp(g.uniform(np.log(1e-3), 0.0, 6)):
        n_dot_v = np.exp(g.uniform(np.log(N_DOT_V_MIN), 0.0, 30))
        cosines, weights = facet_cosines(n_dot_v, alpha, slopes=96, turns=32)
        expected = facet_mean(cosines[..., None], weights)[:, 0]
        np.testing.assert_allclose(mean_cosine(n_dot_v, np.sqrt(alpha)), expected, rtol=0, atol=1e-6)
