"""Light on layers is sent back, passed on or absorbed, and never more than there was."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_energy import layer_shares, sent_facets, stack_energy
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf, coating_reflectance
from gltf_iri.optics.rough_bragg import g1_smith

VISIBLE_NM = np.linspace(370.0, 800.0, 9)


@given(
    n2=st.floats(1.0, 2.6),
    d_nm=st.floats(20.0, 400.0),
    cells=st.integers(1, 12),
    alpha=st.sampled_from([0.0, 0.003, 0.05, 0.3, 1.0]),
    host=st.sampled_from([1.0, 1.4]),
    cosine=st.floats(0.0, 1.0),
)
@settings(max_examples=25, deadline=None)
def test_a_layer_never_gives_more_light_than_it_gets(
    n2: float, d_nm: float, cells: int, alpha: float, host: float, cosine: float
) -> None:
    shares = layer_shares(BraggLayer.of(1.4, n2, d_nm, 130.0, cells, alpha), host, cosine, VISIBLE_NM)
    # What quadrature adds: towards grazing angles the sum over facets keeps 1e-4 of narrow lobes.
    assert min(float(each.min()) for each in shares) >= -1e-3
    np.testing.assert_allclose(sum(shares), 1.0, atol=1e-12)


@pytest.mark.parametrize(
    ("alpha", "degrees", "printed"), [(0.4, 0.0, 0.79), (0.1, 80.0, 0.96), (0.4, 80.0, 1.21)]
)
def test_the_transmissions_loss_is_not_the_layers_absorption(
    alpha: float, degrees: float, printed: float
) -> None:
    """Of facets that mirror all, reflected and Eq. 30's loss do not add up to 1; ours is what is left."""
    cosine = float(np.cos(np.radians(degrees)))
    albedo = float(sent_facets(cosine, alpha)[2].sum())
    assert albedo + 1.0 - float(g1_smith(cosine, alpha)) == pytest.approx(printed, abs=0.005)
    assert 0.0 < albedo < 1.0


@pytest.mark.parametrize("alpha", [0.1, 0.4, 1.0])
@pytest.mark.parametrize("cosine", [0.1, 0.5, 1.0])
def test_the_albedo_of_facets_that_mirror_all_is_the_visible_normals_integral(
    alpha: float, cosine: float
) -> None:
    """∫ D_v G₁(o) over visible normals drawn by Heitz's 2018 map of a disc, an even rule on the disc."""
    n = 200
    radius = np.sqrt((np.polynomial.legendre.leggauss(n)[0] + 1.0) * 0.5)
    radius_weights = np.polynomial.legendre.leggauss(n)[1] * 0.5
    turn = (np.arange(n) + 0.5) * 2.0 * np.pi / n
    r, phi = radius[:, None], turn[None, :]
    sine = np.sqrt(1.0 - cosine * cosine)
    stretched = np.array([alpha * sine, 0.0, cosine]) / np.hypot(alpha * sine, cosine)
    first, second = np.array([0.0, 1.0, 0.0]), np.cross(stretched, [0.0, 1.0, 0.0])
    t_1, t_2 = r * np.cos(phi), r * np.sin(phi)
    share = 0.5 * (1.0 + stretched[2])
    t_2 = (1.0 - share) * np.sqrt(1.0 - t_1 * t_1) + share * t_2
    above = np.sqrt(np.maximum(1.0 - t_1 * t_1 - t_2 * t_2, 0.0))
    sign = -1.0 if second[2] < 0.0 else 1.0
    hemisphere = t_1[..., None] * first + sign * t_2[..., None] * second + above[..., None] * stretched
    normal = hemisphere * [alpha, alpha, 1.0]
    normal[..., 2] = np.maximum(normal[..., 2], 0.0)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    light = np.array([sine, 0.0, cosine])
    cos_o = 2.0 * (normal @ light) * normal[..., 2] - cosine
    masked = np.where(cos_o > 0.0, g1_smith(np.maximum(cos_o, 0.0), alpha), 0.0)
    drawn = float((radius_weights[:, None] * masked).sum() / n)
    found = float(sent_facets(cosine, alpha)[2].sum())
    # The disc's edge and the horizon are not smooth to an even rule.
    assert found == pytest.approx(drawn, abs=5e-4)
    finer = float(sent_facets(cosine, alpha, slopes=96, turns=32)[2].sum())
    assert found == pytest.approx(finer, abs=5e-9)


