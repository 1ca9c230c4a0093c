"""Punctual lights; expectations are the Khronos validator's."""

from __future__ import annotations

import math
from typing import Any

import pytest
from judging import Codes

NAME = "KHR_lights_punctual"
LIGHT = f"/extensions/{NAME}/lights/0"
SPOT = f"{LIGHT}/spot"


def of(*lights: Any, **more: Any) -> dict[str, Any]:
    return {"extensionsUsed": [NAME], "extensions": {NAME: {"lights": list(lights)}}, **more}


def node(light: Any) -> dict[str, Any]:
    return {"extensions": {NAME: light}}


@pytest.mark.parametrize(
    "light",
    [
        {"type": "point"},
        {"type": "point", "range": 1, "color": [1, 1, 1], "intensity": 1e9, "name": "sun"},
        {"type": "directional", "intensity": 0},
        {"type": "spot", "spot": {}, "range": 1},
        {"type": "spot", "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.2}},
    ],
)
def test_sound_lights_are_not_spoken_of(codes: Codes, light: dict[str, Any]) -> None:
    assert codes(of(light)) == set()


@pytest.mark.parametrize(
    ("light", "told"),
    [
        ({}, {("UNDEFINED_PROPERTY", LIGHT)}),
        ({"type": "area"}, {("VALUE_NOT_IN_LIST", f"{LIGHT}/type")}),
        ({"type": "spot"}, {("UNDEFINED_PROPERTY", LIGHT)}),
        ({"type": "point", "spot": {}}, {("EXTRA_PROPERTY", SPOT)}),
        ({"spot": {}}, {("UNDEFINED_PROPERTY", LIGHT), ("EXTRA_PROPERTY", SPOT)}),
        ({"type": "area", "spot": {}}, {("VALUE_NOT_IN_LIST", f"{LIGHT}/type"), ("EXTRA_PROPERTY", SPOT)}),
        ({"type": "directional", "range": 1}, {("EXTRA_PROPERTY", f"{LIGHT}/range")}),
        ({"type": "directional", "range": 0}, {("VALUE_NOT_IN_RANGE", f"{LIGHT}/range")}),
        ({"type": "spot", "spot": 5}, {("TYPE_MISMATCH", SPOT)}),
        ({"type": "point", "color": [1, 1, 2]}, {("VALUE_NOT_IN_RANGE", f"{LIGHT}/color/2")}),
        ({"type": "point", "intensity": -1}, {("VALUE_NOT_IN_RANGE", f"{LIGHT}/intensity")}),
    ],
)
def test_a_light_states_what_its_type_reads(
    codes: Codes, light: dict[str, Any], told: set[tuple[str, str]]
) -> None:
    assert codes(of(light)) == told


@pytest.mark.parametrize(
    ("spot", "speaks"),
    [
        ({"innerConeAngle": math.pi / 4}, True),
        ({"innerConeAngle": 0.8}, True),
        ({"innerConeAngle": 0.5, "outerConeAngle": 0.5}, True),
        ({"innerConeAngle": 0.5, "outerConeAngle": 0.4}, True),
        ({"innerConeAngle": 0.5}, False),
        ({"innerConeAngle": 0.5, "outerConeAngle": 0.6}, False),
        # An angle that is broken is told of already.
        ({"innerConeAngle": 0.8, "outerConeAngle": -1}, False),
        ({"innerConeAngle": "a", "outerConeAngle": 0.1}, False),
    ],
)
def test_a_cone_widens(codes: Codes, spot: dict[str, Any], speaks: bool) -> None:
    issue = ("KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES", f"{SPOT}/outerConeAngle")
    assert (issue in codes(of({"type": "spot", "spot": spot}))) == speaks
    assert issue not in codes(of({"type": "point", "spot": spot}))


@pytest.mark.parametrize(
    ("key", "sound", "broken"),
    [
        ("innerConeAngle", (0, math.nextafter(math.pi / 2, 0)), (-0.1, math.pi / 2)),
        (
            "outerConeAngle",
            (1e-9, math.pi / 2),
            (0, -0.1, math.nextafter(math.pi / 2, 2), 1.5707963705062866),
        ),
    ],
)
def test_angles_open_to_a_right_angle(
    codes: Codes, key: str, sound: tuple[float, ...], broken: tuple[float, ...]
) -> None:
    issue = ("VALUE_NOT_IN_RANGE", f"{SPOT}/{key}")
    for angle in sound:
        assert issue not in codes(of({"type": "spot", "spot": {key: angle}}))
    for angle in broken:
        assert issue in codes(of({"type": "spot", "spot": {key: angle}}))


def test_a_node_names_a_light_of_the_list(codes: Codes) -> None:
    place = f"/nodes/0/extensions/{NAME}"
    assert codes(of({"type": "point"}, nodes=[node({"light": 0})])) == set()
    assert codes(of({"type": "point"}, nodes=[node({"light": 1})])) == {
        ("UNRESOLVED_REFERENCE", f"{place}/light")
    }
    assert codes(of({"type": "point"}, nodes=[node({})])) == {("UNDEFINED_PROPERTY", place)}


@pytest.mark.parametrize(("light", "broken"), [({"light": 0}, set()), ({}, {"UNDEFINED_PROPERTY"})])
def test_without_a_list_no_light_is_looked_for(codes: Codes, light: dict[str, Any], broken: set[str]) -> None:
    place = f"/nodes/0/extensions/{NAME}"
    told = codes({"extensionsUsed": [NAME], "nodes": [node(light)]})
    assert told == {(code, place) for code in {"UNSATISFIED_DEPENDENCY", *broken}}
