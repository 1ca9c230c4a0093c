from __future__ import annotations

import math

import numpy as np
import pytest

from gltf_iri.errors import AssetError

NAME = "KHR_lights_punctual"


@pytest.fixture
def lit(triangle):
    """Call with light objects: each is carried by a node of its own, described by `node`."""

    def load(*lights, **node):
        triangle.json["extensionsUsed"] = [NAME]
        triangle.json["extensions"] = {NAME: {"lights": list(lights)}}
        carriers = [{**node, "extensions": {NAME: {"light": i}}} for i in range(len(lights))]
        triangle.json["nodes"] = [{"mesh": 0}, *carriers]
        triangle.json["scenes"] = [{"nodes": list(range(len(carriers) + 1))}]
        return triangle.load().scene().lights

    return load


def test_absent_properties_have_the_defaults_of_the_extension(lit):
    (light,) = lit({"type": "spot"})
    assert (light.colour, light.intensity, light.range_m) == ((1.0, 1.0, 1.0), 1.0, None)
    assert (light.inner_cone_rad, light.outer_cone_rad) == (0.0, math.pi / 4)


def test_a_light_shines_along_minus_z_of_its_node(lit):
    quarter_turn_about_x = [math.sqrt(0.5), 0, 0, math.sqrt(0.5)]  # takes −Z to +Y
    lights = lit(
        {"type": "directional", "intensity": 3, "color": [1, 0.5, 0]},
        {"type": "spot", "range": 8, "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}},
        {"type": "point", "name": "bulb"},
        rotation=quarter_turn_about_x,
        translation=[1, 2, 3],
        scale=[2, 5, 7],
    )
    for light in lights[:2]:
        np.testing.assert_allclose(light.direction, (0, 1, 0), atol=1e-15)
    np.testing.assert_array_equal(lights[2].position, (1, 2, 3))
    assert lights[0].intensity == 3
    assert lights[0].colour == (1.0, 0.5, 0.0)
    assert lights[1].range_m == 8  # the node's scale leaves it alone
    assert lights[2].name == "bulb"


def test_sunlight_has_no_range(lit):
    (light,) = lit({"type": "directional", "range": 8})
    assert light.range_m is None


def test_a_right_angle_that_passed_through_float32_is_a_legal_cone(lit):
    angle = float(np.float32(math.pi / 2))
    (light,) = lit({"type": "spot", "spot": {"outerConeAngle": angle}})
    assert light.outer_cone_rad == angle


@pytest.mark.parametrize(
    ("light", "pointer"),
    [
        ({}, ""),
        ({"type": "area"}, "/type"),
        ({"type": "point", "range": 0}, "/range"),
        ({"type": "point", "intensity": -1}, "/intensity"),
        ({"type": "point", "color": [1, 1]}, "/color"),
        ({"type": "spot", "spot": {"outerConeAngle": 1.6}}, "/spot/outerConeAngle"),
        ({"type": "spot", "spot": {"innerConeAngle": 0.8}}, "/spot"),
        ({"type": "spot", "spot": []}, "/spot"),
    ],
)
def test_a_light_out_of_range_is_refused_with_its_pointer(lit, light, pointer):
    with pytest.raises(AssetError) as caught:
        lit(light)
    assert caught.value.pointer == f"/extensions/{NAME}/lights/0{pointer}"


@pytest.mark.parametrize("reference", [{"light": 1}, {"light": -1}, {"light": "0"}, {}, []])
def test_a_reference_to_no_light_is_refused_with_its_pointer(triangle, reference):
    triangle.json["extensionsUsed"] = [NAME]
    triangle.json["extensions"] = {NAME: {"lights": [{"type": "point"}]}}
    triangle.json["nodes"][0]["extensions"] = {NAME: reference}
    with pytest.raises(AssetError) as caught:
        triangle.load().scene()
    assert caught.value.pointer.startswith(f"/nodes/0/extensions/{NAME}")


def test_a_light_on_a_node_without_extent_has_no_direction(lit):
    with pytest.raises(AssetError, match="shines nowhere"):
        lit({"type": "directional"}, scale=[0, 0, 0])
    (light,) = lit({"type": "point"}, scale=[0, 0, 0])
    assert np.linalg.norm(light.direction) == 1
