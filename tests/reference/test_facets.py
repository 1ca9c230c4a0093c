"""Drawn facets against the distribution they stand for, and bending against Snell's law in angles."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from gltf_iri.optics.microfacet import d_ggx, v_smith_ggx_correlated
from gltf_iri.reference.facets import Axes, draw_facet, mirror_density, mirrored, refracted, shadowing_ratio
from gltf_iri.reference.low_discrepancy import net, shifted


def _views(cosine: float, count: int) -> np.ndarray:
    sine = np.sqrt(1 - cosine**2)
    return np.tile([sine * np.cos(0.4), sine * np.sin(0.4), cosine], (count, 1))


@pytest.mark.parametrize("cosine", [1.0, 0.6, 0.1])
@pytest.mark.parametrize(("across", "along"), [(0.1, 0.1), (0.5, 0.5), (0.7, 0.2)])
def test_mirrored_directions_lie_as_their_density_says(cosine: float, across: float, along: float) -> None:
    """Moments of the drawn directions against the density integrated over the hemisphere."""
    count = 1 << 12
    places = shifted(net(count), np.random.default_rng(7), 1)[0]
    width_t, width_b = np.full(count, across), np.full(count, along)
    view = _views(cosine, count)
    drawn = mirrored(view, draw_facet(view, width_t, width_b, places))
    drawn = drawn[drawn[:, 2] > 0]

    # Midpoints in azimuth and in the mirror's own angle, fine enough for the narrowest of these lobes.
    polar, azimuth = np.meshgrid((np.arange(600) + 0.5) / 600 * np.pi / 2, (np.arange(720) + 0.5) / 720)
    polar, azimuth = polar.ravel(), 2 * np.pi * azimuth.ravel()
    grid = np.column_stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)])
    solid_angle = np.sin(polar) * (np.pi / 2 / 600) * (2 * np.pi / 720)
    ones = np.ones(len(grid))
    density = mirror_density(_views(cosine, len(grid)), grid, across * ones, along * ones)
    mass = density * solid_angle
    assert_allclose(len(drawn) / count, mass.sum(), atol=3e-3)
    assert_allclose(drawn.sum(axis=0) / count, mass @ grid, atol=3e-3)
    assert_allclose(drawn.T @ drawn / count, (grid * mass[:, None]).T @ grid, atol=3e-3)


@pytest.mark.parametrize("alpha", [0.001, 0.1, 0.8])
def test_lobe_over_density_is_the_shadowing(alpha: float) -> None:
    rng = np.random.default_rng(8)
    count = 200
    view, light = (np.abs(rng.normal(size=(count, 3))) + 0.01 for _ in range(2))
    view /= np.linalg.norm(view, axis=1)[:, None]
    light /= np.linalg.norm(light, axis=1)[:, None]
    half = view + light
    half /= np.linalg.norm(half, axis=1)[:, None]
    sine_squared = half[:, 0] ** 2 + half[:, 1] ** 2
    lobe = d_ggx(sine_squared, alpha) * v_smith_ggx_correlated(light[:, 2], view[:, 2], alpha) * light[:, 2]
    width = np.full(count, alpha)
    ratio = lobe / mirror_density(view, light, width, width)
    assert_allclose(shadowing_ratio(view, light, width, width, is_mirrored=True), ratio, rtol=1e-9)


def test_light_is_bent_by_snells_angles() -> None:
    angle = np.linspace(0, 1.5, 40)
    normal = np.tile([0.0, 0.0, 1.0], (40, 1))
    view = np.column_stack([np.sin(angle), np.zeros(40), np.cos(angle)])
    direction, squared = refracted(view, normal, np.full(40, 1 / 1.5))
    inside = np.arcsin(np.sin(angle) / 1.5)
    assert_allclose(direction, np.column_stack([-np.sin(inside), np.zeros(40), -np.cos(inside)]), atol=1e-12)
    assert_allclose(squared, np.cos(inside) ** 2, atol=1e-12)


def test_light_is_bent_back_by_the_way_out() -> None:
    view = _views(0.3, 1)
    normal = np.array([[0.0, 0.0, 1.0]])
    inside, _ = refracted(view, normal, np.array([1 / 1.7]))
    outside, _ = refracted(inside, -normal, np.array([1.7]))
    assert_allclose(outside, view, atol=1e-12)


def test_nothing_leaves_beyond_the_critical_angle() -> None:
    cosine = np.sqrt(1 - (1 / 1.5) ** 2)
    view = np.concatenate([_views(cosine + 1e-6, 1), _views(cosine - 1e-6, 1)])
    squared = refracted(view, np.tile([0.0, 0.0, 1.0], (2, 1)), np.array([1.5, 1.5]))[1]
    assert squared[0] > 0 > squared[1]


def test_axes_follow_the_tangent_and_stand_upright() -> None:
    rng = np.random.default_rng(9)
    normal = rng.normal(size=(50, 3))
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    tangent = rng.normal(size=(50, 3))
    tangent[::2] = 0.0
    axes = Axes.around(normal, tangent)
    frames = np.stack([axes.tangent, axes.bitangent, axes.normal], axis=1)
    assert_allclose(frames @ frames.transpose(0, 2, 1), np.tile(np.eye(3), (50, 1, 1)), atol=1e-12)
    assert_allclose(np.linalg.det(frames), 1.0)
    assert np.all(np.sum(axes.tangent[1::2] * tangent[1::2], axis=1) > 0)
    assert_allclose(axes.to_world(axes.to_local(tangent)), tangent, atol=1e-12)
