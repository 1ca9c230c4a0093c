"""Facets drawn as a viewer sees them: in the density that they claim, which is the papers' own."""

from __future__ import annotations

from statistics import NormalDist

import numpy as np
import pytest
from numpy.testing import assert_allclose

from gltf_iri.optics.microfacet import d_ggx, d_ggx_anisotropic
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.optics.rough_bragg import facet_weight, g1_smith, transmission_filter
from gltf_iri.optics.visible_normals import draw_facet, facet_density, mirror_density, mirrored

DRAWN = 100_000
# One false alarm in ten thousand a test.
Z_MAX = NormalDist().inv_cdf(1.0 - 1e-4)

SIGHTS = [(1.0, 0.3), (0.6, 0.1), (0.5, 0.6), (0.1, 0.4), (0.02, 0.1), (0.7, 1.0)]


def view_of(cosine: float, count: int = 1, turn: float = 0.4) -> np.ndarray:
    sine = np.sqrt(1.0 - cosine * cosine)
    return np.tile([sine * np.cos(turn), sine * np.sin(turn), cosine], (count, 1))


def chi_square_z(counts: np.ndarray, expected: np.ndarray) -> float:
    """χ² as a standard normal (Wilson & Hilferty 1931); rare bins, and what no bin holds, are one bin."""
    rare = expected < 8.0
    counts, expected = (np.append(x[~rare], x[rare].sum()) for x in (counts, expected))
    kept = expected > 8.0
    degrees = kept.sum() - 1
    chi = np.sum((counts[kept] - expected[kept]) ** 2 / expected[kept]) / degrees
    spread = 2.0 / (9.0 * degrees)
    return float((np.cbrt(chi) - (1.0 - spread)) / np.sqrt(spread))


def facet_bins(
    cosine: float, widths: tuple[float, float], slopes: int, turns: int, gauss: int = 12
) -> np.ndarray:
    """Return the share of visible facets in bins of slope, tan θ = ᾱ tan x, and of turn, by quadrature."""
    nodes, weights = gauss_unit(gauss)
    x, w_x = (0.5 * np.pi / slopes) * (np.arange(slopes)[:, None] + nodes), 0.5 * np.pi / slopes * weights
    turn, w_turn = 2.0 * np.pi / turns * (np.arange(turns)[:, None] + nodes), 2.0 * np.pi / turns * weights
    mean = np.sqrt(widths[0] * widths[1])
    theta = np.arctan(mean * np.tan(x))
    jacobian = np.sin(theta) * mean * np.cos(theta) ** 2 / np.cos(x) ** 2
    grid = np.broadcast_arrays(theta[:, None, :, None], turn[None, :, None, :])
    facets = np.stack(
        [np.sin(grid[0]) * np.cos(grid[1]), np.sin(grid[0]) * np.sin(grid[1]), np.cos(grid[0])], axis=-1
    ).reshape(-1, 3)
    count = len(facets)
    density = facet_density(view_of(cosine, count), facets, *(np.full(count, a) for a in widths))
    density = density.reshape(slopes, turns, gauss, gauss) * jacobian[:, None, :, None]
    return np.einsum("stab,a,b->st", density, w_x, w_turn)


def drawn_facets(cosine: float, widths: tuple[float, float], seed: int = 5) -> np.ndarray:
    place = np.random.default_rng(seed).random((DRAWN, 2))
    return draw_facet(view_of(cosine, DRAWN), *(np.full(DRAWN, a) for a in widths), place)


def counted(facets: np.ndarray, widths: tuple[float, float], slopes: int, turns: int) -> np.ndarray:
    tangent = np.hypot(facets[:, 0], facets[:, 1]) / facets[:, 2]
    x = np.arctan(tangent / np.sqrt(widths[0] * widths[1]))
    turn = np.arctan2(facets[:, 1], facets[:, 0]) % (2.0 * np.pi)
    return np.histogram2d(x, turn, bins=[slopes, turns], range=[[0.0, 0.5 * np.pi], [0.0, 2.0 * np.pi]])[0]


@pytest.mark.parametrize(("cosine", "alpha"), SIGHTS)
def test_density_integrates_to_one(cosine: float, alpha: float) -> None:
    # Where facets begin to face away the density has a kink.
    assert_allclose(facet_bins(cosine, (alpha, alpha), 24, 24).sum(), 1.0, atol=3e-5)
    assert_allclose(facet_bins(cosine, (alpha, 0.5 * alpha), 24, 24).sum(), 1.0, atol=3e-5)


@pytest.mark.parametrize(("cosine", "alpha"), SIGHTS)
def test_facets_are_drawn_in_their_density(cosine: float, alpha: float) -> None:
    for widths in ((alpha, alpha), (alpha, 0.4 * alpha)):
        counts = counted(drawn_facets(cosine, widths), widths, 16, 16)
        assert abs(chi_square_z(counts, DRAWN * facet_bins(cosine, widths, 16, 16))) < Z_MAX


