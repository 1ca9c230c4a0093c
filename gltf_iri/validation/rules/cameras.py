"""Cameras: what they see, and between which distances."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gltf_iri.validation.codes import issue

if TYPE_CHECKING:
    from collections.abc import Iterator

    from gltf_iri.validation.asset import Asset
    from gltf_iri.validation.entry import Entry
    from gltf_iri.validation.issue import Issue
    from gltf_iri.validation.rules.registry import Rules

__all__ = ["RULES"]


def far_is_behind_near(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """The far plane lies behind the near one."""
    if "zfar" in entry and "znear" in entry and entry["zfar"] <= entry["znear"]:
        yield issue("CAMERA_ZFAR_LEQUAL_ZNEAR", entry.pointer)


def field_of_view_is_below_half_a_turn(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A perspective sees less than a half space."""
    if entry.get("yfov", 0) >= math.pi:
        yield issue("CAMERA_YFOV_GEQUAL_PI", entry.pointer)


def magnifications_are_positive(entry: Entry, asset: Asset) -> Iterator[Issue]:
    """A magnification of 0 cannot be divided by, a negative one mirrors."""
    for key in ("xmag", "ymag"):
        magnification = entry.get(key, 1)
        if magnification == 0:
            yield issue("CAMERA_XMAG_YMAG_ZERO", entry.at(key))
        elif magnification < 0:
            yield issue("CAMERA_XMAG_YMAG_NEGATIVE", entry.at(key))


RULES: Rules = {
    "camera.perspective": (far_is_behind_near, field_of_view_is_below_half_a_turn),
    "camera.orthographic": (far_is_behind_near, magnifications_are_positive),
}
