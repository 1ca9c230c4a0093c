"""What GLSL says of a rough layer's facets, its filter and the way light sees it is what Python says."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray
from single_precision import rounded

from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host, sight_of
from gltf_iri.optics.rough_bragg import facet_weight, filter_nodes, g1_smith, transmission_filter
from gltf_iri.rendering.constants import FILTER_POINTS
from gltf_iri.rendering.probe import Probe
from gltf_iri.tolerances import GLSL_LAYERS_MAX_ABS, GLSL_OPTICS_MAX_ABS

Float64 = NDArray[np.float64]

pytestmark = pytest.mark.gl

ROUGH = "optics/rough_bragg.glsl"
STACK = "optics/layer_stack.glsl"
ROWS = 20_000
NODES = (
    "vec3 node_of(float c, float a, float k) {",
    "    return vec3(filter_node(filter_light(c, a), int(k + 0.5)), 0.0);",
    "}",
)


def cosines(g: np.random.Generator) -> Float64:
    """Even ones and, for half of all rows, decades towards grazing; both ends among them."""
    values = np.where(g.random(ROWS) < 0.5, g.random(ROWS), 10.0 ** g.uniform(-6.0, 0.0, ROWS))
    values[:2] = 0.0, 1.0
    return rounded(values)


def relative(found: NDArray[np.float32], expected: Float64) -> Float64:
    return np.asarray(np.abs(found - expected) / np.maximum(1.0, np.abs(expected)))


def test_glsl_masks_facets_as_python_does(probe: Probe) -> None:
    g = np.random.default_rng(19)
    cosine, alpha = cosines(g), rounded(10.0 ** g.uniform(-6.0, 0.0, ROWS))
    alpha[:2] = 0.0
    error = relative(probe.call("g1_smith", ROUGH, [cosine, alpha], "float"), g1_smith(cosine, alpha))
    assert error.max() <= GLSL_OPTICS_MAX_ABS


def test_glsl_weighs_facets_as_python_does(probe: Probe) -> None:
    """From the middle of the narrowest lobe, where it is 1e11, to its end."""
    g = np.random.default_rng(17)
    given = [
        rounded(10.0 ** g.uniform(-12.0, 0.0, ROWS)),
        cosines(g),
        cosines(g),
        rounded(10.0 ** g.uniform(-3.0, 0.0, ROWS)),
    ]
    given[0][:100] = 0.0
    expected = facet_weight(*given)
    found = probe.call("facet_weight", ROUGH, given, "float")
    assert np.abs(found / expected - 1.0).max() <= GLSL_OPTICS_MAX_ABS


@pytest.mark.parametrize("alpha_min", [1e-6, 1e-3, 0.05])
def test_glsl_filters_light_as_python_does(alpha_min: float, probe: Probe) -> None:
    """Around the peak and all over the domain; the angle comes as its distance from light's own."""
    g = np.random.default_rng(26)
    cosine = np.maximum(cosines(g), rounded(1e-6))
    alpha = rounded(10.0 ** g.uniform(np.log10(alpha_min), 0.0, ROWS))
    alpha[-1] = 1.0
    theta_i = np.arccos(cosine)
    near = g.random(ROWS) < 0.5
    offset = np.where(
        near, alpha * np.tan(g.uniform(-1.5, 1.5, ROWS)), g.uniform(0.0, 0.5 * np.pi, ROWS) - theta_i
    )
    offset = rounded(offset)
    inside = (theta_i + offset >= 0.0) & (theta_i + offset <= 0.5 * np.pi)
    cosine, alpha, offset = cosine[inside], alpha[inside], offset[inside]
    assert len(cosine) > ROWS // 2
    expected = transmission_filter(cosine, np.arccos(cosine) + offset, alpha)
    found = probe.call("transmission_filter", ROUGH, [cosine, offset, alpha], "float")
    assert relative(found, expected).max() <= GLSL_LAYERS_MAX_ABS


