"""What targets of pointers may say beside them; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes

NAME = "KHR_animation_pointer"
TARGET = "/animations/0/channels/0/target"
PLACE = f"{TARGET}/extensions/{NAME}"
PATH = ("KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH", PLACE)
NODE = ("KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE", PLACE)


def told(codes: Codes, samplers: Any = None, **target: Any) -> set[tuple[str, Any]]:
    animation = {
        "channels": [
            {"sampler": 0, "target": {**target, "extensions": {NAME: {"pointer": "/nodes/0/scale"}}}}
        ],
        "samplers": [{"input": 0, "output": 1}] if samplers is None else samplers,
    }
    found = codes(
        {
            "extensionsUsed": [NAME],
            "nodes": [{}],
            "accessors": [
                {"componentType": 5126, "type": "SCALAR", "count": 1, "min": [0], "max": [0]},
                {"componentType": 5126, "type": "VEC3", "count": 1},
            ],
            "animations": [animation],
        }
    )
    return {(code, place) for code, place in found if place in {PLACE, f"{TARGET}/path", f"{TARGET}/node"}}


INCOMPLETE = ("INCOMPLETE_EXTENSION_SUPPORT", PLACE)


def test_beside_a_pointer_the_path_is_pointer(codes: Codes) -> None:
    assert told(codes, path="pointer") == {INCOMPLETE}
    assert told(codes, path="scale") == {INCOMPLETE, PATH}
    assert told(codes, path="elsewhere") == {INCOMPLETE, PATH, ("VALUE_NOT_IN_LIST", f"{TARGET}/path")}
    assert told(codes) == {INCOMPLETE, PATH}


@pytest.mark.parametrize(
    ("node", "others"),
    [
        (0, {NODE}),
        (9, {("UNRESOLVED_REFERENCE", f"{TARGET}/node")}),
        (-1, {("INVALID_INDEX", f"{TARGET}/node")}),
    ],
)
def test_beside_a_pointer_there_is_no_node(codes: Codes, node: int, others: set[tuple[str, str]]) -> None:
    assert told(codes, path="pointer", node=node) == {INCOMPLETE, *others}


def test_without_samplers_there_are_no_channels(codes: Codes) -> None:
    assert told(codes, path="pointer", node=0, samplers=[5]) == {INCOMPLETE}
