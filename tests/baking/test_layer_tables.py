"""Tables of Bragg layers: at their nodes they are the truth, and the cache gives them back as they were."""

from __future__ import annotations

from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest

from gltf_iri.baking.cache import TableCache
from gltf_iri.baking.layer_cache import read_layers
from gltf_iri.baking.layer_fill import bake_layers, cosine_nodes, filled_layers, texel_nodes
from gltf_iri.baking.layer_lookup import LayerLookup
from gltf_iri.colour.bands import bands_of
from gltf_iri.errors import UsageError
from gltf_iri.evaluation.layer_methods import layer_colours
from gltf_iri.evaluation.planned_stack import planned_stack
from gltf_iri.optics.microfacet import ALPHA_MIN
from gltf_iri.optics.rough_bragg import g1_smith
from gltf_iri.planning.layer_plan import LayersPlan, LayerTables, PlannedLayer
from gltf_iri.planning.reach import Span

UPPER = PlannedLayer(0, 1.0, 1.5, (180.0, 240.0), 0.4, 5, 0.09)
LOWER = PlannedLayer(1, 1.0, 1.7, (200.0, 260.0), 0.5, 3, 0.2)
TABLES = LayerTables(16, False, 9, 3, "f4", 0.0)
TWO = LayersPlan((UPPER, LOWER), 1.0, "base", Span(0.0, 1.0), "layers-bands", tables=TABLES)


def still(plan: LayersPlan, **changes: object) -> LayersPlan:
    """Return `plan` with one period, and tables so changed."""
    layers = tuple(replace(layer, period_nm=(240.0, 240.0)) for layer in plan.layers)
    tables = replace(TABLES, period_nodes=1, **changes)  # type: ignore[arg-type]
    return replace(plan, layers=layers, texel=Span.at(1.0), tables=tables)


def test_at_the_nodes_the_first_layer_is_the_truth() -> None:
    baked = filled_layers(TWO, "D65", has_sky=False)
    for texel, row in zip(texel_nodes(TWO, 3), baked.first, strict=True):
        truth = layer_colours("layers-single", planned_stack(TWO, texel))
        cosines = cosine_nodes(9)
        exact = truth.reflected(0, cosines, cosines, cosines)
        # 512 wavelengths, and single precision
        assert np.abs(row[:, :3] - exact).max() < 2e-5


def test_look_ups_at_the_nodes_are_the_texels() -> None:
    baked = filled_layers(TWO, "D65", has_sky=False)
    cosines = cosine_nodes(9)
    for place, texel in enumerate(texel_nodes(TWO, 3)):
        found = LayerLookup(baked, texel)
        assert np.allclose(found.reflected(0, cosines, 1.0, 1.0), baked.first[place, :, :3], atol=1e-12)
        passed = np.prod(baked.transmitted[:, place].astype(np.float64), axis=0)
        assert np.allclose(found.passed(cosines, cosines), passed**2 @ baked.weights, atol=1e-9)


def test_between_nodes_look_ups_are_linear_and_beyond_the_ends_they_stay() -> None:
    baked = filled_layers(TWO, "D65", has_sky=False)
    found = LayerLookup(baked, 0.25)
    corners = baked.first[:2, 4:6, :3].mean(axis=(0, 1))
    assert np.allclose(found.reflected(0, 0.5 + 0.0625, 1.0, 1.0), corners, atol=1e-7)
    assert np.array_equal(
        LayerLookup(baked, 7.0).reflected(0, 2.0, 1.0, 1.0),
        LayerLookup(baked, 1.0).reflected(0, 1.0, 1.0, 1.0),
    )


def test_what_passes_is_what_bands_make_of_the_truth() -> None:
    plan = still(TWO, bands=64)
    found = LayerLookup(filled_layers(plan, "D65", has_sky=False))
    truth = layer_colours("layers-single", planned_stack(plan))
    cosines = cosine_nodes(9)[1:]
    assert np.abs(found.passed(cosines, cosines) - truth.passed(cosines, cosines)).max() < 1e-3
    below = truth.reflected(1, cosines, cosines, cosines)
    assert np.abs(found.reflected(1, cosines, cosines, cosines) - below).max() < 1e-3


