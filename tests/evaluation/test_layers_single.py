"""The truth of the single-reflection model, against sums written out by hand and laws that it must keep."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.film import Film, base_from_ior
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayeredSurface, LayerStack, Pose, brdf
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.optics.layer_stack import sight_of
from gltf_iri.optics.rough_bragg import facet_weight, g1_smith, transmission_filter
from gltf_iri.planning.method import method_names

Float64 = NDArray[np.float64]

UPPER = BraggLayer.of(1.0, 1.5, 120.0, 120.0, 3, 0.2)
LOWER = BraggLayer.of(1.0, 1.7, 90.0, 140.0, 2, 0.4)
TWO = LayerStack.of((UPPER, LOWER), 1.0, LayerBase.of([0.5, 0.3, 0.2], [0.9, 0.6, 0.3], 0.4, 0.3))
METHODS = method_names("layers")
CHEAP: dict[str, dict[str, float | str]] = {"layers-single-table": {"nodes": 64}}


def matrix_reflectance(layer: BraggLayer, cosine: Float64, wavelength_nm: Float64) -> Float64:
    """Return R (n, k) of cells in air, the mean of both polarisations, by products of transfer matrices."""
    total = np.zeros((len(cosine), len(wavelength_nm)))
    films = [(float(layer.n1), float(layer.d1_nm)), (float(layer.n2), float(layer.d2_nm))]
    for is_p in (False, True):
        outside = cosine[:, None]
        product = np.broadcast_to(np.eye(2, dtype=complex), (*total.shape, 2, 2))
        for n, d_nm in films * int(layer.cells):
            along = np.sqrt(n * n - (1.0 - outside**2))
            admittance = n * n / along if is_p else along
            phase = 2.0 * np.pi * along * d_nm / wavelength_nm
            cos, sin = np.cos(phase) + 0j, -1j * np.sin(phase)
            matrix = np.stack([cos, sin / admittance, sin * admittance, cos], axis=-1)
            product = product @ matrix.reshape(*total.shape, 2, 2)
        air = (1.0 / outside if is_p else outside) + 0.0 * wavelength_nm
        field = np.einsum("nkij,jnk->ink", product, np.stack([np.ones(air.shape), air]))
        amplitude = (air * field[0] - field[1]) / (air * field[0] + field[1])
        total += 0.5 * np.abs(amplitude) ** 2
    return total


def brute_transmission(layer: BraggLayer, i: float, o: float, wavelength_nm: Float64) -> Float64:
    """Return T(i) T(o) (k,) by midpoints of θ_d, of facets by transfer matrices."""
    steps = 1000
    theta = (np.arange(steps) + 0.5) * 0.5 * np.pi / steps
    weights = transmission_filter(np.array([[i], [o]]), theta, float(layer.alpha)) * 0.5 * np.pi / steps
    there, back = weights @ (1.0 - matrix_reflectance(layer, np.cos(theta), wavelength_nm))
    return np.asarray(there * back)


def test_colours_of_two_layers_are_those_of_transfer_matrices_and_a_plain_sum() -> None:
    rule = colour_rule(64, "D65")
    i, o, h = 0.8, 0.5, 0.9
    mirrored = matrix_reflectance(LOWER, np.array([h]), rule.wavelength_nm)[0]
    upper, lower = (brute_transmission(layer, i, o, rule.wavelength_nm) for layer in (UPPER, LOWER))
    found = layer_colours("layers-single", TWO)
    at = np.array(h), np.array(i), np.array(o)
    # Midpoints miss the square root where facets end at the horizon.
    np.testing.assert_allclose(found.reflected(1, *at), (mirrored * upper) @ rule.weights, atol=2e-5)
    np.testing.assert_allclose(found.passed(*at[1:]), (upper * lower) @ rule.weights, atol=2e-5)


def test_a_table_of_angles_and_single_angles_give_the_same_truth() -> None:
    """So many poses are interpolated over θ_i; each alone is not."""
    g = np.random.default_rng(5)
    i, o = g.uniform(0.0, 1.0, (2, 1500))
    together = layer_colours("layers-single", LayerStack.of((UPPER,), 1.0)).passed(i, o)
    alone = layer_colours("layers-single", LayerStack.of((UPPER,), 1.0)).passed(i[:20], o[:20])
    np.testing.assert_allclose(together[:20], alone, atol=1e-8)


def test_stacks_and_poses_broadcast() -> None:
    d_nm = np.array([100.0, 130.0])[:, None]
    stacks = LayerStack.of((BraggLayer.of(1.0, 1.5, d_nm, d_nm, 3, 0.2), LOWER), 1.0)
    pose = Pose.of([0.9, 0.4, 0.7], 0.6, 0.1)
    all_of_them = evaluate("layers-single", LayeredSurface(stacks, pose)).rgb
    assert all_of_them.shape == (2, 3, 3)
    one = LayerStack.of((BraggLayer.of(1.0, 1.5, 130.0, 130.0, 3, 0.2), LOWER), 1.0)
    alone = evaluate("layers-single", LayeredSurface(one, Pose.of(0.4, 0.6, 0.1))).rgb
    np.testing.assert_allclose(all_of_them[1, 1], alone, atol=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_light_and_viewer_may_change_places(method: str) -> None:
    """Helmholtz reciprocity, also through a coating."""
    coated = BraggLayer.of(1.4, 1.7, 100.0, 130.0, 3, 0.2)
    stack = LayerStack.of((coated, coated), 1.4, LayerBase.of(0.5, 0.8, 0.3, 0.2))
    colours = layer_colours(method, stack, parameters=CHEAP.get(method, {}))
    there, back = (brdf(stack, Pose.of(*pose), colours) for pose in ((0.9, 0.3, -0.4), (0.3, 0.9, -0.4)))
    np.testing.assert_allclose(there, back, rtol=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_films_of_the_hosts_index_mirror_nothing_and_mask_what_passes(method: str) -> None:
    """Such a layer's facets are not there to see, yet its model keeps their masking, T = G₁."""
    nothing = BraggLayer.of(1.0, 1.0, 100.0, 100.0, 4, 0.3)
    found = layer_colours(method, LayerStack.of((nothing, LOWER), 1.0), parameters=CHEAP.get(method, {}))
    i, o = np.array([0.2, 0.9]), np.array([0.6, 0.9])
    np.testing.assert_allclose(found.reflected(0, i, i, o), 0.0, atol=1e-6)
    alone = layer_colours(method, LayerStack.of((LOWER,), 1.0), parameters=CHEAP.get(method, {}))
    masked = (g1_smith(i, 0.3) * g1_smith(o, 0.3))[:, None]
    bound = {"layers-single": 1e-9, "layers-single-table": 2e-3}.get(method, 1e-5)
    np.testing.assert_allclose(found.passed(i, o), masked * alone.passed(i, o), atol=bound)


