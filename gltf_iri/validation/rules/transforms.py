"""A node's own transform: its matrix, or its translation, rotation and scale."""

from __future__ import annotations

import math
import struct
from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue
from gltf_iri.validation.tables import TABLES

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES", "has_transform"]

# How far from 1 a quaternion's length may be: found by bisection with the Khronos validator (2.0.0-dev.3.10).
# Rounding its components to signed bytes moves the length by as much.
LENGTH_TOLERANCE = 0.00769

# How far the end of an axis may lie from where a rotation and a scale would put it: the Khronos validator's
# bound, by bisection, for axes of length 1; longer ones are rounded in proportion.
AXIS_TOLERANCE = 5e-5

_TRS = ("translation", "rotation", "scale")
_LAST_ROW = (0.0, 0.0, 0.0, 1.0)


def rotation_is_of_unit_length(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A rotation is a quaternion of length 1."""
    if "rotation" in entry and abs(math.hypot(*entry["rotation"]) - 1) > LENGTH_TOLERANCE:
        yield issue("ROTATION_NON_UNIT", entry.at("rotation"))


def matrix_is_a_transform(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A matrix stands alone, is not the default, and is a product of translation, rotation and scale."""
    if "matrix" not in entry:
        return
    pointer = entry.at("matrix")
    if any(key in entry for key in _TRS):
        yield issue("NODE_MATRIX_TRS", pointer)
    matrix = _single(entry["matrix"])
    if matrix == _identity("matrix"):
        yield issue("NODE_MATRIX_DEFAULT", pointer)
    elif not _is_decomposable(matrix):
        yield issue("NODE_MATRIX_NON_TRS", pointer)


def has_transform(node: Entry) -> bool:
    """Tell whether the node moves, turns or scales what hangs on it."""
    return any(key in node and _single(node[key]) != _identity(key) for key in ("matrix", *_TRS))


def _identity(key: str) -> tuple[float, ...]:
    return tuple(TABLES["node"].fields[key].default)


def _single(values: list[float]) -> tuple[float, ...]:
    """Return the numbers as renderers keep them, in single precision; infinite where they do not fit."""
    try:
        return struct.unpack(f"{len(values)}f", struct.pack(f"{len(values)}f", *values))
    except OverflowError:
        return (math.inf,) * len(values)


def _is_decomposable(matrix: tuple[float, ...]) -> bool:
    if matrix[3::4] != _LAST_ROW or math.inf in matrix:
        return False
    x, y, z = matrix[0:3], matrix[4:7], matrix[8:11]
    if _dot(_cross(x, y), z) == 0:
        return False
    return all(_are_perpendicular(a, b) for a, b in ((x, y), (y, z), (z, x)))


def _are_perpendicular(a: tuple[float, ...], b: tuple[float, ...]) -> bool:
    """Tell whether the end of the shorter axis lies where a right angle to the longer one wants it.

    Half of the way is the longer one's to go. Decals are a thousand times flatter than wide and written to
    six decimals: seen from the longer axis, that would be no right angle.
    """
    longer = max(math.hypot(*a), math.hypot(*b))
    return abs(_dot(a, b)) / (2 * longer) <= AXIS_TOLERANCE * max(1, longer)


def _dot(a: tuple[float, ...], b: tuple[float, ...]) -> float:
    return sum(p * q for p, q in zip(a, b, strict=True))


def _cross(a: tuple[float, ...], b: tuple[float, ...]) -> tuple[float, ...]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


RULES: Rules = {"node": (rotation_is_of_unit_length, matrix_is_a_transform)}