def test_of_a_layer_without_contrast_the_filter_leaves_its_masking() -> None:
    layer = replace(UPPER, n2=1.0, period_nm=(240.0, 240.0))
    plan = still(replace(TWO, layers=(layer,)))
    baked = filled_layers(plan, "D65", has_sky=False)
    assert np.allclose(baked.transmitted[0, 0, :, 0], g1_smith(cosine_nodes(9), 0.09), atol=1e-6)


def test_a_smooth_layer_passes_what_it_does_not_reflect() -> None:
    plan = still(replace(TWO, layers=(replace(UPPER, alpha=ALPHA_MIN),)))
    baked = filled_layers(plan, "D65", has_sky=False)
    assert np.allclose(baked.reflected + baked.transmitted, 1.0, atol=1e-6)


def test_colours_are_held_as_colours() -> None:
    plan = still(TWO, bands=3, is_colour=True)
    baked = filled_layers(plan, "D65", has_sky=False)
    assert np.array_equal(baked.reflected[0], baked.first)
    assert np.array_equal(baked.weights, np.eye(4, 3))


def test_bands_are_padded_to_fours() -> None:
    baked = filled_layers(still(TWO, bands=6), "E", has_sky=False)
    assert baked.reflected.shape[-1] == 8 and not baked.reflected[..., 6:].any()
    assert np.array_equal(baked.weights[:6], bands_of(6, "E").weights) and not baked.weights[6:].any()


@pytest.mark.parametrize("texel", ["f2", "f4"])
def test_the_cache_gives_back_what_was_filled(tmp_path: Path, texel: str) -> None:
    cache = TableCache(tmp_path)
    plan = still(TWO, texel=texel)
    filled = bake_layers(plan, cache=cache)
    again = bake_layers(plan, cache=cache)
    assert again.is_cached and not filled.is_cached
    for field in fields(filled):
        if field.name != "is_cached":
            assert np.all(getattr(again, field.name) == getattr(filled, field.name)) or (
                field.name == "filled_in_s"
            ), field.name
    assert not bake_layers(plan, "E", cache=cache).is_cached
    upper, lower = plan.layers
    changes = {"n2": 1.71, "period_nm": (250.0, 250.0), "fill": 0.6, "cells": 4, "alpha": 0.3}
    for name, value in changes.items():
        other = replace(plan, layers=(upper, replace(lower, **{name: value})))  # type: ignore[arg-type]
        assert read_layers(cache, other, "D65") is None, name
    assert read_layers(cache, replace(plan, layers=(lower, upper)), "D65") is None
    assert read_layers(cache, plan, "D65") is not None


@pytest.mark.parametrize("host", [1.437, 1.49])
def test_tables_are_numbers_up_to_the_normal(host: float) -> None:
    """These hosts bend light along the normal to a cosine of 1 and a rounding, which has no sine."""
    plan = still(TWO, bands=3, is_colour=True)
    layers = tuple(replace(layer, n1=host) for layer in plan.layers)
    baked = filled_layers(replace(plan, layers=layers, host_ior=host), "D65")
    for field in (
        baked.first,
        baked.reflected,
        baked.transmitted,
        baked.sent,
        baked.scattered,
        baked.mirrored,
    ):
        assert np.isfinite(field).all()


def test_a_damaged_file_is_filled_anew(tmp_path: Path) -> None:
    cache, plan = TableCache(tmp_path), still(TWO)
    bake_layers(plan, cache=cache)
    (path,) = tmp_path.iterdir()
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content)
    assert not bake_layers(plan, cache=cache).is_cached


def test_layers_without_tables_are_not_filled() -> None:
    with pytest.raises(UsageError, match="no tables"):
        bake_layers(replace(TWO, tables=None))
