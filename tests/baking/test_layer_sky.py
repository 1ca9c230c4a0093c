"""What of a white sky passes layers: light from all around, as their coating lets it in."""

from __future__ import annotations

import numpy as np
import pytest

from gltf_iri.baking.layer_fill import bake_layers
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables, PlannedLayer
from gltf_iri.planning.reach import Span

ROUGH = PlannedLayer(0, 1.35, 1.5, (500.0, 500.0), 0.5, 10, 0.1)
DENSE = PlannedLayer(1, 1.35, 1.8, (320.0, 320.0), 0.5, 10, 0.04)


@pytest.mark.parametrize("host", [1.35, 1.0])
@pytest.mark.parametrize("method", ["layers-bands", "layers-rgb"])
@pytest.mark.parametrize("layers", [(ROUGH,), (ROUGH, DENSE)])
def test_what_passes_all_layers_of_a_white_sky_is_the_mean_of_their_product(host, method, layers):
    layers = tuple(PlannedLayer(i, host, e.n2, e.period_nm, 0.5, 10, e.alpha) for i, e in enumerate(layers))
    is_colour = method == "layers-rgb"
    tables = LayerTables(3 if is_colour else 8, is_colour, 256, 1, "f4", 0.0)
    lookup = LayerLookup(bake_layers(LayersPlan(layers, host, "base", Span.at(1.0), method, tables=tables)))
    nodes, weights = gauss_unit(96)
    entering = weights * nodes * coating_transmittance(host, nodes)
    seen = cosine_in_host(host, np.array([1.0, 0.6, 0.2]))
    passed = lookup.passed(cosine_in_host(host, nodes), seen[:, None])
    mean = np.einsum("s,nsc->nc", entering / entering.sum(), passed)
    assert np.abs(lookup.image(seen).diffuse - mean).max() < 1e-4