def test_what_a_stack_sends_is_its_brdf_over_the_hemisphere() -> None:
    """In air and under a coating, by a plain sum over directions."""
    t, weights = (np.polynomial.legendre.leggauss(32)[k] for k in (0, 1))
    cos_o, phi = 0.5 * (t + 1.0), 0.5 * np.pi * (t + 1.0)
    for host, bound in ((1.0, 1e-4), (1.35, 6e-3)):
        layer = BraggLayer.of(host, 1.7, 100.0, 130.0, 2, 0.5)
        stack = LayerStack.of((layer,), host, LayerBase.of([0.7, 0.5, 0.2], 0.9, 0.3, 0.5))
        colours = layer_colours("layers-single-table", stack, parameters={"nodes": 256, "wavelengths": 64})
        values = brdf(stack, Pose.of(0.7, cos_o[:, None], np.cos(phi)), colours)
        sums = np.einsum("a,b,abc->c", weights * cos_o * 0.5, weights * np.pi, values)
        found = stack_energy(stack, 0.7, colours)
        np.testing.assert_allclose(found.reflected[0] - coating_reflectance(host, 0.7), sums, atol=bound)


def test_a_white_furnace_is_not_left_brighter() -> None:
    """Over a white base, of two layers, in luminance: what is sent back and passed on is at most all."""
    layers = tuple(BraggLayer.of(1.0, 1.6, d, 120.0, 2, 0.2) for d in (100.0, 140.0))
    stack = LayerStack.of(layers, 1.0, LayerBase.of(1.0))
    energy = stack_energy(stack, [0.05, 0.7], layer_colours("layers-single", stack))
    luminance = np.array([0.2126, 0.7152, 0.0722])
    assert np.all(energy.reflected @ luminance <= 1.0)
    assert np.all(energy.absorbed @ luminance >= 0.0)
    assert np.all(energy.from_base @ luminance <= energy.transmitted @ luminance)


def test_a_smooth_layer_in_its_host_keeps_nothing() -> None:
    smooth = BraggLayer.of(1.0, 1.5, 120.0, 100.0, 4, 0.0)
    stack = LayerStack.of((smooth,), 1.0)
    energy = stack_energy(stack, [0.2, 0.9], layer_colours("layers-single", stack))
    np.testing.assert_allclose(energy.absorbed, 0.0, atol=1e-8)
    shares = layer_shares(smooth, 1.0, [0.2, 0.9], VISIBLE_NM)
    np.testing.assert_allclose(shares.absorbed, 0.0, atol=1e-12)


def test_nothing_under_a_coating_is_the_coating_alone() -> None:
    stack = LayerStack.of((), 1.5)
    energy = stack_energy(stack, [1.0, 0.3], layer_colours("layers-single", stack))
    np.testing.assert_allclose(energy.reflected[0], 0.04, atol=1e-12)
    np.testing.assert_allclose(energy.reflected + energy.transmitted, 1.0, atol=1e-12)


def test_shares_of_many_layers_at_once_are_refused() -> None:
    many = BraggLayer.of(1.0, 1.5, [100.0, 120.0], 100.0, 4, 0.1)
    with pytest.raises(UsageError, match="one layer"):
        layer_shares(many, 1.0, 0.5, 500.0)
    with pytest.raises(UsageError, match="one stack"):
        stack_energy(LayerStack.of((many,)), 0.5, layer_colours("layers-single", LayerStack.of(())))
