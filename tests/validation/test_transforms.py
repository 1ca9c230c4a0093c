"""Transforms of nodes: unit rotations, and matrices that are products of translation, rotation, scale."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

Codes = Callable[..., set[tuple[str, str | int | None]]]

IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
NON_TRS = ("NODE_MATRIX_NON_TRS", "/nodes/0/matrix")
DEFAULT = ("NODE_MATRIX_DEFAULT", "/nodes/0/matrix")
NON_UNIT = ("ROTATION_NON_UNIT", "/nodes/0/rotation")


def node(**properties: Any) -> dict[str, Any]:
    return {"nodes": [{"extras": {}, **properties}]}


def matrix(**elements: float) -> dict[str, Any]:
    """Return a node with the identity but for some elements: m4=0.5."""
    changed = list(IDENTITY)
    for name, value in elements.items():
        changed[int(name[1:])] = value
    return node(matrix=changed)


@pytest.mark.parametrize(
    ("rotation", "is_told"),
    [
        ([0, 0, 0, 1], False),
        ([0, 0, 0, -1], False),
        ([0, 0, 0, 1 - 0.00768], False),
        ([0, 0, 0, 1 - 0.00770], True),
        ([0.5, 0.5, 0.5, 0.5152], False),
        ([0.5, 0.5, 0.5, 0.51522], True),
        ([0, 0, 0, 0], True),
    ],
)
def test_rotations_are_of_unit_length(rotation: list[float], is_told: bool, codes: Codes) -> None:
    assert codes(node(rotation=rotation)) == ({NON_UNIT} if is_told else set())


@pytest.mark.parametrize("value", [1, 1 + 5e-8, 1 - 2e-8])
def test_the_identity_is_needless_to_single_precision(value: float, codes: Codes) -> None:
    assert codes(matrix(m0=value, m1=-0.0)) == {DEFAULT}


def test_a_matrix_and_a_translation_exclude_each_other(codes: Codes) -> None:
    told = codes(node(matrix=[2, *IDENTITY[1:]], translation=[0, 0, 0]))
    assert told == {("NODE_MATRIX_TRS", "/nodes/0/matrix")}


TURNED = {"m0": math.cos(1), "m1": math.sin(1), "m4": -math.sin(1), "m5": math.cos(1)}


@pytest.mark.parametrize(
    "elements",
    [
        {"m0": 2, "m5": 3, "m10": 4},
        {"m0": -1},
        {"m0": -1, "m5": -1, "m10": -1},
        {"m12": 1e30},
        {"m0": 1e-30, "m5": 1e-30, "m10": 1e-30},
        TURNED,
        {name: 1000 * value for name, value in TURNED.items()} | {"m10": 1000},
        {name: round(value, 4) for name, value in TURNED.items()},
        {"m1": 0.99e-4},
    ],
)
def test_products_of_rotation_and_scale(elements: dict[str, float], codes: Codes) -> None:
    assert codes(matrix(**elements)) == set()


@pytest.mark.parametrize("scales", [(1, 0.001, 1), (100, 1, 1), (1000, 0.01, 1), (1000, 1000, 1000)])
def test_turned_boxes_written_to_six_decimals(scales: tuple[float, ...], codes: Codes) -> None:
    axes = [(2, 1, 2), (-2, 2, 1), (-1, -2, 2)]  # a rotation, times 3
    turned: list[float] = []
    for axis, scale in zip(axes, scales, strict=True):
        turned += [*(round(part * scale / 3, 6) for part in axis), 0]
    assert codes(node(matrix=[*turned, 0, 0, 0, 1])) == set()


@pytest.mark.parametrize(
    "elements",
    [
        {"m1": 0.5},
        {"m1": 1.01e-4},
        {"m6": -1.01e-4},
        {"m0": 0},
        {"m0": 0, "m5": 0, "m10": 0, "m15": 0},
        {"m3": 1},
        {"m3": 1e-30},
        {"m15": 2},
        {"m15": 1 + 1e-6},
        {"m12": 1e39},
        {"m0": 1e-50},
        # A shear of 45° counts however large the rest of the matrix is.
        {"m6": 1, "m0": 100, "m12": 100},
    ],
)
def test_what_is_no_such_product(elements: dict[str, float], codes: Codes) -> None:
    assert codes(matrix(**elements)) == {NON_TRS}
