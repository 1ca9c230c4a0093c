"""The facets' distribution and masking, against their definitions and an independent quadrature."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss

from gltf_iri.optics.microfacet import (
    ALPHA_MIN,
    anisotropic_alphas,
    d_ggx,
    d_ggx_anisotropic,
    v_smith_ggx_anisotropic,
    v_smith_ggx_correlated,
)

ALPHAS = (ALPHA_MIN, 0.04, 0.25, 1.0)


def hemisphere_nodes(alpha: float) -> tuple[np.ndarray, np.ndarray]:
    """1 − cosθ and the weights of ∫ … dω with φ integrated, on panels that resolve a lobe of width α."""
    edges = np.concatenate([[0.0], np.geomspace(1e-3 * alpha**2, 1.0, 40)])
    nodes, weights = leggauss(24)
    half = np.diff(edges)[:, None] / 2.0
    return (edges[:-1, None] + half * (1.0 + nodes)).ravel(), 2.0 * np.pi * (half * weights).ravel()


@pytest.mark.parametrize("alpha", ALPHAS)
def test_projected_facets_cover_the_surface_once(alpha: float) -> None:
    versine, weights = hemisphere_nodes(alpha)
    facets = d_ggx(versine * (2.0 - versine), alpha)
    assert np.sum(facets * (1.0 - versine) * weights) == pytest.approx(1.0, rel=1e-12)


def test_roughness_one_spreads_facets_evenly() -> None:
    np.testing.assert_allclose(d_ggx(np.linspace(0, 1, 7), 1.0), 1.0 / np.pi, rtol=1e-15)


@pytest.mark.parametrize("alpha", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("cosine", [0.05, 0.4, 0.9])
def test_visible_facets_project_to_the_surface_seen(alpha: float, cosine: float) -> None:
    """Heitz 2014, Eq. 11: ∫ G1 max(V·H, 0) D dω = N·V defines the masking.

    With one direction at grazing incidence taken out, the correlated visibility holds G1: for L along the
    normal no shadowing is left, so 4 N·L N·V · V_correlated(1, N·V) = G1(V).
    """
    masking = 4.0 * cosine * v_smith_ggx_correlated(1.0, cosine, alpha)
    versine, weights = hemisphere_nodes(alpha)
    sine_squared = (versine * (2.0 - versine))[:, None]
    azimuth = (np.arange(1000) + 0.5) * 2 * np.pi / 1000
    v_dot_h = np.sqrt(sine_squared * (1 - cosine**2)) * np.cos(azimuth) + (1 - versine[:, None]) * cosine
    seen = np.mean(np.maximum(v_dot_h, 0.0), axis=1)
    total = np.sum(d_ggx(sine_squared[:, 0], alpha) * seen * weights)
    assert masking * total == pytest.approx(cosine, rel=2e-5)


def test_visibility_is_reciprocal() -> None:
    light, view = np.random.default_rng(3).uniform(0.01, 1.0, (2, 200))
    np.testing.assert_allclose(
        v_smith_ggx_correlated(light, view, 0.3), v_smith_ggx_correlated(view, light, 0.3), rtol=1e-14
    )


def test_correlation_shadows_less_than_independent_masking() -> None:
    """Heitz 2014, §6.4: 1/(1 + Λl + Λv) ≥ 1/((1 + Λl)(1 + Λv)), and it equals the former."""
    alpha = 0.35
    light, view = np.random.default_rng(4).uniform(0.01, 1.0, (2, 200))

    def lam(cosine: np.ndarray) -> np.ndarray:
        return 0.5 * (np.sqrt(1.0 + alpha**2 * (1.0 / cosine**2 - 1.0)) - 1.0)

    joint = 4.0 * light * view * v_smith_ggx_correlated(light, view, alpha)
    np.testing.assert_allclose(joint, 1.0 / (1.0 + lam(light) + lam(view)), rtol=1e-12)
    assert np.all(joint >= 1.0 / ((1.0 + lam(light)) * (1.0 + lam(view))))


@pytest.mark.parametrize("alpha", [0.2, 0.6, 1.0])
def test_white_facets_reflect_no_more_than_they_receive(alpha: float) -> None:
    """Directional albedo with F = 1, by quadrature over the outgoing hemisphere."""
    view_cosine = 0.6
    nodes, weights = leggauss(200)
    cosine = 0.5 * (nodes + 1.0)
    azimuth = (np.arange(400) + 0.5) * 2 * np.pi / 400
    light = np.stack(
        np.broadcast_arrays(
            np.sqrt(1 - cosine**2)[:, None] * np.cos(azimuth),
            np.sqrt(1 - cosine**2)[:, None] * np.sin(azimuth),
            cosine[:, None],
        ),
        axis=-1,
    )
    half = light + np.array([np.sqrt(1 - view_cosine**2), 0.0, view_cosine])
    half /= np.linalg.norm(half, axis=-1, keepdims=True)
    brdf = d_ggx(half[..., 0] ** 2 + half[..., 1] ** 2, alpha) * v_smith_ggx_correlated(
        cosine[:, None], view_cosine, alpha
    )
    albedo = np.sum(np.mean(brdf, axis=1) * 2 * np.pi * cosine * 0.5 * weights)
    assert 0.4 < albedo < 1.0


def random_directions(count: int, seed: int) -> np.ndarray:
    """Unit vectors of the upper hemisphere, (count, 3)."""
    g = np.random.default_rng(seed)
    cosine, turn = g.uniform(0.01, 1.0, count), g.uniform(0.0, 2.0 * np.pi, count)
    sine = np.sqrt(1.0 - cosine**2)
    return np.stack([sine * np.cos(turn), sine * np.sin(turn), cosine], axis=-1)


def anisotropic_visibility(light: np.ndarray, view: np.ndarray, alpha_t: float, alpha_b: float) -> np.ndarray:
    return v_smith_ggx_anisotropic(
        light[:, 2], view[:, 2], light[:, 0], light[:, 1], view[:, 0], view[:, 1], alpha_t, alpha_b
    )


@pytest.mark.parametrize("alpha", ALPHAS)
def test_equal_roughness_along_and_across_is_isotropic(alpha: float) -> None:
    half, light, view = (random_directions(500, seed) for seed in (5, 6, 7))
    sine_squared = half[:, 0] ** 2 + half[:, 1] ** 2
    np.testing.assert_array_equal(
        d_ggx_anisotropic(half[:, 0], half[:, 1], alpha, alpha), d_ggx(sine_squared, alpha)
    )
    np.testing.assert_allclose(
        anisotropic_visibility(light, view, alpha, alpha),
        v_smith_ggx_correlated(light[:, 2], view[:, 2], alpha),
        rtol=1e-14,
    )


@pytest.mark.parametrize(("alpha_t", "alpha_b"), [(0.3, 0.3), (1.0, 0.2), (0.05, 0.4), (1.0, ALPHA_MIN)])
def test_stretched_facets_cover_the_surface_once(alpha_t: float, alpha_b: float) -> None:
    """∫ D (N·H) dω over H = normalize(α_t x, α_b y, 1) of the plane: dω = (N·H)³ α_t α_b dx dy."""
    nodes, weights = leggauss(200)
    turn = 0.5 * np.pi * (0.5 + 0.5 * nodes)  # r = tan turn
    x = np.tan(turn)[:, None] * np.cos(2.0 * np.pi * np.arange(64) / 64)
    y = np.tan(turn)[:, None] * np.sin(2.0 * np.pi * np.arange(64) / 64)
    cosine = 1.0 / np.sqrt(1.0 + (alpha_t * x) ** 2 + (alpha_b * y) ** 2)
    facets = d_ggx_anisotropic(alpha_t * x * cosine, alpha_b * y * cosine, alpha_t, alpha_b)
    area = (np.tan(turn) / np.cos(turn) ** 2 * weights * 0.25 * np.pi)[:, None] * (2.0 * np.pi / 64)
    # Deep in the lobe's tail (N·H)² = 1 − (T·H)² − (B·H)² keeps twelve digits of sixteen at α = 0.001.
    assert np.sum(facets * cosine**4 * alpha_t * alpha_b * area) == pytest.approx(1.0, rel=1e-9)


def test_stretched_facets_are_reciprocal() -> None:
    light, view = random_directions(500, 8), random_directions(500, 9)
    np.testing.assert_allclose(
        anisotropic_visibility(light, view, 0.9, 0.1),
        anisotropic_visibility(view, light, 0.9, 0.1),
        rtol=1e-14,
    )


def test_a_quarter_turn_swaps_the_two_roughnesses() -> None:
    half = random_directions(500, 10)
    np.testing.assert_allclose(
        d_ggx_anisotropic(half[:, 0], half[:, 1], 0.8, 0.1),
        d_ggx_anisotropic(-half[:, 1], half[:, 0], 0.1, 0.8),
        rtol=1e-14,
    )


def test_strength_stretches_along_the_tangent_only() -> None:
    alpha_t, alpha_b = anisotropic_alphas(0.09, [0.0, 0.5, 1.0])
    np.testing.assert_allclose(alpha_t, [0.09, 0.09 * 0.75 + 0.25, 1.0], rtol=1e-15)
    np.testing.assert_array_equal(alpha_b, [0.09, 0.09, 0.09])
