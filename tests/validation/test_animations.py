"""Animations: keyframes and what they move; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes
from small_meshes import (
    BUFFER,
    BYTE,
    FLOAT,
    POSITIONS,
    TIMES,
    UNSIGNED_INT,
    UNSIGNED_SHORT,
    accessor,
    animation,
    mesh,
    view,
)

SAMPLER, CHANNEL = "/animations/0/samplers/0", "/animations/0/channels/0"
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
TYPES = {"translation": "VEC3", "rotation": "VEC4", "scale": "VEC3", "weights": "SCALAR"}


def moved(
    path: str,
    values: dict[str, Any] | None = None,
    times: dict[str, Any] = TIMES,
    node: dict[str, Any] | None = None,
    targets: int = 2,
    **sampler: Any,
) -> dict[str, Any]:
    """Return an asset that moves a node, whose mesh has so many morph targets."""
    if values is None:
        values = accessor(TYPES[path], count=2 * targets if path == "weights" else 2)
    more = {"targets": [{"POSITION": 2}] * targets} if targets else {}
    return {
        "accessors": [times, values, POSITIONS],
        "animations": [animation(path, **sampler)],
        "meshes": [mesh({"POSITION": 2}, **more)],
        "nodes": [{"mesh": 0} if node is None else node],
    }


def told(codes: Codes, asset: dict[str, Any]) -> set[tuple[str, str | int | None]]:
    """Return what is said of animations."""
    return {(code, pointer) for code, pointer in codes(asset) if code.startswith("ANIMATION_")}


@pytest.mark.parametrize("path", TYPES)
def test_a_sound_animation_is_fine(codes: Codes, path: str) -> None:
    assert codes(moved(path)) == set()


@pytest.mark.parametrize(
    ("path", "values", "is_accepted"),
    [
        ("translation", accessor("VEC4", count=2), False),
        ("translation", accessor("VEC3", BYTE, 2, normalized=True), False),
        ("rotation", accessor("VEC4", BYTE, 2, normalized=True), True),
        ("rotation", accessor("VEC4", BYTE, 2), False),
        ("scale", accessor("SCALAR", count=2), False),
        ("weights", accessor("SCALAR", UNSIGNED_SHORT, 4, normalized=True), True),
        ("weights", accessor("SCALAR", UNSIGNED_INT, 4), False),
        ("weights", accessor("VEC2", count=4), False),
        ("somewhere", accessor("MAT2", BYTE, 7), True),
    ],
)
def test_values_have_a_format_of_their_path(
    codes: Codes, path: str, values: dict[str, Any], is_accepted: bool
) -> None:
    wrong = ("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT", f"{CHANNEL}/sampler")
    assert told(codes, moved(path, values)) == (set() if is_accepted else {wrong})


@pytest.mark.parametrize(
    ("path", "interpolation", "count"),
    [
        ("translation", "LINEAR", 2),
        ("translation", "STEP", 2),
        ("rotation", "CUBICSPLINE", 6),
        ("weights", "LINEAR", 4),
        ("weights", "CUBICSPLINE", 12),
    ],
)
def test_every_keyframe_has_its_values(codes: Codes, path: str, interpolation: str, count: int) -> None:
    values = accessor(TYPES[path], count=count)
    assert told(codes, moved(path, values, interpolation=interpolation)) == set()
    wrong = ("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT", f"{CHANNEL}/sampler")
    values["count"] += 1
    assert told(codes, moved(path, values, interpolation=interpolation)) == {wrong}


@pytest.mark.parametrize("times", [{"type": "VEC2"}, {"componentType": UNSIGNED_SHORT}])
def test_times_are_floats(codes: Codes, times: dict[str, Any]) -> None:
    bounds = {"min": [0] * 2, "max": [1] * 2} if times.get("type") == "VEC2" else {}
    found = told(codes, moved("scale", times={**TIMES, **times, **bounds}))
    assert found == {("ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", f"{SAMPLER}/input")}


@pytest.mark.parametrize("key", ["min", "max"])
def test_times_have_bounds(codes: Codes, key: str) -> None:
    times = {name: value for name, value in TIMES.items() if name != key}
    found = told(codes, moved("scale", times=times))
    assert found == {("ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS", f"{SAMPLER}/input")}


def test_a_cubic_spline_has_two_keyframes(codes: Codes) -> None:
    few = ("ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS", f"{SAMPLER}/input")
    once = {**TIMES, "count": 1}
    cubic = moved("scale", accessor(count=3), once, interpolation="CUBICSPLINE")
    assert told(codes, cubic) == {few}
    assert told(codes, moved("scale", accessor(count=1), once)) == set()


def test_keyframes_lie_without_gaps(codes: Codes) -> None:
    asset = moved("scale", accessor(count=2, bufferView=0))
    asset |= {"buffers": [BUFFER], "bufferViews": [view(byteStride=12)]}
    assert told(codes, asset) == {("ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE", f"{SAMPLER}/output")}
    asset["bufferViews"] = [view()]
    assert told(codes, asset) == set()


@pytest.mark.parametrize("path", ["translation", "rotation", "scale"])
def test_nodes_with_a_matrix_or_a_skin_do_not_move(codes: Codes, path: str) -> None:
    matrix = ("ANIMATION_CHANNEL_TARGET_NODE_MATRIX", f"{CHANNEL}/target")
    skin = ("ANIMATION_CHANNEL_TARGET_NODE_SKIN", f"{CHANNEL}/target/path")
    assert told(codes, moved(path, node={"mesh": 0, "matrix": IDENTITY})) == {matrix}
    asset = moved(path, node={"mesh": 0, "skin": 0}) | {"skins": [{"joints": [0]}]}
    assert told(codes, asset) == {skin}
    weighted = moved("weights", node={"mesh": 0, "skin": 0, "matrix": IDENTITY})
    assert told(codes, weighted | {"skins": [{"joints": [0]}]}) == set()


@pytest.mark.parametrize(("node", "targets"), [({}, 2), ({"mesh": 0}, 0), ({"mesh": 9}, 2)])
def test_weights_move_morph_targets(codes: Codes, node: dict[str, Any], targets: int) -> None:
    found = told(codes, moved("weights", accessor("SCALAR", count=2), node=node, targets=targets))
    assert found == {("ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS", f"{CHANNEL}/target")}


def channels(*targets: dict[str, Any]) -> dict[str, Any]:
    asset = moved("scale")
    asset["animations"][0]["channels"] = [{"sampler": 0, "target": target} for target in targets]
    return asset


def test_channels_of_the_same_property_are_told_at_the_earlier(codes: Codes) -> None:
    scale, translation = {"node": 0, "path": "scale"}, {"node": 0, "path": "translation"}
    duplicate = "ANIMATION_DUPLICATE_TARGETS"
    assert told(codes, channels(scale, translation)) == set()
    found = told(codes, channels(scale, translation, scale, scale))
    assert found == {(duplicate, f"/animations/0/channels/{position}/target") for position in (0, 2)}
    assert told(codes, channels({"path": "scale"}, {"path": "scale"})) == set()
    nowhere = {"node": 9, "path": "scale"}
    assert told(codes, channels(nowhere, nowhere)) == {(duplicate, f"{CHANNEL}/target")}


def test_pointers_are_no_paths_of_nodes(codes: Codes) -> None:
    extension = {"KHR_animation_pointer": {"pointer": "/nodes/0/scale"}}
    target = {"path": "pointer", "extensions": extension}
    asset = channels(target, target) | {"extensionsUsed": ["KHR_animation_pointer"]}
    asset["accessors"][1] = accessor("VEC3", FLOAT, 2)
    assert told(codes, asset) == set()


def test_a_broken_channel_takes_all_with_it(codes: Codes) -> None:
    asset = moved("scale", accessor("VEC2", count=5))
    asset["animations"][0]["channels"].append(5)
    assert told(codes, asset) == set()
