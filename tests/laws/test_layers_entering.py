"""Laws of what crosses a stack of layers once, by every method, out of tables, and by simulated paths."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from gltf_iri.baking.layer_fill import filled_layers
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.colour.quadrature import colour_rule
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.layer_spectra import LayerSpectra
from gltf_iri.evaluation.layers import BraggLayer, LayerColours, LayerStack
from gltf_iri.optics.rough_bragg import g1_smith
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables, PlannedLayer
from gltf_iri.planning.method import method_names
from gltf_iri.planning.reach import Span
from gltf_iri.reference.layer_truth import TabulatedLayers
from gltf_iri.reference.layers_direct import DirectLayers
from gltf_iri.reference.layers_mc import simulate

Float64 = NDArray[np.float64]

METHODS = method_names("layers")
COARSE: dict[str, dict[str, float | str]] = {"layers-single-table": {"nodes": 129}}
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
COSINES = np.array([0.2, 0.6, 1.0])

UPPER = PlannedLayer(0, 1.0, 1.5, (230.0, 230.0), 0.45, 3, 0.04)
LOWER = PlannedLayer(1, 1.0, 1.4, (270.0, 270.0), 0.5, 4, 0.25)


def stack_of(*layers: PlannedLayer, host: float = 1.0) -> LayerStack:
    """The stack of planned layers whose periods do not vary."""
    made = (
        BraggLayer.of(host, x.n2, x.fill * nm, (1.0 - x.fill) * nm, x.cells, x.alpha)
        for x in layers
        for nm in x.period_nm[:1]
    )
    return LayerStack.of(tuple(made), host)


def planned(*layers: PlannedLayer, tables: LayerTables | None = None) -> LayersPlan:
    return LayersPlan(layers, 1.0, "base", Span.at(1.0), "layers-bands", tables=tables)


def by_shares(stack: LayerStack, cosines: Float64) -> Float64:
    """Each layer's transmitted share, wavelength by wavelength, multiplied and summed."""
    rule, spectra = colour_rule(512, "D65"), np.ones(())
    for layer in stack.layers:
        shares = LayerSpectra(layer, float(stack.host_ior))
        spectra = spectra * shares.transmissivity(cosines, rule.wavelength_nm)
    return np.asarray(spectra @ rule.weights)


def of_method(method: str, stack: LayerStack) -> LayerColours:
    return layer_colours(method, stack, parameters=COARSE.get(method, {}))


@pytest.mark.parametrize("method", METHODS)
def test_layers_without_contrast_let_through_what_their_facets_do_not_mask(method: str) -> None:
    """Π G₁ of each, in a host of their index; all of it where they are smooth."""
    for alphas in ((0.0, 0.0), (0.09, 0.25)):
        layers = tuple(BraggLayer.of(1.4, 1.4, 100.0, 120.0, 3, alpha) for alpha in alphas)
        found = of_method(method, LayerStack.of(layers, 1.4)).entering(COSINES)
        masked = np.prod([g1_smith(COSINES, alpha) for alpha in alphas], axis=0)
        # Tables of spectra are linear between cosines, and G₁ is not.
        atol = 2e-4 if method == "layers-single-table" else 1e-6
        np.testing.assert_allclose(found, np.repeat(masked[:, None], 3, axis=1), rtol=0, atol=atol)


@pytest.mark.parametrize("method", METHODS)
def test_no_layers_let_everything_through(method: str) -> None:
    found = of_method(method, LayerStack.of((), 1.3)).entering(COSINES)
    np.testing.assert_allclose(found, np.ones((3, 3)), rtol=0, atol=1e-12)


