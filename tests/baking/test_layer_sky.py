"""What becomes of a white sky on layers: the integral of what they do to light from each direction."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from gltf_iri.baking.cache import TableCache
from gltf_iri.baking.layer_fill import bake_layers
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.evaluation.layers import LayerBase, layer_terms
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.optics.layer_stack import coating_transmittance, cosine_in_host, sight_of
from gltf_iri.optics.quadrature import gauss_unit
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables, PlannedLayer
from gltf_iri.planning.reach import Span
from gltf_iri.reference.layer_truth import TabulatedLayers
from gltf_iri.rendering.layer_tables import layer_table_slices

ROUGH = (1.5, (500.0, 500.0), 0.1)
DENSE = (1.8, (320.0, 320.0), 0.2)
SEEN = np.array([1.0, 0.6, 0.2])
F0 = np.array([0.9, 0.5, 0.1])


def plan_of(layers, host, tables, metal=None, method="layers-bands"):
    made = tuple(PlannedLayer(i, host, n2, nm, 0.5, 10, alpha) for i, (n2, nm, alpha) in enumerate(layers))
    return LayersPlan(made, host, "base", Span.at(1.0), method, tables=tables, metal_roughness=metal)


def under_white_sky(plan, truth, base):
    """Return each layer's light and the base's at SEEN, (layers + 1, 3, 3), before the host lets it out."""
    nodes, weights = gauss_unit(64)
    cos_i, cos_phi = nodes[:, None, None], np.cos(np.pi * nodes)[:, None]
    sight = sight_of(plan.host_ior, cos_i, SEEN, cos_phi)
    terms = layer_terms(planned_stack(plan, 1.0, base), sight, truth(np.array(1.0)))
    entering = weights * nodes * coating_transmittance(plan.host_ior, nodes) / plan.host_ior**2
    return np.stack([2.0 * np.pi * np.einsum("i,p,ipoc->oc", entering, weights, term) for term in terms])


@pytest.mark.parametrize(("host", "layers"), [(1.0, (ROUGH, DENSE, ROUGH)), (1.35, (ROUGH, DENSE))])
def test_what_layers_and_base_send_is_their_integral_over_the_sky(host, layers):
    plan = plan_of(layers, host, LayerTables(8, False, 512, 1, "f4", 0.0), Span.at(0.5))
    found = LayerLookup(bake_layers(plan)).image(cosine_in_host(host, SEEN), np.full(3, 0.5))
    truth = TabulatedLayers(plan, "D65")
    *each, scattered = under_white_sky(plan, truth, LayerBase.of(diffuse=1.0))
    metal = LayerBase.of(metal_f0=F0, metal_share=1.0, metal_alpha=0.25)
    *_, mirrored = under_white_sky(plan, truth, metal)
    for ours, expected in zip(found.layers, each, strict=True):
        assert np.abs(ours - expected).max() < 5e-4
    assert np.abs(found.diffuse - scattered).max() < 5e-4
    assert np.abs(F0 * found.slope + found.offset - mirrored).max() < 5e-4


def test_colours_of_a_sky_are_exact_where_colours_are_multiplied():
    """They are colours of whole spectra whatever the tables for lights hold."""
    bands = plan_of((ROUGH, DENSE), 1.0, LayerTables(8, False, 64, 1, "f4", 0.0))
    colours = replace(bands, method="layers-rgb", tables=LayerTables(3, True, 64, 1, "f4", 0.0))
    first, second = (LayerLookup(bake_layers(plan)).image(SEEN) for plan in (bands, colours))
    assert np.abs(np.stack(first.layers) - np.stack(second.layers)).max() < 1e-5
    assert np.abs(first.diffuse - second.diffuse).max() < 1e-5


def test_between_roughnesses_of_a_metal_it_is_nearly_what_it_is_there():
    tables = LayerTables(8, False, 64, 1, "f4", 0.0)
    varying = LayerLookup(bake_layers(plan_of((ROUGH,), 1.0, tables, Span(0.0, 1.0))))
    for roughness in (0.0, 0.25, 0.4, 0.93, 1.0):
        fixed = LayerLookup(bake_layers(plan_of((ROUGH,), 1.0, tables, Span.at(roughness))))
        there, here = (each.image(SEEN, np.full(3, roughness)) for each in (fixed, varying))
        is_node = (8.0 * roughness) % 1.0 == 0.0
        assert np.abs(here.slope - there.slope).max() < (1e-12 if is_node else 0.02)
        assert np.abs(here.offset - there.offset).max() < (1e-12 if is_node else 0.01)


@pytest.mark.parametrize("metal", [None, Span.at(0.3), Span(0.0, 0.5)])
def test_tables_take_the_memory_that_the_plan_tells_and_come_back_from_the_cache(tmp_path, metal):
    tables = LayerTables(6, False, 16, 1, "f2", 0.0)
    plan, cache = plan_of((ROUGH, DENSE), 1.0, tables, metal), TableCache(tmp_path)
    filled, read = bake_layers(plan, cache=cache), bake_layers(plan, cache=cache)
    assert (filled.is_cached, read.is_cached) == (False, True)
    assert np.array_equal(layer_table_slices(filled), layer_table_slices(read))
    assert layer_table_slices(filled).nbytes == tables.bytes(plan)
