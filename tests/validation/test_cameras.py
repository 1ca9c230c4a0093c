"""Cameras: planes, field of view, magnifications."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

Codes = Callable[..., set[tuple[str, str | int | None]]]

PERSPECTIVE, ORTHOGRAPHIC = "/cameras/0/perspective", "/cameras/0/orthographic"


def camera(kind: str, **part: Any) -> dict[str, Any]:
    return {"cameras": [{"type": kind, kind: part}]}


@pytest.mark.parametrize(("far", "is_told"), [(1, True), (0.5, True), (1.000000001, False)])
@pytest.mark.parametrize("kind", ["perspective", "orthographic"])
def test_the_far_plane_is_behind_the_near(kind: str, far: float, is_told: bool, codes: Codes) -> None:
    part = {"yfov": 1} if kind == "perspective" else {"xmag": 1, "ymag": 1}
    told = codes(camera(kind, znear=1, zfar=far, **part))
    assert told == ({("CAMERA_ZFAR_LEQUAL_ZNEAR", f"/cameras/0/{kind}")} if is_told else set())


def test_a_perspective_may_see_without_end(codes: Codes) -> None:
    assert codes(camera("perspective", yfov=1, znear=1)) == set()


@pytest.mark.parametrize(
    ("angle", "is_told"), [(math.pi, True), (4, True), (math.nextafter(math.pi, 0), False)]
)
def test_a_perspective_sees_less_than_half_of_all(angle: float, is_told: bool, codes: Codes) -> None:
    told = codes(camera("perspective", yfov=angle, znear=1))
    assert told == ({("CAMERA_YFOV_GEQUAL_PI", PERSPECTIVE)} if is_told else set())


def test_magnifications_are_above_0(codes: Codes) -> None:
    assert codes(camera("orthographic", xmag=1e-300, ymag=1, znear=0, zfar=1)) == set()
    assert codes(camera("orthographic", xmag=-0.0, ymag=-1e-9, znear=0, zfar=1)) == {
        ("CAMERA_XMAG_YMAG_ZERO", f"{ORTHOGRAPHIC}/xmag"),
        ("CAMERA_XMAG_YMAG_NEGATIVE", f"{ORTHOGRAPHIC}/ymag"),
    }
