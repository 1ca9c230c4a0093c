"""Layers that are computed directly loop no farther than the one renderer bears that ends loops."""

from __future__ import annotations

import pytest

from gltf_iri.errors import MissingCapabilityError
from gltf_iri.material.bragg import Bragg, MirrorLayer
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.transmission import Transmission
from gltf_iri.material.volume import Volume
from gltf_iri.planning.decide import plan_materials
from gltf_iri.rendering.layer_loops import check_loops, loop_turns

LAYER = MirrorLayer(cells=6, roughness=0.3)


def turns(count=2, lights=3, method="layers-single", **others):
    pbr = MetallicRoughness(metallic_factor=0.0)
    (plan,) = plan_materials(
        [Material(pbr=pbr, bragg=Bragg(1.0, layers=(LAYER,) * count), **others)], method=method
    )
    return loop_turns(plan, lights, has_image_light=True)


def test_tables_take_no_loops():
    assert turns(method="layers-bands") == 0 < turns()


def test_what_comes_from_behind_is_one_way_more_and_of_a_thin_wall_each_lamp_s_too():
    glass = Transmission(1.0)
    lit, unlit = turns(transmission=glass) - turns(), turns(lights=0, transmission=glass) - turns(lights=0)
    assert lit == 4 * unlit > 0
    assert turns(transmission=glass, volume=Volume(1.0)) - turns() == unlit


def test_the_renderer_that_ends_loops_is_asked_for_no_more_than_it_takes():
    pbr, layers = MetallicRoughness(metallic_factor=0.0), (LAYER,) * 4
    (plan,) = plan_materials([Material(pbr=pbr, bragg=Bragg(1.0, layers=layers))], method="layers-single")
    check_loops(plan, "llvmpipe (LLVM 17)", 1, has_image_light=False)
    check_loops(plan, "a graphics card", 40, has_image_light=True)
    with pytest.raises(MissingCapabilityError, match="layers-bands"):
        check_loops(plan, "llvmpipe (LLVM 17)", 40, has_image_light=True)