@pytest.mark.parametrize("method", METHODS)
def test_a_stack_without_layers_passes_all(method: str) -> None:
    found = layer_colours(method, LayerStack.of((), 1.0, LayerBase.of(0.6)))
    np.testing.assert_allclose(found.passed(np.array([0.3, 1.0]), np.array([0.5, 0.0])), 1.0, atol=1e-14)
    sent = brdf(LayerStack.of((), 1.0, LayerBase.of(0.6)), Pose.of(0.3, 0.5), found)
    np.testing.assert_allclose(sent, 0.6 / np.pi, rtol=1e-15)


def test_a_black_base_sends_nothing() -> None:
    pose = Pose.of(0.8, 0.6, -0.2)
    black, grey = (LayerStack.of((UPPER,), 1.0, LayerBase.of(rho)) for rho in (0.0, 0.5))
    sent = [evaluate("layers-single", LayeredSurface(each, pose)).rgb for each in (black, grey)]
    through = layer_colours("layers-single", grey).passed(np.array(0.8), np.array(0.6))
    np.testing.assert_allclose(sent[1] - sent[0], through * 0.5 / np.pi, atol=1e-9)


def test_one_cell_in_its_own_host_is_a_film() -> None:
    cell = BraggLayer.of(1.2, 1.8, 77.0, 260.0, 1, 0.1)
    cosines = np.array([0.2, 0.6, 1.0])
    found = layer_colours("layers-single", LayerStack.of((cell,), 1.2)).reflected(
        0, cosines, cosines, cosines
    )
    film = evaluate("spectral", Film.of(cosines, 260.0, 1.8, base_from_ior(1.2), 1.2)).rgb
    np.testing.assert_allclose(found, film, atol=1e-8)


