"""Inverse bind matrices of skins; expectations are the Khronos validator's."""

from __future__ import annotations

from typing import Any

import pytest
from judging import Codes
from small_meshes import BUFFER, FLOAT, SHORT, accessor, view

AT = "/skins/0/inverseBindMatrices"


def skinned(matrices: dict[str, Any], *joints: Any, **more: Any) -> dict[str, Any]:
    """Return an asset with a skin of these joints; nodes 1 and 2 hang below node 0."""
    skins = [{"joints": [*joints], "inverseBindMatrices": 0}]
    return {"accessors": [matrices], "skins": skins, "nodes": [{"children": [1, 2]}, {}, {}], **more}


def told(codes: Codes, asset: dict[str, Any]) -> set[str]:
    """Return the codes about the matrices."""
    return {code for code, pointer in codes(asset) if pointer == AT}


@pytest.mark.parametrize(
    ("matrices", "is_accepted"),
    [
        (accessor("MAT4"), True),
        (accessor("MAT3"), False),
        (accessor("MAT4", SHORT), False),
        (accessor("MAT4", FLOAT, normalized=True), False),
        (accessor("X"), False),
    ],
)
def test_matrices_are_four_by_four_floats(codes: Codes, matrices: dict[str, Any], is_accepted: bool) -> None:
    assert told(codes, skinned(matrices, 0)) == (set() if is_accepted else {"SKIN_IBM_INVALID_FORMAT"})


def test_every_joint_has_a_matrix(codes: Codes) -> None:
    assert told(codes, skinned(accessor("MAT4", count=3), 0, 1)) == set()
    assert told(codes, skinned(accessor("MAT4", count=2), 0, 1)) == set()
    assert told(codes, skinned(accessor("MAT4", count=1), 0, 1)) == {"INVALID_IBM_ACCESSOR_COUNT"}
    assert told(codes, skinned(accessor("MAT4", count=1), 0, 9)) == {"INVALID_IBM_ACCESSOR_COUNT"}


def test_matrices_lie_without_gaps(codes: Codes) -> None:
    matrices = accessor("MAT4", bufferView=0)
    strided = skinned(matrices, 0, buffers=[BUFFER], bufferViews=[view(byteStride=64)])
    assert told(codes, strided) == {"SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE"}
    packed = skinned(matrices, 0, buffers=[BUFFER], bufferViews=[view()])
    assert told(codes, packed) == set()