@pytest.mark.parametrize("method", METHODS)
def test_what_enters_is_the_layers_transmitted_shares(method: str) -> None:
    """Of a single layer, whose colour no method has to multiply, and of two by those that keep spectra."""
    bounds = {"layers-rgb": 2e-3, "layers-bands": 2e-3, "layers-single-table": 5e-4}
    keeps_spectra = method.startswith("layers-single")
    stacks = [stack_of(UPPER, LOWER)] if keeps_spectra else [stack_of(UPPER), stack_of(LOWER, host=1.2)]
    for stack in stacks:
        found = of_method(method, stack).entering(COSINES)
        expected = by_shares(stack, COSINES)
        np.testing.assert_allclose(found, expected, rtol=0, atol=bounds.get(method, 2e-6))
        assert np.ptp(expected, axis=-1).max() > 0.02  # there is a colour to be wrong about


@pytest.mark.parametrize("method", METHODS)
def test_crossing_twice_leaves_no_less_than_the_square_of_crossing_once(method: str) -> None:
    """Of luminance, whose weights are positive: the mean of T² is no less than that of T, squared."""
    colours = of_method(method, stack_of(UPPER, LOWER))
    twice, once = (
        values @ LUMINANCE for values in (colours.passed(COSINES, COSINES), colours.entering(COSINES))
    )
    assert np.all(twice >= once**2 - 1e-12)
    assert np.all(twice < once)


def test_colours_that_are_multiplied_cross_twice_as_the_product_of_crossing_once() -> None:
    """By `layers-rgb`, and out of tables of colours."""
    i, o = COSINES, COSINES[::-1]
    tables = LayerTables(3, True, 33, 1, "f4", 0.0)
    looked_up = LayerLookup(filled_layers(planned(UPPER, LOWER, tables=tables), "D65", has_sky=False))
    for colours in (of_method("layers-rgb", stack_of(UPPER, LOWER)), looked_up):
        product = colours.entering(i) * colours.entering(o)
        np.testing.assert_allclose(colours.passed(i, o), product, rtol=0, atol=1e-12)


def test_tables_of_bands_give_what_their_bands_multiply_to() -> None:
    """Between the nodes too: each layer's bands linear in the cosine, then multiplied, then summed."""
    tables = LayerTables(16, False, 65, 1, "f4", 0.0)
    baked = filled_layers(planned(UPPER, LOWER, tables=tables), "D65", has_sky=False)
    cosines = np.random.default_rng(0).uniform(size=20)
    nodes = np.linspace(0.0, 1.0, 65)
    product = np.ones((20, 16))
    for transmitted in baked.transmitted:
        for band in range(16):
            product[:, band] *= np.interp(cosines, nodes, transmitted[0, :, band])
    found = LayerLookup(baked).entering(cosines)
    np.testing.assert_allclose(found, product @ baked.weights, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found, by_shares(stack_of(UPPER, LOWER), cosines), rtol=0, atol=5e-3)


def test_the_references_truth_is_the_truth() -> None:
    truth = TabulatedLayers(planned(UPPER, LOWER), "D65")(np.ones(3))
    expected = by_shares(stack_of(UPPER, LOWER), COSINES)
    np.testing.assert_allclose(truth.entering(COSINES), expected, rtol=0, atol=1e-4)
    direct = DirectLayers(planned(UPPER, LOWER), of_method("layers-single", stack_of(UPPER, LOWER)))
    np.testing.assert_allclose(direct.entering(COSINES), expected, rtol=0, atol=2e-6)


@pytest.mark.parametrize("transmission", ["facets", "table"])
def test_simulated_paths_reach_the_base_as_often(transmission: str) -> None:
    """Those that nothing has mirrored, over a black base in air; 5 standard errors hold but 6e-7 of draws."""
    stack, rule = stack_of(UPPER, LOWER), colour_rule(64, "D65")
    for cosine in (0.4, 0.9):
        estimate = simulate(
            *(stack, cosine),
            **{"paths": 20_000, "rng": np.random.default_rng(5), "max_reflections": 1},
            **{"wavelength_nm": rule.wavelength_nm, "weights": rule.weights, "transmission": transmission},
        )
        expected = of_method("layers-single", stack).entering(np.array(cosine))
        reached = estimate.balance["base"]
        assert np.all(np.abs(reached.mean - expected) < 5 * reached.error + 1e-4)
        assert reached.error.max() < 8e-3