def test_the_smoother_the_nearer_to_a_smooth_mirror() -> None:
    i, o = np.array([0.9, 0.5]), np.array([0.4, 0.7])

    def passed(alpha: float) -> Float64:
        layer = BraggLayer.of(1.0, 1.5, 120.0, 120.0, 3, alpha)
        return layer_colours("layers-single", LayerStack.of((layer,), 1.0)).passed(i, o)

    errors = [float(np.abs(passed(alpha) - passed(0.0)).max()) for alpha in (0.1, 0.01, 0.001)]
    assert errors[0] > errors[1] > errors[2]
    assert errors[2] < 2e-4


def test_the_mirror_image_of_a_smooth_layer_is_told_as_undefined() -> None:
    stack = LayerStack.of((BraggLayer.of(1.0, 1.5, 120.0, 120.0, 3, 0.0),), 1.0)
    found = evaluate("layers-single", LayeredSurface(stack, Pose.of([0.7, 0.7], [0.7, 0.6], -1.0)))
    np.testing.assert_array_equal(found.rgb, 0.0)
    assert [mask.tolist() for mask in found.undefined.values()] == [[True, False]]


@given(
    host=st.sampled_from([1.0, 1.35, 2.0]),
    i=st.floats(0.01, 1.0),
    o=st.floats(0.01, 1.0),
    phi=st.floats(0.0, np.pi),
)
@example(host=1.35, i=0.5, o=0.9999999999999999, phi=0.0)  # whose cosine inside is 1
@settings(max_examples=60, deadline=None)
def test_layers_see_what_vectors_in_space_say(host: float, i: float, o: float, phi: float) -> None:
    def inside(cosine: float, turn: float) -> Float64:
        sine = np.sqrt(1.0 - cosine**2) / host
        return np.array([sine * np.cos(turn), sine * np.sin(turn), np.sqrt(1.0 - sine**2)])

    light, view = inside(i, 0.0), inside(o, phi)
    half = (light + view) / np.linalg.norm(light + view)
    sight = sight_of(host, i, o, np.cos(phi))
    found = [float(x) for x in (sight.cos_i, sight.cos_o, sight.cos_h, sight.n_cross_h_squared)]
    assert found == pytest.approx([light[2], view[2], light @ half, half[0] ** 2 + half[1] ** 2], abs=1e-9)
    step = ((host - 1.0) / (host + 1.0)) ** 2
    if i == o == 1.0:
        assert float(sight.passage) == pytest.approx((1.0 - step) ** 2 / host**2)


def test_a_layers_brdf_is_its_lobe_times_its_colour() -> None:
    stack, pose = LayerStack.of((UPPER,), 1.0), Pose.of(0.8, 0.6, -0.9)
    sight = sight_of(1.0, 0.8, 0.6, -0.9)
    colour = evaluate("yeh-spectral", UPPER.mirror(sight.cos_h, 1.0)).rgb
    weight = facet_weight(sight.n_cross_h_squared, 0.8, 0.6, 0.2)
    found = evaluate("layers-single", LayeredSurface(stack, pose))
    np.testing.assert_allclose(found.rgb, weight * colour, rtol=1e-12)
    assert found.method == "layers-single"


def test_tables_come_nearer_with_their_nodes() -> None:
    i, o = np.random.default_rng(2).uniform(0.0, 1.0, (2, 60))
    truth = layer_colours("layers-single", TWO).reflected(1, i, i, o)
    errors = [
        float(
            np.abs(
                layer_colours("layers-single-table", TWO, parameters={"nodes": n}).reflected(1, i, i, o)
                - truth
            ).max()
        )
        for n in (32, 128, 512)
    ]
    # Nodes first, then the wavelengths' rule.
    assert errors[0] > 4.0 * errors[1]
    assert errors[1] > errors[2]
    assert errors[2] < 1e-4


def test_wrong_stacks_methods_and_shapes_are_refused() -> None:
    many = LayerStack.of((BraggLayer.of(1.0, 1.5, [100.0, 120.0], 100.0, 3, 0.1),), 1.0)
    with pytest.raises(UsageError, match="tabulates one stack"):
        layer_colours("layers-single-table", many)
    with pytest.raises(UsageError, match="no method 'spectral' for layers"):
        layer_colours("spectral", TWO)
    with pytest.raises(UsageError, match="no white"):
        layer_colours("layers-single", TWO, white="F11")
    with pytest.raises(UsageError, match="do not broadcast"):
        evaluate("layers-single", LayeredSurface(many, Pose.of([0.1, 0.2, 0.3], 1.0)))
