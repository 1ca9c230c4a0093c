"""What is saved is what the map of costs says of the thing left out, and nothing where it says nothing."""

from __future__ import annotations

from dataclasses import replace

import pytest

from gltf_iri.material.iridescence import Iridescence
from gltf_iri.material.material import Material, MetallicRoughness
from gltf_iri.material.unlit import Unlit
from gltf_iri.planning.costs import Costs, shipped_costs
from gltf_iri.planning.decide import plan_material, plan_materials
from gltf_iri.planning.savings import pruned_defines, saved_ns_per_pixel
from gltf_iri.planning.way import Way

COSTS = Costs(
    {},
    {
        "glsl": {
            "films": {"texture": 3.0, "khr-guarded": 10.0, "fourier, tolerance 0.0001": 20.0},
            "metals": {"khr-guarded": 11.0, "fourier, tolerance 0.0001": 50.0},
        }
    },
)
FILM = Iridescence(factor=1.0)
DIELECTRIC = MetallicRoughness(metallic_factor=0.0)
BOTH = MetallicRoughness(metallic_factor=0.5)


def saved(material, lights=1, costs=COSTS, method=None):
    return saved_ns_per_pixel(plan_material(material, 0, method=method), lights, costs, method=method)


def test_a_texture_that_is_not_sampled_saves_a_sample(images):
    texture = images.add([[(51, 51, 51, 51)]])
    (plan,) = plan_materials([Material(iridescence=replace(FILM, texture=texture))], document=images)
    assert saved_ns_per_pixel(plan, 2, COSTS)["iridescence-texture"] == 3.0


@pytest.mark.parametrize(
    ("pbr", "ns"), [(DIELECTRIC, 10.0), (MetallicRoughness(), 11.0), (BOTH, 21.0)], ids=["F", "M", "both"]
)
def test_a_film_that_is_left_out_saves_one_a_lobe_and_light(pbr, ns):
    idle = Material(pbr=pbr, iridescence=replace(FILM, factor=0.0))
    assert saved(idle, lights=3)["iridescence"] == 3 * ns


def test_a_film_that_is_left_out_would_have_been_computed_by_the_method_asked_for():
    idle = Material(pbr=DIELECTRIC, iridescence=replace(FILM, factor=0.0))
    assert saved(idle, method="fourier") == {"iridescence": 20.0}


def test_a_lobe_that_is_left_out_saves_its_film():
    assert saved(Material(pbr=DIELECTRIC, iridescence=FILM), lights=2) == {"metal": 22.0}
    assert saved(Material(iridescence=FILM), lights=2) == {"dielectric": 20.0}
    assert saved(Material(pbr=DIELECTRIC)) == {}


def test_the_way_that_a_budget_chose_says_what_a_lobe_would_have_cost():
    way = Way("fourier", {"tolerance": 0.0001})
    plan = plan_material(Material(pbr=DIELECTRIC, iridescence=FILM), 0, way=way, way_reason="cheapest")
    assert saved_ns_per_pixel(plan, 1, COSTS) == {"metal": 50.0}


def test_what_the_map_does_not_know_is_not_told():
    assert saved(Material(pbr=BOTH, iridescence=replace(FILM, factor=0.0)), method="khr") == {}
    assert saved(Material(iridescence=FILM), costs=Costs({}, {})) == {}


def test_what_the_file_does_not_mention_saves_nothing():
    assert saved(Material()) == {}
    assert saved(Material(unlit=Unlit(), iridescence=FILM)) == {}


def test_the_shipped_map_knows_the_methods_that_plans_choose():
    costs = shipped_costs()
    for name in ("khr", "khr-guarded", "fourier"):
        told = saved(Material(iridescence=replace(FILM, factor=0.0)), costs=costs, method=name)
        assert told["iridescence"] > 0.0, name


def test_pruned_defines_are_those_of_what_is_mentioned_and_not_compiled():
    plans = [
        plan_material(Material(pbr=DIELECTRIC, iridescence=replace(FILM, factor=0.0)), 0),
        plan_material(Material(pbr=DIELECTRIC), 1),
    ]
    assert pruned_defines(plans, ("HAS_DIELECTRIC",)) == ("HAS_METAL", "HAS_IRIDESCENCE")


def test_a_grey_base_saves_two_channels(images):
    priced = {"khr-guarded": 10.0, "khr-guarded, one channel": 7.0}
    (plan,) = plan_materials([Material(pbr=DIELECTRIC, iridescence=FILM)], document=images)
    assert plan.grey == {"dielectric"}
    found = saved_ns_per_pixel(plan, 2, Costs({}, {"glsl": {"films": priced}}))
    assert found["grey-dielectric"] == 6.0
    assert "grey-dielectric" not in saved_ns_per_pixel(plan, 2, COSTS)
