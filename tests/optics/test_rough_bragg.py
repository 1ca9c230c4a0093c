"""The rough layer's filter: its closed form, its integral, and its weights on fixed angles."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from gltf_iri.optics.bragg import bragg_reflectance
from gltf_iri.optics.filter_panels import FilterPanels
from gltf_iri.optics.layer_lobe import layer_lobe
from gltf_iri.optics.microfacet import d_ggx
from gltf_iri.optics.rough_bragg import facet_weight, filter_nodes, g1_smith, transmission_filter

Float64 = NDArray[np.float64]

ALPHAS = (0.005, 0.05, 0.1, 0.4, 1.0)


def adaptive(function: Callable[[Float64], Float64], edges: list[float]) -> float:
    """Return ∫ function by Gauss points, of panels halved until no half differs by 1e-14 from its whole."""
    nodes, weights = np.polynomial.legendre.leggauss(12)

    def panel(low: float, high: float) -> float:
        return float(function(low + 0.5 * (high - low) * (nodes + 1.0)) @ weights) * 0.5 * (high - low)

    total, todo = 0.0, list(pairwise(edges))
    while todo:
        low, high = todo.pop()
        middle = 0.5 * (low + high)
        whole, halves = panel(low, high), panel(low, middle) + panel(middle, high)
        if abs(whole - halves) <= 1e-14 or high - low < 1e-12:
            total += halves
        else:
            todo += [(low, middle), (middle, high)]
    return total


def kernel(cos_i: float, theta_d: float, psi: float, alpha: float) -> float:
    """Return the integrand of Eq. 29 over ψ, written as the paper has it."""
    sin_i = np.sqrt(1.0 - cos_i * cos_i)
    cos_m = cos_i * np.cos(theta_d) + sin_i * np.sin(theta_d) * np.cos(psi)
    if cos_m <= 0.0:
        return 0.0
    tan2 = 1.0 / cos_m**2 - 1.0
    density = alpha**2 / (np.pi * cos_m**4 * (alpha**2 + tan2) ** 2)
    g1 = 2.0 / (1.0 + np.sqrt(1.0 + alpha**2 * sin_i**2 / cos_i**2))
    return float(2.0 * g1**2 * np.cos(theta_d) * np.sin(theta_d) / cos_i * density)


@pytest.mark.parametrize("alpha", ALPHAS)
@pytest.mark.parametrize("cos_i", [0.02, 0.3, 0.8, 1.0])
def test_the_filter_integrates_to_the_masking(alpha: float, cos_i: float) -> None:
    """Appendix C, by adaptive quadrature that knows nothing of the panels."""
    theta_i = np.arccos(cos_i)
    marks = {theta_i, 0.5 * np.pi - theta_i}
    marks |= {m + s * alpha * w for m in (theta_i,) for s in (-1, 1) for w in (1.0, 5.0, 25.0)}
    inside = sorted(m for m in marks if 0.0 < m < 0.5 * np.pi)
    edges = [0.0, *inside, 0.5 * np.pi]
    total = adaptive(lambda d: transmission_filter(cos_i, d, alpha), edges)
    assert abs(total - float(g1_smith(cos_i, alpha))) <= 1e-10


@pytest.mark.parametrize("alpha", [0.05, 0.4, 1.0])
@pytest.mark.parametrize(("cos_i", "theta_d"), [(0.1, 0.4), (0.5, 1.0), (0.9, 0.2), (0.3, 1.5)])
def test_the_closed_form_is_equation_29(alpha: float, cos_i: float, theta_d: float) -> None:
    sin_i = np.sqrt(1.0 - cos_i * cos_i)
    limit = -cos_i * np.cos(theta_d) / (sin_i * np.sin(theta_d))
    psi_max = np.arccos(max(limit, -1.0))
    direct = adaptive(np.vectorize(lambda psi: kernel(cos_i, theta_d, psi, alpha)), [0.0, psi_max])
    assert float(transmission_filter(cos_i, theta_d, alpha)) == pytest.approx(direct, rel=1e-10)


@pytest.mark.parametrize(
    ("alpha", "cos_i", "theta_d"), [(1e-3, 0.6, 0.9273), (1e-3, 0.2, 1.5), (0.3, 0.7, 1.2)]
)
def test_the_closed_form_keeps_its_digits(alpha: float, cos_i: float, theta_d: float) -> None:
    """Against 40 digits, at the peak of a narrow filter, beside the horizon and far from either."""
    with mpmath.workdps(40):
        a, c, d = (mpmath.mpf(x) for x in (alpha, cos_i, theta_d))
        s = mpmath.sqrt(1 - c * c)
        limit = -c * mpmath.cos(d) / (s * mpmath.sin(d))
        psi_max = mpmath.acos(limit) if limit > -1 else mpmath.pi

        def density(psi: mpmath.mpf) -> mpmath.mpf:
            u = c * mpmath.cos(d) + s * mpmath.sin(d) * mpmath.cos(psi)
            return a**2 / (mpmath.pi * (1 - (1 - a * a) * u * u) ** 2)

        marks = [0, *[m for m in (a, 10 * a, 100 * a) if m < psi_max], psi_max]
        g1 = 2 * c / (c + mpmath.sqrt(a * a + (1 - a * a) * c * c))
        exact = 2 * g1**2 * mpmath.cos(d) * mpmath.sin(d) / c * mpmath.quad(density, marks)
    assert float(transmission_filter(cos_i, theta_d, alpha)) == pytest.approx(float(exact), rel=1e-9)


@given(st.floats(0.0, 1.0), st.floats(1e-4, 1.0))
@settings(max_examples=60, deadline=None)
def test_weights_of_either_rule_add_up_to_the_masking(cos_i: float, alpha: float) -> None:
    expected = float(g1_smith(max(cos_i, 1e-9), alpha))
    # Nodes of its own lose 1e-7 where the light grazes by no more than α; weights on panels do not.
    assert abs(filter_nodes(cos_i, alpha, count=64)[1].sum() - expected) <= 1e-6
    assert abs(FilterPanels.of(12).weights(np.array([cos_i]), alpha).sum() - expected) <= 1e-11


@pytest.mark.parametrize("alpha", [0.002, 0.02, 0.6])
def test_fixed_angles_filter_fringes_as_angles_of_their_own_do(alpha: float) -> None:
    panels, cosines = FilterPanels.of(64), np.array([0.03, 0.3, 0.7, 1.0])

    def passed(cos_d: Float64) -> Float64:
        return 1.0 - bragg_reflectance(1.0, 1.0, 1.5, 120.0, 120.0, 3, 471.0, cos_d)

    nodes, weights = filter_nodes(cosines, alpha, count=200)
    direct = (weights * passed(nodes)).sum(axis=-1)
    np.testing.assert_allclose(panels.weights(cosines, alpha) @ passed(panels.cosines), direct, atol=1e-9)


def test_a_smooth_layer_takes_light_at_its_own_angle() -> None:
    cosines, weights = filter_nodes(0.37, 0.0)
    np.testing.assert_allclose(cosines, 0.37)
    assert weights.sum() == pytest.approx(1.0, abs=1e-15)
    narrow, shares = filter_nodes(0.37, 1e-5)
    assert (narrow * shares).sum() == pytest.approx(0.37, abs=1e-4)


def test_the_lobe_integrates_to_what_is_neither_masked_nor_shadowed() -> None:
    """Over the hemisphere by Gauss points, against the lobe's own points."""
    alpha, cos_i = 0.4, 0.6
    sin_i = np.sqrt(1.0 - cos_i**2)

    nodes, weights = np.polynomial.legendre.leggauss(160)
    cos_o, phi = 0.5 * (nodes[:, None] + 1.0), 0.5 * np.pi * (nodes + 1.0)
    sin_o = np.sqrt(1.0 - cos_o**2)
    half = np.stack(np.broadcast_arrays(sin_i + sin_o * np.cos(phi), sin_o * np.sin(phi), cos_i + cos_o))
    half /= np.linalg.norm(half, axis=0)
    sent = facet_weight(half[0] ** 2 + half[1] ** 2, cos_i, cos_o, alpha) * cos_o
    direct = float(weights @ sent @ weights) * 0.5 * np.pi
    assert float(layer_lobe(cos_i, alpha, angles=32, turns=32)[1].sum()) == pytest.approx(direct, abs=1e-9)


def test_the_lobe_is_the_density_of_facets_and_the_separable_masking() -> None:
    i, o, sine_squared, alpha = 0.7, 0.4, 0.13, 0.25
    written = d_ggx(sine_squared, alpha) * g1_smith(i, alpha) * g1_smith(o, alpha) / (4.0 * i * o)
    assert float(facet_weight(sine_squared, i, o, alpha)) == pytest.approx(float(written), rel=1e-14)