def test_chi_square_sees_a_roughness_that_is_four_percent_off() -> None:
    counts = counted(drawn_facets(0.6, (0.3, 0.3)), (0.312, 0.312), 16, 16)
    assert chi_square_z(counts, DRAWN * facet_bins(0.6, (0.312, 0.312), 16, 16)) > 2.0 * Z_MAX


def test_densities_are_the_papers_own() -> None:
    rng = np.random.default_rng(8)
    count = 1000
    alpha = rng.uniform(0.01, 1.0, count)
    view = np.concatenate([view_of(c, 1, t) for c, t in rng.uniform(0.0, 1.0, (count, 2))])
    facet = draw_facet(view, alpha, alpha, rng.random((count, 2)))
    seen = np.sum(view * facet, axis=1)
    sine_squared = facet[:, 0] ** 2 + facet[:, 1] ** 2
    expected = d_ggx(sine_squared, alpha) * g1_smith(view[:, 2], alpha) * seen / view[:, 2]
    assert_allclose(facet_density(view, facet, alpha, alpha), expected, rtol=1e-9)
    light = mirrored(view, facet)
    up = light[:, 2] > 1e-6
    # f·cosθ_o of facets that reflect everything is the density times what the way out masks.
    weight = facet_weight(sine_squared, view[:, 2], np.where(up, light[:, 2], 1.0), alpha) * light[:, 2]
    masked = mirror_density(view, light, alpha, alpha) * g1_smith(np.where(up, light[:, 2], 1.0), alpha)
    assert_allclose(masked[up], weight[up], rtol=1e-6)
    assert np.all(mirror_density(view, light, alpha, alpha)[light[:, 2] <= 0.0] == 0.0)
    assert_allclose(
        facet_density(view, facet, alpha, 0.5 * alpha) * (view[:, 2] + slant(view, alpha, 0.5 * alpha)),
        2.0 * d_ggx_anisotropic(facet[:, 0], facet[:, 1], alpha, 0.5 * alpha) * seen,
        rtol=1e-9,
    )


def slant(view: np.ndarray, along: np.ndarray, across: np.ndarray) -> np.ndarray:
    return np.linalg.norm(view * np.column_stack([along, across, np.ones_like(along)]), axis=1)


@pytest.mark.parametrize(("cosine", "alpha"), SIGHTS)
def test_angles_between_light_and_facets_follow_the_transmission_filter(cosine: float, alpha: float) -> None:
    facets = drawn_facets(cosine, (alpha, alpha), seed=6)
    angle = np.arccos(np.clip(np.sum(view_of(cosine, DRAWN) * facets, axis=1), -1.0, 1.0))
    edges = np.quantile(angle[DRAWN // 2 :], np.linspace(0.0, 1.0, 41))
    edges[[0, -1]] = 0.0, 0.5 * np.pi
    nodes, weights = gauss_unit(64)
    lengths = np.diff(edges)[:, None]
    density = transmission_filter(cosine, edges[:-1, None] + lengths * nodes, alpha) / g1_smith(cosine, alpha)
    share = np.sum(density * lengths * weights, axis=1)
    counts = np.histogram(angle[: DRAWN // 2], edges)[0]
    assert abs(chi_square_z(counts, DRAWN // 2 * share)) < Z_MAX


def test_smooth_surfaces_have_one_facet() -> None:
    place = np.random.default_rng(1).random((100, 2))
    facets = draw_facet(view_of(0.3, 100), np.zeros(100), np.zeros(100), place)
    assert_allclose(facets, np.tile([0.0, 0.0, 1.0], (100, 1)), atol=1e-15)


@pytest.mark.parametrize(("cosine", "alpha"), [(1.0, 0.3), (0.5, 0.6), (0.1, 0.4)])
def test_mirrored_light_that_stays_above_is_the_densitys_integral(cosine: float, alpha: float) -> None:
    facets = drawn_facets(cosine, (alpha, alpha), seed=7)
    above = np.mean(mirrored(view_of(cosine, DRAWN), facets)[:, 2] > 0.0)
    nodes, weights = gauss_unit(200)
    turn, w_turn = gauss_unit(200)
    z, phi = np.broadcast_arrays(nodes[:, None], 2.0 * np.pi * turn)
    sine = np.sqrt(1.0 - z * z)
    light = np.stack([sine * np.cos(phi), sine * np.sin(phi), z], axis=-1).reshape(-1, 3)
    width = np.full(len(light), alpha)
    density = mirror_density(view_of(cosine, len(light)), light, width, width).reshape(z.shape)
    integral = 2.0 * np.pi * np.einsum("ab,a,b->", density, weights, w_turn)
    assert abs(above - integral) < 4.0 * np.sqrt(integral * (1.0 - integral) / DRAWN) + 1e-4