def test_glsl_integrates_the_filter_at_the_nodes_that_python_does(probe: Probe) -> None:
    """Grazing and straight, down to α = 0.001; sums of weights are G₁ as near as the rule comes to it."""
    g = np.random.default_rng(28)
    rows = 2000
    cosine, alpha = cosines(g)[:rows], rounded(10.0 ** g.uniform(-3.0, 0.0, rows))
    place = np.arange(3.0 * FILTER_POINTS)
    found = probe.call(
        "node_of",
        ROUGH,
        np.broadcast_arrays(cosine[:, None], alpha[:, None], place),
        argument_types=["float"] * 3,
        lines=NODES,
    ).astype(np.float64)
    nodes, weights = filter_nodes(cosine, alpha, count=FILTER_POINTS)
    assert np.abs(found[..., 0] - nodes).max() <= GLSL_LAYERS_MAX_ABS
    assert np.abs(found[..., 1] - weights).max() <= GLSL_LAYERS_MAX_ABS
    assert np.abs(found[..., 1].sum(axis=1) - weights.sum(axis=1)).max() <= GLSL_OPTICS_MAX_ABS
    assert np.abs(weights.sum(axis=1) - g1_smith(np.maximum(cosine, 1e-9), alpha)).max() <= 5e-4
    for powers in (1, 7, 20):
        moment, expected = (
            np.sum(w * np.cos(powers * c), axis=1)
            for c, w in ((found[..., 0], found[..., 1]), (nodes, weights))
        )
        assert np.abs(moment - expected).max() <= GLSL_OPTICS_MAX_ABS


@pytest.mark.parametrize("host", [1.0, 1.0000001, 1.33, 1.5, 2.5])
@pytest.mark.parametrize(
    "pose", ["any", "near the mirror direction", "grazing", "grazing from opposite sides"]
)
def test_glsl_sees_layers_as_python_does(host: float, pose: str, probe: Probe) -> None:
    g = np.random.default_rng(34)
    i, o, phi = g.random(ROWS), g.random(ROWS), g.uniform(-1.0, 1.0, ROWS)
    if pose == "near the mirror direction":
        o, phi = (
            np.clip(i * (1.0 + 1e-4 * g.normal(size=ROWS)), 0.0, 1.0),
            10.0 ** g.uniform(-9.0, 0.0, ROWS) - 1.0,
        )
    elif pose.startswith("grazing"):
        i, o = 10.0 ** g.uniform(-6.0, 0.0, (2, ROWS))
        phi = np.where(g.random(ROWS) < 0.5, -1.0, phi) if pose == "grazing" else np.full(ROWS, -1.0)
    given = [rounded(np.full(ROWS, host)), rounded(i), rounded(o), rounded(phi)]
    expected = sight_of(*given)
    for name in ("cos_i", "cos_o", "cos_h", "n_cross_h_squared", "passage"):
        found, wanted = probe.call("sight_of", STACK, given, "float", member=name), getattr(expected, name)
        assert np.abs(found - wanted).max() <= GLSL_OPTICS_MAX_ABS
        # Narrow lobes ask for the digits of small angles too.
        seen = wanted > 1e-12
        assert np.abs(found[seen] / wanted[seen] - 1.0).max() <= 2e-4


def test_glsl_coats_layers_as_python_does(probe: Probe) -> None:
    g = np.random.default_rng(35)
    host, cosine = rounded(g.uniform(1.0, 3.0, ROWS)), cosines(g)
    host[:2000] = 1.0
    for name, python in (
        ("cosine_in_host", cosine_in_host),
        ("coating_transmittance", coating_transmittance),
    ):
        error = np.abs(probe.call(name, STACK, [host, cosine], "float") - python(host, cosine))
        assert error.max() <= GLSL_OPTICS_MAX_ABS


def test_glsl_knows_no_nan_at_the_ends(probe: Probe) -> None:
    """Straight on, along the surface, from opposite sides, smooth and as rough as may be."""
    ends = np.array(list(itertools.product([1.0, 1.5], [0.0, 1e-7, 1.0], [0.0, 1e-7, 1.0], [-1.0, 0.0, 1.0])))
    for name in ("cos_i", "cos_o", "cos_h", "n_cross_h_squared", "passage"):
        values = probe.call("sight_of", STACK, list(ends.T), "float", member=name)
        assert np.isfinite(values).all()
        assert values.min() >= 0.0
    nodes = np.array(
        list(
            itertools.product(
                [0.0, 1e-7, 0.70710677, 0.70710683, 1.0, 1.0000001],
                [0.0, 1e-3, 1.0],
                range(3 * FILTER_POINTS),
            )
        )
    )
    values = probe.call("node_of", ROUGH, list(nodes.T), argument_types=["float"] * 3, lines=NODES)
    assert np.isfinite(values).all()
    assert values.min() >= 0.0
