"""Light on layers is sent back, passed on or absorbed, and never more than there was."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_energy import layer_shares, stack_energy
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayerStack, Pose, brdf, coating_reflectance
from gltf_iri.optics.layer_lobe import layer_lobe
from gltf_iri.optics.rough_bragg import g1_smith

VISIBLE_NM = np.linspace(370.0, 800.0, 9)


@pytest.mark.parametrize(
    ("alpha", "degrees", "printed"), [(0.4, 0.0, 0.79), (0.1, 80.0, 0.96), (0.4, 80.0, 1.21)]
)
def test_the_transmissions_loss_is_not_the_layers_absorption(
    alpha: float, degrees: float, printed: float
) -> None:
    """Of facets that mirror all, reflected and Eq. 30's loss do not add up to 1; ours is what is left."""
    cosine = float(np.cos(np.radians(degrees)))
    albedo = float(layer_lobe(cosine, alpha)[1].sum())
    assert albedo + 1.0 - float(g1_smith(cosine, alpha)) == pytest.approx(printed, abs=0.005)
    assert 0.0 < albedo < 1.0


def test_what_a_stack_sends_is_its_brdf_over_the_hemisphere() -> None:
    """In air, under a coating, and beyond a layer that bends light, by a plain sum over directions."""
    t, weights = np.polynomial.legendre.leggauss(40)
    cos_o, phi = 0.5 * (t + 1.0), 0.5 * np.pi * (t + 1.0)
    for host, n1, metal_share in ((1.0, 1.0, 0.3), (1.35, 1.35, 0.3), (1.0, 1.59, 0.0)):
        layer = BraggLayer.of(n1, 1.7, 100.0, 130.0, 2, 0.5)
        stack = LayerStack.of((layer,), host, LayerBase.of([0.7, 0.5, 0.2], 0.9, metal_share, 0.5))
        colours = layer_colours("layers-single-table", stack, parameters={"nodes": 256, "wavelengths": 64})
        values = brdf(stack, Pose.of(0.7, cos_o[:, None], np.cos(phi)), colours)
        sums = np.einsum("a,b,abc->c", weights * cos_o * 0.5, weights * np.pi, values)
        found = stack_energy(stack, 0.7, colours)
        np.testing.assert_allclose(found.reflected[0] - coating_reflectance(host, 0.7), sums, atol=2e-5)


def test_a_smooth_layer_in_its_host_keeps_nothing() -> None:
    smooth = BraggLayer.of(1.0, 1.5, 120.0, 100.0, 4, 0.0)
    stack = LayerStack.of((smooth,), 1.0)
    energy = stack_energy(stack, [0.2, 0.9], layer_colours("layers-single", stack))
    np.testing.assert_allclose(energy.absorbed, 0.0, atol=1e-8)
    shares = layer_shares(smooth, 1.0, [0.2, 0.9], VISIBLE_NM)
    np.testing.assert_allclose(shares.absorbed, 0.0, atol=1e-12)


@pytest.mark.parametrize("alpha", [1e-12, 1e-9, 1e-5, 2e-4])
def test_what_hardly_rough_facets_send_is_what_smooth_ones_do(alpha: float) -> None:
    def sent(alpha: float) -> np.ndarray:
        stack = LayerStack.of((BraggLayer.of(1.0, 1.5, 120.0, 100.0, 4, alpha),), 1.0)
        return stack_energy(stack, [0.3, 1.0], layer_colours("layers-single", stack)).reflected

    np.testing.assert_allclose(sent(alpha), sent(0.0), atol=5e-4)


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
