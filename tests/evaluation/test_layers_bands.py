"""`layers-bands` and `layers-rgb` against the truth: exact where they must be, near it where they may err."""

from __future__ import annotations

import itertools
from collections.abc import Mapping

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.bench.layer_set import layer_set
from gltf_iri.colour.difference import delta_e_2000
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layers import BraggLayer, LayerBase, LayeredSurface, LayerStack, Pose
from gltf_iri.evaluation.layers_rgb import LAYER_REFLECTANCES
from gltf_iri.evaluation.registry import evaluate
from gltf_iri.evaluation.yeh_spectral import evaluate_yeh_spectral
from gltf_iri.optics.layer_stack import sight_of
from gltf_iri.optics.rough_bragg import g1_smith
from gltf_iri.planning.method import ParameterValue

Float64 = NDArray[np.float64]

COSINES = np.array([0.95, 0.6, 0.25])


def layer(d_nm: float, alpha: float, n2: float = 1.5, cells: int = 4) -> BraggLayer:
    """Return a layer of equal films in air."""
    return BraggLayer.of(1.0, n2, d_nm, d_nm, cells, alpha)


def stack(*layers: BraggLayer) -> LayerStack:
    """Return a stack on white, in air."""
    return LayerStack.of(layers, 1.0, LayerBase.of(1.0))


def colours(method: str, of: LayerStack, **parameters: ParameterValue) -> tuple[Float64, Float64]:
    """Return what reaches the viewer of the last layer, and of the base, at three pairs of angles."""
    given: Mapping[str, ParameterValue] = parameters
    found = layer_colours(method, of, parameters=given)
    last = len(of.layers) - 1
    return found.reflected(last, COSINES, COSINES[::-1], COSINES), found.passed(COSINES[::-1], COSINES)


def test_the_first_layers_colour_is_the_truth_to_the_last_bit() -> None:
    of = stack(layer(200.0, 0.1))
    np.testing.assert_array_equal(colours("layers-bands", of, bands=5)[0], colours("layers-single", of)[0])


def test_the_more_bands_the_nearer_to_the_truth() -> None:
    of = stack(layer(210.0, 0.0), layer(250.0, 0.0))
    truth = np.concatenate(colours("layers-single", of))
    errors = [
        float(delta_e_2000(np.concatenate(colours("layers-bands", of, bands=b)), truth).max())
        for b in (4, 8, 16, 32)
    ]
    assert all(fine < coarse for coarse, fine in itertools.pairwise(errors))
    assert errors[-1] < 0.02


@pytest.mark.parametrize("method", ["layers-bands", "layers-rgb"])
def test_layers_that_mirror_nothing_let_pass_what_their_facets_do(method: str) -> None:
    of = stack(layer(200.0, 0.2, n2=1.0), layer(300.0, 0.0, n2=1.0))
    reflected, passed = colours(method, of)
    masked = g1_smith(COSINES[::-1], 0.2) * g1_smith(COSINES, 0.2)
    np.testing.assert_allclose(reflected, 0.0, atol=1e-6)
    np.testing.assert_allclose(passed, np.broadcast_to(masked[:, None], (3, 3)), atol=2e-6)


def test_where_both_gaps_coincide_bands_know_that_little_is_left_to_mirror() -> None:
    # Straight on, the layer above takes away just what the one below would mirror; colours cannot know.
    mirror = BraggLayer.of(1.0, 1.5, 140.0, 140.0, 10, 0.0)
    of, straight = stack(mirror, mirror), np.ones(1)
    truth, bands, rgb = (
        layer_colours(method, of).reflected(1, straight, straight, straight)
        for method in ("layers-single", "layers-bands", "layers-rgb")
    )
    errors = [float(delta_e_2000(each, truth)[0]) for each in (bands, rgb)]
    assert errors[0] < 0.5
    assert errors[1] > 5.0


def test_random_stacks_keep_the_stated_error() -> None:
    of, pose = layer_set(12, 2, most_cells=4)
    sight = sight_of(of.host_ior, pose.cos_theta_i, pose.cos_theta_o, pose.cos_phi)
    at = sight.cos_h, sight.cos_i, sight.cos_o
    truth = layer_colours("layers-single", of).reflected(1, *at)
    p95 = {
        bands: np.percentile(
            delta_e_2000(
                layer_colours("layers-bands", of, parameters={"bands": bands}).reflected(1, *at), truth
            ),
            95,
        )
        for bands in (8, 16, 32)
    }
    # Few cells have softer gaps than the 600 stacks of spec/layers-notes.md, and err less.
    assert p95[8] < 2.0
    assert p95[16] < 0.3
    assert p95[32] < 0.15


def test_colours_of_one_layer_are_those_of_its_mirror() -> None:
    of = layer(180.0, 0.0)
    reflected, passed = colours("layers-rgb", stack(of), reflectance="yeh-spectral")
    at_facets = evaluate_yeh_spectral(of.mirror(COSINES, 1.0), "D65").rgb
    np.testing.assert_allclose(reflected, at_facets, atol=1e-12)
    np.testing.assert_allclose(passed, (1.0 - at_facets) * (1.0 - at_facets[::-1]), atol=1e-12)


def test_colours_multiply_by_every_method_for_mirrors() -> None:
    of = stack(layer(200.0, 0.0, cells=20), layer(230.0, 0.0, cells=20))
    exact = np.concatenate(colours("layers-rgb", of, reflectance="yeh-spectral"))
    for reflectance, bound in (("bloch", 2e-3), ("landmarks-sub", 0.1), ("landmarks", 0.15)):
        found = np.concatenate(colours("layers-rgb", of, reflectance=reflectance))
        assert 0.0 < np.abs(found - exact).max() < bound
    assert set(LAYER_REFLECTANCES) == {"yeh-spectral", "bloch", "landmarks-sub", "landmarks"}


@pytest.mark.parametrize("method", ["layers-bands", "layers-rgb"])
def test_light_and_viewer_may_change_places(method: str) -> None:
    of = stack(layer(200.0, 0.1), layer(230.0, 0.3))
    found = layer_colours(method, of)
    np.testing.assert_allclose(
        found.reflected(1, COSINES, COSINES[::-1], COSINES),
        found.reflected(1, COSINES, COSINES, COSINES[::-1]),
        rtol=1e-12,
    )


@pytest.mark.parametrize("method", ["layers-bands", "layers-rgb"])
def test_stacks_of_arrays_are_computed_one_by_one(method: str) -> None:
    of, pose = layer_set(3, 2, most_cells=4)
    cosines = np.array([[0.4], [0.9]])
    together = layer_colours(method, of).passed(cosines, pose.cos_theta_o)
    assert together.shape == (2, 3, 3)
    for number in range(3):
        layers = tuple(
            BraggLayer.of(*(a[number] for a in (e.n1, e.n2, e.d1_nm, e.d2_nm, e.cells, e.alpha)))
            for e in of.layers
        )
        one = LayerStack.of(layers, of.host_ior[number])
        alone = layer_colours(method, one).passed(cosines[:, 0], pose.cos_theta_o[number])
        np.testing.assert_allclose(together[:, number], alone, atol=1e-4)


def test_numbers_of_bands_that_cannot_be_are_refused() -> None:
    with pytest.raises(UsageError, match="bands"):
        layer_colours("layers-bands", stack(layer(200.0, 0.1)), parameters={"bands": 65})


def test_both_methods_evaluate_a_surface_as_the_truth_does() -> None:
    surface = LayeredSurface(
        stack(layer(200.0, 0.1, cells=2), layer(240.0, 0.2, cells=2)), Pose.of(COSINES, COSINES[::-1])
    )
    truth = evaluate("layers-single", surface).rgb
    bands = evaluate("layers-bands", surface, parameters={"bands": 32}).rgb
    np.testing.assert_allclose(bands, truth, rtol=0.01)
